// SPDX-License-Identifier: MIT
// How fast flights are drawn from encounter models: bench_encounter_model [DRAWS] FILE...
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/stopwatch.h"
#include "encounter_model/model_flight.h"

namespace {

using namespace sigs;

constexpr int kFlightLength_s = 60;

struct Speeds {
  double read_ms = 0;
  double states_per_s = 0;   // first seconds, with values
  double seconds_per_s = 0;  // further seconds, with values
  double flights_per_s = 0;  // of 60 s
  double pairs_per_s = 0;    // two such flights drawn and placed, or refused
};

double states_per_s(const EncounterModel& model, int draws, double& sum) {
  Random random(1);
  const Stopwatch watch;
  for (int draw = 0; draw < draws; ++draw) sum += initial_state(model, random).values.back();
  return draws / watch.elapsed_s();
}

double seconds_per_s(const EncounterModel& model, int draws, double& sum) {
  Random random(2);
  ModelState state = initial_state(model, random);
  const Stopwatch watch;
  for (int draw = 0; draw < draws; ++draw) state = next_state(model, state, random);
  sum += state.values.back();
  return draws / watch.elapsed_s();
}

double flights_per_s(const EncounterModel& model, int flights, double& sum) {
  const Stopwatch watch;
  for (int flight = 0; flight < flights; ++flight) {
    Random random(3, static_cast<std::uint64_t>(flight));
    sum += drawn_flight(model, {.duration_s = kFlightLength_s}, random).points.back().speed_mps;
  }
  return flights / watch.elapsed_s();
}

double pairs_per_s(const EncounterModel& model, int pairs, double& sum) {
  const Stopwatch watch;
  for (int pair = 0; pair < pairs; ++pair) {
    Random random(4, static_cast<std::uint64_t>(pair));
    const ModelFlight own = drawn_flight(model, {.duration_s = kFlightLength_s}, random);
    const ModelFlight other = drawn_flight(model, {.duration_s = kFlightLength_s}, random);
    const Result<ModelFlight> placed =
        placed_intruder(own, other, {.time_s = 40, .hmd_m = 150, .bearing_rad = random.uniform() - 0.5});
    sum += placed ? placed->points.front().position_neu_m.x : 0;
  }
  return pairs / watch.elapsed_s();
}

Result<Speeds> measured(const std::filesystem::path& file, int draws) {
  const Stopwatch watch;
  const Result<EncounterModel> model = read_encounter_model(file);
  if (!model) return fail(model.error());
  Speeds speeds{.read_ms = 1e3 * watch.elapsed_s()};
  double sum = 0;  // looked at below, so that the compiler leaves no work out
  speeds.states_per_s = states_per_s(*model, draws, sum);
  speeds.seconds_per_s = seconds_per_s(*model, draws, sum);
  speeds.flights_per_s = flights_per_s(*model, draws / 100, sum);
  speeds.pairs_per_s = pairs_per_s(*model, draws / 200, sum);
  if (std::isnan(sum)) return fail(file.string(), "gave a state that is not a number");
  return speeds;
}

}  // namespace

int main(int argc, char** argv) {
  int draws = 1000000;
  std::puts("| model | read, ms | first seconds/s | further seconds/s | flights of 60 s/s | placed pairs/s |");
  std::puts("|---|---|---|---|---|---|");
  for (int i = 1; i < argc; ++i) {
    if (i == 1 && std::atoi(argv[1]) >= 1000) {
      draws = std::atoi(argv[1]);
      continue;
    }
    const Result<Speeds> speeds = measured(argv[i], draws);
    if (!speeds) {
      std::fprintf(stderr, "error: %s\n", speeds.error().text().c_str());
      return 1;
    }
    fmt::print("| {} | {:.1f} | {:.3g} | {:.3g} | {:.3g} | {:.3g} |\n", std::filesystem::path(argv[i]).stem().string(),
               speeds->read_ms, speeds->states_per_s, speeds->seconds_per_s, speeds->flights_per_s,
               speeds->pairs_per_s);
  }
  return 0;
}
