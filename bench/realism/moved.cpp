// SPDX-License-Identifier: MIT
#include "realism/moved.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "appearance/target_silhouette.h"

namespace sigs::bench {

namespace {

constexpr double kWhole_px = 10;  // around the target: taken over wholly
constexpr double kSoft_px = 5;    // beyond: less and less
constexpr double kFine_px = 4;    // sigma: what is smoother at the new place is background

// The plane with the weighted stretch replaced by the smooth background there plus the difference.
void put(cv::Mat& plane, const cv::Mat& difference, const cv::Mat& weight, cv::Point at) {
  cv::Mat part = plane(cv::Rect(at, difference.size())), values, smooth;
  part.convertTo(values, CV_32F);
  cv::GaussianBlur(values, smooth, {}, kFine_px);
  const cv::Mat mixed = values + weight.mul(smooth + difference - values);
  mixed.convertTo(part, CV_8U);
}

}  // namespace

std::optional<Frame> with_target_moved(const Frame& frame, const Box& box, cv::Point shift) {
  const auto target = target_silhouette(frame, box);
  if (!target || frame.layout == PixelLayout::rgb) return std::nullopt;
  cv::Mat weight = (kWhole_px + kSoft_px - target->distance_px) / kSoft_px;
  weight = cv::max(0.0, cv::min(1.0, weight));
  const cv::Size step = chroma_step(frame.layout);
  cv::Rect part = target->patch;
  part.x += part.x % 2;  // where chroma samples begin
  part.y += part.y % 2;
  part.width = (target->patch.br().x - part.x) / 2 * 2;
  part.height = (target->patch.br().y - part.y) / 2 * 2;
  const cv::Rect image({0, 0}, frame.size_px());
  const cv::Rect wanted = cv::Rect(part.tl() + shift, part.size());
  // As much of the patch as lies within the image at the new place; the target's own neighbourhood must.
  const cv::Rect reach =
      cv::Rect(target->box.x - 8, target->box.y - 8, target->box.width + 16, target->box.height + 16);
  if (((reach + shift) & image) != reach + shift) return std::nullopt;
  cv::Rect there = wanted & image;
  there.width = there.width / 2 * 2;
  there.height = there.height / 2 * 2;
  const cv::Rect in_patch = there - shift - target->patch.tl();
  Frame moved = cloned(frame);
  put(moved.planes[0], target->difference(in_patch), weight(in_patch), there.tl());
  const cv::Mat differences[] = {{}, target->cb_difference, target->cr_difference};
  for (int p = 1; p < frame.plane_count(); ++p) {
    // The chroma samples themselves: the background's surface is the same whichever plane size it is taken from.
    const cv::Size size(there.width / step.width, there.height / step.height);
    const cv::Point from((there.x - shift.x) / step.width, (there.y - shift.y) / step.height);
    cv::Mat surface, samples, small_weight, small_surface;
    const cv::Mat full = p == 1 ? target->cb : target->cr;
    surface = full(in_patch) - differences[p](in_patch);
    cv::resize(surface, small_surface, size, 0, 0, cv::INTER_AREA);
    cv::resize(weight(in_patch), small_weight, size, 0, 0, cv::INTER_AREA);
    frame.planes[static_cast<std::size_t>(p)](cv::Rect(from, size)).convertTo(samples, CV_32F);
    put(moved.planes[static_cast<std::size_t>(p)], samples - small_surface, small_weight,
        {there.x / step.width, there.y / step.height});
  }
  return moved;
}

}  // namespace sigs::bench
