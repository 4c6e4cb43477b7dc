// SPDX-License-Identifier: MIT
#include "telemetry/log_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"

namespace sigs {
namespace {

constexpr double kLeastGap_s = 1;
constexpr double kGapInIntervals = 5;
constexpr std::size_t kMaxNamedGaps = 5;
constexpr double kNoFix_deg = 1e-6;

}  // namespace

bool has_samples(const Track& track) {
  return !track.position.empty() || !track.local_position_ned_m.empty() || !track.velocity_ned_mps.empty() ||
         !track.ned_from_airframe.empty() || !track.ned_from_camera.empty() || !track.airframe_rate_radps.empty() ||
         !track.airframe_force_mps2.empty() || !track.exposure_s.empty();
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
    std::string what = count_text(static_cast<std::int64_t>(samples.count), "sample") + " left out";
    const double first_s = samples.first_s - zero_s;
    if (std::isfinite(first_s)) what += ", the first at " + short_number_text(first_s) + " s";
    warnings.push_back({source, what + ": " + reason});
  }
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_interval_s(const std::vector<double>& times_s) {
  if (times_s.size() < 2) return 0;
  std::vector<double> intervals_s(times_s.size() - 1);
  for (std::size_t i = 0; i + 1 < times_s.size(); ++i) intervals_s[i] = times_s[i + 1] - times_s[i];
  return median_of(std::move(intervals_s));
}

void warn_of_gaps(const std::vector<double>& times_s, const std::string& source, std::vector<Warning>& warnings) {
  const double least_s = std::max(kLeastGap_s, kGapInIntervals * median_interval_s(times_s));
  std::size_t gaps = 0;
  for (std::size_t i = 0; i + 1 < times_s.size(); ++i) {
    const double gap_s = times_s[i + 1] - times_s[i];
    if (!(gap_s > least_s)) continue;
    if (++gaps <= kMaxNamedGaps)
      warnings.push_back(
          {source, "no samples for " + short_number_text(gap_s) + " s after " + short_number_text(times_s[i]) + " s"});
  }
  if (gaps > kMaxNamedGaps)
    warnings.push_back({source, count_text(static_cast<std::int64_t>(gaps - kMaxNamedGaps), "more gap")});
}

}  // namespace sigs
