// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <system_error>

#include "base/result.h"

namespace sigs {

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

}  // namespace sigs
