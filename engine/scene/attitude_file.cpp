// SPDX-License-Identifier: MIT
#include "scene/attitude_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr std::array<std::string_view, 4> kColumns{"frame", "roll_deg", "pitch_deg", "yaw_deg"};
constexpr std::string_view kHeader = "frame,roll_deg,pitch_deg,yaw_deg";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kLastFrame = 1e9;
constexpr double kLargest_deg = 360;

// Takes the part before the next separator, and the separator, off the text.
std::string_view taken_until(char separator, std::string_view& text) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return part;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (line.find(',') != std::string_view::npos) cells.push_back(trimmed(taken_until(',', line)));
  cells.push_back(trimmed(line));
  return cells;
}

bool is_header(std::string_view line) {
  const std::vector<std::string_view> cells = cells_of(line);
  return std::equal(cells.begin(), cells.end(), kColumns.begin(), kColumns.end());
}

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

Result<AttitudeAtFrame> attitude_in(std::string_view line, const std::string& where) {
  const std::vector<std::string_view> cells = cells_of(line);
  if (cells.size() != kColumns.size())
    return fail(where, "expected 4 numbers between commas, found " + std::to_string(cells.size()));
  std::array<double, kColumns.size()> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<double> number = number_of(cells[i]);
    const std::string cell = where + ": " + std::string(kColumns[i]);
    if (!number) return fail(cell, "is not a number such as -0.25");
    if (i == 0 && std::abs(*number) > kLastFrame) return fail(cell, "must lie between -1e9 and 1e9");
    if (i > 0 && std::abs(*number) > kLargest_deg) return fail(cell, "must lie between -360 and 360 degrees");
    numbers[i] = *number;
  }
  return AttitudeAtFrame{numbers[0], {rad_of_deg(numbers[1]), rad_of_deg(numbers[2]), rad_of_deg(numbers[3])}};
}

}  // namespace

Result<std::vector<AttitudeAtFrame>> read_attitude_file(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  std::string_view rest = *text;
  if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
  if (!is_header(taken_until('\n', rest)))
    return fail(path.string() + ": line 1", "expected the header " + std::string(kHeader));
  std::vector<AttitudeAtFrame> attitudes;
  for (int line_number = 2; !rest.empty(); ++line_number) {
    const std::string_view line = taken_until('\n', rest);
    if (trimmed(line).empty()) continue;
    const std::string where = path.string() + ": line " + std::to_string(line_number);
    const Result<AttitudeAtFrame> attitude = attitude_in(line, where);
    if (!attitude) return fail(attitude.error());
    if (!attitudes.empty() && attitude->frame <= attitudes.back().frame)
      return fail(where + ": frame", "is not after the frame of the line before; frames must rise");
    attitudes.push_back(*attitude);
  }
  if (attitudes.empty()) return fail(path.string(), "has no line below its header; expected one for each frame");
  return attitudes;
}

}  // namespace sigs
