// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/result.h"

namespace sigs {

// Names of files and folders: which are allowed, what a folder contains, and which names mean the same file; flushing
// to the disk, and renaming without losing the older file.

// Says why a text cannot be the name of a file or folder; empty where it can. The name must have 1 to 200 bytes
// (extensions are appended to it, and file systems allow 255), no slash, no control character and no dot at its
// beginning.
[[nodiscard]] std::string file_name_error(const std::string& name);

// The extension with its dot, letters A to Z in lower case: ".png" for "A.PNG"; empty where there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

// Paths of what a folder contains, sorted by name (bytes compared), so that no result depends on the file system. Does
// not descend into folders in it. Error cannot_read. Throws std::bad_alloc, where libstdc++'s iterator of a folder ends
// the program.
[[nodiscard]] Result<std::vector<std::filesystem::path>> folder_contents(const std::filesystem::path& folder);

// Whether the path names a folder or a symbolic link to one. False where it cannot be examined.
[[nodiscard]] bool is_folder(const std::filesystem::path& path);

// The one spelling of a path, also where nothing exists under it yet: absolute, symbolic links followed, no slash at
// the end.
[[nodiscard]] std::filesystem::path canonical_path(const std::filesystem::path& path);

// The same, but without following a symbolic link at the path itself: identifies the name, not what it points to.
[[nodiscard]] std::filesystem::path canonical_name(const std::filesystem::path& path);

// Whether `path` is the folder or lies in it, at any depth. Compares spellings: both must come from canonical_path() or
// canonical_name().
[[nodiscard]] bool is_at_or_below(const std::filesystem::path& path, const std::filesystem::path& folder);

// Checks that no output replaces a file that the same run reads. An existing output is refused where it is one of the
// inputs or a folder that contains one: under its own name, through symbolic links, or through a second name (hard
// link) of the same file. Empty paths and inputs that do not exist are ignored.
//   reader  who reads the inputs, for the message: "is read by this command"
// Error cannot_create, which names the output and the input.
[[nodiscard]] Result<void> check_inputs_not_overwritten(const std::vector<std::filesystem::path>& outputs,
                                                        const std::vector<std::filesystem::path>& inputs,
                                                        std::string_view reader = "command");

// The last step of writing files safely: wait until they are on the disk, then rename them without losing what had the
// name before.

// Waits until a file, or the list of names in a folder, is on the disk, so that a power cut cannot undo it (fsync(2)).
// Counts as done where the file system does not support it. Error write_failed.
[[nodiscard]] Result<void> flush(const std::filesystem::path& file);

// The same for a folder with all folders and files in it, at any depth. Error write_failed.
[[nodiscard]] Result<void> flush_all(const std::filesystem::path& folder);

// Renames a file or folder to a name that nothing has. Errors are those of rename(2), and file_exists where the name is
// taken. Where the file system does not support renameat2(2) with RENAME_NOREPLACE, a file is renamed by link(2) and
// unlink(2), which do not replace either; only where there are no hard links too (FAT) the name is first tested and
// then taken, which another process could come between.
[[nodiscard]] std::error_code rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

// Renames `from` to `to` and what had that name to `backup`. `from` and `to` must exist, `backup` must not; all three
// lie on one file system. A complete file or folder has the name `to` at every moment, except for folders on file
// systems without RENAME_EXCHANGE (NFS): there two renames follow each other.
// On an error everything is as before. Where that too is impossible, the error is state_not_recoverable and the older
// file lies at `backup`.
[[nodiscard]] std::error_code replace_with_backup(const std::filesystem::path& from, const std::filesystem::path& to,
                                                  const std::filesystem::path& backup);

// A file or folder as it lies on disk at one moment. What was made from it is out of date once its stamp is another
// one: a file's changes when it is written, a folder's when something in it appears or disappears.
struct FileStamp {
  std::filesystem::path path;  // "": none is named
  std::uintmax_t bytes = 0;    // 0 for a folder
  std::filesystem::file_time_type changed;
  bool exists = false;

  [[nodiscard]] bool operator==(const FileStamp&) const = default;
};

// The present stamp; exists is false where the path cannot be examined or is empty. Asks the file system.
[[nodiscard]] inline FileStamp stamp_of(const std::filesystem::path& path) {
  FileStamp stamp{.path = path};
  if (path.empty()) return stamp;
  std::error_code code;
  stamp.bytes = std::filesystem::file_size(path, code);
  if (code) stamp.bytes = 0;
  stamp.changed = std::filesystem::last_write_time(path, code);
  stamp.exists = !code;
  if (code) stamp.changed = {};
  return stamp;
}

}  // namespace sigs
