// SPDX-License-Identifier: MIT
#include "editor/document/recovery.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/staged_outputs.h"
#include "editor/document/mask_painting.h"
#include "project/fields.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;

std::string stamp_of_this_editor() {
  const auto start = std::chrono::system_clock::now().time_since_epoch();
  return fmt::format("editor-{}-{}", ::getpid(), std::chrono::duration_cast<std::chrono::nanoseconds>(start).count());
}

// Files of an editor: its project, the mask beside it, its lock.
bool is_recovery_file(const fs::path& path) {
  const bool is_part = path.stem().extension() == ".part";
  return path.extension() == ".json" && path.filename().string().starts_with("editor-") && !is_part;
}

fs::path mask_of(const fs::path& recovery_file) {
  return fs::path(recovery_file).replace_extension(".mask.png");
}

fs::path lock_of(const fs::path& recovery_file) {
  return fs::path(recovery_file).replace_extension(".lock");
}

// The number in "editor-NUMBER-TIME.json"; none: it is no such name.
std::optional<pid_t> process_of(const fs::path& recovery_file) {
  int number = 0;
  if (std::sscanf(recovery_file.stem().c_str(), "editor-%d-", &number) != 1 || number <= 0) return std::nullopt;
  return number;
}

// The lock is let go of when its process ends, however that happens. Where the file system has no locks, the process
// itself is looked for.
bool is_abandoned(const fs::path& recovery_file) {
  std::error_code code;
  if (!fs::exists(lock_of(recovery_file), code)) return true;
  const Descriptor lock = open_for_lock(lock_of(recovery_file), LockFile::must_be_there);
  if (!lock.is_open()) return false;
  const LockAnswer answer = try_lock(lock);
  if (answer != LockAnswer::unavailable) return answer == LockAnswer::held;
  const std::optional<pid_t> process = process_of(recovery_file);
  return process && ::kill(*process, 0) != 0 && errno == ESRCH;
}

// A file that is not there has neither size nor time.
Json json_of(const FileStamp& stamp) {
  if (!stamp.exists) return Json::object();
  return {{"bytes", stamp.bytes}, {"changed_ns", stamp.changed.time_since_epoch() / std::chrono::nanoseconds(1)}};
}

std::optional<FileStamp> stamp_from(const Json& json, const fs::path& path) {
  if (!json.is_object()) return std::nullopt;
  FileStamp stamp{.path = path};
  const auto bytes = json.find("bytes");
  const auto changed = json.find("changed_ns");
  if (bytes == json.end() || changed == json.end() || !bytes->is_number_unsigned() || !changed->is_number_integer())
    return stamp;
  stamp.bytes = bytes->get<std::uintmax_t>();
  stamp.changed = fs::file_time_type(std::chrono::nanoseconds(changed->get<std::int64_t>()));
  stamp.exists = true;
  return stamp;
}

std::string text_of_recovery(const Document& document, const fs::path& mask_file, const MaskToKeep& mask) {
  const Project& project = document.whole();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  Json json;
  json["sigs_recovery"] = kFormat;
  json["file"] = project.file.empty() ? std::string() : fs::absolute(project.file).lexically_normal().string();
  json["file_as_read"] = json_of(document.file_stamp());
  json["name"] = project.name;
  json["written_unix_s"] = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  if (!mask_file.empty()) {
    json["mask"] = mask_file.filename().string();
    json["mask_has_strokes"] = mask.has_strokes;
    json["mask_camera"] = mask.camera;
  }
  json["project"] = text_of(project);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct RecoveryContent {
  AbandonedProject head;
  std::string project;
  fs::path mask_file;  // "": none
  bool mask_has_strokes = false;
  std::size_t mask_camera = 0;
  std::optional<FileStamp> as_read;
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
  if (const auto stamp = json.find("file_as_read"); stamp != json.end())
    content.as_read = stamp_from(*stamp, content.head.project_file);
  // Beside the file, wherever a name that was tampered with may point.
  if (const fs::path mask = fs::path(text_at("mask")).filename(); !mask.empty())
    content.mask_file = file.parent_path() / mask;
  content.mask_has_strokes = json.value("mask_has_strokes", Json(false)) == Json(true);
  if (const auto camera = json.find("mask_camera"); camera != json.end() && camera->is_number_unsigned())
    content.mask_camera = camera->get<std::size_t>();
  content.head.has_mask = !content.mask_file.empty();
  return content;
}

AbandonedProject abandoned_at(const fs::path& file) {
  const Result<RecoveryContent> content = read_recovery(file);
  if (content) return content->head;
  return {.recovery_file = file, .name = file.filename().string(), .problem = content.error().what};
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
    if (is_recovery_file(it->path()) && is_abandoned(it->path())) found.push_back(abandoned_at(it->path()));
  }
  std::ranges::sort(found, [](const AbandonedProject& a, const AbandonedProject& b) {
    if (a.problem.empty() != b.problem.empty()) return a.problem.empty();
    return a.written_unix_s != b.written_unix_s ? a.written_unix_s > b.written_unix_s
                                                : a.recovery_file < b.recovery_file;
  });
  return found;
}

void discard(const AbandonedProject& abandoned) {
  if (!is_abandoned(abandoned.recovery_file)) return;
  std::error_code code;
  const Result<RecoveryContent> content = read_recovery(abandoned.recovery_file);
  fs::remove(abandoned.recovery_file, code);
  if (content && !content->mask_file.empty()) fs::remove(content->mask_file, code);
  fs::remove(mask_of(abandoned.recovery_file), code);
  fs::remove(lock_of(abandoned.recovery_file), code);
}

Recovery::Recovery(fs::path folder) : folder_(std::move(folder)), file_(folder_ / (stamp_of_this_editor() + ".json")) {}

Recovery::~Recovery() {
  std::error_code code;
  if (lock_.is_open() && !written_) fs::remove(lock_of(file_), code);
}

Result<void> Recovery::hold_lock() {
  if (lock_.is_open()) return {};
  std::error_code code;
  fs::create_directories(folder_, code);
  if (code)
    return fail(folder_.string(), fmt::format("cannot be created: {}; unsaved changes are not kept", code.message()),
                ErrorKind::cannot_create);
  Descriptor lock = open_for_lock(lock_of(file_), LockFile::made_where_missing);
  if (!lock.is_open())
    return fail(folder_.string(), std::string("cannot be written: ") + std::strerror(errno), ErrorKind::cannot_create);
  if (try_lock(lock) == LockAnswer::taken)
    return fail(lock_of(file_).string(), "is locked by another editor", ErrorKind::cannot_create);
  lock_ = std::move(lock);
  return {};
}

// The mask first: the file that names it follows it, and what it no longer names goes last.
Result<void> Recovery::write(const Document& document, const MaskToKeep& mask) {
  if (const Result<void> held = hold_lock(); !held) return held;
  const fs::path mask_file = mask.state != 0 ? mask_of(file_) : fs::path();
  const bool lies_there = mask_file_ == mask_file && kept_mask_ == mask.state;
  if (mask.state != 0 && !lies_there)
    if (const Result<void> done = write_mask(mask.pixels, mask_file, true); !done) return done;
  const std::string text = text_of_recovery(document, mask_file, mask);
  if (const Result<void> done = write_text(file_, text, true); !done) return done;
  remove_mask_other_than(mask_file);
  written_ = true;
  kept_revision_ = document.state().number;
  kept_mask_ = mask.state;
  waiting_since_s_.reset();
  return {};
}

void Recovery::remove_mask_other_than(const fs::path& kept) noexcept {
  std::error_code code;
  if (!mask_file_.empty() && mask_file_ != kept) fs::remove(mask_file_, code);
  mask_file_ = kept;
}

std::optional<Error> Recovery::keep(const Document& document, double now_s, double delay_s, const MaskToKeep& mask) {
  if (mask.is_changing) return std::nullopt;
  if (!document.has_unsaved_changes() && mask.state == 0) {
    forget();
    return std::nullopt;
  }
  if (written_ && kept_revision_ == document.state().number && kept_mask_ == mask.state) {
    waiting_since_s_.reset();
    return std::nullopt;
  }
  if (!waiting_since_s_) waiting_since_s_ = now_s;
  if (now_s - *waiting_since_s_ < delay_s) return std::nullopt;
  const Result<void> done = write(document, mask);
  if (done) {
    error_reported_ = false;
    return std::nullopt;
  }
  waiting_since_s_ = now_s;
  if (std::exchange(error_reported_, true)) return std::nullopt;
  return done.error();
}

void Recovery::forget() {
  waiting_since_s_.reset();
  if (!written_) return;
  std::error_code code;
  fs::remove(file_, code);
  remove_mask_other_than({});
  written_ = false;
  kept_mask_ = 0;
}

Result<RecoveredProject> Recovery::take_over(const AbandonedProject& abandoned) {
  const Result<RecoveryContent> content = read_recovery(abandoned.recovery_file);
  if (!content) return fail(content.error());
  Result<ReadProject> read = parse_project(content->project, abandoned.project_file);
  if (!read) return fail(read.error());
  if (const Result<void> held = hold_lock(); !held) return fail(held.error());
  if (!is_abandoned(abandoned.recovery_file))
    return fail(abandoned.recovery_file.string(), "is in use by another editor", ErrorKind::cannot_read);
  std::error_code code;
  fs::rename(abandoned.recovery_file, file_, code);
  if (code)
    return fail(abandoned.recovery_file.string(), "cannot be taken over: " + code.message(), ErrorKind::cannot_read);
  fs::remove(lock_of(abandoned.recovery_file), code);
  written_ = true;
  kept_revision_ = kept_mask_ = 0;
  mask_file_ = content->mask_file;
  RecoveredProject recovered{.read = std::move(*read), .as_read = content->as_read};
  if (!content->head.project_file.empty()) {
    // An editor that ended between saving and noting it has written these bytes itself.
    const FileStamp present = stamp_of(content->head.project_file);
    const Result<std::string> saved = read_text(content->head.project_file);
    if (saved && *saved == content->project) recovered.as_read = present;
  }
  if (mask_file_.empty()) return recovered;
  Result<cv::Mat> mask = read_mask(mask_file_);
  if (mask)
    recovered.mask = RecoveredMask{std::move(*mask), content->mask_has_strokes, content->mask_camera};
  else
    recovered.mask_problem = mask.error().text();
  return recovered;
}

}  // namespace sigs::editor
