// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "evaluation/metrics/aot_rules.h"

namespace sigs::cli {

// `sigs evaluate detect --rules aot`: a groundtruth.json and a result.json of the Airborne Object Tracking challenge,
// by that challenge's own rules.
//   folder  where the report goes; empty: nowhere
[[nodiscard]] Result<void> evaluate_by_aot_rules(const std::vector<std::filesystem::path>& truth,
                                                 const std::vector<std::filesystem::path>& results,
                                                 const AotPolicy& policy, const std::filesystem::path& folder,
                                                 bool force);

}  // namespace sigs::cli
