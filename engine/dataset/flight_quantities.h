// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sigs {

// How one intruder flies: one of the paper's four ways (Table 1), or an encounter.
enum class FlightKind { left_right, right_left, approaching, moving_away, encounter };

[[nodiscard]] std::string_view name_of(FlightKind kind);
[[nodiscard]] std::optional<FlightKind> flight_kind_of(std::string_view name);
[[nodiscard]] std::span<const FlightKind> all_flight_kinds();

// One number that a flight is made of. Said here once for reading, planning and docs/dataset.md.
struct FlightQuantity {
  std::string_view name;  // with its unit: "miss_distance_m"
  double low = 0;         // least and greatest value that makes sense; what is sampled beyond them is impossible
  double high = 0;
  std::optional<double> standard;  // taken where the recipe gives none; none: then there is none
  bool required = false;
  std::string_view help;
};

[[nodiscard]] std::span<const FlightQuantity> quantities_of(FlightKind kind);

}  // namespace sigs
