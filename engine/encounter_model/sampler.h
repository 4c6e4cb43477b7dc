// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/random.h"
#include "encounter_model/encounter_model.h"

namespace sigs {

// Drawing from a model. All of it is sums and products of numbers of the file and of Random, so that a seed gives
// the same bits on every machine.

// The state of an aircraft at a second, by variable.
struct ModelState {
  std::vector<int> bins;       // from 0
  std::vector<double> values;  // in the file's units; of a category the number of its bin, from 1

  [[nodiscard]] bool operator==(const ModelState&) const = default;
};

// The bins at the first second: each variable in the network's order, given the bins of its parents, with the counts as
// probabilities. A configuration of the parents that was never counted gives all bins of the variable with equal
// probability. One random number for each variable.
[[nodiscard]] std::vector<int> initial_bins(const EncounterModel& model, Random& random);

// The bins a second later. Variables without a successor (\dot v has one, L and v have none in the published models)
// keep theirs. In a configuration of the parents that was never counted a variable keeps its bin too, as in the prior
// of the published program that lets nothing change.
[[nodiscard]] std::vector<int> next_bins(const EncounterModel& model, const std::vector<int>& bins, Random& random);

// A value of a bin: uniform within it; exactly 0 in the zero bin, of a category the bin's number from 1. No random
// number is taken for these two.
[[nodiscard]] double value_in_bin(const ModelVariable& variable, int bin, Random& random);

// The state at the first second: initial_bins(), then a value of each in the order of the variables.
[[nodiscard]] ModelState initial_state(const EncounterModel& model, Random& random);

// The state a second later: next_bins(), then for each variable in order: another value where its bin has changed;
// where it has not, another value of the same bin with the probability resample_rate, else the same value. A random
// number decides that for each unchanged variable whose rate is above 0.
[[nodiscard]] ModelState next_state(const EncounterModel& model, const ModelState& state, Random& random);

}  // namespace sigs
