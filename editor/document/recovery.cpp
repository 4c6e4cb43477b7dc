// SPDX-License-Identifier: MIT
#include "editor/document/recovery.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/partial_file.h"
#include "project/json_reading.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;

std::string stamp_of_this_editor() {
  const auto start = std::chrono::system_clock::now().time_since_epoch();
  return "editor-" + std::to_string(::getpid()) + "-" +
         std::to_string(std::chrono::duration_cast<std::chrono::nanoseconds>(start).count());
}

fs::path lock_of(const fs::path& recovery_file) {
  return fs::path(recovery_file).replace_extension(".lock");
}

// -1 where another one holds it. The system lets go of a lock when its process ends, however that happens.
int locked(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | flags, 0600);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

bool is_abandoned(const fs::path& recovery_file) {
  std::error_code code;
  if (!fs::exists(lock_of(recovery_file), code)) return true;
  const int lock = locked(lock_of(recovery_file), 0);
  if (lock >= 0) ::close(lock);
  return lock >= 0;
}

std::string text_of_recovery(const Project& project) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  Json json;
  json["sigs_recovery"] = kFormat;
  json["file"] = project.file.empty() ? std::string() : fs::absolute(project.file).lexically_normal().string();
  json["name"] = project.name;
  json["written_unix_s"] = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  json["project"] = text_of(project);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct RecoveryContent {
  AbandonedProject head;
  std::string project;
};

Result<RecoveryContent> read_recovery(const fs::path& file) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  const Result<Json> parsed = parsed_json(*text, file.string(), ErrorKind::bad_data);
  const Json json = parsed ? *parsed : Json();
  const auto text_at = [&](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (!json.is_object() || json.value("sigs_recovery", Json()) != Json(kFormat))
    return fail(file.string(), "is no recovery file of this program");
  RecoveryContent content{{.recovery_file = file, .project_file = text_at("file"), .name = text_at("name")},
                          text_at("project")};
  if (const auto time = json.find("written_unix_s"); time != json.end() && time->is_number_integer())
    content.head.written_unix_s = time->get<std::int64_t>();
  return content;
}

}  // namespace

fs::path recovery_folder() {
  if (const char* folder = std::getenv("XDG_STATE_HOME"); folder != nullptr && *folder != '\0')
    return fs::path(folder) / "sigs/recovery";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : ".") / ".local/state/sigs/recovery";
}

std::vector<AbandonedProject> abandoned_projects(const fs::path& folder) {
  std::vector<AbandonedProject> found;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const fs::path& path = it->path();
    const bool is_part = path.stem().extension() == ".part";
    if (path.extension() != ".json" || is_part || !is_abandoned(path)) continue;
    if (const Result<RecoveryContent> content = read_recovery(path)) found.push_back(content->head);
  }
  std::sort(found.begin(), found.end(), [](const AbandonedProject& a, const AbandonedProject& b) {
    return a.written_unix_s != b.written_unix_s ? a.written_unix_s > b.written_unix_s
                                                : a.recovery_file < b.recovery_file;
  });
  return found;
}

void discard(const AbandonedProject& abandoned) {
  if (!is_abandoned(abandoned.recovery_file)) return;
  std::error_code code;
  fs::remove(abandoned.recovery_file, code);
  fs::remove(lock_of(abandoned.recovery_file), code);
}

Recovery::Recovery(fs::path folder) : folder_(std::move(folder)), file_(folder_ / (stamp_of_this_editor() + ".json")) {}

Recovery::~Recovery() {
  if (lock_ < 0) return;
  std::error_code code;
  if (!written_) fs::remove(lock_of(file_), code);
  ::close(lock_);
}

Result<void> Recovery::hold_lock() {
  if (lock_ >= 0) return {};
  std::error_code code;
  fs::create_directories(folder_, code);
  if (code)
    return fail(folder_.string(), "cannot be created: " + code.message() + "; unsaved changes are not kept",
                ErrorKind::cannot_create);
  lock_ = locked(lock_of(file_), O_CREAT);
  if (lock_ < 0)
    return fail(folder_.string(), std::string("cannot be written: ") + std::strerror(errno), ErrorKind::cannot_create);
  return {};
}

Result<void> Recovery::write(const Document& document) {
  if (const Result<void> held = hold_lock(); !held) return held;
  if (const Result<void> done = write_text(file_, text_of_recovery(document.project()), true); !done) return done;
  written_ = true;
  kept_revision_ = document.revision().number;
  waiting_since_s_.reset();
  return {};
}

std::optional<Error> Recovery::keep(const Document& document, double now_s, double delay_s) {
  if (!document.has_unsaved_changes()) {
    forget();
    return std::nullopt;
  }
  if (written_ && kept_revision_ == document.revision().number) {
    waiting_since_s_.reset();
    return std::nullopt;
  }
  if (!waiting_since_s_) waiting_since_s_ = now_s;
  if (now_s - *waiting_since_s_ < delay_s) return std::nullopt;
  const Result<void> done = write(document);
  if (done) {
    told_ = false;
    return std::nullopt;
  }
  waiting_since_s_ = now_s;
  if (std::exchange(told_, true)) return std::nullopt;
  return done.error();
}

void Recovery::forget() {
  waiting_since_s_.reset();
  if (!written_) return;
  std::error_code code;
  fs::remove(file_, code);
  written_ = false;
}

Result<ReadProject> Recovery::take_over(const AbandonedProject& abandoned) {
  const Result<RecoveryContent> content = read_recovery(abandoned.recovery_file);
  if (!content) return fail(content.error());
  Result<ReadProject> read = parse_project(content->project, abandoned.project_file);
  if (!read) return read;
  if (const Result<void> held = hold_lock(); !held) return fail(held.error());
  if (!is_abandoned(abandoned.recovery_file))
    return fail(abandoned.recovery_file.string(), "is in use by another editor", ErrorKind::cannot_read);
  std::error_code code;
  fs::rename(abandoned.recovery_file, file_, code);
  if (code)
    return fail(abandoned.recovery_file.string(), "cannot be taken over: " + code.message(), ErrorKind::cannot_read);
  fs::remove(lock_of(abandoned.recovery_file), code);
  written_ = true;
  kept_revision_ = 0;
  return read;
}

}  // namespace sigs::editor
