// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sigs {

// The kind of a flight: one of the four of the paper's Table 1, which are given by places in the image; an encounter
// (encounter.h); a flight drawn from an encounter model or recorded, placed as an encounter (flight_plan.h); or a
// straight flight by its place in the image and its size in pixels at one time.
enum class FlightKind {
  left_right,
  right_left,
  approaching,
  moving_away,
  encounter,
  encounter_model,
  recorded,
  image_position
};

// Names as recipes write them: "left_right".
[[nodiscard]] std::string_view name_of(FlightKind kind);
[[nodiscard]] std::optional<FlightKind> flight_kind_of(std::string_view name);
[[nodiscard]] std::string flight_kind_names();  // all of them: "left_right, right_left, ..."

// One of the numbers that describe a flight. Reading, planning and docs/dataset-recipe.md all use this list.
struct FlightQuantity {
  std::string_view name;  // with its unit: "miss_distance_m"
  double low = 0;         // minimum and maximum; a flight with a value outside them is impossible
  double high = 0;
  std::optional<double> standard;  // value where the recipe gives none; none: there is no default
  bool required = false;
  std::string_view help;
};

// The quantities of a kind, in the order of the documentation.
[[nodiscard]] std::span<const FlightQuantity> quantities_of(FlightKind kind);

}  // namespace sigs
