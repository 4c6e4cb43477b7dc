// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "evaluation/reports/report_files.h"
#include "performance/risk.h"
#include "plot/plot.h"

namespace sigs {

// The result of a simulation of risk, for people and for programs.

// All settings and figures, NaN as null. A shard of several has its batches too, which risk_shard_of() reads.
[[nodiscard]] Json risk_json(const RiskSettings& settings, const RiskResult& result);

// What a run of one shard wrote.
struct RiskShard {
  Json settings;
  int shard = 1;
  int shards = 1;
  std::vector<RiskBatch> batches;
};
// Errors bad_data that name the member.
[[nodiscard]] Result<RiskShard> risk_shard_of(const Json& json, const std::string& file);

// All shards as one run: the JSON that it would have written. Errors bad_data: other settings, a shard that is missing
// or twice.
[[nodiscard]] Result<Json> merged_risk_json(const std::vector<RiskShard>& shards,
                                            const std::vector<std::string>& files);

// A result in JSON as a table, and with its sentences as text. It must be of risk_json() or merged_risk_json(), or have
// passed check_risk_json().
[[nodiscard]] std::vector<TableColumn> risk_table(const Json& json);
[[nodiscard]] std::string risk_text(const Json& json);

// Whether a file's content is such a result. Error bad_data.
[[nodiscard]] Result<void> check_risk_json(const Json& json, const std::string& file);

// Ratios by class, with their intervals.
[[nodiscard]] Plot risk_plot(const Json& json);

}  // namespace sigs
