// SPDX-License-Identifier: MIT
#include "encounter_model/encounter_model.h"

#include <cmath>

#include "base/ensure.h"
#include "encounter_model/model_flight.h"
#include "fuzz/fuzz_input.h"

namespace sigs::fuzz {

namespace {

void check_network(const CountNetwork& network) {
  for (const CountTable& table : network.tables)
    for (const double count : table.counts) ENSURE(std::isfinite(count) && count >= 0);
}

}  // namespace

void try_encounter_model(const FuzzInput& input) {
  const Result<EncounterModel> model = encounter_model_of(input.bytes, "model.txt");
  if (!model) return check_message(model.error());
  check_messages(model->warnings);
  ENSURE(model->initial.tables.size() == model->variables.size());
  check_network(model->initial);
  check_network(model->transition);
  if (const Result<void> flies = check_can_fly(*model); !flies) return check_message(flies.error());
  Random random(1);
  const ModelFlight flight = drawn_flight(*model, {.duration_s = 5}, random);
  ENSURE(flight.points.size() == 6);
}

}  // namespace sigs::fuzz
