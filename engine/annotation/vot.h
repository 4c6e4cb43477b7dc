// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// VOT folder: sequence, groundtruth.txt, list.txt. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_vot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
