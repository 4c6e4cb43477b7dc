// SPDX-License-Identifier: MIT
#include "geo/recorded/path_draft.h"

#include <charconv>
#include <cmath>

#include "base/xml_text.h"

namespace sigs {

std::optional<double> file_number_of(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

double file_number_or_nan(std::string_view text) {
  return file_number_of(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string file_name_text(std::string_view text) {
  constexpr std::size_t kMaxBytes = 200;
  const std::string line = line_text(text.substr(0, kMaxBytes));
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(' ') - first + 1);
}

bool is_repeated(const PathDraft& draft, const DraftPoint& point) {
  constexpr double kRounding_s = 0.5;  // readsb rounds the age of a position to 0.1 s
  if (draft.points.empty()) return false;
  const DraftPoint& last = draft.points.back();
  return last.latitude_deg == point.latitude_deg && last.longitude_deg == point.longitude_deg && last.time_s &&
         point.time_s && std::abs(*last.time_s - *point.time_s) < kRounding_s;
}

}  // namespace sigs
