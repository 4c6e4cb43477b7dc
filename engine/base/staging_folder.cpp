// SPDX-License-Identifier: MIT
#include "base/staging_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_lock.h"
#include "base/input_file.h"
#include "base/paths.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kBeginning = ".sigs-";
constexpr std::string_view kPattern = "XXXXXX";
constexpr const char* kUnfinishedLock = "lock.part";

Error not_created(const fs::path& folder) {
  const bool is_full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  return {folder.string(), std::string("cannot be written into: ") + std::strerror(errno),
          is_full ? ErrorKind::write_failed : ErrorKind::cannot_create};
}

// The text of the lock file. It names the machine, because some file systems keep locks to each machine alone.
std::string lock_text() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return std::string("SIGS staging folder; it goes when its run ends\nhost ") + host.data() + "\n";
}

bool is_staging_name(const std::string& name) {
  return name.size() == kBeginning.size() + kPattern.size() && name.starts_with(kBeginning);
}

std::vector<fs::path> staging_folders_in(const fs::path& folder) {
  std::vector<fs::path> found = folder_contents(folder).value_or(std::vector<fs::path>());
  std::erase_if(found, [](const fs::path& path) { return !is_staging_name(path.filename().string()); });
  return found;
}

bool is_private_folder(const fs::path& path) {
  struct stat state {};
  return lstat(path.c_str(), &state) == 0 && S_ISDIR(state.st_mode) && state.st_uid == geteuid() &&
         (state.st_mode & 0777) == 0700;
}

// The lock file of a staging folder; not open where it is not a staging folder of this user and machine.
Descriptor opened_lock(const fs::path& staging) {
  if (!is_private_folder(staging)) return {};
  Descriptor lock = open_for_lock(staging / "lock", LockFile::must_be_there);
  if (!lock.is_open()) return lock;
  const std::string expected = lock_text();
  std::string text(expected.size() + 1, '\0');
  const ssize_t read = pread(lock.number(), text.data(), text.size(), 0);
  if (read != static_cast<ssize_t>(expected.size()) || !text.starts_with(expected)) return {};
  return lock;
}

// Removes a file, or a folder with its contents. Has one folder open at a time, at any depth.
void remove_tree(const fs::path& path) {
  if (unlink(path.c_str()) == 0) return;
  struct stat state {};
  if (lstat(path.c_str(), &state) != 0 || !S_ISDIR(state.st_mode)) return;
  if (const Result<std::vector<fs::path>> inside = folder_contents(path))
    for (const fs::path& one : *inside) remove_tree(one);
  rmdir(path.c_str());
}

// Removes the lock last, so that the next run can complete a removal that was killed.
void remove_staging(const fs::path& staging) {
  remove_tree(staging / "new");
  remove_tree(staging / "old");
  unlink((staging / kUnfinishedLock).c_str());
  unlink((staging / "lock").c_str());
  rmdir(staging.c_str());
}

// Removes what a run left that was killed before the folder had its lock file, or after it had it no more: an empty
// folder, or one with the beginning of a lock file and nothing else. Where that run is alive it begins anew.
void remove_unfinished_staging(const fs::path& staging) {
  if (!is_private_folder(staging)) return;
  const Result<std::vector<fs::path>> inside = folder_contents(staging);
  if (!inside || inside->size() > 1 || (inside->size() == 1 && inside->front() != staging / kUnfinishedLock)) return;
  if (!inside->empty()) {
    const Result<std::string> text = read_text(inside->front());
    if (!text || !lock_text().starts_with(*text)) return;
    unlink(inside->front().c_str());
  }
  rmdir(staging.c_str());
}

// Gives the outputs in old/ their names back, where the run was killed before the newer ones took those names. False:
// some could not be put back.
bool put_back_older(const fs::path& staging) {
  std::error_code code;
  if (!fs::exists(fs::symlink_status(staging / "old", code))) return true;
  const Result<std::vector<fs::path>> older = folder_contents(staging / "old");
  if (!older) return false;
  for (const fs::path& one : *older)
    if (code = rename_new(one, staging.parent_path() / one.filename()); code && code != std::errc::file_exists)
      return false;
  return true;
}

}  // namespace

void remove_abandoned_staging(const fs::path& folder) {
  for (const fs::path& staging : staging_folders_in(folder)) {
    remove_unfinished_staging(staging);
    const Descriptor lock = opened_lock(staging);
    if (!lock.is_open() || try_lock(lock) != LockAnswer::held || !is_named(lock, staging / "lock")) continue;
    if (put_back_older(staging)) remove_staging(staging);
  }
}

Result<StagingFolder> StagingFolder::create(const fs::path& folder) {
  constexpr int kStagingTries = 20;  // other runs may take a folder without a lock file for one that was left behind
  remove_abandoned_staging(folder);
  for (int i = 1;; ++i) {
    Descriptor spare(open("/", O_PATH | O_CLOEXEC));
    if (!spare.is_open()) return fail(not_created(folder));
    std::string path = (folder / std::string(kBeginning).append(kPattern)).string();
    if (mkdtemp(path.data()) == nullptr) return fail(not_created(folder));
    StagingFolder staging(folder, path, std::move(spare));
    if (staging.begin()) return staging;
    const Error error = not_created(folder);
    if (errno != ENOENT || i == kStagingTries) return fail(error);
  }
}

StagingFolder::StagingFolder(fs::path folder, fs::path path, Descriptor spare)
    : folder_(std::move(folder)), path_(std::move(path)), spare_(std::move(spare)) {}

StagingFolder::StagingFolder(StagingFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      path_(std::exchange(other.path_, {})),
      stays_(other.stays_),
      lock_(std::move(other.lock_)),
      spare_(std::move(other.spare_)) {}

StagingFolder::~StagingFolder() {
  remove();
}

// The lock file gets its name when it has its text and is locked: with that name, and a free lock, the folder counts as
// left behind.
bool StagingFolder::begin() {
  constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const fs::path unfinished = path_ / kUnfinishedLock;
  lock_ = Descriptor(open(unfinished.c_str(), kFlags, 0600));
  if (!lock_.is_open()) return false;
  static_cast<void>(try_lock(lock_));  // where there are no locks, other runs leave the folder alone
  const std::string text = lock_text();
  return write(lock_.number(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
         rename(unfinished.c_str(), (path_ / "lock").c_str()) == 0 && mkdir((path_ / "new").c_str(), 0700) == 0 &&
         mkdir((path_ / "old").c_str(), 0700) == 0;
}

bool StagingFolder::is_staged_elsewhere(const fs::path& name) const {
  for (const fs::path& other : staging_folders_in(folder_)) {
    if (other == path_) continue;
    std::error_code code;
    const Descriptor lock = open_for_lock(other / "lock", LockFile::must_be_there);
    if (lock.is_open() && is_locked_by_another(lock) && fs::exists(fs::symlink_status(other / "new" / name, code)))
      return true;
  }
  return false;
}

void StagingFolder::leave_on_disk() noexcept {
  stays_ = true;
  unlink((path_ / "lock").c_str());
}

void StagingFolder::remove() noexcept {
  if (path_.empty() || stays_) return;
  spare_.reset();
  try {
    remove_staging(path_);
  } catch (const std::exception&) {  // no memory for the names in it: the next run removes the folder
  }
}

}  // namespace sigs
