// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// A statistical model of how aircraft fly, as MIT Lincoln Laboratory publishes them (Kochenderfer et al.: Uncorrelated
// encounter model of the National Airspace System, ATC-345, 2008): a Bayesian network of the state at the first second,
// and a dynamic Bayesian network from each second to the next. Variables take bins, which are numbered from 0 here.

// A variable of the state.
struct ModelVariable {
  std::string label;  // as in the file, without quotes: "L", "v", "\dot v", "\dot h", "\dot \psi"
  int bins = 1;
  // bins + 1 limits, increasing, in the unit of the file (ft, kt, kt/s, ft/min, deg/s). Empty: a category, whose value
  // is the number of its bin, from 1 as in the file.
  std::vector<double> boundaries;
  std::optional<int> zero_bin;  // the bin whose values are all exactly 0; none where no bin straddles zero
  double resample_rate = 0;     // probability a second, 0..1, of another value within an unchanged bin
};

// How often each bin of a variable was counted, given the bins of its parents.
struct CountTable {
  int bins = 0;              // 0: the variable is not drawn by this network
  std::vector<int> parents;  // variables, ascending
  // bins times the number of configurations of the parents: the bin changes fastest, then the first parent, then the
  // second. 0 or more, finite.
  std::vector<double> counts;

  // Number of parameters: probabilities that are free, each configuration's sum being 1.
  [[nodiscard]] std::size_t parameters() const { return bins == 0 ? 0 : counts.size() / bins * (bins - 1); }
};

// Tables by variable, and an order in which every variable comes after its parents. Among those that could come next it
// is the one with the lowest number.
struct CountNetwork {
  std::vector<CountTable> tables;
  std::vector<int> order;
};

struct EncounterModel {
  std::vector<ModelVariable> variables;
  CountNetwork initial;  // tables for all variables
  // Variables 0 .. n-1 are those above at a second, without tables; n + k is the variable next_of[k] a second later.
  CountNetwork transition;
  std::vector<int> next_of;
  std::vector<Warning> warnings;  // sections that are not known and were left out

  // The variable of this label; nullopt: there is none.
  [[nodiscard]] std::optional<int> find(const std::string& label) const;
};

// The largest file that is read; the models for which it is tested have up to 0.6 MB.
inline constexpr std::uint64_t kEncounterModelLimit_bytes = std::uint64_t{64} << 20;

// Reads a model's text file: sections "# name", in any order, each once. All but zero_bins must be there.
//   labels_initial, labels_transition  names, separated by commas, with or without quotes. A transition's labels are
//   the
//                    initial ones in their order, those that change with (t) behind them, and then each of these once
//                    more with (t+1), in any order
//   G_initial, G_transition  a row for each label: 1 in column j means that the row's variable is a parent of j.
//   Nothing
//                    may be its own ancestor, and only labels with (t+1) may have parents in the transition
//   r_initial, r_transition  number of bins of each label
//   N_initial, N_transition  counts, one table after the other (CountTable), of the labels that the network draws
//   boundaries       a line for each initial label: limits of the bins, or * for a category
//   resample_rates   a number for each initial label
//   zero_bins        a line for each initial label: a bin, from 1, or *. Without the section it is the bin whose limits
//                    lie on both sides of zero, of a variable with at least two bins
// Errors cannot_read; bad_data with the line and the section. Memory is taken for numbers that are in the file, never
// for numbers that a section announces.
[[nodiscard]] Result<EncounterModel> read_encounter_model(const std::filesystem::path& file);

// The same from the file's contents.
//   name  what errors call the file
[[nodiscard]] Result<EncounterModel> encounter_model_of(std::string_view text, const std::string& name);

}  // namespace sigs
