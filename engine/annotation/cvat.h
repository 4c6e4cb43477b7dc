// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// CVAT for video XML 1.1: a track for each intruder. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_cvat(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
