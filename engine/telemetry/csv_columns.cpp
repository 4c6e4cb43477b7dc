// SPDX-License-Identifier: MIT
#include "telemetry/track_csv.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/pose.h"
#include "base/text.h"

namespace sigs {
namespace {

bool is_attitude(std::string_view channel) {
  return channel.starts_with("ned_from_");
}

}  // namespace

std::vector<std::string> csv_columns(std::string_view channel) {
  static const std::map<std::string, std::vector<std::string>, std::less<>> kColumns = {
      {"position", {"latitude_deg", "longitude_deg", "height_m"}},
      {"local_position_ned_m", {"north_m", "east_m", "down_m"}},
      {"velocity_ned_mps", {"vn_mps", "ve_mps", "vd_mps"}},
      {"ned_from_airframe", {"roll_deg", "pitch_deg", "yaw_deg"}},
      {"ned_from_camera", {"camera_roll_deg", "camera_pitch_deg", "camera_yaw_deg"}},
      {"camera_attitude_sd_rad", {"camera_sd_x_deg", "camera_sd_y_deg", "camera_sd_z_deg"}},
      {"start_from_camera", {"start_camera_qw", "start_camera_qx", "start_camera_qy", "start_camera_qz"}},
      {"camera_from_image", {"camera_image_qw", "camera_image_qx", "camera_image_qy", "camera_image_qz"}},
      {"camera_rate_radps", {"camera_rate_x_radps", "camera_rate_y_radps", "camera_rate_z_radps"}},
      {"airframe_rate_radps", {"airframe_rate_x_radps", "airframe_rate_y_radps", "airframe_rate_z_radps"}},
      {"camera_force_mps2", {"camera_force_x_mps2", "camera_force_y_mps2", "camera_force_z_mps2"}},
      {"airframe_force_mps2", {"airframe_force_x_mps2", "airframe_force_y_mps2", "airframe_force_z_mps2"}},
      {"camera_gravity", {"camera_gravity_x", "camera_gravity_y", "camera_gravity_z"}},
      {"exposure_s", {"exposure_s"}},
      {"white_cdpm2", {"white_cdpm2"}},
  };
  return kColumns.find(channel)->second;
}

std::string csv_column_name(std::string_view name) {
  struct Names {
    const char* ours;
    std::vector<std::string_view> others;
  };
  static const std::vector<Names> kNames = {
      {"time_s", {"time", "t", "t_s", "timestamp_s"}},
      {"latitude_deg", {"lat", "lat_deg", "latitude"}},
      {"longitude_deg", {"lon", "lng", "lon_deg", "long", "longitude"}},
      {"height_m", {"alt", "alt_m", "altitude", "altitude_m", "height"}},
      {"roll_deg", {"roll"}},
      {"pitch_deg", {"pitch"}},
      {"yaw_deg", {"yaw", "heading", "heading_deg"}},
      {"vn_mps", {"vn"}},
      {"ve_mps", {"ve"}},
      {"vd_mps", {"vd"}},
  };
  std::string small = lower_case(name);
  for (const Names& names : kNames)
    if (std::ranges::find(names.others, small) != names.others.end()) return names.ours;
  return small;
}

std::vector<double> csv_numbers(std::string_view, const GeodeticPosition& value) {
  return {value.latitude_deg, value.longitude_deg, value.height_m};
}

std::vector<double> csv_numbers(std::string_view channel, const glm::dvec3& value) {
  if (channel == "camera_attitude_sd_rad") return {deg_of_rad(value.x), deg_of_rad(value.y), deg_of_rad(value.z)};
  return {value.x, value.y, value.z};
}

std::vector<double> csv_numbers(std::string_view channel, const glm::dquat& value) {
  if (!is_attitude(channel)) return {value.w, value.x, value.y, value.z};
  const Attitude attitude = attitude_of(value);
  return {deg_of_rad(attitude.roll_rad), deg_of_rad(attitude.pitch_rad), deg_of_rad(attitude.yaw_rad)};
}

std::vector<double> csv_numbers(std::string_view, double value) {
  return {value};
}

bool csv_value(std::string_view, std::span<const double> numbers, GeodeticPosition& value) {
  value = {numbers[0], numbers[1], numbers[2]};
  return check_place(value).has_value();
}

bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dvec3& value) {
  value = {numbers[0], numbers[1], numbers[2]};
  if (channel == "camera_attitude_sd_rad") value = value * rad_of_deg(1);
  return true;
}

bool csv_value(std::string_view channel, std::span<const double> numbers, glm::dquat& value) {
  if (is_attitude(channel)) {
    value = rotation_of({rad_of_deg(numbers[0]), rad_of_deg(numbers[1]), rad_of_deg(numbers[2])});
    return true;
  }
  const glm::dquat read(numbers[0], numbers[1], numbers[2], numbers[3]);
  const double length = glm::length(read);
  if (!(length > 1e-6) || !std::isfinite(length)) return false;
  value = std::abs(length - 1) < 1e-12 ? read : read / length;
  return true;
}

bool csv_value(std::string_view, std::span<const double> numbers, double& value) {
  value = numbers[0];
  return true;
}

}  // namespace sigs
