// SPDX-License-Identifier: MIT
#include "geo/utc_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "base/text.h"

namespace sigs {

namespace {

namespace ch = std::chrono;

// Takes the parts of a text off its front.
class InstantText {
 public:
  explicit InstantText(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] bool failed() const { return failed_; }

  bool take(char c) {
    const bool is_there = rest_.starts_with(c);
    if (is_there) rest_.remove_prefix(1);
    return is_there;
  }
  void expect(char c) { failed_ |= !take(c); }

  // Exactly so many digits.
  int digits(std::size_t count, int low, int high) {
    int number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (i >= rest_.size() || rest_[i] < '0' || rest_[i] > '9') {
        failed_ = true;
        return low;
      }
      number = 10 * number + (rest_[i] - '0');
    }
    rest_.remove_prefix(count);
    failed_ |= number < low || number > high;
    return number;
  }

  // The digits behind a decimal point, as a part of 1.
  double fraction() {
    double value = 0;
    double unit = 0.1;
    bool has_digit = false;
    while (!rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9') {
      value += unit * (rest_[0] - '0');
      unit /= 10;
      has_digit = true;
      rest_.remove_prefix(1);
    }
    failed_ |= !has_digit;
    return value;
  }

 private:
  std::string_view rest_;
  bool failed_ = false;
};

double day_s(InstantText& text) {
  const int year = text.digits(4, 1, 9999);
  const int month = text.take('-') ? text.digits(2, 1, 12) : 1;
  const int day = text.take('-') ? text.digits(2, 1, 31) : 1;
  return utc_of_day(year, month, day).value_or(NAN);
}

double clock_s(InstantText& text) {
  const int hour = text.digits(2, 0, 24);
  text.expect(':');
  const int minute = text.digits(2, 0, 59);
  double second = 0;
  if (text.take(':')) {
    second = text.digits(2, 0, 60);
    if (text.take('.') || text.take(',')) second += text.fraction();
  }
  // 24:00:00 is the end of the day (ISO 8601), 23:59:60 a leap second; no time is later.
  if (hour == 24 && (minute > 0 || second > 0)) return NAN;
  if (second >= 60 && (hour != 23 || minute != 59)) return NAN;
  return 3600.0 * hour + 60.0 * minute + second;
}

// How far the clock of the zone is ahead of UTC; nullopt where the text states no zone.
std::optional<double> zone_s(InstantText& text) {
  if (text.take('Z') || text.take('z')) return 0;
  const bool is_ahead = text.take('+');
  if (!is_ahead && !text.take('-')) return std::nullopt;
  const int hours = text.digits(2, 0, 14);
  text.take(':');
  const int minutes = text.at_end() ? 0 : text.digits(2, 0, 59);
  return (is_ahead ? 1 : -1) * (3600.0 * hours + 60.0 * minutes);
}

}  // namespace

std::optional<double> utc_of_day(int year, int month, int day) {
  const ch::year_month_day date{ch::year(year), ch::month(static_cast<unsigned>(month)),
                                ch::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(ch::sys_days(date).time_since_epoch().count());
}

std::optional<UtcInstant> utc_instant_of(std::string_view text) {
  InstantText rest(trimmed(text, " \t\r\n"));
  double time_s = day_s(rest);
  if (rest.take('T') || rest.take('t') || rest.take(' ')) time_s += clock_s(rest);
  const std::optional<double> zone = zone_s(rest);
  if (rest.failed() || !rest.at_end() || !std::isfinite(time_s)) return std::nullopt;
  return UtcInstant{time_s - zone.value_or(0), zone.has_value()};
}

std::string utc_text(double time_s) {
  const double within_s = std::clamp(time_s, kFirstUtc_s, kLastUtc_s);
  double whole_s = std::floor(within_s);
  auto micros = std::llround((within_s - whole_s) * 1e6);
  if (micros == 1000000) {
    whole_s += 1;
    micros = 0;
  }
  const ch::sys_seconds instant{ch::seconds(static_cast<std::int64_t>(std::min(whole_s, kLastUtc_s)))};
  const ch::sys_days day = ch::floor<ch::days>(instant);
  const ch::year_month_day date(day);
  const ch::hh_mm_ss clock(instant - day);
  std::string fraction = micros == 0 ? "" : fmt::format(".{:06}", micros);
  fraction.erase(fraction.find_last_not_of('0') + 1);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), fraction);
}

}  // namespace sigs
