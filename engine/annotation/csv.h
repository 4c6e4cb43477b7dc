// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// one row for each intruder and frame. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_csv(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
