// SPDX-License-Identifier: MIT
#include "flights/reflection.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "flights/random.h"

namespace sigs::flights {

namespace {

constexpr double kVeil = 0.2;  // of the codes: the reflection between the objects

cv::Scalar tint(double codes, int thing, std::uint32_t seed) {
  const auto channel = [&](int c) { return codes * (0.85 + 0.15 * random_share(thing, 20 + c, seed)); };
  return {channel(0), channel(1), channel(2)};
}

// A turned rectangle or an ellipse somewhere in the box.
void draw_thing(cv::Mat& image, const cv::Rect2d& box_px, int thing, const Reflection& reflection) {
  const auto dice = [&](int what) { return random_share(thing, what, reflection.seed); };
  const cv::Point2f middle(static_cast<float>(box_px.x + dice(1) * box_px.width),
                           static_cast<float>(box_px.y + dice(2) * box_px.height));
  const cv::Size2f size(static_cast<float>((0.03 + 0.3 * dice(3)) * image.cols),
                        static_cast<float>((0.01 + 0.12 * dice(4)) * image.rows));
  const cv::RotatedRect place(middle, size, static_cast<float>(50 * (dice(5) - 0.5)));
  const cv::Scalar color = tint(reflection.codes * (0.3 + 0.7 * dice(6)), thing, reflection.seed);
  if (dice(7) < 0.35) {
    cv::ellipse(image, place, color, cv::FILLED);
    return;
  }
  cv::Point2f corners[4];
  place.points(corners);
  const std::vector<cv::Point> outline(corners, corners + 4);
  cv::fillConvexPoly(image, outline, color);
}

// 1 within the box, falling to 0 at its edges that lie in the image.
cv::Mat fading(const cv::Rect2d& box_px, cv::Size size_px) {
  cv::Mat share = cv::Mat::zeros(size_px, CV_32FC1);
  const cv::Rect inside =
      cv::Rect(cvRound(box_px.x), cvRound(box_px.y), cvRound(box_px.width), cvRound(box_px.height)) &
      cv::Rect({}, size_px);
  share(inside).setTo(1);
  cv::GaussianBlur(share, share, {}, 0.03 * size_px.width, 0, cv::BORDER_REPLICATE);
  return share;
}

}  // namespace

cv::Mat painted(const Reflection& reflection, cv::Size size_px) {
  if (reflection.codes <= 0) return {};
  const cv::Rect2d box_px(reflection.where.x * size_px.width, reflection.where.y * size_px.height,
                          reflection.where.width * size_px.width, reflection.where.height * size_px.height);
  cv::Mat image(size_px, CV_8UC3, tint(reflection.codes * kVeil, 0, reflection.seed));
  for (int thing = 1; thing <= reflection.things; ++thing) draw_thing(image, box_px, thing, reflection);
  cv::GaussianBlur(image, image, {}, reflection.blur_px * size_px.width / 640);
  cv::Mat share;
  cv::cvtColor(fading(box_px, size_px), share, cv::COLOR_GRAY2BGR);
  cv::Mat light;
  image.convertTo(light, CV_32FC3);
  cv::Mat(light.mul(share)).convertTo(image, CV_8UC3);
  return image;
}

void add_to(cv::Mat& image, const cv::Mat& painted, const Reflection& reflection, int frame) {
  if (painted.empty()) return;
  cv::Mat moved = painted;
  const double shift_px = reflection.creep_px * frame / 100 * image.cols / 640;
  if (shift_px != 0)
    cv::warpAffine(painted, moved, cv::Matx23d(1, 0, shift_px, 0, 1, 0), image.size(), cv::INTER_LINEAR,
                   cv::BORDER_REPLICATE);
  image += moved;
}

}  // namespace sigs::flights
