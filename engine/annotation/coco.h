// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// COCO instances JSON: run-length masks, video and track ids, own body as crowd region. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_coco(const std::filesystem::path& path,
                                                             const LabelSequence& sequence);

}  // namespace sigs
