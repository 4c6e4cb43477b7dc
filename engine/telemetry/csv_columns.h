// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "telemetry/track.h"

namespace sigs {

// How a channel's values stand in the columns of track_csv.h: the names of the columns, and values as numbers and back.

// Names of the columns of a channel, in order; the channel by its name as for_each_channel() gives it.
[[nodiscard]] std::vector<std::string> csv_columns(std::string_view channel);

// The column name of ours for one that others use, "lat" -> "latitude_deg"; the same name in small letters otherwise.
[[nodiscard]] std::string csv_column_name(std::string_view name);

// A value as the numbers of its columns.
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const GeodeticPosition& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const glm::dvec3& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, const glm::dquat& value);
[[nodiscard]] std::vector<double> csv_numbers(std::string_view channel, double value);

// And back. `numbers` has as many as there are columns, all finite. False: they are no such value (a place beyond the
// poles, a quaternion of length 0).
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, GeodeticPosition& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dvec3& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dquat& value);
[[nodiscard]] bool csv_value(std::string_view channel, std::span<const double> numbers, double& value);

}  // namespace sigs
