// SPDX-License-Identifier: MIT
#include "comparison/target_boxes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "base/csv.h"
#include "base/input_file.h"
#include "base/parsing.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr double kMaxFrame = 1e7;
constexpr double kMaxPixel = 1e6;

struct Line {
  std::size_t frame = 0;
  Box box;
};

// What is wrong with the line, or what it says.
Result<Line> line_of(std::string_view line, const std::string& where) {
  const auto fields = csv_fields(line);
  if (fields.size() < 6)
    return fail(where, fmt::format("expected frame,label,x,y,w,h, found {} fields", fields.size()),
                ErrorKind::bad_data);
  std::array<double, 6> numbers{};
  for (const std::size_t i : {0U, 2U, 3U, 4U, 5U}) {
    const auto number = finite_number(fields[i]);
    if (!number || std::abs(*number) > (i == 0 ? kMaxFrame : kMaxPixel))
      return fail(where, fmt::format("field {} is no number in its range", i + 1), ErrorKind::bad_data);
    numbers[i] = *number;
  }
  if (numbers[0] < 0 || numbers[0] != std::floor(numbers[0]))
    return fail(where, "the frame is no whole number from 0", ErrorKind::bad_data);
  // From the centre of the first pixel at (1, 1) to its edge at (-0.5, -0.5).
  return Line{static_cast<std::size_t>(numbers[0]), {numbers[2] - 1.5, numbers[3] - 1.5, numbers[4], numbers[5]}};
}

}  // namespace

Result<std::vector<std::optional<Box>>> read_target_boxes(const std::filesystem::path& csv) {
  const Result<std::string> text = read_text(csv);
  if (!text) return fail(text.error());
  std::string_view rest = without_bom(*text);
  (void)next_line(rest);
  std::vector<std::optional<Box>> boxes;
  bool any = false;
  for (int number = 2; !rest.empty(); ++number) {
    const std::string_view line = trimmed(next_line(rest));
    if (line.empty()) continue;
    const Result<Line> read = line_of(line, fmt::format("{}: line {}", csv.string(), number));
    if (!read) return fail(read.error());
    if (!(read->box.width > 0 && read->box.height > 0)) continue;
    if (read->frame >= boxes.size()) boxes.resize(read->frame + 1);
    if (!boxes[read->frame]) boxes[read->frame] = read->box;
    any = true;
  }
  if (!any) return fail(csv.string(), "has no box", ErrorKind::bad_data);
  return boxes;
}

}  // namespace sigs
