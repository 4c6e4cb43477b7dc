// SPDX-License-Identifier: MIT
#include "base/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "base/interpolation.h"
#include "base/pose.h"
#include "base/random.h"
#include "base/text.h"
#include "base/transfer.h"

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

TEST_CASE("every 8-bit code value comes back from linear light") {
  for (int code = 0; code <= 255; ++code) {
    const float display = static_cast<float>(code) / 255.0F;
    CHECK(std::lround(255.0F * display_of_linear(linear_of_display(display))) == code);
  }
}

TEST_CASE("the transfer function has the known values of the standard") {
  CHECK(linear_of_display(0.0F) == 0.0F);
  CHECK(linear_of_display(1.0F) == doctest::Approx(1.0F).epsilon(1e-6));
  CHECK(linear_of_display(0.5F) == doctest::Approx(0.21404114F).epsilon(1e-5));  // IEC 61966-2-1
  CHECK(linear_of_display(0.04045F) == doctest::Approx(0.0031308F).epsilon(1e-4));
}

TEST_CASE("values below zero and above one follow the curve and its mirror image") {
  for (const float display : {-0.2F, -0.01F, 1.1F, 1.5F}) {
    CHECK(display_of_linear(linear_of_display(display)) == doctest::Approx(display).epsilon(1e-5));
    CHECK(linear_of_display(-display) == -linear_of_display(display));
  }
}

namespace {

// The inverse of SplitMix64's output function, to start a generator at a known state.
std::uint64_t unmixed(std::uint64_t z) {
  const auto inverse = [](std::uint64_t odd) {  // modulo 2^64, by Newton's method
    std::uint64_t x = odd;
    for (int i = 0; i < 6; ++i) x *= 2 - odd * x;
    return x;
  };
  z ^= (z >> 31) ^ (z >> 62);
  z *= inverse(0x94d049bb133111eb);
  z ^= (z >> 27) ^ (z >> 54);
  z *= inverse(0xbf58476d1ce4e5b9);
  return z ^ (z >> 30) ^ (z >> 60);
}

}  // namespace

TEST_CASE("the generator is SplitMix64: from the state 1234567 it gives the numbers that others publish") {
  Random random(unmixed(unmixed(1234567)));
  CHECK(random.bits() == 6457827717110365317U);
  CHECK(random.bits() == 3203168211198807973U);
  CHECK(random.bits() == 9817491932198370423U);
  CHECK(Random(1, 0).bits() != Random(1, 1).bits());
  CHECK(Random(1, 0).bits() != Random(2, 0).bits());
}

TEST_CASE("a straight line in time comes back between its samples, and its ends go on beyond them") {
  const std::vector<double> times_s{1, 2, 4};
  const std::vector<double> heights_m{10, 12, 16};  // 2 m/s
  for (const double time_s : {1.0, 1.25, 2.0, 2.5, 3.75, 4.0})
    CHECK(value_at(times_s, heights_m, time_s) == doctest::Approx(8 + 2 * time_s).epsilon(1e-15));
  CHECK(value_at(times_s, heights_m, -100) == 10);
  CHECK(value_at(times_s, heights_m, 100) == 16);
  CHECK(value_at({5}, std::vector<double>{7}, 5.5) == 7);
}

TEST_CASE("at a sample its value comes back to the bit, of several at one time the last") {
  const std::vector<double> times_s{0, 0.1, 0.1, 0.3};
  const std::vector<glm::dquat> turns{rotation_of({0.1, 0.2, 0.3}), rotation_of({1, 0, 0}), rotation_of({0, 0.7, -2}),
                                      rotation_of({0.5, 0.5, 0.5})};
  CHECK(value_at(times_s, turns, 0) == turns[0]);
  CHECK(value_at(times_s, turns, 0.1) == turns[2]);
  CHECK(value_at(times_s, turns, 0.3) == turns[3]);
}

TEST_CASE("a rotation turns at constant rate, by the shorter way") {
  const std::vector<double> times_s{0, 1};
  const glm::dquat end = rotation_of({.yaw_rad = 2});
  for (const glm::dquat& same : {end, -end}) {  // two signs of one rotation
    const glm::dquat middle = value_at(times_s, std::vector<glm::dquat>{{1, 0, 0, 0}, same}, 0.25);
    CHECK(attitude_of(middle).yaw_rad == doctest::Approx(0.5).epsilon(1e-12));
  }
}

TEST_CASE("neighbours are found by any member that is a time") {
  struct Sample {
    double time_s;
    int value;
  };
  const std::vector<Sample> samples{{0, 3}, {10, 4}, {30, 5}};
  const Neighbours at = neighbours_of(samples, 15, &Sample::time_s);
  CHECK(at.before == 1);
  CHECK(at.after == 2);
  CHECK(at.share == 0.25);
  CHECK(neighbours_of(samples, 31, &Sample::time_s).before == 2);
}

TEST_CASE("the whole of a text is a number, or none") {
  CHECK(parsed_number("1.5") == 1.5);
  CHECK(parsed_number("-2e3") == -2000);
  CHECK(parsed_number("+7") == 7);
  CHECK(parsed_number<int>("42") == 42);
  CHECK(parsed_number<std::uint8_t>("255") == 255);
  for (const char* text : {"", "+", "-", "+-1", "++1", "1 ", " 1", "1,5", "1.5x", "0x10", "1e", "1e999", "one"})
    CHECK_MESSAGE(!parsed_number(text), text);
  for (const char* text : {"1.0", "99999999999", "1e2"}) CHECK_MESSAGE(!parsed_number<int>(text), text);
  CHECK_FALSE(parsed_number<std::uint8_t>("256"));
  CHECK_FALSE(parsed_number(std::string_view("1\0", 2)));
}

TEST_CASE("finite numbers are those that are neither nan nor inf") {
  CHECK(finite_number("-0.25") == -0.25);
  CHECK(std::isnan(*parsed_number("nan")));
  CHECK(std::isinf(*parsed_number("-inf")));
  for (const char* text : {"nan", "inf", "-inf", "infinity", "NaN", ""}) CHECK_MESSAGE(!finite_number(text), text);
}
