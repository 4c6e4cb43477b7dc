// SPDX-License-Identifier: MIT
#include "world_lock/background_point.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video.hpp>

#include "base/statistics.h"

namespace sigs::bench {

namespace {

const cv::Size kWindow(15, 15);
constexpr int kLevels = 4;
constexpr float kReturn_px = 0.1F;
constexpr std::size_t kMinCorners = 8;
constexpr double kMinCorrelation = 0.9;
constexpr double kFarFromKey_px = 1.5;  // a match that far from where the corners lead is a wrong one

// Median and its standard deviation.
std::pair<double, double> middle_of_axis(const std::vector<cv::Point2f>& moves, float cv::Point2f::*axis) {
  std::vector<double> values;
  for (const cv::Point2f& move : moves) values.push_back(static_cast<double>(move.*axis));
  return {median(values), 1.253 * robust_standard_deviation(values) / std::sqrt(static_cast<double>(moves.size()))};
}

std::vector<cv::Point2f> followed(const Pyramid& from, const Pyramid& to, const std::vector<cv::Point2f>& points,
                                  std::vector<uchar>& found) {
  std::vector<cv::Point2f> there;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(from, to, points, there, found, error, kWindow, kLevels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.003});
  return there;
}

cv::Point2d mapped(const cv::Matx23d& map, cv::Point2d point) {
  return {map(0, 0) * point.x + map(0, 1) * point.y + map(0, 2), map(1, 0) * point.x + map(1, 1) * point.y + map(1, 2)};
}

cv::Matx23d shifted(cv::Matx23d map, cv::Point2d by) {
  map(0, 2) += by.x;
  map(1, 2) += by.y;
  return map;
}

cv::Rect rect_around(cv::Point2d at, cv::Size half_px, cv::Size size_px) {
  const cv::Rect rect(cvRound(at.x) - half_px.width, cvRound(at.y) - half_px.height, 2 * half_px.width + 1,
                      2 * half_px.height + 1);
  return rect & cv::Rect({}, size_px);
}

// Where the key image lies in another one, from a start nearby; nothing where they do not agree.
std::optional<cv::Matx23d> matched(const cv::Mat& key, const cv::Mat& image, const cv::Mat& mask, cv::Matx23d start) {
  cv::Mat warp;
  cv::Mat(start).convertTo(warp, CV_32F);
  try {
    const cv::TermCriteria effort(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-5);
    if (cv::findTransformECC(key, image, warp, cv::MOTION_AFFINE, effort, mask, 3) < kMinCorrelation)
      return std::nullopt;
  } catch (const cv::Exception&) {
    return std::nullopt;  // the search did not converge
  }
  cv::Matx23d result;
  for (int i = 0; i < 6; ++i) result.val[i] = static_cast<double>(warp.at<float>(i / 3, i % 3));
  return result;
}

}  // namespace

cv::Size template_half_px(const Clip& clip) {
  return {clip.source.patch_px.width * 3 / 4, clip.source.patch_px.height * 3 / 4};
}

Pyramid pyramid_of(const cv::Mat& luma) {
  Pyramid pyramid;
  cv::buildOpticalFlowPyramid(luma, pyramid, kWindow, kLevels);
  return pyramid;
}

Displacements displacements(const cv::Mat& luma, const Pyramid& before, const Pyramid& after, const cv::Mat& mask,
                            const CornerSettings& settings) {
  const cv::Rect rect = cv::boundingRect(mask);
  Displacements result;
  std::vector<cv::Point2f> corners;
  if (rect.empty()) return result;
  cv::goodFeaturesToTrack(luma(rect), corners, settings.corners, 0.02, settings.spacing_px, mask(rect), 5);
  if (corners.empty()) return result;
  for (cv::Point2f& corner : corners) corner += cv::Point2f(rect.tl());
  std::vector<uchar> found, returned;
  const std::vector<cv::Point2f> there = followed(before, after, corners, found);
  const std::vector<cv::Point2f> back = followed(after, before, there, returned);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (found[i] == 0 || returned[i] == 0 || cv::norm(back[i] - corners[i]) > kReturn_px) continue;
    result.points.push_back(corners[i]);
    result.moves.push_back(there[i] - corners[i]);
  }
  return result;
}

Displacement middle_of(const Displacements& all) {
  const auto [x, sd_x] = middle_of_axis(all.moves, &cv::Point2f::x);
  const auto [y, sd_y] = middle_of_axis(all.moves, &cv::Point2f::y);
  return {.px = {x, y}, .sd_px = std::max(sd_x, sd_y)};
}

BackgroundPoint::BackgroundPoint(const Clip& clip, int frame, cv::Point2d at) : clip_(clip), frame_(frame), at_(at) {
  take_key(at, 1);
}

void BackgroundPoint::take_key(cv::Point2d at, double growth) {
  const cv::Rect rect = rect_around(at, template_half_px(clip_), clip_.shape.size_px);
  key_ = clip_.luma[static_cast<std::size_t>(frame_)](rect).clone();
  key_at_ = at - cv::Point2d(rect.tl());
  key_growth_ = growth;
  image_from_key_ = {1, 0, static_cast<double>(rect.x), 0, 1, static_cast<double>(rect.y)};
}

std::optional<BackgroundStep> BackgroundPoint::next(const Pyramid& before, const Pyramid& after) {
  const std::size_t n = static_cast<std::size_t>(frame_);
  if (n + 1 >= clip_.luma.size() || !is_in_view(at_)) return std::nullopt;
  cv::Mat around = cv::Mat::zeros(clip_.shape.size_px, CV_8UC1);
  cv::ellipse(around, {cvRound(at_.x), cvRound(at_.y)}, clip_.source.patch_px, 0, 0, 360, 255, cv::FILLED);
  around &= clip_.world_mask(frame_);
  const Displacements found = displacements(clip_.luma[n], before, after, around, {});
  if (found.moves.size() < kMinCorners) return std::nullopt;
  BackgroundStep step{.step = middle_of(found), .corners = static_cast<int>(found.moves.size()), .growth = growth_};
  step.at = at_ + step.step.px;
  if (!is_in_view(step.at)) return std::nullopt;
  if (!match(step)) {
    take_key(at_, growth_);  // of the frame before
    (void)match(step);
  }
  ++frame_;
  at_ = step.at;
  growth_ = step.growth;
  return step;
}

bool BackgroundPoint::match(BackgroundStep& step) {
  cv::Matx23d map = image_from_key_;
  map = shifted(map, step.at - mapped(map, key_at_));
  const cv::Rect near = rect_around(step.at, template_half_px(clip_) * 2, clip_.shape.size_px);
  const std::size_t n = static_cast<std::size_t>(frame_) + 1;
  const std::optional<cv::Matx23d> found =
      matched(key_, clip_.luma[n](near), clip_.world_mask(frame_ + 1)(near), shifted(map, -cv::Point2d(near.tl())));
  if (!found) return false;
  map = shifted(*found, near.tl());
  const cv::Point2d at = mapped(map, key_at_);
  if (cv::norm(at - step.at) > kFarFromKey_px) return false;
  step.at = at;
  step.growth = key_growth_ * std::sqrt(std::abs(map(0, 0) * map(1, 1) - map(0, 1) * map(1, 0)));
  step.is_matched = true;
  image_from_key_ = map;
  return true;
}

bool BackgroundPoint::is_in_view(cv::Point2d at) const {
  constexpr int kMargin_px = 20;
  const cv::Rect inner(kMargin_px, kMargin_px, clip_.shape.size_px.width - 2 * kMargin_px,
                       clip_.shape.size_px.height - 2 * kMargin_px);
  const cv::Point pixel(cvRound(at.x), cvRound(at.y));
  if (!inner.contains(pixel)) return false;
  return clip_.own_body.empty() || clip_.own_body.at<uchar>(pixel) == 0;
}

}  // namespace sigs::bench
