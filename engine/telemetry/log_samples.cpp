// SPDX-License-Identifier: MIT
#include "telemetry/log_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"

namespace sigs {
namespace {

constexpr double kMinGap_s = 1;
constexpr double kGapInIntervals = 5;
constexpr std::size_t kMaxNamedGaps = 5;
constexpr double kNoFix_deg = 1e-6;
constexpr std::size_t kMaxOutliers = 1000;  // one after the other
constexpr double kJump_intervals = 3;
constexpr std::size_t kUsual = 64;  // intervals that tell what is usual
constexpr double kLone_intervals = 1000;
constexpr std::size_t kMaxLone = 3;
constexpr std::size_t kMinStamps = 10;

// The median of the last intervals before stamp `end` and of those between the late stamps; 0 where there is none.
double usual_interval_s(const std::vector<double>& times_s, std::size_t end, const std::vector<double>& late_s) {
  std::vector<double> intervals_s;
  for (std::size_t i = end > kUsual ? end - kUsual : 1; i < end; ++i)
    intervals_s.push_back(times_s[i] - times_s[i - 1]);
  for (std::size_t i = 1; i < std::min(kUsual, late_s.size()); ++i) intervals_s.push_back(late_s[i] - late_s[i - 1]);
  return intervals_s.empty() ? 0 : median(std::move(intervals_s));
}

}  // namespace

LateStamps judge_late_stamps(const std::vector<double>& kept_s, const std::vector<double>& late_s) {
  const double late = late_s.front();
  const auto first_after = std::upper_bound(kept_s.begin(), kept_s.end(), late);
  const std::size_t begin = static_cast<std::size_t>(first_after - kept_s.begin());
  const std::size_t ahead = kept_s.size() - begin;
  if (ahead >= kMaxOutliers) return LateStamps::leave_out;
  const double jump_s = kJump_intervals * usual_interval_s(kept_s, begin, late_s);
  const bool has_before = begin > 0;
  const bool is_jump = *first_after - late > jump_s && (!has_before || *first_after - kept_s[begin - 1] > jump_s);
  if (!is_jump) return LateStamps::leave_out;
  const bool goes_on = has_before && jump_s > 0 && late - kept_s[begin - 1] <= jump_s;
  const std::size_t needed = goes_on ? ahead : ahead + 1;
  return late_s.size() >= needed ? LateStamps::replace : LateStamps::wait;
}

LoneStamps lone_stamps(const std::vector<double>& times_s) {
  LoneStamps lone;
  if (times_s.size() < kMinStamps) return lone;
  const double far_s = kLone_intervals * median_interval_s(times_s);
  if (!(far_s > 0)) return lone;
  const std::size_t last = times_s.size() - 1;
  const auto is_gap = [&](double gap_s, double rest_s) { return gap_s > far_s && gap_s > rest_s; };
  for (std::size_t n = kMaxLone; n > 0 && lone.at_end == 0; --n)
    if (is_gap(times_s[last + 1 - n] - times_s[last - n], times_s[last - n] - times_s[0])) lone.at_end = n;
  const std::size_t end = last - lone.at_end;
  for (std::size_t n = kMaxLone; n > 0 && lone.at_begin == 0; --n)
    if (is_gap(times_s[n] - times_s[n - 1], times_s[end] - times_s[n])) lone.at_begin = n;
  return lone;
}

bool has_samples(const Track& track) {
  bool any = false;
  for_each_channel(track, [&](std::string_view, const auto& channel) { any = any || !channel.empty(); });
  return any;
}

bool all_finite(double value) {
  return std::isfinite(value);
}
bool all_finite(const glm::dvec3& value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}
bool all_finite(const glm::dquat& value) {
  return std::isfinite(value.w) && std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}
bool all_finite(const GeodeticPosition& value) {
  return std::isfinite(value.latitude_deg) && std::isfinite(value.longitude_deg) && std::isfinite(value.height_m);
}

const char* why_no_place(const GeodeticPosition& place) {
  if (!all_finite(place)) return "not a finite number";
  if (std::abs(place.latitude_deg) > 90) return "a latitude beyond 90 degrees is impossible";
  if (std::abs(place.longitude_deg) > 180) return "a longitude beyond 180 degrees is impossible";
  if (std::abs(place.latitude_deg) < kNoFix_deg && std::abs(place.longitude_deg) < kNoFix_deg)
    return "latitude and longitude are 0, as receivers write without a fix";
  if (!check_place(place)) return "a height below every trench or above every orbit is impossible";
  return nullptr;
}

void LeftOutByReason::count(const std::string& reason, double own_time_s) {
  const auto [entry, is_first] = by_reason_.try_emplace(reason);
  if (is_first) entry->second.first_s = own_time_s;
  ++entry->second.count;
}

void LeftOutByReason::report(const std::string& source, double zero_s, std::vector<Warning>& warnings) const {
  for (const auto& [reason, samples] : by_reason_) {
    std::string what = count_text(samples.count, "sample") + " left out";
    const double first_s = samples.first_s - zero_s;
    if (std::isfinite(first_s)) what += ", the first at " + short_number_text(first_s) + " s";
    warnings.push_back({source, what + ": " + reason});
  }
}

double median_interval_s(const std::vector<double>& times_s) {
  if (times_s.size() < 2) return 0;
  std::vector<double> intervals_s(times_s.size() - 1);
  for (std::size_t i = 0; i + 1 < times_s.size(); ++i) intervals_s[i] = times_s[i + 1] - times_s[i];
  return median(std::move(intervals_s));
}

void warn_of_gaps(const std::vector<double>& times_s, const std::string& source, std::vector<Warning>& warnings) {
  const double min_s = std::max(kMinGap_s, kGapInIntervals * median_interval_s(times_s));
  std::size_t gaps = 0;
  for (std::size_t i = 0; i + 1 < times_s.size(); ++i) {
    const double gap_s = times_s[i + 1] - times_s[i];
    if (!(gap_s > min_s)) continue;
    if (++gaps <= kMaxNamedGaps)
      warnings.push_back(
          {source, "no samples for " + short_number_text(gap_s) + " s after " + short_number_text(times_s[i]) + " s"});
  }
  if (gaps > kMaxNamedGaps) warnings.push_back({source, count_text(gaps - kMaxNamedGaps, "more gap")});
}

void add_place(Samples<GeodeticPosition>& places, double own_time_s, const GeodeticPosition& place) {
  if (const char* const why = why_no_place(place))
    places.leave_out(why, own_time_s);
  else
    places.add(own_time_s, place);
}

void warn_of_captures(const std::vector<double>& captures_s, const std::string& source, double zero_s,
                      std::vector<Warning>& warnings) {
  if (captures_s.empty()) return;
  warnings.push_back({source, count_text(captures_s.size(), "image") + " taken, the first at " +
                                  short_number_text(captures_s.front() - zero_s) +
                                  " s; a track has no channel for them"});
}

glm::dquat rotation_of_deg(double roll_deg, double pitch_deg, double yaw_deg) {
  return rotation_of(
      {.roll_rad = rad_of_deg(roll_deg), .pitch_rad = rad_of_deg(pitch_deg), .yaw_rad = rad_of_deg(yaw_deg)});
}

}  // namespace sigs
