// SPDX-License-Identifier: MIT
#include "performance/confidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"

namespace sigs {

namespace {

constexpr double kZ = 1.959963984540054;  // 97.5 % of the standard normal distribution are below it
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Interval wilson(double share, double trials) {
  const double square = kZ * kZ / trials;
  const double middle = (share + square / 2) / (1 + square);
  const double half = kZ / (1 + square) * std::sqrt(share * (1 - share) / trials + square / (4 * trials));
  return {share <= 0 ? 0.0 : std::max(0.0, middle - half), share >= 1 ? 1.0 : std::min(1.0, middle + half)};
}

// P(N <= events) of a Poisson distribution: the sum of its terms, the largest first.
double poisson_at_most(int events, double mean) {
  if (events < 0) return 0;
  if (mean <= 0) return 1;
  double sum = 0;
  double term = std::exp(events * std::log(mean) - mean - std::lgamma(events + 1.0));
  if (mean < events + 1) {  // 1 less the upper tail, which falls from its first term on
    double tail = 0;
    for (double n = events + 1; (term *= mean / n) > 1e-18 * (tail + 1e-300) && n < events + 1e6; ++n) tail += term;
    return std::max(0.0, 1 - tail);
  }
  for (int n = events; n >= 0 && term > 1e-18 * sum; --n) {
    sum += term;
    term *= n / mean;
  }
  return std::min(1.0, sum);
}

// The mean at which a falling function of it is `wanted`.
template <class Function>
double mean_with(const Function& function, double wanted, double high) {
  double low = 0;
  while (function(high) > wanted) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (function(middle) > wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

Interval wilson_interval(double part, double whole) {
  if (!(whole > 0)) return {kNaN, kNaN};
  return wilson(std::clamp(part / whole, 0.0, 1.0), whole);
}

double student_t_975(double freedom) {
  // Cornish and Fisher's expansion about the normal quantile, exact values where it is coarse.
  constexpr std::array kExact{12.7062, 4.3027, 3.1824, 2.7764};
  if (freedom < 4.5) return kExact[static_cast<std::size_t>(std::clamp(std::lround(freedom), 1L, 4L) - 1)];
  const double z = kZ, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * freedom * freedom * freedom);
}

Interval clustered_interval(std::span<const GroupShare> groups) {
  GroupShare sum;
  double count = 0;
  for (const GroupShare& group : groups) {
    sum.part += group.part;
    sum.whole += group.whole;
    count += group.whole > 0 ? 1 : 0;
  }
  if (!(sum.whole > 0)) return {kNaN, kNaN};
  if (count < 2) return {0, 1};
  const double share = sum.part / sum.whole;
  double trials = count;
  if (sum.part > 0 && sum.part < sum.whole) {
    double squares = 0;
    for (const GroupShare& group : groups) squares += std::pow(group.part - share * group.whole, 2);
    const double variance = squares * count / (count - 1) / (sum.whole * sum.whole);
    // Never more than the trials that there are.
    trials = std::min(sum.whole, share * (1 - share) / variance);
  }
  const double t = student_t_975(count - 1);
  return wilson(share, trials * kZ * kZ / (t * t));
}

Interval poisson_rate_interval(int events, double exposure) {
  if (!(exposure > 0) || events < 0) return {kNaN, kNaN};
  if (events == 0) return {0, -std::log(0.05) / exposure};
  const auto at_most = [&](double mean) { return poisson_at_most(events, mean); };
  const auto fewer = [&](double mean) { return poisson_at_most(events - 1, mean); };
  return {mean_with(fewer, 0.975, events + 1.0) / exposure, mean_with(at_most, 0.025, events + 1.0) / exposure};
}

double FallingCurve::at(double place) const {
  if (from.empty()) return kNaN;
  const auto next = std::ranges::upper_bound(from, place);
  return values[next == from.begin() ? 0 : static_cast<std::size_t>(next - from.begin()) - 1];
}

double FallingCurve::last_with(double value) const {
  const auto below = std::ranges::find_if(values, [&](double v) { return v < value; });
  if (below == values.begin()) return 0;
  if (below == values.end()) return std::numeric_limits<double>::infinity();
  const auto next = static_cast<std::size_t>(below - values.begin());
  return (until[next - 1] + from[next]) / 2;
}

FallingCurve falling_fit(std::vector<Trial> trials) {
  std::erase_if(trials, [](const Trial& trial) { return !(trial.whole > 0) || std::isnan(trial.at); });
  std::ranges::stable_sort(trials, {}, &Trial::at);
  struct Block {
    double from, until, part, whole;
  };
  std::vector<Block> places;  // trials at one place are one
  for (const Trial& trial : trials) {
    if (places.empty() || places.back().from != trial.at) places.push_back({trial.at, trial.at, 0, 0});
    places.back().part += trial.part;
    places.back().whole += trial.whole;
  }
  std::vector<Block> blocks;
  for (const Block& place : places) {
    blocks.push_back(place);
    while (blocks.size() > 1) {
      const Block last = blocks.back();
      Block& before = blocks[blocks.size() - 2];
      if (last.part * before.whole <= before.part * last.whole) break;
      before.until = last.until;
      before.part += last.part;
      before.whole += last.whole;
      blocks.pop_back();
    }
  }
  FallingCurve curve;
  for (const Block& block : blocks) {
    const double value = block.part / block.whole;
    if (!curve.values.empty() && curve.values.back() == value) {
      curve.until.back() = block.until;
      continue;
    }
    curve.from.push_back(block.from);
    curve.until.push_back(block.until);
    curve.values.push_back(value);
  }
  return curve;
}

double ranked_quantile(std::span<const double> sorted, double share) {
  if (sorted.empty()) return kNaN;
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const double low = sorted[below], high = sorted[std::min(below + 1, sorted.size() - 1)];
  return std::isfinite(high) ? low + (at - static_cast<double>(below)) * (high - low) : low;
}

Interval bootstrap_interval(std::vector<double> figures, std::size_t groups) {
  if (figures.empty() || groups < 2) return {kNaN, kNaN};
  std::ranges::sort(figures);
  return {ranked_quantile(figures, 0.025), ranked_quantile(figures, 0.975)};
}

void draw_weights(std::size_t groups, int draws, const std::function<void(const GroupWeights&)>& take) {
  GroupWeights weights{.groups = std::vector<double>(groups)};
  Random random(1);
  const auto half = [&] {  // half a chi-squared number of one degree of freedom
    const double normal = normal_quantile(random.uniform() + 0x1p-54);
    return normal * normal / 2;
  };
  for (int i = 0; groups > 0 && i < draws; ++i) {
    for (double& weight : weights.groups) weight = -std::log1p(-random.uniform());
    weights.failing = half();
    weights.succeeding = half();
    take(weights);
  }
}

DistributionDistance distribution_distance(std::vector<double> first, std::vector<double> second) {
  if (first.empty() || second.empty()) return {kNaN, kNaN};
  std::ranges::sort(first);
  std::ranges::sort(second);
  DistributionDistance result;
  std::size_t i = 0, j = 0;
  while (i < first.size() && j < second.size()) {
    const double value = std::min(first[i], second[j]);
    while (i < first.size() && first[i] == value) ++i;
    while (j < second.size() && second[j] == value) ++j;
    result.distance =
        std::max(result.distance, std::abs(double(i) / double(first.size()) - double(j) / double(second.size())));
  }
  const double root = std::sqrt(double(first.size()) * double(second.size()) / double(first.size() + second.size()));
  const double x = (root + 0.12 + 0.11 / root) * result.distance;
  if (x < 0.2) return result;  // the series below converges slowly there, to 1 within 1e-12
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  result.p_value = std::clamp(sum, 0.0, 1.0);
  return result;
}

double normal_share_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double normal_quantile(double share) {
  if (share <= 0) return -std::numeric_limits<double>::infinity();
  if (share >= 1) return std::numeric_limits<double>::infinity();
  // Newton's steps on the smaller tail, from a start that is within 0.02 (Abramowitz and Stegun 26.2.22).
  const bool upper = share > 0.5;
  const double tail = upper ? 1 - share : share;
  const double t = std::sqrt(-2 * std::log(tail));
  double x = -(t - (2.30753 + 0.27061 * t) / (1 + 0.99229 * t + 0.04481 * t * t));
  for (int i = 0; i < 8; ++i) {
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
    const double ratio = (normal_share_below(x) - tail) / density;
    const double step = ratio / (1 + x * ratio / 2);  // Halley
    x -= step;
    if (std::abs(step) < 1e-12) break;
  }
  return upper ? -x : x;
}

double both_below(double a, double b, double correlation) {
  const double at = std::clamp(correlation, -1.0, 1.0);
  if (!std::isfinite(a) || !std::isfinite(b)) return normal_share_below(a) * normal_share_below(b);
  // P(0) = Phi(a) Phi(b), and dP/dr is the joint density; with r = sin(angle) it has no pole.
  const double end = std::asin(at);
  double sum = 0;
  constexpr int kSteps = 64;  // Gauss-Legendre of two points in each
  for (int i = 0; i < kSteps; ++i)
    for (const double offset : {-0.5 / std::numbers::sqrt3, 0.5 / std::numbers::sqrt3}) {
      const double angle = end * (i + 0.5 + offset) / kSteps;
      const double c = std::cos(angle);
      sum += std::exp(-(a * a + b * b - 2 * a * b * std::sin(angle)) / (2 * c * c));
    }
  return std::clamp(normal_share_below(a) * normal_share_below(b) + sum * end / (2 * kSteps) / (2 * std::numbers::pi),
                    0.0, 1.0);
}

}  // namespace sigs
