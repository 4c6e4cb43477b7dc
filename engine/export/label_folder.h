// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "labels/labels.h"

namespace sigs {

// Whether a relative path is one of a pattern of LabelFormat::files.
[[nodiscard]] bool fits(std::string_view path, std::string_view pattern);

// A folder of labels is replaced whole. Error cannot_create where it holds a file that the format does not write, which
// is somebody's own. A folder that is not there is none such.
[[nodiscard]] Result<void> check_label_folder(const std::filesystem::path& folder, const LabelFormat& format);

}  // namespace sigs
