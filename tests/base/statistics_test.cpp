// SPDX-License-Identifier: MIT
#include "base/statistics.h"

#include <doctest/doctest.h>

#include <random>

using namespace sigs;

TEST_CASE("quantiles lie between sorted samples as the definition says, whatever their order") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-5, 5), share(0, 1);
  for (int count = 1; count < 40; ++count) {
    std::vector<double> samples;
    for (int i = 0; i < count; ++i) samples.push_back(value(random));
    std::vector<double> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < 20; ++i) {
      const double wanted = share(random), at = wanted * (count - 1);
      const auto low = static_cast<std::size_t>(at);
      const double high = sorted[std::min(low + 1, sorted.size() - 1)];
      // By the definition; both round once or twice.
      CHECK(quantile(samples, wanted) ==
            doctest::Approx(sorted[low] + (at - static_cast<double>(low)) * (high - sorted[low])).epsilon(1e-12));
    }
    CHECK(quantile(samples, 0) == sorted.front());
    CHECK(quantile(samples, 1) == sorted.back());
    CHECK(quantile(samples, -1) == sorted.front());
    CHECK(quantile(samples, 2) == sorted.back());
  }
}

TEST_CASE("medians of odd and even numbers, of floats and integers") {
  CHECK(median(std::vector<double>{3, 1, 2}) == 2);
  CHECK(median(std::vector<double>{4, 1, 3, 2}) == 2.5);
  CHECK(median(std::vector<float>{1, 8}) == 4.5);
  CHECK(median(std::vector<int>{1, 2}) == 1.5);
  CHECK(median(std::vector<double>{1e308, 1e308}) == 1e308);
}

TEST_CASE("no samples have no statistics") {
  CHECK(std::isnan(quantile(std::vector<double>(), 0.3)));
  CHECK(std::isnan(median(std::vector<float>())));
  CHECK(std::isnan(mean({})));
  CHECK(std::isnan(standard_deviation({})));
  CHECK(std::isnan(robust_standard_deviation(std::vector<double>())));
}

TEST_CASE("deviations are those of a Gaussian's samples; outliers do not move the robust one") {
  std::mt19937 random(3);
  std::normal_distribution<double> gaussian(10, 2);
  std::vector<double> samples;
  for (int i = 0; i < 20000; ++i) samples.push_back(gaussian(random));
  CHECK(mean(samples) == doctest::Approx(10).epsilon(0.005));  // 2 / sqrt(20000) is 0.014
  CHECK(standard_deviation(samples) == doctest::Approx(2).epsilon(0.02));
  CHECK(robust_standard_deviation(samples) == doctest::Approx(2).epsilon(0.03));
  for (int i = 0; i < 500; ++i) samples[static_cast<std::size_t>(i)] = 1e9;
  CHECK(robust_standard_deviation(samples) == doctest::Approx(2).epsilon(0.05));
}
