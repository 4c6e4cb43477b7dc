// SPDX-License-Identifier: MIT
#include "telemetry/log_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>

#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "geo/utc_time.h"
#include "telemetry/gopro_stream.h"
#include "telemetry/log_samples.h"

namespace sigs {
namespace {

const std::vector<std::string> kKeys = {"GYRO", "ACCL", "CORI", "IORI", "GRAV", "SHUT", "SROT",
                                        "GPS5", "GPS9", "ATTD", "LNED", "GLPI", "SYST"};
constexpr double kDaysTo2000 = 10957;  // from 1970-01-01 to 2000-01-01
constexpr double kSecondsPerDay = 86400;

using Row = std::span<const double>;

// Samples of a stream that are left out for one reason: how many, and when.
struct LeftOutSpan {
  int count = 0;
  double first_s = 0;
  double last_s = 0;

  void add(double time_s) {
    if (count++ == 0) first_s = time_s;
    last_s = time_s;
  }
  // "at 1.20 s", "from 1.20 to 3.40 s"
  [[nodiscard]] std::string text() const {
    if (first_s == last_s) return "at " + fixed_text(first_s, 2) + " s";
    return "from " + fixed_text(first_s, 2) + " to " + fixed_text(last_s, 2) + " s";
  }
};

// UTC of GPSU's "yymmddhhmmss.sss", seconds since 1970 without leap seconds; nothing where it is no date.
std::optional<double> utc_of_gpsu(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
  if (std::sscanf(text.c_str(), "%2d%2d%2d%2d%2d%lf", &year, &month, &day, &hour, &minute, &second) != 6) return {};
  const std::optional<double> day_s = utc_of_day(2000 + year, month, day);
  if (!day_s || hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0 && second < 61)) return {};
  return *day_s + hour * 3600 + minute * 60 + second;
}

class Reading {
 public:
  Reading(const std::filesystem::path& file, const DataPackets& payloads)
      : file_(file), streams_(gopro_streams(payloads.packets, kKeys)) {
    track_.file = file;
    track_.format = "GoPro GPMF";
    track_.device = listed(streams_.devices);
    track_.on_footage_time = payloads.on_footage_time;
  }

  Track taken() {
    set_camera_offset();
    read_camera();
    read_gps();
    read_drone();
    join_camera_attitude(track_);
    say_unused();
    say_broken();
    return std::move(track_);
  }

 private:
  void warn(const std::string& channel, std::string what) {
    track_.warnings.push_back({channel.empty() ? file_.string() : file_.string() + ": " + channel, std::move(what)});
  }

  // The stream of a key. Where several devices have it, the first.
  const GoproStream* find(const std::string& key, int columns) {
    const GoproStream* found = nullptr;
    for (const GoproStream& stream : streams_.streams) {
      if (stream.key != key || stream.samples.rows() == 0) continue;
      if (found != nullptr) {
        warn(key, "several devices have it; that of " + found->device + " is used");
        break;
      }
      if (stream.samples.columns < columns)
        warn(key, fmt::format("has {} columns where {} are expected; left out", stream.samples.columns, columns));
      else
        found = &stream;
    }
    return found;
  }

  // Streams with one sample a frame tell how the camera's clock lies to the footage; without one any stream does.
  void set_camera_offset() {
    std::vector<double> of_frames;
    std::vector<double> of_all;
    for (const GoproStream& stream : streams_.streams) {
      if (!is_stamped(stream)) continue;
      const double offset_s = stream.blocks[0].time_s - *stream.blocks[0].stamp_s;
      of_all.push_back(offset_s);
      if (stream.key == "SHUT" || stream.key == "CORI" || stream.key == "IORI" || stream.key == "GRAV")
        of_frames.push_back(offset_s);
    }
    if (!of_all.empty()) camera_offset_s_ = median(of_frames.empty() ? of_all : of_frames);
  }

  GoproTimes times_of(const GoproStream& stream) {
    if (camera_offset_s_ && is_stamped(stream)) return gopro_stamped_times(stream, *camera_offset_s_);
    GoproTimes times = gopro_times(stream);
    if (!times.is_fit && stream.blocks.size() >= 3)
      warn(stream.key, "its samples do not come at an even rate; they are spread evenly within each payload");
    return times;
  }

  static std::string clock_of(const GoproTimes& times) {
    if (!times.own_times_s.empty()) return "time since the camera's start";
    return times.is_fit
               ? fmt::format("footage, an even rate fitted to the payloads within {:.1f} ms", 1000 * times.residual_s)
               : "footage, spread evenly within each payload";
  }

  template <class T>
  Channel<T> channel_at(const GoproStream& stream, const GoproTimes& times, const std::function<T(Row)>& value_of) {
    Channel<T> channel{.source = "GPMF " + stream.key};
    LeftOutSpan unsound;
    const std::size_t columns = static_cast<std::size_t>(stream.samples.columns);
    for (std::size_t i = 0; i < times.times_s.size(); ++i) {
      const T value = value_of(Row(stream.samples.values).subspan(i * columns, columns));
      if (!all_finite(value)) {
        unsound.add(times.times_s[i]);
        continue;
      }
      channel.times_s.push_back(times.times_s[i]);
      channel.values.push_back(value);
      if (!times.own_times_s.empty()) channel.own_times_s.push_back(times.own_times_s[i]);
    }
    if (unsound.count > 0)
      warn(stream.key, fmt::format("{} that {} no number left out, {}", count_text(unsound.count, "sample"),
                                   unsound.count == 1 ? "is" : "are", unsound.text()));
    if (!channel.values.empty()) channel.clock = clock_of(times);
    return channel.values.empty() ? Channel<T>() : channel;
  }

  template <class T>
  Channel<T> channel_of(const GoproStream* stream, const std::function<T(Row)>& value_of) {
    return stream == nullptr ? Channel<T>() : channel_at<T>(*stream, times_of(*stream), value_of);
  }

  Channel<glm::dvec3> along_axes(const std::string& key) {
    const GoproStream* stream = find(key, 3);
    if (stream == nullptr) return {};
    const GoproAxes axes = gopro_axes(*stream);
    if (axes.assumed)
      warn(key, "the file does not say which of the camera's axes its columns are, and the model \"" + stream->device +
                    "\" is not known; up, left, backwards is assumed, as HERO5 has them");
    return channel_of<glm::dvec3>(
        stream, [&](Row row) { return axes.camera_from_columns * glm::dvec3(row[0], row[1], row[2]); });
  }

  // Stored as w and the parts about GoPro's X (left), Z (up) and Y (backwards).
  Channel<glm::dquat> turns(const std::string& key) {
    return channel_of<glm::dquat>(find(key, 4), [](Row row) {
      return glm::normalize(glm::dquat(row[0], -row[3], -row[1], -row[2]));  // 0/0 is NaN, which is left out
    });
  }

  void read_camera() {
    track_.camera_rate_radps = along_axes("GYRO");
    track_.camera_force_mps2 = along_axes("ACCL");
    track_.start_from_camera = turns("CORI");
    track_.camera_from_image = turns("IORI");
    track_.camera_gravity = channel_of<glm::dvec3>(
        find("GRAV", 3), [](Row row) { return glm::normalize(glm::dvec3(row[2], -row[0], row[1])); });
    if (opposes(track_.camera_gravity, track_.camera_force_mps2))
      for (glm::dvec3& down : track_.camera_gravity.values) down = -down;
    track_.exposure_s = channel_of<double>(find("SHUT", 1), [](Row row) { return row[0] > 0 ? row[0] : std::nan(""); });
    if (const GoproStream* readout = find("SROT", 1)) {
      const double readout_s = median(readout->samples.values) * 1e-3;
      if (readout_s > 0 && readout_s < 1) track_.readout_s = readout_s;
    }
  }

  // Whether what should be gravity points where the accelerometer measures the force that holds the camera up.
  static bool opposes(const Channel<glm::dvec3>& gravity, const Channel<glm::dvec3>& force) {
    glm::dvec3 mean_gravity{0};
    glm::dvec3 mean_force{0};
    for (const glm::dvec3& value : gravity.values) mean_gravity += value;
    for (const glm::dvec3& value : force.values) mean_force += value;
    return glm::dot(mean_gravity, mean_force) > 0;
  }

  struct GpsSample {
    GeodeticPosition position;
    double fix = 3;
    double utc_s = NAN;
  };

  static GpsSample gps_sample(const GoproStream& stream, const GoproBlock& block, int row) {
    const auto number = [&](int column) { return stream.samples.at(row, column); };
    GpsSample sample{.position = {number(0), number(1), number(2)}, .fix = block.fix.value_or(3)};
    if (stream.key == "GPS9") {
      sample.utc_s = (number(5) + kDaysTo2000) * kSecondsPerDay + number(6);
      sample.fix = number(8);
    } else if (row == block.first_row) {
      sample.utc_s = utc_of_gpsu(block.utc).value_or(NAN);
    }
    return sample;
  }

  void read_gps() {
    const GoproStream* stream = find("GPS9", 9);
    if (stream == nullptr) stream = find("GPS5", 5);
    if (stream == nullptr) return;
    const GoproTimes times = times_of(*stream);
    Channel<GeodeticPosition> position{.source = "GPMF " + stream->key, .clock = clock_of(times)};
    LeftOutSpan no_fix, at_zero, flat, unsound;
    std::vector<double> utc_s;
    for (const GoproBlock& block : stream->blocks) {
      for (int row = block.first_row; row < block.first_row + block.rows; ++row) {
        const double time_s = times.times_s[static_cast<std::size_t>(row)];
        const GpsSample sample = gps_sample(*stream, block, row);
        if (!(sample.fix >= 2)) {
          no_fix.add(time_s);
        } else if (sample.position.latitude_deg == 0 && sample.position.longitude_deg == 0) {
          at_zero.add(time_s);
        } else if (why_no_place(sample.position) != nullptr) {
          unsound.add(time_s);
        } else {
          if (sample.fix < 3) flat.add(time_s);
          position.times_s.push_back(time_s);
          position.values.push_back(sample.position);
          if (!times.own_times_s.empty())
            position.own_times_s.push_back(times.own_times_s[static_cast<std::size_t>(row)]);
          if (std::isfinite(sample.utc_s)) utc_s.push_back(sample.utc_s - time_s);
        }
      }
    }
    const auto say = [&](const LeftOutSpan& left, const char* what) {
      if (left.count > 0)
        warn(stream->key, fmt::format("{} {}, {}", count_text(left.count, "sample"), what, left.text()));
    };
    say(no_fix, "without a fix (GPSF) left out");
    say(at_zero, "at latitude 0, longitude 0 left out");
    say(unsound, "with no place on the Earth left out");
    say(flat, "with a fix in two dimensions; the heights there are not measured");
    if (!utc_s.empty()) track_.utc_at_zero_s = median(utc_s);
    if (position.values.empty()) return;
    if (stream->height_of != "MSLV")
      warn(stream->key, "the file does not say whether its heights are above the sea or above the ellipsoid");
    track_.position = std::move(position);
  }

  // Samples of the drone, whose column 0 is its own time.
  template <class T>
  Channel<T> drone_channel(const GoproStream* stream, double offset_s, const std::function<T(Row)>& value_of) {
    if (stream == nullptr) return {};
    GoproTimes times;
    for (int row = 0; row < stream->samples.rows(); ++row) times.own_times_s.push_back(stream->samples.at(row, 0));
    for (const double own_s : times.own_times_s) times.times_s.push_back(own_s + offset_s);
    for (std::size_t i = 0; i < times.times_s.size(); ++i) {
      const double before_s = i > 0 ? times.times_s[i - 1] : -INFINITY;
      if (std::isfinite(times.times_s[i]) && times.times_s[i] >= before_s) continue;
      warn(stream->key, fmt::format("its clock goes back or is no number at {} s of its own time; it is left out",
                                    fixed_text(times.own_times_s[i], 3)));
      return {};
    }
    Channel<T> channel = channel_at<T>(*stream, times, value_of);
    if (!channel.empty()) channel.clock = "time since the drone's start";
    return channel;
  }

  void read_drone() {
    const GoproStream* attitude = find("ATTD", 7);
    const GoproStream* local = find("LNED", 7);
    const GoproStream* global = find("GLPI", 9);
    std::vector<const GoproStream*> clocked;
    for (const GoproStream* stream : {attitude, local, global})
      if (stream != nullptr) clocked.push_back(stream);
    const std::optional<ClockOffset> offset = clock_offset(clocked, 0);
    if (!offset) return;
    say_offset(*offset);
    const double o = offset->offset_s;
    track_.ned_from_airframe = drone_channel<glm::dquat>(attitude, o, [](Row row) {
      return rotation_of({row[1], row[2], row[3]});
    });
    const auto vectors = [&](const GoproStream* stream, std::size_t first) {
      return drone_channel<glm::dvec3>(
          stream, o, [first](Row row) { return glm::dvec3(row[first], row[first + 1], row[first + 2]); });
    };
    track_.airframe_rate_radps = vectors(attitude, 4);
    track_.local_position_ned_m = vectors(local, 1);
    track_.velocity_ned_mps = vectors(local, 4);
    if (track_.velocity_ned_mps.empty()) track_.velocity_ned_mps = vectors(global, 5);
    Channel<GeodeticPosition> position = drone_channel<GeodeticPosition>(global, o, [](Row row) {
      const bool nowhere = row[1] == 0 && row[2] == 0;
      return GeodeticPosition{nowhere ? NAN : row[1], row[2], row[3]};
    });
    if (!position.empty()) track_.position = std::move(position);
    set_drone_utc(o);
  }

  void say_offset(const ClockOffset& offset) {
    warn(
        "ATTD, LNED, GLPI",
        offset.consistent
            ? fmt::format("the drone's clock is placed on the footage to within {:.2f} s, by the payloads in which its "
                          "samples arrived; how long they took is not known",
                          offset.uncertainty_s)
            : fmt::format(
                  "the drone's attitude and position may be up to {:.2f} s off against the images: its clock does "
                  "not agree with when its samples arrived",
                  offset.uncertainty_s));
  }

  // SYST: the drone's clock and UTC, in seconds.
  void set_drone_utc(double offset_s) {
    if (track_.utc_at_zero_s) return;
    std::vector<double> utc_s;
    if (const GoproStream* system = find("SYST", 2))
      for (int row = 0; row < system->samples.rows(); ++row)
        if (system->samples.at(row, 1) > 0)
          utc_s.push_back(system->samples.at(row, 1) - (system->samples.at(row, 0) + offset_s));
    std::erase_if(utc_s, [](double utc) { return !std::isfinite(utc); });
    if (!utc_s.empty()) track_.utc_at_zero_s = median(utc_s);
  }

  void say_unused() {
    std::vector<std::string> names;
    for (const auto& [key, payloads] : streams_.unused) names.push_back(key);
    if (names.size() > 40) names.resize(40);
    track_.unused_streams = std::move(names);
  }

  void say_broken() {
    constexpr std::size_t kMaxSaid = 10;
    track_.damaged = !streams_.broken.empty();
    for (std::size_t i = 0; i < std::min(kMaxSaid, streams_.broken.size()); ++i)
      warn("", fmt::format("the payload of {} s {}; what stands before it was read",
                           fixed_text(streams_.broken[i].second, 2), streams_.broken[i].first));
    if (streams_.broken.size() > kMaxSaid)
      warn("", fmt::format("and {} more broken places", streams_.broken.size() - kMaxSaid));
  }

  std::filesystem::path file_;
  GoproStreams streams_;
  std::optional<double> camera_offset_s_;  // footage time minus STMP
  Track track_;
};

}  // namespace

bool is_gopro(const DataStream& stream) {
  return stream.kind == DataKind::gpmf;
}

Result<Track> track_of_gopro(const std::filesystem::path& file, const DataPackets& payloads) {
  Track track = Reading(file, payloads).taken();
  if (!payloads.on_footage_time)
    track.warnings.push_back({file.string(), "there is no video that can be read; time 0 is where the file begins"});
  if (payloads.broke_off) {
    track.damaged = true;
    track.warnings.push_back(
        {file.string(), payloads.packets.empty()
                            ? "the file ends before its telemetry"
                            : fmt::format("the file ends before its telemetry does; the last payload read begins at "
                                          "byte {}",
                                          payloads.packets.back().file_offset)});
  }
  if (!has_samples(track))
    return fail(file.string(), track.damaged ? "its GoPro telemetry is broken; none of it can be read"
                                             : "its GoPro telemetry has no motion, place or exposure in it");
  return track;
}

}  // namespace sigs
