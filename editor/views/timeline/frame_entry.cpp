// SPDX-License-Identifier: MIT
#include "editor/views/timeline/frame_entry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace sigs::editor {

namespace {

constexpr double kMaxFrames = 1e9;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Without sign or exponent, all of the text.
std::optional<double> number(std::string_view text) {
  if (text.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "h:mm:ss.ss" or "m:ss.ss".
std::optional<double> time_in(std::string_view text) {
  double time_s = 0;
  while (true) {
    const auto colon = text.find(':');
    const std::optional<double> part = number(text.substr(0, colon));
    if (!part) return std::nullopt;
    time_s = time_s * 60 + *part;
    if (colon == std::string_view::npos) return time_s;
    text.remove_prefix(colon + 1);
  }
}

double nearest_in_time(double time_s, std::span<const double> times_s) {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  const auto number = static_cast<double>(after - times_s.begin());
  if (after == times_s.begin()) return 0;
  return after == times_s.end() || time_s - *(after - 1) <= *after - time_s ? number - 1 : number;
}

}  // namespace

std::optional<int> frame_from_entry(std::string_view entry, int playhead, std::span<const double> times_s) {
  const std::string_view text = trimmed(entry);
  if (text.empty()) return std::nullopt;
  const bool is_time = text.find(':') != std::string_view::npos;
  const bool is_relative = text.front() == '+' || text.front() == '-';
  const std::optional<double> value = is_time ? time_in(text) : number(text.substr(is_relative ? 1 : 0));
  if (!value || (is_time && times_s.empty())) return std::nullopt;
  double frame = *value;
  if (is_time) frame = nearest_in_time(*value, times_s);
  if (is_relative) frame = text.front() == '-' ? playhead - *value : playhead + *value;
  const double highest = times_s.empty() ? kMaxFrames : static_cast<double>(times_s.size() - 1);
  return static_cast<int>(std::floor(std::clamp(frame, 0.0, highest)));
}

}  // namespace sigs::editor
