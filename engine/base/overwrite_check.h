// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// An output may replace an older one, but nothing that the same run reads. Error cannot_create, naming both, where an
// output that is there is one of the inputs or a folder that holds one: by its own name, at the end of symbolic links,
// or by a second name (hard link) of the same file. Empty paths and inputs that are not there are none. reader: what
// reads them, for the message.
[[nodiscard]] Result<void> check_inputs_not_overwritten(const std::vector<std::filesystem::path>& outputs,
                                                        const std::vector<std::filesystem::path>& inputs,
                                                        std::string_view reader = "command");

// Whether a place is the folder or lies in it. Both as canonical_path() gives them.
[[nodiscard]] bool is_at_or_below(const std::filesystem::path& place, const std::filesystem::path& folder);

// One spelling for one place, also where it is not there yet: absolute, symbolic links followed, no slash at the end.
[[nodiscard]] std::filesystem::path canonical_path(const std::filesystem::path& path);

// The same, but a link at the path itself is not followed: the place of the name.
[[nodiscard]] std::filesystem::path canonical_name(const std::filesystem::path& path);

}  // namespace sigs
