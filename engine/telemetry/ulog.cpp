// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "base/pose.h"
#include "base/text.h"
#include "geo/geodetic.h"
#include "telemetry/log_messages.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

using TopicValues = std::span<const double>;

constexpr double kMinUtc_us = 946684800e6;  // the year 2000; before it, the receiver had no date
constexpr double kUtcDrift_s = 0.5;
constexpr std::size_t kMaxDropouts = 10;  // that are named

// A gimbal's attitude as it is logged; whether yaw is from north or from the nose depends on its flags.
struct GimbalAttitude {
  glm::dquat q{1, 0, 0, 0};
  bool yaw_from_north = true;
};

// A unit quaternion, if the numbers are nearly one. Elements w, x, y, z.
std::optional<glm::dquat> unit_quaternion(TopicValues wxyz) {
  const glm::dquat q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const double length = glm::length(q);
  if (!(std::abs(length - 1) < 0.1)) return {};
  return q / length;
}

bool is_true(double flag) {
  return std::isfinite(flag) && flag != 0;
}

// Not false: topics of some versions lack the flag.
bool is_not_false(double flag) {
  return !std::isfinite(flag) || flag != 0;
}

// Seconds since boot; the time of the measurement if the topic has it.
double time_of(TopicValues v) {
  return 1e-6 * (v[1] > 0 ? v[1] : v[0]);
}

class UlogReading {
 public:
  [[nodiscard]] UlogReader reader() {
    return {.wanted = [](std::string_view topic) { return fields_of(topic); },
            .take = [this](std::string_view topic, TopicValues v) { take(topic, v); }};
  }

  Track track(const UlogContents& log, const std::filesystem::path& file);

 private:
  struct Topic {
    const char* fields = "";  // those after timestamp and timestamp_sample, with blanks between
    void (UlogReading::*take)(TopicValues v) = nullptr;
  };
  static const std::map<std::string, Topic, std::less<>>& topics();

  static std::vector<std::string> fields_of(std::string_view topic) {
    const auto found = topics().find(topic);
    if (found == topics().end()) return {};
    std::vector<std::string> fields = {"timestamp", "timestamp_sample"};
    std::string_view rest = found->second.fields;
    while (!rest.empty()) fields.emplace_back(next_token(rest));
    return fields;
  }
  void take(std::string_view topic, TopicValues v) {
    if (const auto found = topics().find(topic); found != topics().end()) (this->*found->second.take)(v);
  }

  void take_attitude(TopicValues v) {
    if (const std::optional<glm::dquat> q = unit_quaternion(v.subspan(2, 4)))
      attitude_.add(time_of(v), *q);
    else
      attitude_.leave_out("the quaternion is not of length 1", time_of(v));
  }

  void take_local_position(TopicValues v) {
    const double t_s = time_of(v);
    if (is_not_false(v[8]) && is_not_false(v[9]))
      local_position_.add(t_s, {v[2], v[3], v[4]});
    else
      local_position_.leave_out("xy_valid or z_valid is false", t_s);
    if (is_not_false(v[10]) && is_not_false(v[11]))
      velocity_.add(t_s, {v[5], v[6], v[7]});
    else
      velocity_.leave_out("v_xy_valid or v_z_valid is false", t_s);
    if (is_true(v[12]) && is_true(v[13]) && is_not_false(v[8])) add_place_of_reference(t_s, v);
  }

  void add_place_of_reference(double t_s, TopicValues v) {
    const GeodeticPosition reference{.latitude_deg = v[14], .longitude_deg = v[15], .height_m = v[16]};
    if (why_no_place(reference)) return;
    if (!reference_ || reference_->origin() != reference) reference_.emplace(reference, 0);
    add_place(referred_, t_s, reference_->place_of({v[2], v[3], v[4]}));
  }

  void take_global_position(TopicValues v) {
    const GeodeticPosition place{.latitude_deg = v[2], .longitude_deg = v[3], .height_m = v[4]};
    if (!is_not_false(v[5])) return global_.leave_out("lat_lon_valid is false", time_of(v));
    add_place(global_, time_of(v), place);
  }

  void take_vehicle_gps(TopicValues v) { take_gps(gps_, v); }
  void take_sensor_gps(TopicValues v) { take_gps(sensor_gps_, v); }

  struct Gps {
    explicit Gps(const std::string& topic) : above_sea(topic), above_ellipsoid(topic), velocity(topic) {}
    Samples<GeodeticPosition> above_sea;
    Samples<GeodeticPosition> above_ellipsoid;
    Samples<glm::dvec3> velocity;
    bool has_ellipsoid = false;
  };

  // Older versions have integers of 1e-7 degrees and of millimetres, newer ones degrees and metres.
  void take_gps(Gps& gps, TopicValues v) {
    const double t_s = time_of(v);
    const bool is_new = std::isfinite(v[6]);
    GeodeticPosition place{.latitude_deg = is_new ? v[6] : v[2] * 1e-7,
                           .longitude_deg = is_new ? v[7] : v[3] * 1e-7,
                           .height_m = is_new ? v[8] : v[4] * 1e-3};
    const double above_ellipsoid_m = is_new ? v[9] : v[5] * 1e-3;
    note_utc(v);
    if (!(v[10] >= 3)) return gps.above_sea.leave_out("no three-dimensional fix (fix_type below 3)", t_s);
    add_place(gps.above_sea, t_s, place);
    place.height_m = above_ellipsoid_m;
    gps.has_ellipsoid |= std::isfinite(above_ellipsoid_m) && above_ellipsoid_m != 0;
    if (!why_no_place(place)) gps.above_ellipsoid.add(t_s, place);
    if (is_true(v[14])) gps.velocity.add(t_s, {v[11], v[12], v[13]});
  }

  // UTC minus the time since boot, at the first fix with a date, and how far it runs away.
  void note_utc(TopicValues v) {
    if (!(v[15] >= kMinUtc_us) || !(v[10] >= 2)) return;
    const double offset_s = 1e-6 * (v[15] - v[0] - (std::isfinite(v[16]) ? v[16] : 0));
    if (!utc_minus_boot_s_) utc_minus_boot_s_ = offset_s;
    if (std::abs(offset_s - *utc_minus_boot_s_) > kUtcDrift_s && !utc_jump_s_) utc_jump_s_ = v[0] * 1e-6;
  }

  void take_sensor_combined(TopicValues v) {
    combined_rate_.add(time_of(v), {v[2], v[3], v[4]});
    // The accelerometer was read this much later than the gyroscope; INT32_MAX: no reading.
    const double later_us = std::isfinite(v[5]) ? v[5] : 0;
    if (later_us >= 2147483647.0) return combined_force_.leave_out("no reading of the accelerometer", time_of(v));
    combined_force_.add(time_of(v) + 1e-6 * later_us, {v[6], v[7], v[8]});
  }
  void take_angular_velocity(TopicValues v) { rate_.add(time_of(v), {v[2], v[3], v[4]}); }
  void take_acceleration(TopicValues v) { force_.add(time_of(v), {v[2], v[3], v[4]}); }

  // Flags of MAVLink's GIMBAL_DEVICE_FLAGS: 32 yaw from the nose, 64 yaw from north; neither: 16, yaw lock, decides.
  void take_gimbal(TopicValues v) {
    const std::optional<glm::dquat> q = unit_quaternion(v.subspan(2, 4));
    if (!q) return camera_.leave_out("the quaternion is not of length 1", time_of(v));
    const unsigned flags = v[6] >= 0 && v[6] <= 65535 ? static_cast<unsigned>(v[6]) : 0;
    const bool says_frame = (flags & (32U | 64U)) != 0;
    gimbal_.push_back({time_of(v), {*q, (flags & (says_frame ? 64U : 16U)) != 0}});
  }
  void take_mount(TopicValues v) {
    if (all_finite(glm::dvec3(v[2], v[3], v[4]))) mount_.push_back({time_of(v), {v[2], v[3], v[4]}});
  }
  void take_capture(TopicValues v) {
    if (std::isfinite(time_of(v))) captures_s_.push_back(time_of(v));
  }

  [[nodiscard]] std::optional<glm::dquat> airframe_at(double t_s) const;
  void make_camera();
  void choose_position(Track& track, double zero_s);
  void add_utc(Track& track, double zero_s);
  static void add_dropouts(Track& track, const UlogContents& log);

  Samples<glm::dquat> attitude_{"vehicle_attitude"};
  Samples<glm::dvec3> local_position_{"vehicle_local_position"};
  Samples<glm::dvec3> velocity_{"vehicle_local_position"};
  Samples<GeodeticPosition> referred_{"vehicle_local_position with ref_lat, ref_lon, ref_alt"};
  std::optional<LocalFrame> reference_;
  Samples<GeodeticPosition> global_{"vehicle_global_position"};
  Gps gps_{"vehicle_gps_position"};
  Gps sensor_gps_{"sensor_gps"};
  Samples<glm::dvec3> combined_rate_{"sensor_combined"};
  Samples<glm::dvec3> combined_force_{"sensor_combined"};
  Samples<glm::dvec3> rate_{"vehicle_angular_velocity"};
  Samples<glm::dvec3> force_{"vehicle_acceleration"};
  Samples<glm::dquat> camera_{"gimbal_device_attitude_status"};
  Samples<glm::dquat> mount_camera_{"mount_orientation"};
  std::vector<std::pair<double, GimbalAttitude>> gimbal_;
  std::vector<std::pair<double, glm::dvec3>> mount_;  // roll, pitch, yaw, radians
  std::vector<double> captures_s_;
  std::optional<double> utc_minus_boot_s_;
  std::optional<double> utc_jump_s_;
};

const std::map<std::string, UlogReading::Topic, std::less<>>& UlogReading::topics() {
  constexpr const char* kGps =
      "lat lon alt alt_ellipsoid latitude_deg longitude_deg altitude_msl_m altitude_ellipsoid_m fix_type vel_n_m_s "
      "vel_e_m_s vel_d_m_s vel_ned_valid time_utc_usec timestamp_time_relative";
  constexpr const char* kCombined =
      "gyro_rad[0] gyro_rad[1] gyro_rad[2] accelerometer_timestamp_relative accelerometer_m_s2[0] "
      "accelerometer_m_s2[1] accelerometer_m_s2[2]";
  constexpr const char* kLocal =
      "x y z vx vy vz xy_valid z_valid v_xy_valid v_z_valid xy_global z_global ref_lat ref_lon ref_alt";
  constexpr const char* kMount = "attitude_euler_angle[0] attitude_euler_angle[1] attitude_euler_angle[2]";
  static const std::map<std::string, Topic, std::less<>> kTopics = {
      {"vehicle_attitude", {"q[0] q[1] q[2] q[3]", &UlogReading::take_attitude}},
      {"vehicle_local_position", {kLocal, &UlogReading::take_local_position}},
      {"vehicle_global_position", {"lat lon alt lat_lon_valid", &UlogReading::take_global_position}},
      {"vehicle_gps_position", {kGps, &UlogReading::take_vehicle_gps}},
      {"sensor_gps", {kGps, &UlogReading::take_sensor_gps}},
      {"sensor_combined", {kCombined, &UlogReading::take_sensor_combined}},
      {"vehicle_angular_velocity", {"xyz[0] xyz[1] xyz[2]", &UlogReading::take_angular_velocity}},
      {"vehicle_acceleration", {"xyz[0] xyz[1] xyz[2]", &UlogReading::take_acceleration}},
      {"gimbal_device_attitude_status", {"q[0] q[1] q[2] q[3] device_flags", &UlogReading::take_gimbal}},
      {"mount_orientation", {kMount, &UlogReading::take_mount}},
      {"camera_capture", {"", &UlogReading::take_capture}},
      {"camera_trigger", {"", &UlogReading::take_capture}},
  };
  return kTopics;
}

// The airframe's attitude at or before a time, or its first one; none where the log has none.
std::optional<glm::dquat> UlogReading::airframe_at(double t_s) const {
  if (attitude_.empty()) return {};
  const std::vector<double>& times_s = attitude_.own_times_s();
  const auto after = std::upper_bound(times_s.begin(), times_s.end(), t_s);
  const std::ptrdiff_t index = std::max<std::ptrdiff_t>(after - times_s.begin() - 1, 0);
  return attitude_.values()[static_cast<std::size_t>(index)];
}

void UlogReading::make_camera() {
  for (const auto& [t_s, gimbal] : gimbal_) {
    const std::optional<glm::dquat> airframe = airframe_at(t_s);
    if (gimbal.yaw_from_north)
      camera_.add(t_s, gimbal.q);
    else if (airframe)
      camera_.add(t_s, rotation_of({.yaw_rad = attitude_of(*airframe).yaw_rad}) * gimbal.q);
    else
      camera_.leave_out("yaw is from the nose, whose heading is not in the log", t_s);
  }
  for (const auto& [t_s, angles] : mount_) {
    if (const std::optional<glm::dquat> airframe = airframe_at(t_s))
      mount_camera_.add(t_s,
                        *airframe * rotation_of({.roll_rad = angles.x, .pitch_rad = angles.y, .yaw_rad = angles.z}));
    else
      mount_camera_.leave_out("the angles are from the airframe, whose attitude is not in the log", t_s);
  }
}

void UlogReading::choose_position(Track& track, double zero_s) {
  Gps& gps = gps_.above_sea.empty() ? sensor_gps_ : gps_;
  const bool by_ellipsoid = gps.has_ellipsoid && !gps.above_ellipsoid.empty();
  track.position = std::move(global_).on_axis(zero_s, track.warnings);
  if (track.position.empty() && by_ellipsoid) {
    track.position = std::move(gps.above_ellipsoid).on_axis(zero_s, track.warnings);
    track.height_above_ellipsoid = true;
    // What was left out of the channel is counted once, above the sea.
    std::vector<Warning> gaps;
    (void)std::move(gps.above_sea).on_axis(zero_s, gaps);
    for (Warning& warning : gaps)
      if (warning.what.find("left out") != std::string::npos) track.warnings.push_back(std::move(warning));
  } else if (track.position.empty()) {
    track.position = std::move(gps.above_sea).on_axis(zero_s, track.warnings);
  }
  if (track.position.empty()) track.position = std::move(referred_).on_axis(zero_s, track.warnings);
  if (!track.position.empty() && !track.height_above_ellipsoid)
    track.warnings.push_back({track.position.source, "heights are above the mean sea, not above the ellipsoid"});
  track.velocity_ned_mps = std::move(velocity_).on_axis(zero_s, track.warnings);
  if (track.velocity_ned_mps.empty()) track.velocity_ned_mps = std::move(gps.velocity).on_axis(zero_s, track.warnings);
}

void UlogReading::add_utc(Track& track, double zero_s) {
  if (utc_minus_boot_s_) track.utc_at_zero_s = *utc_minus_boot_s_ + zero_s;
  if (utc_jump_s_)
    track.warnings.push_back({"time_utc_usec", "UTC and the time since boot part by more than " +
                                                   short_number_text(kUtcDrift_s) + " s from " +
                                                   short_number_text(*utc_jump_s_ - zero_s) + " s on"});
}

void UlogReading::add_dropouts(Track& track, const UlogContents& log) {
  for (std::size_t i = 0; i < std::min(log.dropouts.size(), kMaxDropouts); ++i)
    track.warnings.push_back({"dropout", "the logger lost " + short_number_text(log.dropouts[i].duration_s) +
                                             " s of all topics after " +
                                             short_number_text(log.dropouts[i].after_s - log.start_s) + " s"});
  if (log.dropouts.size() <= kMaxDropouts) return;
  double sum_s = 0;
  for (const UlogDropout& dropout : log.dropouts) sum_s += dropout.duration_s;
  track.warnings.push_back({"dropout", std::to_string(log.dropouts.size()) + " dropouts in all, together " +
                                           short_number_text(sum_s) + " s"});
}

Track UlogReading::track(const UlogContents& log, const std::filesystem::path& file) {
  Track track{.file = file, .format = "PX4 ULog"};
  track.device = log.hardware + (log.software.empty() ? "" : " (PX4 " + log.software + ")");
  track.damaged = log.damaged;
  track.warnings = log.warnings;
  add_dropouts(track, log);
  make_camera();
  const double zero_s = log.start_s;
  choose_position(track, zero_s);
  track.local_position_ned_m = std::move(local_position_).on_axis(zero_s, track.warnings);
  track.ned_from_camera = std::move(camera_).on_axis(zero_s, track.warnings);
  if (track.ned_from_camera.empty() && !mount_camera_.empty()) {
    track.ned_from_camera = std::move(mount_camera_).on_axis(zero_s, track.warnings);
    track.warnings.push_back(
        {"mount_orientation", "these are angles that the mount was told to take, against the airframe"});
  }
  track.airframe_rate_radps = std::move(rate_.empty() ? combined_rate_ : rate_).on_axis(zero_s, track.warnings);
  track.airframe_force_mps2 =
      std::move(combined_force_.empty() ? force_ : combined_force_).on_axis(zero_s, track.warnings);
  track.ned_from_airframe = std::move(attitude_).on_axis(zero_s, track.warnings);
  add_utc(track, zero_s);
  warn_of_captures(captures_s_, "camera_capture", zero_s, track.warnings);
  return track;
}

}  // namespace

Result<Track> ulog_track(std::string_view bytes, const std::filesystem::path& file) {
  UlogReading reading;
  const Result<UlogContents> log = read_ulog_messages(bytes, file.string(), reading.reader());
  if (!log) return fail(log.error());
  Track track = reading.track(*log, file);
  if (!has_samples(track)) return fail(file.string(), "has no sound sample of a topic that SIGS reads");
  return track;
}

}  // namespace sigs
