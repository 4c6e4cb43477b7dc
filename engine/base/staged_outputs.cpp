// SPDX-License-Identifier: MIT
#include "base/staged_outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include "base/file_lock.h"
#include "base/paths.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::array<int, 3> kBlockedSignals{SIGHUP, SIGINT, SIGTERM};

// A signal handler can use only global data. Blocking the signals of one thread would not do: a signal to the process
// goes to any thread that does not block it.
struct BlockedSignals {
  std::mutex mutex;
  int blockers = 0;
  std::array<struct sigaction, kBlockedSignals.size()> before{};
  // The thread that a signal was sent to, else kToProcess; 0: the signal has not come.
  std::array<std::atomic<pid_t>, kBlockedSignals.size()> pending{};
};
BlockedSignals blocked_signals;
constexpr pid_t kToProcess = -1;

void note_signal(int signal, siginfo_t* info, void*) {
  const bool to_thread = info != nullptr && info->si_code == SI_TKILL;
  const pid_t wanted = to_thread ? static_cast<pid_t>(syscall(SYS_gettid)) : kToProcess;
  for (std::size_t i = 0; i < kBlockedSignals.size(); ++i)
    if (kBlockedSignals[i] == signal) blocked_signals.pending[i] = wanted;
}

// Sends a deferred signal to whom it was sent: the process, which has a thread take it that does not block it, or one
// thread. raise(3) would send it to the thread that happens to end last, where it may be blocked for good.
void send_again(int signal, pid_t wanted) {
  if (wanted == kToProcess || syscall(SYS_tgkill, getpid(), wanted, signal) != 0) kill(getpid(), signal);
}

// Defers SIGHUP, SIGINT and SIGTERM during its life, whichever thread they are delivered to; afterwards they act as
// they would have, where they would have. Several may live at once, also in several threads.
class SignalBlocker {
 public:
  SignalBlocker() {
    const std::lock_guard lock(blocked_signals.mutex);
    if (blocked_signals.blockers++ > 0) return;
    struct sigaction action {};
    action.sa_sigaction = note_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART | SA_SIGINFO;
    for (std::size_t i = 0; i < kBlockedSignals.size(); ++i)
      sigaction(kBlockedSignals[i], &action, &blocked_signals.before[i]);
  }
  ~SignalBlocker() {
    const std::lock_guard lock(blocked_signals.mutex);
    if (--blocked_signals.blockers > 0) return;
    for (std::size_t i = 0; i < kBlockedSignals.size(); ++i)
      sigaction(kBlockedSignals[i], &blocked_signals.before[i], nullptr);
    for (std::size_t i = 0; i < kBlockedSignals.size(); ++i)
      if (const pid_t wanted = blocked_signals.pending[i].exchange(0); wanted != 0)
        send_again(kBlockedSignals[i], wanted);
  }
  SignalBlocker(const SignalBlocker&) = delete;
  SignalBlocker& operator=(const SignalBlocker&) = delete;
};

constexpr const char* kTaken = "exists already; --force overwrites it";

Error refused(const fs::path& path, const std::string& what) {
  return {path.string(), what, ErrorKind::cannot_create};
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::file_type type_of(const fs::path& path) {
  std::error_code code;
  return fs::symlink_status(path, code).type();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

bool make_empty_file(const fs::path& path) {
  return Descriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)).is_open();
}

// Number of attempts: other processes may take or free a name between two steps of ours.
constexpr int kTries = 3;

}  // namespace

Result<fs::path> StagedOutputs::add_file(const fs::path& final_path) {
  return add({.final_path = final_path, .kind = Kind::file});
}

Result<fs::path> StagedOutputs::add_folder(const fs::path& final_path, MayReplace may_replace) {
  return add({.final_path = final_path, .kind = Kind::folder, .may_replace = std::move(may_replace)});
}

// A symbolic link itself may be replaced, the file that it points to is not.
Result<void> StagedOutputs::check_free(const Output& output) const {
  const fs::path& path = output.final_path;
  const fs::file_type type = type_of(path);
  if (type == fs::file_type::not_found) return {};
  if (existing_ == Existing::refuse) return fail(refused(path, kTaken));
  std::error_code code;
  if (output.kind == Kind::file) {
    if (fs::is_directory(path, code)) return fail(refused(path, "is a folder; a file is to be written"));
    if (type != fs::file_type::regular && type != fs::file_type::symlink)
      return fail(refused(path, "is no file that could be replaced; choose another name"));
    return {};
  }
  if (type != fs::file_type::directory && type != fs::file_type::symlink)
    return fail(refused(path, "is a file; a folder is to be written"));
  return output.may_replace ? output.may_replace(path) : Result<void>();
}

Result<StagingFolder*> StagedOutputs::staging_beside(const fs::path& final_path) {
  const fs::path folder = folder_of(final_path);
  for (const auto& staging : stagings_)
    if (staging->folder() == folder) return staging.get();
  std::error_code code;
  if (!fs::is_directory(folder, code)) return fail(refused(folder, "no such folder to write into"));
  Result<StagingFolder> created = StagingFolder::create(folder);
  if (!created) return fail(created.error());
  return stagings_.emplace_back(std::make_unique<StagingFolder>(std::move(*created))).get();
}

Result<fs::path> StagedOutputs::add(Output output) {
  if (const Result<void> free = check_free(output); !free) return fail(free.error());
  const Result<StagingFolder*> staging = staging_beside(output.final_path);
  if (!staging) return fail(staging.error());
  output.staging = *staging;
  const fs::path staged = output.staged();
  const bool created = output.kind == Kind::file ? make_empty_file(staged) : mkdir(staged.c_str(), 0777) == 0;
  if (!created && errno == EEXIST) return fail(refused(output.final_path, "is the name of two outputs"));
  if (!created) return fail(refused(output.final_path, std::string("cannot be created: ") + std::strerror(errno)));
  if (output.staging->is_staged_elsewhere(output.final_path.filename()))
    return fail(refused(output.final_path, "is being written by another process"));
  outputs_.push_back(std::move(output));
  return staged;
}

// The older output is examined at its backup place, where no other process changes it.
Result<void> StagedOutputs::replace(Output& output) const {
  const std::error_code code = replace_with_backup(output.staged(), output.final_path, output.backup());
  if (code == std::errc::state_not_recoverable) output.placed = Placed::instead;
  if (code) return fail(output.final_path.string(), "cannot be replaced: " + code.message(), ErrorKind::write_failed);
  output.placed = Placed::instead;
  const fs::file_type type = type_of(output.backup());
  if (type == fs::file_type::symlink) return {};
  if (output.kind == Kind::file && type == fs::file_type::regular) return {};
  if (output.kind == Kind::folder && type == fs::file_type::directory)
    return output.may_replace ? output.may_replace(output.backup()) : Result<void>();
  return fail(refused(output.final_path, "is no longer what it was when the work began; choose another name"));
}

Result<void> StagedOutputs::place(Output& output) const {
  std::error_code code;
  for (int tries = 0; tries < kTries; ++tries) {
    code = rename_new(output.staged(), output.final_path);
    if (!code) output.placed = Placed::as_new;
    if (code != std::errc::file_exists) break;
    if (existing_ == Existing::refuse) return fail(refused(output.final_path, kTaken));
    const Result<void> step = replace(output);
    const bool is_gone = output.placed == Placed::no && type_of(output.final_path) == fs::file_type::not_found;
    if (step || !is_gone) return step;
  }
  if (!code) return {};
  return fail(output.final_path.string(), "cannot be given its final name: " + code.message(), ErrorKind::write_failed);
}

// An older output that cannot be put back is named in the error and stays on the disk.
Error StagedOutputs::undo_all(Error error) {
  error = with_final_names(std::move(error));
  for (auto last = outputs_.rbegin(); last != outputs_.rend(); ++last) {
    Output& output = *last;
    std::error_code code;
    if (output.placed == Placed::as_new) code = rename_new(output.final_path, output.staged());
    if (output.placed == Placed::instead && type_of(output.final_path) == fs::file_type::not_found)
      code = rename_new(output.backup(), output.final_path);
    else if (output.placed == Placed::instead)
      code = replace_with_backup(output.backup(), output.final_path, output.staged());
    if (code && output.placed == Placed::instead) {
      output.staging->leave_on_disk();
      error.what +=
          fmt::format("; the older {} lies at {}", output.final_path.filename().string(), output.backup().string());
    }
    output.placed = Placed::no;
  }
  return error;
}

Result<void> StagedOutputs::flush_names() const {
  for (const auto& staging : stagings_)
    if (const Result<void> step = flush(staging->folder()); !step) return step;
  return {};
}

Result<void> StagedOutputs::commit() {
  for (const Output& output : outputs_) {
    const Result<void> step = output.kind == Kind::file ? flush(output.staged()) : flush_all(output.staged());
    if (!step) return fail(with_final_names(step.error()));
  }
  {
    const SignalBlocker blocker;
    for (Output& output : outputs_)
      if (const Result<void> step = place(output); !step) return fail(undo_all(step.error()));
  }
  const Result<void> flushed = flush_names();
  for (Output& output : outputs_) output.staging = nullptr;
  stagings_.clear();
  return flushed;
}

void StagedOutputs::take(StagedOutputs other) {
  std::ranges::move(other.stagings_, std::back_inserter(stagings_));
  std::ranges::move(other.outputs_, std::back_inserter(outputs_));
}

std::vector<fs::path> StagedOutputs::final_paths() const {
  std::vector<fs::path> paths;
  for (const Output& output : outputs_) paths.push_back(output.final_path);
  return paths;
}

Error StagedOutputs::with_final_names(Error error) const {
  for (const Output& output : outputs_) {
    if (output.staging == nullptr) continue;
    for (const fs::path& place : {output.staged(), output.backup()}) {
      error.where = replaced(std::move(error.where), place.string(), output.final_path.string());
      error.what = replaced(std::move(error.what), place.string(), output.final_path.string());
    }
  }
  return error;
}

namespace {

StagedOutputs::Existing existing(bool overwrite) {
  return overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse;
}

}  // namespace

Result<TemporaryFile> TemporaryFile::create(fs::path final_path, bool overwrite) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> temporary_path = outputs.add_file(final_path);
  if (!temporary_path) return fail(temporary_path.error());
  return TemporaryFile(std::move(final_path), std::move(*temporary_path), std::move(outputs));
}

Result<TemporaryFile> TemporaryFile::create_folder(fs::path final_path, bool overwrite,
                                                   StagedOutputs::MayReplace may_replace) {
  StagedOutputs outputs(existing(overwrite));
  Result<fs::path> temporary_path = outputs.add_folder(final_path, std::move(may_replace));
  if (!temporary_path) return fail(temporary_path.error());
  return TemporaryFile(std::move(final_path), std::move(*temporary_path), std::move(outputs));
}

TemporaryFile::TemporaryFile(fs::path final_path, fs::path temporary_path, StagedOutputs outputs)
    : final_(std::move(final_path)), temporary_path_(std::move(temporary_path)), outputs_(std::move(outputs)) {}

CreatedFolders::~CreatedFolders() {
  std::error_code code;
  for (auto last = created_.rbegin(); last != created_.rend(); ++last)
    fs::remove(*last, code);  // refused where not empty
}

Result<void> CreatedFolders::make(const fs::path& folder) {
  fs::path part;
  for (const fs::path& name : folder) {
    part /= name;
    std::error_code code;
    if (fs::create_directory(part, code)) created_.push_back(fs::absolute(part, code));
    if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  }
  return {};
}

Result<void> write_text(const fs::path& path, std::string_view text, bool overwrite) {
  Result<TemporaryFile> file = TemporaryFile::create(path, overwrite);
  if (!file) return fail(file.error());
  std::ofstream out(file->temporary_path(), std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
    return fail(path.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return file->commit();
}

}  // namespace sigs
