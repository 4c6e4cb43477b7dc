// SPDX-License-Identifier: MIT
#include "comparison/measured_target.h"

#include <algorithm>

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

}  // namespace sigs
