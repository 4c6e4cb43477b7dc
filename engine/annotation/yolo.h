// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// YOLO folder: one text file a picture, data.yaml. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_yolo(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
