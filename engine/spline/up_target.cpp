// SPDX-License-Identifier: MIT
#include "spline/up_target.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spline/directions.h"
#include "spline/gravity.h"

namespace sigs {

namespace {

constexpr double kSteep = 0.25;    // cosine of the pitch (75.5 degrees) below which any roll is right
constexpr double kModerate = 0.5;  // cosine of the pitch (60 degrees) above which the bank limit holds in full
constexpr double kNothing = 1e-9;  // length below which a direction is rounding

enum class Side { upright, inverted };

struct Run {
  std::size_t first = 0;
  std::size_t past = 0;
};

bool steep(const FlightSample& sample) {
  return length(level_up(sample.nose)) < kSteep;
}

// The stretches of samples that are not steep.
std::vector<Run> moderate_runs(std::span<const FlightSample> samples) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (steep(samples[i])) continue;
    if (runs.empty() || runs.back().past != i) runs.push_back({i, i});
    runs.back().past = i + 1;
  }
  return runs;
}

Side side_of(const Run& run, std::span<const FlightSample> samples) {
  if (run.first == 0 && run.past == samples.size()) return Side::upright;
  double upward = 0;
  for (std::size_t i = run.first; i < run.past; ++i) {
    const double since_s = samples[i].time_s - samples[i > 0 ? i - 1 : 0].time_s;
    upward += since_s * dot(samples[i].specific_force_mps2, level_up(samples[i].nose));
  }
  return upward < 0 ? Side::inverted : Side::upright;
}

std::vector<Side> sides_of(std::span<const FlightSample> samples) {
  std::vector<Side> sides(samples.size(), Side::upright);
  for (const Run& run : moderate_runs(samples)) {
    const Side side = side_of(run, samples);
    std::fill(sides.begin() + std::ptrdiff_t(run.first), sides.begin() + std::ptrdiff_t(run.past), side);
  }
  return sides;
}

// The bank limit where the cosine of the pitch is so: in full, opening smoothly, none.
double limit_rad(double bank_limit_rad, double cos_pitch) {
  const double share = std::clamp((cos_pitch - kSteep) / (kModerate - kSteep), 0.0, 1.0);
  return std::lerp(std::numbers::pi, bank_limit_rad, share * share * (3 - 2 * share));
}

UpTarget level_target(const FlightSample& sample) {
  const glm::dvec3 level = level_up(sample.nose);
  const double cos_pitch = length(level);
  if (cos_pitch < kNothing) return {};
  return {level / cos_pitch, cos_pitch};
}

UpTarget coordinated_target(const FlightSample& sample, Side side, double bank_limit_rad) {
  glm::dvec3 force_mps2 = across(sample.specific_force_mps2, sample.nose);
  const double strength = length(force_mps2) / kGravity_mps2;
  if (strength < kNothing) return {};
  const double weight = std::min(strength, 1.0);
  const glm::dvec3 level = level_up(sample.nose);
  const double cos_pitch = length(level);
  if (cos_pitch < kSteep) return {normalize(force_mps2), weight};

  const glm::dvec3 middle = (side == Side::inverted ? -level : level) / cos_pitch;
  if (dot(force_mps2, middle) < 0) force_mps2 = -force_mps2;  // pushed, not pulled: still nothing pulls sideways
  const double max_rad = limit_rad(bank_limit_rad, cos_pitch);
  const double bank_rad = std::clamp(signed_angle(middle, force_mps2, sample.nose), -max_rad, max_rad);
  return {turned(middle, sample.nose, bank_rad), weight};
}

}  // namespace

glm::dvec3 level_up(const glm::dvec3& nose) {
  return across(kWorldUp, nose);
}

std::vector<UpTarget> up_targets(std::span<const FlightSample> samples, Bank bank, double bank_limit_rad) {
  const std::vector<Side> sides = sides_of(samples);
  std::vector<UpTarget> targets;
  targets.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    targets.push_back(bank == Bank::level ? level_target(samples[i])
                                          : coordinated_target(samples[i], sides[i], bank_limit_rad));
  return targets;
}

}  // namespace sigs
