// SPDX-License-Identifier: MIT
#include "encounter_model/sampler.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/ensure.h"

namespace sigs {

namespace {

// Counts of the bins, given those of the parents.
std::span<const double> counts_given(const CountTable& table, const std::vector<int>& bins,
                                     const std::vector<CountTable>& tables,
                                     const std::vector<ModelVariable>& variables) {
  std::size_t configuration = 0;
  std::size_t stride = 1;
  for (const int parent : table.parents) {
    const auto at = static_cast<std::size_t>(parent);
    configuration += stride * static_cast<std::size_t>(bins[at]);
    stride *= static_cast<std::size_t>(at < variables.size() ? variables[at].bins : tables[at].bins);
  }
  const auto size = static_cast<std::size_t>(table.bins);
  return std::span(table.counts).subspan(configuration * size, size);
}

// A bin with the probability of its count. `never_counted`: the answer where all counts are 0.
//   share  of [0, 1)
int drawn_bin(std::span<const double> counts, double share, int never_counted) {
  const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
  if (total <= 0) return never_counted;
  const double target = share * total;
  double sum = 0;
  int last = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    if (counts[bin] <= 0) continue;
    sum += counts[bin];
    last = static_cast<int>(bin);
    if (target < sum) return last;
  }
  return last;  // the product may have been rounded up to the total
}

}  // namespace

std::vector<int> initial_bins(const EncounterModel& model, Random& random) {
  std::vector<int> bins(model.variables.size(), 0);
  for (const int variable : model.initial.order) {
    const CountTable& table = model.initial.tables[static_cast<std::size_t>(variable)];
    const double share = random.uniform();
    const int any = std::min(static_cast<int>(share * table.bins), table.bins - 1);
    bins[static_cast<std::size_t>(variable)] =
        drawn_bin(counts_given(table, bins, model.initial.tables, model.variables), share, any);
  }
  return bins;
}

std::vector<int> next_bins(const EncounterModel& model, const std::vector<int>& bins, Random& random) {
  const std::size_t count = model.variables.size();
  ENSURE(bins.size() == count);
  const std::vector<CountTable>& tables = model.transition.tables;
  std::vector<int> both = bins;  // the variables at the second, then their successors
  both.resize(tables.size(), 0);
  for (const int variable : model.transition.order) {
    const auto at = static_cast<std::size_t>(variable);
    if (at < count) continue;
    const int kept = bins[static_cast<std::size_t>(model.next_of[at - count])];
    both[at] = drawn_bin(counts_given(tables[at], both, tables, model.variables), random.uniform(), kept);
  }
  std::vector<int> next = bins;
  for (std::size_t i = 0; i < model.next_of.size(); ++i)
    next[static_cast<std::size_t>(model.next_of[i])] = both[count + i];
  return next;
}

double value_in_bin(const ModelVariable& variable, int bin, Random& random) {
  if (variable.boundaries.empty()) return bin + 1;
  if (variable.zero_bin == bin) return 0;
  const auto at = static_cast<std::size_t>(bin);
  const double low = variable.boundaries[at];
  return low + (variable.boundaries[at + 1] - low) * random.uniform();
}

ModelState initial_state(const EncounterModel& model, Random& random) {
  ModelState state{.bins = initial_bins(model, random), .values = {}};
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    state.values.push_back(value_in_bin(model.variables[i], state.bins[i], random));
  return state;
}

ModelState next_state(const EncounterModel& model, const ModelState& state, Random& random) {
  ModelState next{.bins = next_bins(model, state.bins, random), .values = state.values};
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const ModelVariable& variable = model.variables[i];
    const bool is_same = next.bins[i] == state.bins[i];
    if (is_same && (variable.resample_rate <= 0 || random.uniform() >= variable.resample_rate)) continue;
    next.values[i] = value_in_bin(variable, next.bins[i], random);
  }
  return next;
}

}  // namespace sigs
