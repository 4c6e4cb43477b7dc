// SPDX-License-Identifier: MIT
#include "telemetry/gopro_values.h"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "base/text.h"

namespace sigs {

bool is_finite(double value) {
  return std::isfinite(value);
}
bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_finite(const glm::dquat& q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}
bool is_finite(const GeodeticPosition& p) {
  return std::isfinite(p.height_m) && std::abs(p.latitude_deg) <= 90 && std::abs(p.longitude_deg) <= 180;
}

std::optional<double> utc_of_gpsu(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
  if (std::sscanf(text.c_str(), "%2d%2d%2d%2d%2d%lf", &year, &month, &day, &hour, &minute, &second) != 6) return {};
  const std::chrono::year_month_day date{std::chrono::year(2000 + year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0 && second < 61)) return {};
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<double>(days) * kSecondsPerDay + hour * 3600 + minute * 60 + second;
}

std::string span_text(double first_s, double last_s) {
  if (first_s == last_s) return "at " + fixed_text(first_s, 2) + " s";
  return "from " + fixed_text(first_s, 2) + " to " + fixed_text(last_s, 2) + " s";
}

}  // namespace sigs
