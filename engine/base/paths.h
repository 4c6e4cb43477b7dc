// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// Names of files and folders: which are allowed, what a folder contains, and which names mean the same file.

// Says why a text cannot be the name of a file or folder; empty where it can. The name must have 1 to 200 bytes
// (extensions are appended to it, and file systems allow 255), no slash, no control character and no dot at its
// beginning.
[[nodiscard]] std::string file_name_error(const std::string& name);

// The extension with its dot, letters A to Z in lower case: ".png" for "A.PNG"; empty where there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

// Paths of what a folder contains, sorted by name (bytes compared), so that no result depends on the file system. Does
// not descend into folders in it. Error cannot_read.
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

}  // namespace sigs
