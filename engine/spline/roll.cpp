// SPDX-License-Identifier: MIT
#include "spline/roll.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ensure.h"
#include "spline/tridiagonal.h"

namespace sigs {

namespace {

constexpr double kFollow_s = 0.15;   // tau
constexpr double kWorthless = 0.01;  // a desired roll of less weight is rounding, and its whole turns would be chance

// Drops the worthless desired rolls' weight and adds whole turns to the others.
std::vector<DesiredRoll> unwrapped(std::span<const DesiredRoll> desired_rolls) {
  std::vector<DesiredRoll> result(desired_rolls.begin(), desired_rolls.end());
  const DesiredRoll* before = nullptr;
  for (DesiredRoll& desired : result) {
    if (desired.weight < kWorthless) {
      desired.weight = 0;
      continue;
    }
    if (before)
      desired.roll_rad = before->roll_rad + std::remainder(desired.roll_rad - before->roll_rad, 2 * std::numbers::pi);
    before = &desired;
  }
  return result;
}

// The gradient of the sum, set to zero. A desired roll stands for half the time to either neighbour.
std::vector<TridiagonalRow<double>> rows_of(std::span<const DesiredRoll> desired_rolls) {
  std::vector<TridiagonalRow<double>> rows(desired_rolls.size(), {.self = 0});
  for (std::size_t i = 0; i + 1 < desired_rolls.size(); ++i) {
    const double gap_s = desired_rolls[i + 1].time_s - desired_rolls[i].time_s;
    const double rate_weight = kFollow_s * kFollow_s / gap_s;
    rows[i].after = rows[i + 1].before = -rate_weight;
    rows[i].self += rate_weight + desired_rolls[i].weight * gap_s / 2;
    rows[i + 1].self += rate_weight + desired_rolls[i + 1].weight * gap_s / 2;
    rows[i].right += desired_rolls[i].weight * gap_s / 2 * desired_rolls[i].roll_rad;
    rows[i + 1].right += desired_rolls[i + 1].weight * gap_s / 2 * desired_rolls[i + 1].roll_rad;
  }
  return rows;
}

}  // namespace

std::vector<double> smoothed_roll_rad(std::span<const DesiredRoll> desired_rolls) {
  ENSURE(desired_rolls.size() >= 2);
  const std::vector<DesiredRoll> clear = unwrapped(desired_rolls);
  if (std::ranges::all_of(clear, [](const DesiredRoll& desired) { return desired.weight == 0; }))
    return std::vector<double>(desired_rolls.size(), 0.0);
  return solved<double>(rows_of(clear));
}

}  // namespace sigs
