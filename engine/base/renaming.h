// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <system_error>

namespace sigs {

// Renaming that never replaces what was there before. Errors are those of rename(2).

// Gives a file or folder a name that is free. Error file_exists: it is not. Where the file system does not know
// renameat2(2)'s RENAME_NOREPLACE, a file gets the name by link(2), which does not replace either; only where there are
// no hard links too (FAT) the name is looked at and then taken.
[[nodiscard]] std::error_code rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

// What has the name `to` lies at `aside` afterwards, what had the name `from` at `to`. Both must be there, `aside`
// must be free, all on one file system. At every moment something whole has the name `to`, but for folders where the
// file system does not know RENAME_EXCHANGE (NFS): there two renames follow each other. On an error all is as before;
// where not even that is possible, the error is state_not_recoverable and the older one lies at `aside`.
[[nodiscard]] std::error_code replace_with_backup(const std::filesystem::path& from, const std::filesystem::path& to,
                                                  const std::filesystem::path& aside);

}  // namespace sigs
