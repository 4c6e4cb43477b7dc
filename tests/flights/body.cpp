// SPDX-License-Identifier: MIT
#include "flights/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "flights/body_paint.h"
#include "flights/mosaic.h"
#include "flights/random.h"

namespace sigs::flights {

namespace {

// Light of the highlight along one axis.
std::vector<float> bell(int first, int count, double middle, double sigma_px) {
  std::vector<float> values(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double z = (first + i - middle) / sigma_px;
    values[static_cast<std::size_t>(i)] = static_cast<float>(std::exp(-0.5 * z * z));
  }
  return values;
}

void blend_row(cv::Vec3b* under, const cv::Vec4b* over, int count, float light, const float* gloss, float gloss_codes) {
  for (int x = 0; x < count; ++x) {
    const float cover = static_cast<float>(over[x][3]);
    if (cover == 0) continue;
    const float shine = cover * (1.0F / 255) * gloss_codes * gloss[x], left = 1 - cover * (1.0F / 255);
    for (int k = 0; k < 3; ++k)
      under[x][k] = cv::saturate_cast<uchar>(static_cast<float>(under[x][k]) * left +
                                             static_cast<float>(over[x][k]) * light + shine);
  }
}

// One blade's blurred trace as a polygon, in pixels.
std::vector<cv::Point> trace(cv::Point2d middle_px, double radius_px, double angle_rad, int shift) {
  constexpr double kTurned_rad = 0.35;  // while the shutter is open
  std::vector<cv::Point> points;
  const auto add = [&](double radius, double angle) {
    const cv::Point2d p = middle_px + radius * cv::Point2d(std::cos(angle), std::sin(angle));
    points.emplace_back(cvRound(p.x * (1 << shift)), cvRound(p.y * (1 << shift)));
  };
  add(0.08 * radius_px, angle_rad);
  for (int k = 0; k <= 4; ++k) add(radius_px, angle_rad + kTurned_rad * k / 4);
  return points;
}

}  // namespace

Body body_of(const std::vector<Part>& parts, cv::Size size_px, std::uint32_t seed) {
  const Painted painted = painted_parts(parts, size_px, Body::kMargin_px, seed);
  Body body{.size_px = size_px, .paint = painted.premultiplied};
  const cv::Rect inside(Body::kMargin_px, Body::kMargin_px, size_px.width, size_px.height);
  cv::threshold(painted.cover(inside), body.truth, 127, 255, cv::THRESH_BINARY);
  cv::Mat alpha;
  cv::extractChannel(body.paint, alpha, 3);
  body.where = cv::boundingRect(alpha);
  return body;
}

Shake shake_at(int frame, cv::Size size_px, std::uint32_t seed) {
  const double scale = std::min(1.0, size_px.width / 640.0);
  const double way = 2 * std::numbers::pi * random_share(frame, 1, seed),
               reach_px = 0.5 + 1.5 * random_share(frame, 2, seed);
  const auto slow = [&](double rate_hz, int part) {
    return std::sin(2 * std::numbers::pi * (rate_hz * frame / 25.0 + random_share(part, 3, seed)));
  };
  return {.shift_px = scale * reach_px * cv::Point2d(std::cos(way), std::sin(way)),
          .light = 1 + 0.05 * slow(0.11, 1) + 0.02 * slow(0.5, 2),
          .gloss_px = {size_px.width * (0.5 + 0.35 * slow(0.05, 3)), size_px.height * (0.72 + 0.2 * slow(0.08, 4))},
          .gloss_codes = 28 + 14 * slow(0.21, 5)};
}

void draw_over(cv::Mat& image, const Body& body, const Shake& shake) {
  if (body.where.empty()) return;
  const int reach_px = cvCeil(std::max(std::abs(shake.shift_px.x), std::abs(shake.shift_px.y))) + 1;
  const cv::Rect shown =
      cv::Rect(body.where.x - reach_px - Body::kMargin_px, body.where.y - reach_px - Body::kMargin_px,
               body.where.width + 2 * reach_px, body.where.height + 2 * reach_px) &
      cv::Rect({}, image.size());
  const cv::Matx23d move(1, 0, shown.x + Body::kMargin_px - shake.shift_px.x,  //
                         0, 1, shown.y + Body::kMargin_px - shake.shift_px.y);
  cv::Mat moved;
  cv::warpAffine(body.paint, moved, move, shown.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  const double sigma_px = 0.12 * image.cols;
  const std::vector<float> across = bell(shown.x, shown.width, shake.gloss_px.x, sigma_px);
  const std::vector<float> down = bell(shown.y, shown.height, shake.gloss_px.y, sigma_px);
  for (int y = 0; y < shown.height; ++y)
    blend_row(image.ptr<cv::Vec3b>(shown.y + y) + shown.x, moved.ptr<cv::Vec4b>(y), shown.width,
              static_cast<float>(shake.light), across.data(),
              static_cast<float>(shake.gloss_codes) * down[static_cast<std::size_t>(y)]);
}

void draw_over(cv::Mat& image, const Propeller& propeller, int frame) {
  if (propeller.radius <= 0) return;
  constexpr double kTurnAFrame_rad = 2.4, kCover = 0.42;
  const double radius_px = propeller.radius * image.cols;
  const cv::Point2d middle_px(propeller.middle.x * image.cols, propeller.middle.y * image.rows);
  const cv::Rect disc = cv::Rect(cvFloor(middle_px.x - radius_px) - 4, cvFloor(middle_px.y - radius_px) - 4,
                                 cvCeil(2 * radius_px) + 9, cvCeil(2 * radius_px) + 9) &
                        cv::Rect({}, image.size());
  cv::Mat cover = cv::Mat::zeros(disc.size(), CV_8UC1);
  const cv::Point2d middle_of_disc = middle_px - cv::Point2d(disc.tl());
  for (int blade = 0; blade < propeller.blades; ++blade) {
    const double angle = kTurnAFrame_rad * frame + 2 * std::numbers::pi * blade / propeller.blades;
    cv::fillConvexPoly(cover, trace(middle_of_disc, radius_px, angle, kDrawingShift), cv::Scalar(255 * kCover),
                       cv::LINE_AA, kDrawingShift);
  }
  cv::blur(cover, cover, {5, 5});
  for (int y = 0; y < disc.height; ++y)
    for (int x = 0; x < disc.width; ++x)
      for (int k = 0; k < 3; ++k) {
        uchar& code = image.at<cv::Vec3b>(disc.y + y, disc.x + x)[k];
        code = cv::saturate_cast<uchar>(code + (46 - code) * (cover.at<uchar>(y, x) / 255.0));
      }
}

}  // namespace sigs::flights
