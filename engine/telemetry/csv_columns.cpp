// SPDX-License-Identifier: MIT
#include "telemetry/track_csv.h"

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
  static const std::map<std::string, std::string, std::less<>> kOurs = {
      {"time", "time_s"},
      {"t", "time_s"},
      {"t_s", "time_s"},
      {"timestamp_s", "time_s"},
      {"lat", "latitude_deg"},
      {"lat_deg", "latitude_deg"},
      {"latitude", "latitude_deg"},
      {"lon", "longitude_deg"},
      {"lng", "longitude_deg"},
      {"lon_deg", "longitude_deg"},
      {"long", "longitude_deg"},
      {"longitude", "longitude_deg"},
      {"alt", "height_m"},
      {"alt_m", "height_m"},
      {"altitude", "height_m"},
      {"altitude_m", "height_m"},
      {"height", "height_m"},
      {"roll", "roll_deg"},
      {"pitch", "pitch_deg"},
      {"yaw", "yaw_deg"},
      {"heading", "yaw_deg"},
      {"heading_deg", "yaw_deg"},
      {"vn", "vn_mps"},
      {"ve", "ve_mps"},
      {"vd", "vd_mps"},
  };
  const std::string small = lower_case(name);
  const auto found = kOurs.find(small);
  return found != kOurs.end() ? found->second : small;
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
