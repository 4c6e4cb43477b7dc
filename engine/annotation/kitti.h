// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// KITTI tracking folder: label_02, calib. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_kitti(const std::filesystem::path& path,
                                                              const LabelSequence& sequence);

}  // namespace sigs
