// SPDX-License-Identifier: MIT
#include "telemetry/track_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "geo/geodetic.h"
#include "plot/plot.h"
#include "telemetry/log_samples.h"
#include "telemetry/track.h"
#include "telemetry/track_csv.h"

namespace sigs {
namespace {

constexpr double kMinJump_s = 0.5;  // less may be a delay

// Of rising stamps alone: a clock that goes back is told of by itself.
double typical_interval_s(const std::vector<double>& times_s) {
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < times_s.size(); ++i)
    if (times_s[i] > times_s[i - 1]) intervals_s.push_back(times_s[i] - times_s[i - 1]);
  return intervals_s.empty() ? 0 : median(std::move(intervals_s));
}

std::string name_of_jump(double jump_s, double slack_s) {
  struct Count {
    double period_s;
    const char* name;
  };
  for (const Count& count : {Count{4294967.296, "2^32 ms: a 32-bit count began again"},
                             Count{4294.967296, "2^32 us: a 32-bit count began again"},
                             Count{65.536, "2^16 ms: a 16-bit count began again"}})
    if (std::abs(jump_s + count.period_s) <= slack_s) return fmt::format("goes back by {}", count.name);
  return jump_s < 0 ? "goes back" : "goes ahead";
}

// Places need more digits than six.
std::string range_text(const Range& range, double value) {
  const bool of_place = range.column == "latitude_deg" || range.column == "longitude_deg";
  return of_place ? fixed_text(value, 7) : short_number_text(value);
}

void find_gaps(ChannelReport& report, const std::vector<double>& times_s, double interval_s) {
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    const double step_s = times_s[i] - times_s[i - 1];
    report.repeated += step_s == 0;
    if (interval_s > 0 && step_s > kGapFactor * interval_s) report.gaps.push_back({times_s[i - 1], step_s});
  }
}

void find_jumps(ChannelReport& report, const std::vector<double>& times_s, const std::vector<double>& own_s,
                double interval_s) {
  const double slack_s = std::max(kMinJump_s, kGapFactor * interval_s);
  for (std::size_t i = 1; i < own_s.size() && i < times_s.size(); ++i) {
    const double own_step_s = own_s[i] - own_s[i - 1];
    const double jump_s = own_step_s - (times_s[i] - times_s[i - 1]);
    if (own_step_s < 0 || std::abs(jump_s) > slack_s)
      report.jumps.push_back({times_s[i], jump_s, name_of_jump(jump_s, slack_s)});
  }
}

template <class T>
std::vector<Range> ranges_of(std::string_view name, const Channel<T>& channel) {
  std::vector<Range> ranges;
  for (const std::string& column : csv_columns(name)) ranges.push_back({column, INFINITY, -INFINITY});
  for (const T& value : channel.values) {
    const std::vector<double> numbers = csv_numbers(name, value);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i].low = std::min(ranges[i].low, numbers[i]);
      ranges[i].high = std::max(ranges[i].high, numbers[i]);
    }
  }
  return ranges;
}

std::string date_text(double utc_s) {
  const double day = std::floor(utc_s / 86400);
  if (!(std::abs(day) < 1e6)) return exact_text(utc_s) + " s since 1970";
  const double in_day_s = utc_s - day * 86400;
  const std::chrono::year_month_day date(std::chrono::sys_days(std::chrono::days(static_cast<int>(day))));
  const int whole_s = static_cast<int>(in_day_s);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:06.3f}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), whole_s / 3600,
                     whole_s / 60 % 60, in_day_s - whole_s / 60 * 60);
}

std::string heading_of(const Track& track) {
  std::string text = fmt::format("format: {}\n", track.format);
  if (!track.device.empty()) text += fmt::format("device: {}\n", track.device);
  text += fmt::format("time 0: {}\n", track.on_footage_time ? "the footage's frame 0" : "the log's first stamp");
  if (track.utc_at_zero_s) text += fmt::format("UTC at time 0: {}\n", date_text(*track.utc_at_zero_s));
  if (track.readout_s)
    text += fmt::format("rolling shutter: {} s from the first row to the last\n", short_number_text(*track.readout_s));
  if (!track.heading_is_north) text += "yaw 0: an arbitrary heading, not north\n";
  if (!track.level_is_known) text += "roll and pitch: against the first sample, which counts as level\n";
  if (track.attitude_is_whole) text += "camera's attitude: its own, with no mount's angles to be added\n";
  if (!track.position.empty())
    text += fmt::format("heights: {}\n", track.height_above_ellipsoid ? "above the ellipsoid"
                                                                      : "above the sea, the start, or not known");
  if (!track.unused_streams.empty())
    text += fmt::format("streams not used: {}\n", fmt::join(track.unused_streams, ", "));
  if (track.damaged) text += "damaged: yes; what stands before the damage is here\n";
  return text;
}

std::string odd_times_of(const ChannelReport& report, int most) {
  std::string text;
  const std::size_t limit = static_cast<std::size_t>(std::max(most, 0));
  for (std::size_t i = 0; i < std::min(limit, report.gaps.size()); ++i)
    text += fmt::format("  gap: {} s after {} s\n", fixed_text(report.gaps[i].length_s, 3),
                        fixed_text(report.gaps[i].at_s, 3));
  if (report.gaps.size() > limit) text += fmt::format("  and {} more gaps\n", report.gaps.size() - limit);
  for (std::size_t i = 0; i < std::min(limit, report.jumps.size()); ++i)
    text += fmt::format("  clock: {}, {} s at {} s\n", report.jumps[i].what, fixed_text(report.jumps[i].jump_s, 3),
                        fixed_text(report.jumps[i].at_s, 3));
  if (report.jumps.size() > limit)
    text += fmt::format("  and {} more jumps of the clock\n", report.jumps.size() - limit);
  if (report.repeated > 0)
    text += fmt::format("  {} at the same time as the one before\n", count_text(report.repeated, "sample"));
  return text;
}

}  // namespace

std::vector<ChannelReport> track_report(const Track& track) {
  std::vector<ChannelReport> reports;
  for_each_channel(track, [&](std::string_view name, const auto& channel) {
    if (channel.empty()) return;
    ChannelReport report{.name = std::string(name),
                         .source = channel.source,
                         .clock = channel.clock,
                         .count = static_cast<int>(channel.values.size()),
                         .first_s = channel.times_s.front(),
                         .last_s = channel.times_s.back()};
    const double interval_s = typical_interval_s(channel.times_s);
    if (interval_s > 0) report.median_rate_hz = 1 / interval_s;
    find_gaps(report, channel.times_s, interval_s);
    find_jumps(report, channel.times_s, channel.own_times_s, interval_s);
    report.ranges = ranges_of(name, channel);
    reports.push_back(std::move(report));
  });
  return reports;
}

std::string track_report_text(const Track& track, int most_gaps) {
  std::string text = heading_of(track);
  text += fmt::format("\n{:<24}{:>8}{:>12}{:>12}{:>10}{:>6}  {}\n", "channel", "samples", "from s", "to s", "rate Hz",
                      "gaps", "source");
  for (const ChannelReport& report : track_report(track)) {
    text += fmt::format("{:<24}{:>8}{:>12}{:>12}{:>10}{:>6}  {}\n", report.name, report.count,
                        fixed_text(report.first_s, 3), fixed_text(report.last_s, 3),
                        report.median_rate_hz > 0 ? fixed_text(report.median_rate_hz, 2) : "-", report.gaps.size(),
                        report.source);
    if (!report.clock.empty()) text += fmt::format("  times: {}\n", report.clock);
    for (const Range& range : report.ranges)
      text += fmt::format("  {:<24}{:>14} to {}\n", range.column, range_text(range, range.low),
                          range_text(range, range.high));
    text += odd_times_of(report, most_gaps);
  }
  return text;
}

std::string contents_text(const Track& track) {
  static const std::map<std::string_view, std::string_view> kWords = {
      {"position", "position"},
      {"local_position_ned_m", "local position"},
      {"velocity_ned_mps", "velocity"},
      {"ned_from_airframe", "attitude of the airframe"},
      {"ned_from_camera", "attitude of the camera"},
      {"start_from_camera", "turns of the camera"},
      {"camera_from_image", "turns of the stabilisation"},
      {"camera_rate_radps", "angular rates of the camera"},
      {"airframe_rate_radps", "angular rates of the airframe"},
      {"camera_force_mps2", "forces"},
      {"airframe_force_mps2", "forces of the airframe"},
      {"camera_gravity", "direction of gravity"},
      {"exposure_s", "exposure time"},
      {"white_cdpm2", "luminance of white"}};
  std::vector<std::string> there;
  for_each_channel(track, [&](std::string_view name, const auto& channel) {
    if (const auto word = kWords.find(name); word != kWords.end() && !channel.empty())
      there.push_back(fmt::format("{} ({})", word->second, channel.source));
  });
  return listed(there);
}

namespace {

constexpr double kPanel_px = 270, kMap_px = 560;

PlotSeries line_of(std::string title) {
  return {.title = std::move(title), .runs = {{}}};
}

// Angles go on beyond 180 degrees rather than jump.
void add_attitude(std::vector<PlotSeries>& list, const std::string& prefix, const Channel<glm::dquat>& channel) {
  if (channel.empty()) return;
  std::array<PlotSeries, 3> angles{line_of(prefix + "roll"), line_of(prefix + "pitch"), line_of(prefix + "yaw")};
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    const Attitude attitude = attitude_of(channel.values[i]);
    const std::array<double, 3> angles_rad{attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad};
    for (std::size_t k = 0; k < angles.size(); ++k) {
      std::vector<PlotPoint>& run = angles[k].runs.front();
      double deg = deg_of_rad(angles_rad[k]);
      if (!run.empty()) deg += 360 * std::round((run.back().y - deg) / 360);
      run.push_back({channel.times_s[i], deg});
    }
  }
  for (PlotSeries& angle : angles) list.push_back(std::move(angle));
}

std::vector<PlotSeries> rate_series(const Channel<glm::dvec3>& channel) {
  if (channel.empty()) return {};
  std::vector<PlotSeries> list{line_of("X forward"), line_of("Y right"), line_of("Z down")};
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      list[static_cast<std::size_t>(axis)].runs.front().push_back(
          {channel.times_s[i], deg_of_rad(channel.values[i][axis])});
  return list;
}

std::vector<PlotSeries> height_series(const Track& track) {
  const auto& places = track.position;
  const auto& local = track.local_position_ned_m;
  PlotSeries height = line_of(places.empty() ? "local" : "height");
  for (std::size_t i = 0; i < places.values.size(); ++i)
    height.runs.front().push_back({places.times_s[i], places.values[i].height_m});
  for (std::size_t i = 0; i < local.values.size() && places.empty(); ++i)
    height.runs.front().push_back({local.times_s[i], -local.values[i].z});
  return height.runs.front().empty() ? std::vector<PlotSeries>{} : std::vector<PlotSeries>{std::move(height)};
}

std::vector<PlotSeries> ground_series(const Track& track) {
  PlotSeries path = line_of("path");
  const auto add = [&](const glm::dvec3& ned_m) { path.runs.front().push_back({ned_m.y, ned_m.x}); };
  if (!track.position.empty()) {
    const LocalFrame frame(track.position.values.front(), 0);  // heading 0: the world's X is north
    for (const GeodeticPosition& place : track.position.values) add(frame.world_of(place));
  } else {
    for (const glm::dvec3& place_m : track.local_position_ned_m.values) add(place_m);
  }
  if (path.runs.front().empty()) return {};
  PlotSeries start{.title = "start", .runs = {{path.runs.front().front()}}, .kind = SeriesKind::marks};
  return {std::move(path), std::move(start)};
}

}  // namespace

cv::Mat track_plot(const Track& track) {
  std::vector<Plot> plots;
  const auto add = [&](std::string title, std::vector<PlotSeries> series) {
    if (series.empty()) return;
    const PlotSpan times_s = range_of(series, &PlotPoint::x), values = range_of(series, &PlotPoint::y);
    plots.push_back({.title = std::move(title),
                     .x_label = "time, s",
                     .x_range = times_s,
                     .y_range = values,
                     .series = std::move(series),
                     .height = kPanel_px});
  };
  std::vector<PlotSeries> attitudes, since_start;
  add_attitude(attitudes, "", track.ned_from_airframe);
  add_attitude(attitudes, "camera ", track.ned_from_camera);
  if (attitudes.empty()) add_attitude(since_start, "camera ", track.start_from_camera);
  add("attitude, degrees", std::move(attitudes));
  add("attitude of the camera against its start, degrees", std::move(since_start));
  add("angular rate of the camera, degrees/s", rate_series(track.camera_rate_radps));
  add("angular rate of the airframe, degrees/s", rate_series(track.airframe_rate_radps));
  add("height, m", height_series(track));
  const std::size_t over_time = plots.size();
  add("ground track, north up", ground_series(track));
  if (plots.size() > over_time) {
    plots.back().x_label = "m east";
    plots.back().y_label = "m north";
    plots.back().same_scale = true;
    plots.back().height = kMap_px;
  }
  return image_of(plots);
}

}  // namespace sigs
