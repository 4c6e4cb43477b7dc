// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"
#include "visibility.h"

namespace sigs {

// How each planned video's intruder is seen, estimated without drawing it (outlook.h); in order, none where what its project names cannot be opened, or after cancel. Looks at up to
// `frames` frames of each.
[[nodiscard]] std::vector<std::optional<Visibility>> views_of(const std::vector<const PlannedVideo*>& videos, int frames,
                                                             const std::atomic<bool>* cancel);

}  // namespace sigs
