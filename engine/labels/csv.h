// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "labels/labels.h"

namespace sigs {

// A row for each intruder and frame (RFC 4180: commas, quotes, CRLF), seen or not: what the SIGS XML file has, with the
// same digits; empty where there is no box. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_csv(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
