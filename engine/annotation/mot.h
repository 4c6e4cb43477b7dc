// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "annotation/labels.h"

namespace sigs {

// MOTChallenge folder: gt.txt, seqinfo.ini, seqmaps. docs/label-formats.md.
[[nodiscard]] Result<std::unique_ptr<LabelWriter>> open_mot(const std::filesystem::path& path,
                                                            const LabelSequence& sequence);

}  // namespace sigs
