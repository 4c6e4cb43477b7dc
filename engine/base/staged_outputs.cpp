// SPDX-License-Identifier: MIT
#include "base/staged_outputs.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ranges>
#include <string>
#include <system_error>
#include <utility>

#include "base/descriptor.h"
#include "base/flush.h"
#include "base/renaming.h"
#include "base/signal_blocker.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

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

// A name may change its owner between two looks at it.
constexpr int kTries = 3;

}  // namespace

Result<fs::path> StagedOutputs::add_file(const fs::path& final_path) {
  return add({.final_path = final_path, .kind = Kind::file});
}

Result<fs::path> StagedOutputs::add_folder(const fs::path& final_path, MayReplace may_replace) {
  return add({.final_path = final_path, .kind = Kind::folder, .may_replace = std::move(may_replace)});
}

// What a symbolic link names is never replaced, but the link itself may be.
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
  Result<StagingFolder> made = StagingFolder::create(folder);
  if (!made) return fail(made.error());
  return stagings_.emplace_back(std::make_unique<StagingFolder>(std::move(*made))).get();
}

Result<fs::path> StagedOutputs::add(Output output) {
  if (const Result<void> free = check_free(output); !free) return fail(free.error());
  const Result<StagingFolder*> staging = staging_beside(output.final_path);
  if (!staging) return fail(staging.error());
  output.staging = *staging;
  const fs::path staged = output.staged();
  const bool made = output.kind == Kind::file ? make_empty_file(staged) : mkdir(staged.c_str(), 0777) == 0;
  if (!made && errno == EEXIST) return fail(refused(output.final_path, "is the name of two outputs"));
  if (!made) return fail(refused(output.final_path, std::string("cannot be created: ") + std::strerror(errno)));
  if (output.staging->is_staged_elsewhere(output.final_path.filename()))
    return fail(refused(output.final_path, "is being written by another process"));
  outputs_.push_back(std::move(output));
  return staged;
}

// What is replaced is looked at where nobody else reaches it.
Result<void> StagedOutputs::replace(Output& output) const {
  const std::error_code code = replace_with_backup(output.staged(), output.final_path, output.aside());
  if (code == std::errc::state_not_recoverable) output.placed = Placed::instead;
  if (code) return fail(output.final_path.string(), "cannot be replaced: " + code.message(), ErrorKind::write_failed);
  output.placed = Placed::instead;
  const fs::file_type type = type_of(output.aside());
  if (type == fs::file_type::symlink) return {};
  if (output.kind == Kind::file && type == fs::file_type::regular) return {};
  if (output.kind == Kind::folder && type == fs::file_type::directory)
    return output.may_replace ? output.may_replace(output.aside()) : Result<void>();
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

// What cannot be undone is told, and stays on the disk.
Error StagedOutputs::undo_all(Error error) {
  error = with_final_names(std::move(error));
  for (Output& output : outputs_ | std::views::reverse) {
    std::error_code code;
    if (output.placed == Placed::as_new) code = rename_new(output.final_path, output.staged());
    if (output.placed == Placed::instead && type_of(output.final_path) == fs::file_type::not_found)
      code = rename_new(output.aside(), output.final_path);
    else if (output.placed == Placed::instead)
      code = replace_with_backup(output.aside(), output.final_path, output.staged());
    if (code && output.placed == Placed::instead) {
      output.staging->leave_on_disk();
      error.what += "; the older " + output.final_path.filename().string() + " lies at " + output.aside().string();
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
    const SignalBlocker held;
    for (Output& output : outputs_)
      if (const Result<void> step = place(output); !step) return fail(undo_all(step.error()));
  }
  const Result<void> flushed = flush_names();
  for (Output& output : outputs_) output.staging = nullptr;
  stagings_.clear();
  return flushed;
}

std::vector<fs::path> StagedOutputs::final_paths() const {
  std::vector<fs::path> paths;
  for (const Output& output : outputs_) paths.push_back(output.final_path);
  return paths;
}

Error StagedOutputs::with_final_names(Error error) const {
  for (const Output& output : outputs_) {
    if (output.staging == nullptr) continue;
    for (const fs::path& place : {output.staged(), output.aside()}) {
      error.where = replaced(std::move(error.where), place.string(), output.final_path.string());
      error.what = replaced(std::move(error.what), place.string(), output.final_path.string());
    }
  }
  return error;
}

}  // namespace sigs
