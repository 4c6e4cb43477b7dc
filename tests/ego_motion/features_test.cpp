// SPDX-License-Identifier: MIT
#include "ego_motion/features.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace sigs {

namespace {

const cv::Size kSeen_px(480, 360);

// Rough ground of all scales, larger than what is seen of it and finer than its pixels.
cv::Mat ground_texture() {
  cv::RNG random(7);
  cv::Mat_<float> sum(1080, 1440, 0.0F);
  for (const double sigma_px : {2.0, 5.0, 12.0}) {
    cv::Mat_<float> noise(sum.size());
    random.fill(noise, cv::RNG::NORMAL, 0, 1);
    cv::GaussianBlur(noise, noise, {}, sigma_px);
    sum += noise * sigma_px;
  }
  cv::normalize(sum, sum, 20, 235, cv::NORM_MINMAX);
  return sum;
}

// The matrix that takes a place seen at the start to where it is seen after growing and turning about the middle.
cv::Matx23d seen_from_start(double scale, double turn_rad) {
  const double c = scale * std::cos(turn_rad), s = scale * std::sin(turn_rad);
  const double x = kSeen_px.width / 2.0, y = kSeen_px.height / 2.0;
  return {c, -s, x - c * x + s * y, s, c, y - s * x - c * y};
}

// How far features have slid over what they show when the view has reached the scale and turn, root mean square, px.
// Only features that are as old as the footage count.
double slide_px(double last_scale, double last_turn_rad, int frames) {
  const cv::Mat texture = ground_texture();
  FeatureTracker tracker(kSeen_px, {}, {});
  std::map<int, cv::Point2f> first;
  std::vector<double> squares;
  for (int n = 0; n <= frames; ++n) {
    const double share = static_cast<double>(n) / frames;
    const cv::Matx23d seen = seen_from_start(std::pow(last_scale, share), last_turn_rad * share);
    // At the start one pixel spans two of the texture, around its middle.
    cv::Matx23d of_texture = seen;
    const cv::Vec2d shift(240, 180);
    for (int i = 0; i < 2; ++i) {
      of_texture(i, 2) -= (seen(i, 0) * shift[0] + seen(i, 1) * shift[1]) / 2;
      for (int j = 0; j < 2; ++j) of_texture(i, j) /= 2;
    }
    cv::Mat image;
    cv::warpAffine(texture, image, of_texture, kSeen_px, cv::INTER_CUBIC);
    image.convertTo(image, CV_8U);
    for (const Feature& feature : tracker.next(image)) {
      if (n == 0) first[feature.id] = feature.pixel_px;
      const auto start = first.find(feature.id);
      if (n < frames || start == first.end()) continue;
      const cv::Vec2d there = seen * cv::Vec3d(start->second.x, start->second.y, 1);
      squares.push_back(std::pow(feature.pixel_px.x - there[0], 2) + std::pow(feature.pixel_px.y - there[1], 2));
    }
  }
  REQUIRE(squares.size() > 30);
  std::sort(squares.begin(), squares.end());
  squares.resize(squares.size() * 9 / 10);  // the rest may have lost what they show
  double sum = 0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace

TEST_CASE("features stay on what they show while it grows to one and a half times its size or turns by 30 degrees") {
  // Windows that are taken to shift as a whole slide by 0.5 px and more.
  const double grown = slide_px(1.5, 0, 40);
  const double turned = slide_px(1, 0.52, 40);
  MESSAGE("slide: grown " << grown << " px, turned " << turned << " px");
  CHECK(grown < 0.25);
  CHECK(turned < 0.25);
}

TEST_CASE("features are followed in images of 4K, which are halved more than once") {
  cv::Mat texture, image;
  cv::resize(ground_texture(), texture, {}, 3, 3, cv::INTER_CUBIC);
  const cv::Size size_px(3840, 2160);
  FeatureTracker tracker(size_px, {}, {});
  std::map<int, cv::Point2f> first;
  int followed = 0;
  for (int n = 0; n < 4; ++n) {
    texture(cv::Rect(cv::Point(100 - 8 * n, 60), size_px)).convertTo(image, CV_8U);
    for (const Feature& feature : tracker.next(image)) {
      if (n == 0) first[feature.id] = feature.pixel_px;
      const auto start = first.find(feature.id);
      if (n < 3 || start == first.end()) continue;
      ++followed;
      // A tenth of a pixel of the image reduced to 640 px.
      CHECK(feature.pixel_px.x - start->second.x == doctest::Approx(24).epsilon(0.025));
    }
  }
  CHECK(followed > 100);
}

TEST_CASE(
    "the gradient of a displacement that is linear over the image is found, though one feature in ten is a pixel "
    "astray") {
  const cv::Matx22f gradient(0.03F, -0.02F, 0.01F, 0.04F);
  cv::RNG random(3);
  std::vector<cv::Point2f> from, to;
  for (int i = 0; i < 300; ++i) {
    const cv::Vec2f p(random.uniform(8.0F, 632.0F), random.uniform(8.0F, 472.0F));
    cv::Vec2f d = gradient * (p - cv::Vec2f(320, 240)) + cv::Vec2f(1, -2);
    if (i % 10 == 0) d += cv::Vec2f(0.8F, 0.6F);
    from.emplace_back(p[0], p[1]);
    to.emplace_back(p[0] + d[0], p[1] + d[1]);
  }
  // A window's gradients lie some 2 px off its middle, so that 0.01 is an error of 0.02 px.
  double largest = 0;
  for (const cv::Vec4f& found : displacement_gradients(from, to, {640, 480}))
    largest = std::max(largest, cv::norm(found - cv::Vec4f(0.03F, -0.02F, 0.01F, 0.04F)));
  CHECK(largest < 0.01);
  CHECK(displacement_gradients({}, {}, {640, 480}).empty());
}

}  // namespace sigs
