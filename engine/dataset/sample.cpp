// SPDX-License-Identifier: MIT
#include "dataset/sample.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ensure.h"
#include "base/random.h"

namespace sigs {

namespace {

constexpr double kMaxDeviations = 37;  // standard deviations: beyond them a double holds no probability but 0

std::uint64_t absorbed(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;  // FNV-1a
  return splitmix64(hash + kSplitMixStep);
}

// Of the standard normal distribution, precise in the lower tail.
double probability_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

// By bisection. The last digits of erfc, in which machines may differ, are rounded away.
double inverse_probability(double probability, double from, double to) {
  double low = from, high = to;
  for (int i = 0; i < 64; ++i) {
    const double middle = low + (high - low) / 2;
    (probability_below(middle) < probability ? low : high) = middle;
  }
  const double step = (to - from) * 0x1p-30;
  return step > 0 ? from + std::round((high - from) / step) * step : from;
}

// Standard normal, truncated to [low, high]: the value that a share of it lies below.
double truncated_normal(double low, double high, double share) {
  if (low > 0) return -truncated_normal(-high, -low, 1 - share);  // into the tail where probabilities are precise
  const double from = std::clamp(low, -kMaxDeviations, kMaxDeviations);
  const double to = std::clamp(high, -kMaxDeviations, kMaxDeviations);
  const double below = probability_below(from);
  return inverse_probability(below + (probability_below(to) - below) * share, from, to);
}

// base^share for a share in [0, 1), by square roots and products, which every machine rounds alike.
double power_of(double base, double share) {
  double power = 1;
  for (double root = std::sqrt(base); share > 0; root = std::sqrt(root)) {
    share *= 2;
    if (share < 1) continue;
    power *= root;
    share -= 1;
  }
  return power;
}

double sampled_normal(const Quantity& quantity, double share) {
  if (quantity.deviation == 0) return std::clamp(quantity.mean, quantity.low, quantity.high);
  const double z = truncated_normal((quantity.low - quantity.mean) / quantity.deviation,
                                    (quantity.high - quantity.mean) / quantity.deviation, share);
  return std::clamp(quantity.mean + quantity.deviation * z, quantity.low, quantity.high);
}

}  // namespace

std::uint64_t random_bits(const SampleKey& key) {
  const std::uint64_t start = splitmix64(key.seed + kSplitMixStep);
  return splitmix64(absorbed(absorbed(start, key.what), key.which) + kSplitMixStep);
}

double random_share(const SampleKey& key) {
  return static_cast<double>(random_bits(key) >> 11) * 0x1p-53;
}

double sampled(const Quantity& quantity, const SampleKey& key) {
  switch (quantity.kind) {
    case Quantity::Kind::fixed:
      return quantity.value;
    case Quantity::Kind::uniform:
      return quantity.low + (quantity.high - quantity.low) * random_share(key);
    case Quantity::Kind::log_uniform:
      return std::min(quantity.low * power_of(quantity.high / quantity.low, random_share(key)), quantity.high);
    case Quantity::Kind::normal:
      return sampled_normal(quantity, random_share(key));
    case Quantity::Kind::choice: {
      ENSURE(!quantity.choices.empty());
      const auto count = static_cast<double>(quantity.choices.size());
      return quantity.choices[static_cast<std::size_t>(random_share(key) * count)];
    }
  }
  return 0;
}

Span span_of(const Quantity& quantity) {
  switch (quantity.kind) {
    case Quantity::Kind::fixed:
      return {quantity.value, quantity.value};
    case Quantity::Kind::uniform:
    case Quantity::Kind::log_uniform:
    case Quantity::Kind::normal:
      return {quantity.low, quantity.high};
    case Quantity::Kind::choice: {
      ENSURE(!quantity.choices.empty());
      const auto [low, high] = std::minmax_element(quantity.choices.begin(), quantity.choices.end());
      return {*low, *high};
    }
  }
  return {};
}

}  // namespace sigs
