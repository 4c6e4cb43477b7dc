// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "cli/detect_inputs.h"
#include "performance/observations.h"

namespace sigs::cli {

// What sigs evaluate performance and sigs risk read: labels with one detector's results, and what datasets know beyond.
struct PerformanceInputs {
  DetectSources sources;
  PerformancePolicy policy;
  std::string declare = "3/5";
  std::vector<std::filesystem::path> empty;  // videos without aircraft, whose results lie in the same folder
  std::filesystem::path calibration;         // empty: of a dataset its projects' own
};

struct ReadPerformance {
  PerformancePolicy policy;  // with what --declare says
  std::vector<PerformanceClip> clips;
  Observations observations;
};

// A JSON file. Errors: those of reading it, bad_data.
[[nodiscard]] Result<Json> json_of_file(const std::filesystem::path& file);

// Errors usage, cannot_read, bad_data.
[[nodiscard]] Result<ReadPerformance> read_performance(const PerformanceInputs& inputs);

}  // namespace sigs::cli
