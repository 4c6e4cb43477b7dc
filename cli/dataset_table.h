// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/claim.h"
#include "dataset/plan.h"

namespace sigs::cli {

// What a plan would make, a line a video, columns aligned: name, split, background, aircraft, flight, frames, and what
// was drawn for any of them; the last line is the sum.
[[nodiscard]] Result<std::string> table_of(const Plan& plan, const Shard& shard);

}  // namespace sigs::cli
