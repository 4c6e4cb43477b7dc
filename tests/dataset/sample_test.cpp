// SPDX-License-Identifier: MIT
#include "dataset/sample.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

using namespace sigs;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();

std::vector<double> many(const Quantity& quantity, int count, const std::string& which = "q", std::uint64_t seed = 0) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(sampled(quantity, {seed, "video" + std::to_string(i), which}));
  return values;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

// Largest gap between the sample's distribution and the true one (Kolmogorov, Smirnov), times the root of its size:
// over 1.95 in one of 1000 correct samples.
double kolmogorov(std::vector<double> values, const std::function<double(double)>& probability_below) {
  std::sort(values.begin(), values.end());
  const auto count = double(values.size());
  double gap = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double wanted = probability_below(values[i]);
    gap = std::max({gap, double(i + 1) / count - wanted, wanted - double(i) / count});
  }
  return gap * std::sqrt(count);
}

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

constexpr double kMaxGap = 1.95;
const Quantity kUniform{.kind = Quantity::Kind::uniform, .low = -3, .high = 5};

}  // namespace

// Computed by another program from the description in sample.h, with arbitrary precision integers.
TEST_CASE("random bits are those of the documented generator") {
  CHECK(random_bits({0, "", ""}) == 0x2130748aaac80268);
  CHECK(random_bits({0, "1LRB737", "distance_m"}) == 0xc47b8967891c33c4);
  CHECK(random_bits({1, "1LRB737", "distance_m"}) == 0x49c0f9bb670961c7);
  CHECK(random_bits({0, "1LRB737", "bearing_deg"}) == 0xa840b644682c1ef2);
  CHECK(random_bits({kLargest, "día/ñ", "q"}) == 0x46debab7e33b2473);
  CHECK(random_bits({0, "ab", "c"}) == 0xb9a5cee60868fb11);
  CHECK(random_bits({0, "a", "bc"}) == 0x1dc081645467c9ba);
  CHECK(random_share({0, "1LRB737", "distance_m"}) == 0.7675100209972789);
}

// Quantiles from SciPy's truncnorm at the key's share; samples are rounded to some 1e-8 deviations.
TEST_CASE("a normal sample is the quantile of the truncated distribution") {
  struct Case {
    double mean, deviation, low, high, wanted;
  };
  for (const Case& c : {Case{100, 20, -kInfinite, kInfinite, 114.61342573131415},
                        Case{100, 20, 90, 130, 115.9877216096391}, Case{0, 1, 3, 4, 3.399014414017631},
                        Case{0, 1, 7, kInfinite, 7.201603067399579}, Case{0, 1, -kInfinite, -6, -6.042820426160301}}) {
    const Quantity normal{
        .kind = Quantity::Kind::normal, .low = c.low, .high = c.high, .mean = c.mean, .deviation = c.deviation};
    CHECK(std::abs(sampled(normal, {0, "1LRB737", "distance_m"}) - c.wanted) < 1e-7 * c.deviation);
  }
}

TEST_CASE("uniform samples fill their range evenly and never leave it") {
  const std::vector<double> values = many(kUniform, 20'000);
  CHECK(*std::min_element(values.begin(), values.end()) >= -3);
  CHECK(*std::max_element(values.begin(), values.end()) < 5);
  CHECK(kolmogorov(values, [](double x) { return (x + 3) / 8; }) < kMaxGap);
}

TEST_CASE("normal samples follow the normal distribution, truncated at its bounds") {
  const Quantity whole{
      .kind = Quantity::Kind::normal, .low = -kInfinite, .high = kInfinite, .mean = 10, .deviation = 2};
  CHECK(kolmogorov(many(whole, 10'000), [](double x) { return normal_below((x - 10) / 2); }) < kMaxGap);
  Quantity cut = whole;
  cut.low = 11;
  cut.high = 16;
  const double from = normal_below(0.5), to = normal_below(3);
  const std::vector<double> values = many(cut, 10'000);
  CHECK(*std::min_element(values.begin(), values.end()) >= 11);
  CHECK(*std::max_element(values.begin(), values.end()) <= 16);
  CHECK(kolmogorov(values, [&](double x) { return (normal_below((x - 10) / 2) - from) / (to - from); }) < kMaxGap);
}

TEST_CASE("a normal quantity without deviation is its mean") {
  const Quantity normal{.kind = Quantity::Kind::normal, .low = -kInfinite, .high = kInfinite, .mean = 7};
  CHECK(sampled(normal, {3, "v", "q"}) == 7);
}

TEST_CASE("choices come up equally often and nothing else does") {
  const Quantity choice{.kind = Quantity::Kind::choice, .choices = {1, 2.5, -4}};
  std::array<int, 3> counts{};
  for (const double value : many(choice, 9000)) {
    const auto place = std::find(choice.choices.begin(), choice.choices.end(), value);
    REQUIRE(place != choice.choices.end());
    ++counts.at(static_cast<std::size_t>(place - choice.choices.begin()));
  }
  for (const int count : counts) CHECK(std::abs(count - 3000) < 4 * std::sqrt(9000 * 2.0 / 9.0));  // 4 sigma
}

TEST_CASE("videos, quantities and seeds sample independently of each other") {
  const std::vector<double> one = many(kUniform, 10'000, "distance_m", 0);
  // 4 sigma of the correlation of independent samples.
  CHECK(std::abs(correlation(one, many(kUniform, 10'000, "speed_mps", 0))) < 0.04);
  CHECK(std::abs(correlation(one, many(kUniform, 10'000, "distance_m", 1))) < 0.04);
  std::vector<double> next(one.begin() + 1, one.end());
  next.push_back(one.front());
  CHECK(std::abs(correlation(one, next)) < 0.04);
}

TEST_CASE("every seed, also 0, gives its own sequence") {
  std::set<std::uint64_t> bits;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, kLargest, kLargest - 1})
    for (const char* const video : {"", "a", "b", "ab"})
      for (const char* const which : {"", "a", "b", "ab"}) bits.insert(random_bits({seed, video, which}));
  CHECK(bits.size() == 5 * 4 * 4);
}

TEST_CASE("log-uniform samples put as many values between 4 and 8 as between 64 and 128") {
  const Quantity quantity{.kind = Quantity::Kind::log_uniform, .low = 4, .high = 128};
  std::vector<int> octaves(5);
  for (int i = 0; i < 5000; ++i) {
    const std::string video = std::to_string(i);
    const double value = sampled(quantity, {7, video, "size_px"});
    // The C library's power gives the same number by another method; both round some fifty products.
    CHECK(value == doctest::Approx(4 * std::pow(32, random_share({7, video, "size_px"}))).epsilon(1e-13));
    ++octaves.at(static_cast<std::size_t>(std::log2(value / 4)));
  }
  for (const int count : octaves) CHECK(std::abs(count - 1000) < 150);  // five standard deviations of 28
}

TEST_CASE("a fixed quantity is its value, whatever the seed") {
  const Quantity fixed{.value = 12.5};
  CHECK(sampled(fixed, {0, "a", "q"}) == 12.5);
  CHECK(sampled(fixed, {9, "b", "q"}) == 12.5);
}

TEST_CASE("the span of a quantity contains all its samples") {
  const std::vector<Quantity> quantities{
      {.value = 3},
      kUniform,
      {.kind = Quantity::Kind::normal, .low = 1, .high = 2, .mean = 0, .deviation = 1},
      {.kind = Quantity::Kind::choice, .choices = {5, -1, 3}}};
  for (const Quantity& quantity : quantities) {
    const Span span = span_of(quantity);
    for (const double value : many(quantity, 200)) CHECK((value >= span.low && value <= span.high));
  }
  CHECK(span_of(quantities[3]).low == -1);
  CHECK(span_of(quantities[3]).high == 5);
}
