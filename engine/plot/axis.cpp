// SPDX-License-Identifier: MIT
#include "plot/axis.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMaxTicks = 8;

double placed(double value, PlotScale scale) {
  if (scale == PlotScale::log) return std::log10(std::max(value, 1e-300));
  return scale == PlotScale::symlog ? std::asinh(value / 10) : value;
}

// Powers of ten, and 2 and 5 times these where there are few of them.
std::vector<double> log_ticks(const PlotSpan& range) {
  const double first = std::log10(std::max(range.first, 1e-300)), last = std::log10(range.last);
  const double step = std::max(1.0, std::ceil((last - first) / kMaxTicks));
  std::vector<double> ticks;
  for (double power = std::floor(first / step) * step; power <= last; power += step)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10, power);
      const bool is_wanted = factor == 1 || last - first < 3;
      if (is_wanted && tick >= range.first * (1 - 1e-9) && tick <= range.last * (1 + 1e-9)) ticks.push_back(tick);
    }
  return ticks;
}

std::vector<double> symlog_ticks(const PlotSpan& range) {
  constexpr double kMinGap = 0.035;  // of the axis; about a label's height
  const double gap = kMinGap * (placed(range.last, PlotScale::symlog) - placed(range.first, PlotScale::symlog));
  std::vector<double> ticks;
  if (range.first <= 0 && range.last >= 0) ticks.push_back(0);
  double last = 0;
  for (const double tick : {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}) {
    if (placed(tick, PlotScale::symlog) - last < gap) continue;
    last = placed(tick, PlotScale::symlog);
    if (tick <= range.last && tick >= range.first) ticks.push_back(tick);
    if (-tick >= range.first && -tick <= range.last) ticks.push_back(-tick);
  }
  std::sort(ticks.begin(), ticks.end());
  return ticks;
}

// 1, 2 or 5 times a power of ten, so that at most this many steps fit into the range.
double step_of(double range, double most) {
  const double rough = range / most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<double> round_numbers(const PlotSpan& range, double most) {
  const double step = step_of(range.last - range.first, most);
  std::vector<double> ticks;
  // By whole numbers: sums of steps would not end at round numbers.
  const double slack = 1e-9 * (range.last - range.first);
  for (double n = std::ceil((range.first - slack) / step); n * step <= range.last + slack; ++n)
    ticks.push_back(n == 0 ? 0 : n * step);
  return ticks;
}

// With as many decimals as tell the ticks apart.
std::string tick_text(double value, const std::vector<double>& ticks) {
  double step = std::abs(value);
  for (std::size_t i = 0; i + 1 < ticks.size(); ++i) step = std::min(step > 0 ? step : 1e300, ticks[i + 1] - ticks[i]);
  if (step <= 0 || step >= 1e300) return fixed_text(value, 0);
  return fixed_text(value, std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9));
}

// 1e-4, 0.001, 20, 1e5
std::string decade_text(double value) {
  if (value >= 1e-3 * (1 - 1e-9) && value < 1e5 * (1 - 1e-9)) return short_number_text(value);
  const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  return short_number_text(std::round(value / std::pow(10, power))) + "e" + std::to_string(power);
}

}  // namespace

double Axis::at(double value) const {
  const double first = placed(range.first, scale), last = placed(range.last, scale);
  const double share = (placed(value, scale) - first) / (last - first);
  return std::isfinite(share) ? first_px + share * (last_px - first_px) : first_px;  // of numbers beyond 1e308
}

double Axis::length_px() const {
  return std::abs(last_px - first_px);
}

double Axis::per_px() const {
  return std::abs(range.last - range.first) / length_px();
}

void Axis::widen(double wanted_per_px) {
  const double middle = (range.first + range.last) / 2;
  const double half = std::copysign(wanted_per_px * length_px() / 2, range.last - range.first);
  range = {middle - half, middle + half};
}

std::vector<double> ticks_of(const PlotSpan& range, PlotScale scale) {
  if (!(range.last > range.first)) return {range.first};
  if (scale == PlotScale::symlog) return symlog_ticks(range);
  return scale == PlotScale::log ? log_ticks(range) : round_numbers(range, kMaxTicks);
}

std::vector<PlotTick> ticks_on(const Axis& axis, double most) {
  const PlotSpan rising{std::min(axis.range.first, axis.range.last), std::max(axis.range.first, axis.range.last)};
  const std::vector<double> numbers =
      axis.scale == PlotScale::linear ? round_numbers(rising, std::min(most, kMaxTicks)) : ticks_of(rising, axis.scale);
  std::vector<PlotTick> ticks;
  for (const double number : numbers)
    ticks.push_back({number, axis.scale == PlotScale::log ? decade_text(number) : tick_text(number, numbers)});
  return ticks;
}

}  // namespace sigs
