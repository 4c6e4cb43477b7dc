// SPDX-License-Identifier: MIT
#include "comparison/measured_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/csv.h"
#include "base/input_file.h"
#include "base/parsing.h"
#include "base/text.h"
#include "video/bit_depth.h"

namespace sigs {

namespace {

cv::Mat surroundings(const Frame& frame, const cv::Rect& box) {
  const int margin_px = 12 + std::max(box.width, box.height) / 4;
  const cv::Rect part(box.x - margin_px, box.y - margin_px, box.width + 2 * margin_px, box.height + 2 * margin_px);
  return bgr_of(frame)(part & cv::Rect({0, 0}, frame.size_px())).clone();
}

}  // namespace

Result<std::optional<Stretch>> stretch_around(FrameSource& footage, const std::vector<std::optional<Box>>& boxes,
                                              int middle, int reach) {
  const auto box_at = [&](int n) -> std::optional<Box> {
    if (n < 0 || n >= static_cast<int>(boxes.size()) || n >= footage.info().frame_count()) return std::nullopt;
    return boxes[static_cast<std::size_t>(n)];
  };
  if (!box_at(middle)) return std::optional<Stretch>();
  for (int n = middle - reach; n <= middle + reach; ++n)
    if (!box_at(n)) reach = 0;
  Stretch stretch{.middle = middle};
  for (int n = middle - reach; n <= middle + reach; ++n) {
    const Result<Frame> frame = footage.read(n);
    if (!frame) return fail(frame.error());
    stretch.frames.push_back(cloned(with_bit_depth(*frame, 8)));
    stretch.boxes.push_back(*box_at(n));
  }
  return std::optional(std::move(stretch));
}

std::optional<MeasuredTarget> measured_target(std::span<const Frame> frames, std::span<const Box> boxes) {
  const std::size_t middle = frames.size() / 2;
  std::vector<TargetLook> looks;
  std::optional<TargetLook> look;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto here = target_look(frames[i], boxes[i]);
    if (here) looks.push_back(*here);
    if (i == middle) look = here;
  }
  if (!look) return std::nullopt;
  MeasuredTarget target{.look = *look, .image = surroundings(frames[middle], look->box)};
  if (looks.size() < frames.size()) return target;
  add_flicker(target.look, looks);
  for (const TargetLook& one : looks) target.path_px.push_back(one.centroid_px - look->centroid_px);
  return target;
}

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
