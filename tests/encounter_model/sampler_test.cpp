// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "encounter_model/chi_squared.h"
#include "encounter_model/published_tables.h"
#include "encounter_model/small_model.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// Probability with which a correct sampler would fail one of these test cases, shared among all tests within it.
constexpr double kFalseAlarm = 1e-4;

EncounterModel small() {
  return encounter_model_of(text_of(small_model()), "m.txt").value();
}

}  // namespace

TEST_CASE("the tail of chi-squared is that of the tables") {
  CHECK(chi_squared_tail(3.841, 1) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(chi_squared_tail(23.209, 10) == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(chi_squared_tail(2 * 7.0, 2) == doctest::Approx(std::exp(-7.0)).epsilon(1e-9));  // exact for 2 degrees
  CHECK(chi_squared_tail(2 * 0.3, 2) == doctest::Approx(std::exp(-0.3)).epsilon(1e-9));
}

TEST_CASE("a million first states of each published model have the network's exact marginals") {
  if (!has_real_data()) return say_skipped("no published encounter models");
  const auto folder = real_data() / "encounters" / "models";
  const auto truth = nlohmann::json::parse(std::ifstream(folder / "exact_initial_marginals.json"));
  constexpr int kDraws = 1000000;
  constexpr double kLevel = kFalseAlarm / 33;  // there are 33 variables: Bonferroni
  int variables = 0;
  for (const std::string& name : published_models()) {
    const EncounterModel model = read_encounter_model(folder / name).value();
    std::vector<std::vector<double>> counted;
    for (const ModelVariable& variable : model.variables) counted.emplace_back(variable.bins, 0.0);
    Random random(20261122);
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::vector<int> bins = initial_bins(model, random);
      for (std::size_t i = 0; i < bins.size(); ++i) ++counted[i][bins[i]];
    }
    for (std::size_t i = 0; i < counted.size(); ++i, ++variables) {
      const std::string& label = model.variables[i].label;
      const auto exact = truth[name]["initial_marginals"][label].get<std::vector<double>>();
      const double p = likelihood(counted[i], exact, kDraws);
      CHECK_MESSAGE(p > kLevel, name << " " << label << ": p = " << p);
    }
  }
  CHECK(variables == 33);
}

TEST_CASE("the second after a state follows the counts of the file, read without the engine") {
  if (!has_real_data()) return say_skipped("no published encounter models");
  constexpr int kStarts = 5;
  constexpr int kDraws = 100000;
  for (const std::string& name : published_models()) {
    const auto file = real_data() / "encounters" / "models" / name;
    const EncounterModel model = read_encounter_model(file).value();
    const PublishedTransition published = published_transition(file);
    Random random(7);
    for (int start = 0; start < kStarts; ++start) {
      std::vector<int> bins = initial_bins(model, random);
      for (int second = 0; second < 10 * start; ++second) bins = next_bins(model, bins, random);
      std::size_t combinations = 1;
      for (std::size_t i = published.now; i < published.labels.size(); ++i) combinations *= published.bins[i];
      std::vector<double> exact;
      double sum = 0;
      for (std::size_t number = 0; number < combinations; ++number) {
        std::vector<int> both = bins;
        std::size_t rest = number;
        for (std::size_t i = published.now; i < published.labels.size(); ++i) {
          both.push_back(static_cast<int>(rest % published.bins[i]));
          rest /= published.bins[i];
        }
        exact.push_back(published.probability(both));
        sum += exact.back();
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-12));
      std::vector<double> counted(combinations, 0);
      for (int draw = 0; draw < kDraws; ++draw) {
        const std::vector<int> next = next_bins(model, bins, random);
        std::size_t number = 0;
        for (std::size_t i = published.labels.size(); i-- > published.now;)
          number = number * published.bins[i] + next[published.before(i)];
        ++counted[number];
        for (std::size_t i = 0; i < next.size(); ++i)
          if (published.labels[i].find("(t)") == std::string::npos) REQUIRE(next[i] == bins[i]);
      }
      const double p = likelihood(counted, exact, kDraws);
      CHECK_MESSAGE(p > kFalseAlarm / (7 * kStarts), name << " start " << start << ": p = " << p);
    }
  }
}

TEST_CASE("what was never counted is equally likely at first and stays as it is later") {
  const EncounterModel model = small();
  Random random(3);
  int second_layer = 0;
  int slow = 0;
  for (int draw = 0; draw < 100000; ++draw) {
    const std::vector<int> bins = initial_bins(model, random);
    if (bins[0] == 1) {
      ++second_layer;
      slow += bins[1] == 0 ? 1 : 0;
    }
  }
  CHECK(second_layer / 1e5 == doctest::Approx(0.25).epsilon(0.03));  // 1 of 4; 6 standard deviations
  CHECK(slow / static_cast<double>(second_layer) == doctest::Approx(0.5).epsilon(0.04));
  for (int draw = 0; draw < 1000; ++draw) CHECK(next_bins(model, {0, 0, 0}, random)[2] == 0);
}

TEST_CASE("a value is uniform within its bin, exactly 0 in the zero bin, and a category's is its number") {
  ModelVariable variable{.label = "v", .bins = 3, .boundaries = {-3, -1, 1, 5}, .zero_bin = 1};
  Random random(11);
  std::vector<double> tenths(10, 0);
  for (int draw = 0; draw < 100000; ++draw) {
    const double value = value_in_bin(variable, 2, random);
    REQUIRE(value >= 1);
    REQUIRE(value < 5);
    ++tenths[static_cast<std::size_t>((value - 1) / 0.4)];
  }
  CHECK(likelihood(tenths, std::vector<double>(10, 0.1), 100000) > kFalseAlarm);
  CHECK(value_in_bin(variable, 1, random) == 0);
  variable.boundaries.clear();
  CHECK(value_in_bin(variable, 1, random) == 2);
}

TEST_CASE("within an unchanged bin the value changes with the variable's rate, and always where the bin changes") {
  const EncounterModel model = small();
  Random random(5);
  ModelState state = initial_state(model, random);
  double unchanged = 0;
  double redrawn = 0;
  for (int second = 0; second < 400000; ++second) {
    if (second % 20 == 0) {
      state = initial_state(model, random);
      continue;
    }
    const ModelState next = next_state(model, state, random);
    CHECK(next.values[0] == state.values[0]);  // rate 0, and nothing changes the bin
    if (next.bins[2] == 1) CHECK(next.values[2] == 0);
    if (next.bins[2] != state.bins[2]) CHECK(next.values[2] != state.values[2]);
    if (next.bins[2] == state.bins[2] && next.bins[2] != 1) {
      ++unchanged;
      redrawn += next.values[2] != state.values[2] ? 1 : 0;
    }
    state = next;
  }
  REQUIRE(unchanged > 10000);
  const double sd = std::sqrt(0.25 * 0.75 / unchanged);
  CHECK(std::abs(redrawn / unchanged - 0.25) < 4.5 * sd);  // beyond it: 7e-6
}

TEST_CASE("a seed gives the same states, and another seed others") {
  const EncounterModel model = small();
  const auto states = [&](std::uint64_t seed) {
    Random random(seed);
    std::vector<ModelState> all{initial_state(model, random)};
    for (int second = 0; second < 50; ++second) all.push_back(next_state(model, all.back(), random));
    return all;
  };
  CHECK(states(1) == states(1));
  CHECK(states(1) != states(2));
}

}  // namespace sigs::test
