// SPDX-License-Identifier: MIT
#include "dataset/quantity_json.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "project/json_reading.h"

namespace sigs {

namespace {

constexpr double kMaxNumber = 1e12;        // of any number that a recipe gives
constexpr double kMaxBoundDeviations = 8;  // deviations from the mean at which hardly anything is left to sample from
constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Read = tl::expected<Quantity, std::string>;

std::optional<double> number_of(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const double number = json.get<double>();
  return std::abs(number) <= kMaxNumber ? std::optional(number) : std::nullopt;
}

Read uniform_of(const Json& json) {
  const bool is_pair = json.is_array() && json.size() == 2;
  const std::optional<double> low = is_pair ? number_of(json[0]) : std::nullopt;
  const std::optional<double> high = is_pair ? number_of(json[1]) : std::nullopt;
  if (!low || !high || *low > *high)
    return tl::unexpected("expected {\"uniform\": [low, high]} with low <= high, found " + shown(json));
  return Quantity{.kind = Quantity::Kind::uniform, .low = *low, .high = *high};
}

Read choice_of(const Json& json) {
  Quantity quantity{.kind = Quantity::Kind::choice};
  if (json.is_array())
    for (const Json& item : json)
      if (const std::optional<double> number = number_of(item)) quantity.choices.push_back(*number);
  if (quantity.choices.empty() || quantity.choices.size() != json.size())
    return tl::unexpected("expected {\"choice\": [numbers]}, at least one, found " + shown(json));
  return quantity;
}

Read normal_of(const Json& json) {
  const std::string expected =
      "expected {\"normal\": {\"mean\": m, \"deviation\": d, \"low\": a, \"high\": b}}, found " + shown(json);
  if (!json.is_object()) return tl::unexpected(expected);
  Quantity normal{.kind = Quantity::Kind::normal, .low = -kInfinite, .high = kInfinite, .deviation = -1};
  bool has_mean = false;
  for (const auto& [key, item] : json.items()) {
    const std::optional<double> number = number_of(item);
    double* const place = key == "mean"        ? &normal.mean
                          : key == "deviation" ? &normal.deviation
                          : key == "low"       ? &normal.low
                          : key == "high"      ? &normal.high
                                               : nullptr;
    if (!number || place == nullptr) return tl::unexpected(expected);
    *place = *number;
    has_mean = has_mean || key == "mean";
  }
  if (!has_mean || normal.deviation < 0 || normal.low > normal.high) return tl::unexpected(expected);
  const double max_offset = kMaxBoundDeviations * normal.deviation;
  if (normal.low > normal.mean + max_offset || normal.high < normal.mean - max_offset)
    return tl::unexpected(
        std::string("the bounds lie more than 8 deviations from the mean; nothing is left to sample"));
  return normal;
}

}  // namespace

tl::expected<Quantity, std::string> quantity_of(const Json& json) {
  if (const std::optional<double> number = number_of(json))
    return Quantity{.kind = Quantity::Kind::fixed, .value = *number};
  if (json.is_object() && json.size() == 1) {
    const std::string& kind = json.begin().key();
    const Json& rest = json.begin().value();
    if (kind == "uniform") return uniform_of(rest);
    if (kind == "normal") return normal_of(rest);
    if (kind == "choice") return choice_of(rest);
  }
  return tl::unexpected("expected a number up to 1e12, {\"uniform\": [low, high]}, {\"normal\": {...}} or " +
                        std::string("{\"choice\": [...]}, found ") + shown(json));
}

}  // namespace sigs
