// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "base/ensure.h"
#include "base/pose.h"

namespace sigs {

namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kKnot_mps = 1852.0 / 3600.0;

// Integrals over s from 0 to 1 of cos(angle s), sin(angle s), s cos(angle s) and s sin(angle s).
struct TurnIntegrals {
  double cos = 1;
  double sin = 0;
  double s_cos = 0.5;
  double s_sin = 0;
};

// By their power series: sum over n of (-1)^n angle^2n / (2n)! / (2n + 1), and so on. At 1 rad the first term left out
// is below 1e-18.
TurnIntegrals small_turn(double angle_rad) {
  TurnIntegrals sums{0, 0, 0, 0};
  double term = 1;  // (-1)^n angle^2n / (2n)!
  for (int n = 0; n < 10; ++n) {
    const double even = 2 * n;
    const double odd_term = term * angle_rad / (even + 1);  // (-1)^n angle^(2n+1) / (2n+1)!
    sums.cos += term / (even + 1);
    sums.s_cos += term / (even + 2);
    sums.sin += odd_term / (even + 2);
    sums.s_sin += odd_term / (even + 3);
    term = -odd_term * angle_rad / (even + 2);
  }
  return sums;
}

TurnIntegrals turn_integrals(double angle_rad) {
  if (std::abs(angle_rad) < 1) return small_turn(angle_rad);
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {.cos = s / angle_rad,
          .sin = (1 - c) / angle_rad,
          .s_cos = (angle_rad * s + c - 1) / (angle_rad * angle_rad),
          .s_sin = (s - angle_rad * c) / (angle_rad * angle_rad)};
}

// Variables by what they do.
struct FlightVariables {
  std::optional<int> altitude;
  std::optional<int> speed;
  std::optional<int> acceleration;
  std::optional<int> vertical_rate;
  std::optional<int> turn_rate;
};

FlightVariables flight_variables(const EncounterModel& model) {
  return {model.find("L"), model.find("v"), model.find("\\dot v"), model.find("\\dot h"), model.find("\\dot \\psi")};
}

double value_of(const ModelState& state, std::optional<int> variable) {
  return variable ? state.values[static_cast<std::size_t>(*variable)] : 0;
}

// What the aircraft does in the second that begins with this state.
void steer(SampledPoint& point, const ModelState& state, const FlightVariables& variables) {
  point.vertical_speed_mps = value_of(state, variables.vertical_rate) * kFoot_m / 60;
  point.acceleration_mps2 = value_of(state, variables.acceleration) * kKnot_mps;
  point.turn_rate_radps = rad_of_deg(value_of(state, variables.turn_rate));
}

void round_level_altitude(ModelState& state, const FlightVariables& variables, double step_ft) {
  if (step_ft <= 0 || !variables.vertical_rate || value_of(state, variables.vertical_rate) != 0) return;
  double& altitude_ft = state.values[static_cast<std::size_t>(*variables.altitude)];
  const double rounded_ft = step_ft * std::ceil(altitude_ft / step_ft - 0.5);
  if (rounded_ft > 0) altitude_ft = rounded_ft;
}

class Limits {
 public:
  Limits(const EncounterModel& model, const FlightVariables& variables) {
    if (!variables.speed) return;
    const std::vector<double>& boundaries = model.variables[static_cast<std::size_t>(*variables.speed)].boundaries;
    low_mps_ = boundaries.front() * kKnot_mps;
    high_mps_ = boundaries.back() * kKnot_mps;
  }

  [[nodiscard]] bool contain(const SampledPoint& point) const {
    return point.position_neu_m.z >= 0 && point.speed_mps > low_mps_ && point.speed_mps < high_mps_;
  }

 private:
  double low_mps_ = -1;
  double high_mps_ = std::numeric_limits<double>::infinity();
};

ModelFlight drawn_once(const EncounterModel& model, const ModelFlightSettings& settings, Random& random) {
  const FlightVariables variables = flight_variables(model);
  const Limits limits(model, variables);
  ModelState state = initial_state(model, random);
  round_level_altitude(state, variables, settings.level_step_ft);
  SampledPoint point;
  point.position_neu_m.z = value_of(state, variables.altitude) * kFoot_m;
  point.speed_mps = std::max(0.0, value_of(state, variables.speed) * kKnot_mps);
  steer(point, state, variables);
  ModelFlight flight{.points = {point}, .initial_values = state.values, .is_within_limits = limits.contain(point)};
  for (int second = 1; second <= settings.duration_s; ++second) {
    point = moved_on(point, 1);
    point.time_s = second;
    state = next_state(model, state, random);
    steer(point, state, variables);
    flight.points.push_back(point);
    flight.is_within_limits = flight.is_within_limits && limits.contain(point);
  }
  return flight;
}

}  // namespace

SampledPoint moved_on(const SampledPoint& point, double after_s) {
  // Less than after_s where the speed falls to 0.
  const double moving_s =
      point.acceleration_mps2 >= 0 ? after_s : std::min(after_s, point.speed_mps / -point.acceleration_mps2);
  const TurnIntegrals turn = turn_integrals(point.turn_rate_radps * moving_s);
  const double by_speed_m = point.speed_mps * moving_s;
  const double by_acceleration_m = point.acceleration_mps2 * moving_s * moving_s;
  const double ahead_m = by_speed_m * turn.cos + by_acceleration_m * turn.s_cos;
  const double right_m = by_speed_m * turn.sin + by_acceleration_m * turn.s_sin;
  const double c = std::cos(point.heading_rad);
  const double s = std::sin(point.heading_rad);
  SampledPoint moved = point;
  moved.time_s += after_s;
  moved.position_neu_m +=
      glm::dvec3(c * ahead_m - s * right_m, s * ahead_m + c * right_m, point.vertical_speed_mps * after_s);
  moved.heading_rad += point.turn_rate_radps * after_s;
  moved.speed_mps = moving_s < after_s ? 0 : std::max(0.0, point.speed_mps + point.acceleration_mps2 * after_s);
  return moved;
}

SampledPoint at_time(const ModelFlight& flight, double time_s) {
  ENSURE(!flight.points.empty() && time_s >= 0 && time_s <= flight.duration_s());
  const auto second = std::min(static_cast<std::size_t>(time_s), flight.points.size() - 1);
  const SampledPoint& before = flight.points[second];
  return moved_on(before, time_s - before.time_s);
}

Result<void> check_can_fly(const EncounterModel& model) {
  if (!model.find("L")) return fail("", "the model has no altitude L, so it gives no flights");
  for (const char* const label : {"L", "v", "\\dot v", "\\dot h", "\\dot \\psi"}) {
    const std::optional<int> variable = model.find(label);
    if (variable && model.variables[static_cast<std::size_t>(*variable)].boundaries.empty())
      return fail("",
                  fmt::format("{} has no limits of its bins in # boundaries, so the model gives no flights", label));
  }
  return {};
}

ModelFlight drawn_flight(const EncounterModel& model, const ModelFlightSettings& settings, Random& random) {
  ENSURE(settings.duration_s >= 1 && check_can_fly(model));
  ModelFlight flight = drawn_once(model, settings, random);
  for (int redraws = 1; !flight.is_within_limits && redraws <= settings.max_redraws; ++redraws) {
    flight = drawn_once(model, settings, random);
    flight.redraws = redraws;
  }
  return flight;
}

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
