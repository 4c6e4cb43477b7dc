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
constexpr double kWorthless = 0.01;  // a wish of less weight is rounding, and its whole turns would be chance

// Drops the worthless wishes' weight and adds whole turns to the others.
std::vector<RollWish> unwrapped(std::span<const RollWish> wishes) {
  std::vector<RollWish> result(wishes.begin(), wishes.end());
  const RollWish* before = nullptr;
  for (RollWish& wish : result) {
    if (wish.weight < kWorthless) {
      wish.weight = 0;
      continue;
    }
    if (before)
      wish.roll_rad = before->roll_rad + std::remainder(wish.roll_rad - before->roll_rad, 2 * std::numbers::pi);
    before = &wish;
  }
  return result;
}

// The gradient of the sum, set to zero. A wish stands for half the time to either neighbour.
std::vector<TridiagonalRow<double>> rows_of(std::span<const RollWish> wishes) {
  std::vector<TridiagonalRow<double>> rows(wishes.size(), {.self = 0});
  for (std::size_t i = 0; i + 1 < wishes.size(); ++i) {
    const double gap_s = wishes[i + 1].time_s - wishes[i].time_s;
    const double stiffness = kFollow_s * kFollow_s / gap_s;
    rows[i].after = rows[i + 1].before = -stiffness;
    rows[i].self += stiffness + wishes[i].weight * gap_s / 2;
    rows[i + 1].self += stiffness + wishes[i + 1].weight * gap_s / 2;
    rows[i].right += wishes[i].weight * gap_s / 2 * wishes[i].roll_rad;
    rows[i + 1].right += wishes[i + 1].weight * gap_s / 2 * wishes[i + 1].roll_rad;
  }
  return rows;
}

}  // namespace

std::vector<double> smoothed_roll_rad(std::span<const RollWish> wishes) {
  ENSURE(wishes.size() >= 2);
  const std::vector<RollWish> clear = unwrapped(wishes);
  if (std::ranges::all_of(clear, [](const RollWish& wish) { return wish.weight == 0; }))
    return std::vector<double>(wishes.size(), 0.0);
  return solved<double>(rows_of(clear));
}

}  // namespace sigs
