// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>

#include "base/pose.h"
#include "base/text.h"
#include "telemetry/log_messages.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

using Values = std::span<const double>;

// GPS time has no leap seconds: seconds that it is ahead of UTC, from a week on (IERS Bulletin C; 2009-01-01,
// 2012-07-01, 2015-07-01, 2017-01-01, rounded to the beginning of the week).
double leap_seconds(double gps_week) {
  if (gps_week < 1695) return 15;
  if (gps_week < 1851) return 16;
  return gps_week < 1930 ? 17 : 18;
}

constexpr double kGpsEpoch_s = 315964800;  // 1980-01-06 as UTC seconds since 1970
constexpr double kWeek_s = 604800;
constexpr double kLastWeek = 4000;  // beyond 2056 the receiver has no date

// Seconds since boot: TimeUS, or TimeMS in old logs.
double time_of_message(Values v) {
  return std::isfinite(v[0]) ? v[0] * 1e-6 : v[1] * 1e-3;
}

class DataflashReading {
 public:
  [[nodiscard]] DataflashReader reader() {
    return {.wanted = [](std::string_view name) { return columns_of(name); },
            .take = [this](std::string_view name, Values v) { take(name, v); },
            .take_text = [this](std::string_view text) { take_text(text); }};
  }

  Track track(const DataflashContents& log, const std::filesystem::path& file);

 private:
  struct Message {
    const char* raw = "";     // columns, with blanks between; the first are TimeUS, TimeMS and the instance
    const char* scaled = "";  // behind them
    void (DataflashReading::*take)(Values v) = nullptr;
  };
  static const std::map<std::string, Message, std::less<>>& messages();

  static std::vector<DataflashColumn> columns_of(std::string_view name) {
    const auto found = messages().find(name);
    std::vector<DataflashColumn> columns;
    if (found == messages().end()) return columns;
    std::string_view raw = found->second.raw, scaled = found->second.scaled;
    while (!raw.empty()) columns.push_back({std::string(next_token(raw)), false});
    while (!scaled.empty()) columns.push_back({std::string(next_token(scaled)), true});
    return columns;
  }

  void take(std::string_view name, Values v) {
    const auto found = messages().find(name);  // there, since columns of it were wanted
    if (v[2] >= 1) {
      other_instances_.insert(found->first);
      return;
    }
    if (!zero_s_ && std::isfinite(time_of_message(v))) zero_s_ = time_of_message(v);
    (this->*found->second.take)(v);
  }

  // The autopilot's first texts name the vehicle and its version.
  void take_text(std::string_view text) {
    if (!device_.empty() || !text.starts_with("Ardu")) return;
    for (const char c : text) device_ += c >= ' ' && c <= '~' ? c : '?';
  }

  void take_att(Values v) { att_.add(time_of_message(v), rotation_of_deg(v[3], v[4], v[5])); }

  void take_pos(Values v) { take_place(pos_, v, 3); }

  void take_ahr2(Values v) {
    ahr2_attitude_.add(time_of_message(v), rotation_of_deg(v[3], v[4], v[5]));
    take_place(ahr2_, v, 6);
  }

  // Status 3 and above is a three-dimensional fix. Course over ground is clockwise from north, VZ positive down.
  void take_gps(Values v) {
    const double t_s = time_of_message(v);
    if (!(v[3] >= 3)) return gps_.leave_out("no three-dimensional fix (Status below 3)", t_s);
    take_place(gps_, v, 6);
    const double course_rad = rad_of_deg(v[10]);
    gps_velocity_.add(t_s, {v[9] * std::cos(course_rad), v[9] * std::sin(course_rad), v[11]});
    if (!utc_minus_boot_s_ && v[5] > 0 && v[5] < kLastWeek && v[4] >= 0 && v[4] <= kWeek_s * 1e3)
      utc_minus_boot_s_ = kGpsEpoch_s + v[5] * kWeek_s + v[4] * 1e-3 - leap_seconds(v[5]) - t_s;
  }

  void take_imu(Values v) {
    rate_.add(time_of_message(v), {v[3], v[4], v[5]});
    force_.add(time_of_message(v), {v[6], v[7], v[8]});
  }

  struct Filter {
    explicit Filter(const std::string& name) : attitude(name), velocity(name), local_position(name) {}
    Samples<glm::dquat> attitude;
    Samples<glm::dvec3> velocity;
    Samples<glm::dvec3> local_position;
  };
  void take_xkf1(Values v) { take_filter(xkf1_, v); }
  void take_nkf1(Values v) { take_filter(nkf1_, v); }
  static void take_filter(Filter& filter, Values v) {
    const double t_s = time_of_message(v);
    filter.attitude.add(t_s, rotation_of_deg(v[3], v[4], v[5]));
    filter.velocity.add(t_s, {v[6], v[7], v[8]});
    filter.local_position.add(t_s, {v[9], v[10], v[11]});
  }

  // Roll and pitch are from the horizon, YawE from north, YawB from the nose; one of the two may be missing.
  void take_mnt(Values v) {
    const double t_s = time_of_message(v);
    if (std::isfinite(v[5])) return camera_.add(t_s, rotation_of_deg(v[3], v[4], v[5]));
    if (att_.empty() || !std::isfinite(v[6]))
      return camera_.leave_out("its yaw is not from north, and the heading is not known", t_s);
    const double nose_deg = deg_of_rad(attitude_of(att_.values().back()).yaw_rad);
    camera_.add(t_s, rotation_of_deg(v[3], v[4], nose_deg + v[6]));
  }

  void take_cam(Values v) {
    if (std::isfinite(time_of_message(v))) captures_s_.push_back(time_of_message(v));
  }

  // Latitude, longitude and height lie in three columns from `first` on.
  static void take_place(Samples<GeodeticPosition>& places, Values v, std::size_t first) {
    add_place(places, time_of_message(v), {v[first], v[first + 1], v[first + 2]});
  }

  std::string device_;
  std::optional<double> zero_s_;
  std::optional<double> utc_minus_boot_s_;
  std::set<std::string> other_instances_;
  Samples<glm::dquat> att_{"ATT"};
  Samples<GeodeticPosition> pos_{"POS"};
  Samples<GeodeticPosition> gps_{"GPS"};
  Samples<glm::dvec3> gps_velocity_{"GPS"};
  Samples<glm::dquat> ahr2_attitude_{"AHR2"};
  Samples<GeodeticPosition> ahr2_{"AHR2"};
  Samples<glm::dvec3> rate_{"IMU"};
  Samples<glm::dvec3> force_{"IMU"};
  Filter xkf1_{"XKF1"};
  Filter nkf1_{"NKF1"};
  Samples<glm::dquat> camera_{"MNT"};
  std::vector<double> captures_s_;
};

const std::map<std::string, DataflashReading::Message, std::less<>>& DataflashReading::messages() {
  constexpr const char* kStamp = "TimeUS TimeMS I";
  constexpr const char* kFilter = "Roll Pitch Yaw VN VE VD PN PE PD";
  static const std::map<std::string, Message, std::less<>> kMessages = {
      {"ATT", {kStamp, "Roll Pitch Yaw", &DataflashReading::take_att}},
      {"POS", {kStamp, "Lat Lng Alt", &DataflashReading::take_pos}},
      {"AHR2", {kStamp, "Roll Pitch Yaw Lat Lng Alt", &DataflashReading::take_ahr2}},
      {"GPS", {"TimeUS TimeMS I Status GMS GWk", "Lat Lng Alt Spd GCrs VZ", &DataflashReading::take_gps}},
      {"IMU", {kStamp, "GyrX GyrY GyrZ AccX AccY AccZ", &DataflashReading::take_imu}},
      {"XKF1", {"TimeUS TimeMS C", kFilter, &DataflashReading::take_xkf1}},
      {"NKF1", {"TimeUS TimeMS C", kFilter, &DataflashReading::take_nkf1}},
      {"MNT", {kStamp, "Roll Pitch YawE YawB", &DataflashReading::take_mnt}},
      {"CAM", {kStamp, "", &DataflashReading::take_cam}},
  };
  return kMessages;
}

Track DataflashReading::track(const DataflashContents& log, const std::filesystem::path& file) {
  Track track{.file = file, .format = "ArduPilot dataflash", .device = device_};
  track.warnings = log.warnings;
  track.damaged = log.damaged;
  const double zero_s = zero_s_.value_or(0);
  const auto first_of = [&](auto&... candidates) {
    std::common_type_t<decltype(std::move(candidates).on_axis(zero_s, track.warnings))...> chosen;
    ((chosen.empty() ? void(chosen = std::move(candidates).on_axis(zero_s, track.warnings)) : void()), ...);
    return chosen;
  };
  track.ned_from_camera = first_of(camera_);
  track.ned_from_airframe = first_of(att_, xkf1_.attitude, nkf1_.attitude, ahr2_attitude_);
  track.position = first_of(pos_, gps_, ahr2_);
  track.velocity_ned_mps = first_of(xkf1_.velocity, nkf1_.velocity, gps_velocity_);
  track.local_position_ned_m = first_of(xkf1_.local_position, nkf1_.local_position);
  track.airframe_rate_radps = first_of(rate_);
  track.airframe_force_mps2 = first_of(force_);
  if (utc_minus_boot_s_) track.utc_at_zero_s = *utc_minus_boot_s_ + zero_s;
  if (!track.position.empty())
    track.warnings.push_back({track.position.source, "heights are above the mean sea, not above the ellipsoid"});
  if (!other_instances_.empty())
    track.warnings.push_back({listed(other_instances_), "only the first instance (0) is read"});
  warn_of_captures(captures_s_, "CAM", zero_s, track.warnings);
  return track;
}

}  // namespace

Result<Track> dataflash_track(std::string_view bytes, const std::filesystem::path& file) {
  DataflashReading reading;
  const Result<DataflashContents> log = read_dataflash_messages(bytes, file.string(), reading.reader());
  if (!log) return fail(log.error());
  Track track = reading.track(*log, file);
  if (!has_samples(track)) return fail(file.string(), "has no sound sample of a message that SIGS reads");
  return track;
}

}  // namespace sigs
