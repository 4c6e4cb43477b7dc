// SPDX-License-Identifier: MIT
#include "performance/sensor_model.h"

#include <cmath>

#include "base/ensure.h"
#include "base/json.h"
#include "fuzz/fuzz_input.h"
#include "performance/risk.h"

namespace sigs::fuzz {

namespace {

void fly(const SensorModel& sensor) {
  for (const double range_m : {0.0, 1.0, 500.0, 1e7}) {
    const double share = sensor.probability(range_m, HorizonSide::below, 1);
    ENSURE(share >= 0 && share <= 1);
  }
  if (sensor.rate_hz > 100) return;  // very many steps
  RiskSettings settings{.sensor = sensor};
  settings.encounters.lead_s = 5;
  settings.encounters.after_s = 1;
  for (std::int64_t number = 0; number < 3; ++number) {
    const Result<FlownOutcome> outcome = flown_encounter(settings, number, {});
    ENSURE(outcome && std::isfinite(outcome->weight));
  }
}

void try_model(const std::string& text) {
  const Result<SensorModel> model = sensor_model_of(text, "sensor.json");
  if (!model) return check_message(model.error());
  fly(*model);
  const Result<SensorModel> again = sensor_model_of(sensor_model_json(*model), "sensor.json");
  ENSURE(again && again->range_m.size() == model->range_m.size());
}

void try_risk(const std::string& text) {
  const Result<Json> json = parsed_json(text, "risk.json", ErrorKind::bad_data);
  if (!json) return check_message(json.error());
  if (const Result<void> good = check_risk_json(*json, "risk.json"); !good) check_message(good.error());
  const Result<RiskShard> shard = risk_shard_of(*json, "risk.json");
  if (!shard) return check_message(shard.error());
  if (const Result<Json> merged = merged_risk_json({*shard}, {"risk.json"}); !merged) check_message(merged.error());
}

}  // namespace

void try_sensor_model(const FuzzInput& input) {
  const std::string text(input.bytes);
  try_model(text);
  try_risk(text);
  const Result<Logic> logic = logic_table(text, "rules.csv");
  if (!logic) return check_message(logic.error());
  ENSURE((*logic)({.bearing_rad = 0.1}));
}

}  // namespace sigs::fuzz
