// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// Pascal VOC folder: one XML file a picture. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_voc(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
