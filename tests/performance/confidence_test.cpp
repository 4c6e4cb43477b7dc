// SPDX-License-Identifier: MIT
#include "performance/confidence.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"

namespace sigs::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// P(N <= events), each term by itself.
double plain_poisson(int events, double mean) {
  double sum = 0;
  for (int n = 0; n <= events; ++n) sum += std::exp(n * std::log(mean) - mean - std::lgamma(n + 1.0));
  return sum;
}

// The falling fit by the formula of minima and maxima (Barlow et al. 1972): at place i, the least over l <= i of the
// greatest mean from l to u, u >= i.
std::vector<double> min_max_fit(const std::vector<Trial>& trials) {
  std::vector<double> values;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    double least = kInfinite;
    for (std::size_t l = 0; l <= i; ++l) {
      double greatest = -kInfinite;
      for (std::size_t u = i; u < trials.size(); ++u) {
        double part = 0, whole = 0;
        for (std::size_t k = l; k <= u; ++k) {
          part += trials[k].part;
          whole += trials[k].whole;
        }
        greatest = std::max(greatest, part / whole);
      }
      least = std::min(least, greatest);
    }
    values.push_back(least);
  }
  return values;
}

// The share of repetitions whose interval holds the truth.
template <class Draw>
double coverage(int repetitions, double truth, const Draw& interval_of) {
  int held = 0;
  for (int i = 0; i < repetitions; ++i) {
    Random random(7, static_cast<std::uint64_t>(i));
    const Interval interval = interval_of(random);
    held += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  return double(held) / repetitions;
}

double drawn_normal(Random& random) {
  return normal_quantile(random.uniform() + 0x1p-54);
}

// Groups of trials whose probability differs from group to group.
std::vector<GroupShare> drawn_groups(int groups, int trials, double sd, Random& random) {
  std::vector<GroupShare> drawn;
  for (int g = 0; g < groups; ++g) {
    const double share = normal_share_below(0.5 * std::sqrt(1 + sd * sd) + sd * drawn_normal(random));
    GroupShare group{.part = 0, .whole = double(trials)};
    for (int t = 0; t < trials; ++t) group.part += random.uniform() < share ? 1 : 0;
    drawn.push_back(group);
  }
  return drawn;
}

}  // namespace

TEST_CASE("Wilson's interval is the set of shares that a test of the normal approximation does not refuse") {
  const Interval interval = wilson_interval(8, 10);
  for (const double end : {interval.low, interval.high})
    CHECK(std::abs(0.8 - end) / std::sqrt(end * (1 - end) / 10) == doctest::Approx(1.959963984540054).epsilon(1e-12));
  CHECK(wilson_interval(0, 10).low == 0);
  CHECK(wilson_interval(0, 10).high == doctest::Approx(3.8414588 / (10 + 3.8414588)).epsilon(1e-6));
  CHECK(wilson_interval(10, 10).high == 1);
  CHECK(std::isnan(wilson_interval(0, 0).low));
  CHECK(std::isnan(wilson_interval(1, std::nan("")).low));
}

TEST_CASE("the ends of a Poisson interval have tails of 2.5 %") {
  for (const int events : {1, 2, 17, 400}) {
    const Interval rate = poisson_rate_interval(events, 2);
    CHECK(1 - plain_poisson(events - 1, 2 * rate.low) == doctest::Approx(0.025).epsilon(1e-6));
    CHECK(plain_poisson(events, 2 * rate.high) == doctest::Approx(0.025).epsilon(1e-6));
  }
  // The rule of three.
  CHECK(poisson_rate_interval(0, 5).high == doctest::Approx(2.995732273554 / 5).epsilon(1e-9));
  CHECK(poisson_rate_interval(0, 5).low == 0);
  CHECK(std::isnan(poisson_rate_interval(3, 0).high));
  CHECK(std::isnan(poisson_rate_interval(3, std::nan("")).low));
  CHECK(poisson_rate_interval(100'000, 1).high == doctest::Approx(100'000 + 1.96 * std::sqrt(1e5)).epsilon(1e-4));
}

TEST_CASE("the falling fit is the one of minima and maxima") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<Trial> trials;
    for (int i = 0; i < 30; ++i)
      trials.push_back(
          {double(i), std::floor(4 * random.uniform() * (40 - i) / 40), 1 + std::floor(4 * random.uniform())});
    for (Trial& trial : trials) trial.part = std::min(trial.part, trial.whole);
    const std::vector<double> twin = min_max_fit(trials);
    std::vector<Trial> shuffled = trials;
    std::ranges::reverse(shuffled);
    const FallingCurve curve = falling_fit(shuffled);
    for (std::size_t i = 0; i < trials.size(); ++i)
      CHECK(curve.at(double(i)) == doctest::Approx(twin[i]).epsilon(1e-12));
  }
}

TEST_CASE("the falling fit at the edges") {
  CHECK(std::isnan(falling_fit({}).at(3)));
  CHECK(falling_fit({}).last_with(0.5) == 0);
  const FallingCurve same = falling_fit({{5, 1, 1}, {5, 0, 1}, {5, 1, 2}});
  CHECK(same.at(0) == 0.5);
  CHECK(same.at(1e7) == 0.5);
  CHECK(same.last_with(0.5) == kInfinite);
  CHECK(same.last_with(0.6) == 0);
  const FallingCurve step = falling_fit({{100, 1, 1}, {200, 1, 1}, {300, 0, 1}, {std::nan(""), 1, 1}, {400, 1, 0}});
  CHECK(step.at(299) == 1);
  CHECK(step.at(300) == 0);
  CHECK(step.last_with(0.9) == 250);  // between the last one seen and the first one missed
  CHECK(step.until.back() == 300);
  // A rise is pooled: 0.5, 0.5 and not 0, 1.
  const FallingCurve rise = falling_fit({{1, 0, 1}, {2, 1, 1}});
  CHECK(rise.at(1) == 0.5);
  CHECK(rise.at(2) == 0.5);
}

TEST_CASE("95 % intervals hold the truth in 93 to 97 % of 1000 repetitions") {
  SUBCASE("Wilson") {
    const double held = coverage(1000, 0.7, [](Random& random) {
      double part = 0;
      for (int i = 0; i < 80; ++i) part += random.uniform() < 0.7 ? 1 : 0;
      return wilson_interval(part, 80);
    });
    MESSAGE("Wilson: ", held);
    CHECK(held > 0.93);
    CHECK(held < 0.97);
  }
  SUBCASE("Poisson") {
    const double held = coverage(1000, 30.0, [](Random& random) {
      int events = 0;
      for (double t = -std::log(1 - random.uniform()); t < 30; t -= std::log(1 - random.uniform())) ++events;
      return poisson_rate_interval(events, 1);
    });
    MESSAGE("Poisson: ", held);
    CHECK(held > 0.93);
    CHECK(held < 0.97);
  }
  SUBCASE("shares of groups that differ") {
    for (const auto& [groups, trials, sd] :
         {std::tuple(30, 20, 1.0), std::tuple(12, 100, 0.7), std::tuple(60, 5, 0.0)}) {
      const double held =
          coverage(1000, normal_share_below(0.5), [&, groups = groups, trials = trials, sd = sd](Random& random) {
            return clustered_interval(drawn_groups(groups, trials, sd, random));
          });
      MESSAGE("clustered, ", groups, " groups: ", held);
      CHECK(held > 0.93);
      CHECK(held < 0.97);
    }
  }
}

TEST_CASE("intervals of groups at the edges") {
  CHECK(std::isnan(clustered_interval({}).low));
  const std::vector<GroupShare> one{{3, 10}};
  CHECK(clustered_interval(one).low == 0);
  CHECK(clustered_interval(one).high == 1);
  // All succeed: five encounters are worth five trials, whatever their frames.
  const std::vector<GroupShare> five(5, {100, 100});
  CHECK(clustered_interval(five).high == 1);
  CHECK(clustered_interval(five).low < wilson_interval(5, 5).low);
  CHECK(clustered_interval(five).low > 0.2);
  // Groups that are all alike are worth no more than their trials.
  const std::vector<GroupShare> alike(100, {5, 10});
  CHECK(clustered_interval(alike).low == doctest::Approx(wilson_interval(500, 1000).low).epsilon(0.002));
}

TEST_CASE("the bivariate normal distribution") {
  // Of medians: Sheppard's formula.
  for (const double r : {-0.99, -0.5, 0.0, 0.3, 0.9, 0.999})
    CHECK(both_below(0, 0, r) == doctest::Approx(0.25 + std::asin(r) / (2 * std::numbers::pi)).epsilon(1e-6));
  CHECK(both_below(0.7, -1.2, 0) == doctest::Approx(normal_share_below(0.7) * normal_share_below(-1.2)).epsilon(1e-12));
  CHECK(both_below(kInfinite, 0.3, 0.5) == doctest::Approx(normal_share_below(0.3)).epsilon(1e-12));
  CHECK(both_below(-kInfinite, 0.3, 0.5) == 0);
  // Against drawing pairs.
  Random random(3);
  int both = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double a = drawn_normal(random), b = 0.8 * a + 0.6 * drawn_normal(random);
    both += a < 0.4 && b < -0.5 ? 1 : 0;
  }
  CHECK(both / 200'000.0 == doctest::Approx(both_below(0.4, -0.5, 0.8)).epsilon(0.01));  // 4 standard deviations
}

TEST_CASE("normal quantiles come back, far out too") {
  for (const double share : {1e-300, 1e-12, 0.001, 0.025, 0.5, 0.975, 1 - 1e-9})
    CHECK(normal_share_below(normal_quantile(share)) == doctest::Approx(share).epsilon(1e-9));
  CHECK(normal_quantile(0.975) == doctest::Approx(1.959963984540054).epsilon(1e-12));
  CHECK(normal_quantile(0) == -kInfinite);
  CHECK(normal_quantile(1) == kInfinite);
  // Tables of Student's t.
  CHECK(student_t_975(1) == doctest::Approx(12.706).epsilon(1e-3));
  CHECK(student_t_975(5) == doctest::Approx(2.5706).epsilon(2e-3));
  CHECK(student_t_975(30) == doctest::Approx(2.0423).epsilon(1e-4));
}

TEST_CASE("Kolmogorov and Smirnov's distance") {
  CHECK(distribution_distance({1, 2, 3, 4}, {1, 2, 3, 4}).distance == 0);
  CHECK(distribution_distance({1, 2, 3, 4}, {11, 12}).distance == 1);
  // 0 and infinity are ranks like others: half of the first is 0, none of the second.
  CHECK(distribution_distance({0, 0, 5, kInfinite}, {5, 5, 6, kInfinite}).distance == 0.5);
  CHECK(std::isnan(distribution_distance({}, {1}).distance));
  // Samples of one distribution are refused at 5 % in 5 % of cases.
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(11, seed);
    std::vector<double> a, b;
    for (int i = 0; i < 60; ++i) a.push_back(random.uniform());
    for (int i = 0; i < 80; ++i) b.push_back(random.uniform());
    refused += distribution_distance(a, b).p_value < 0.05 ? 1 : 0;
  }
  CHECK(refused > 25);
  CHECK(refused < 75);
}

}  // namespace sigs::test
