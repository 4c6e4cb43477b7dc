// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// Airborne Object Tracking ground truth JSON: range, side of the horizon. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_aot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
