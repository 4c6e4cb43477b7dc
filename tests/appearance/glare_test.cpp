// SPDX-License-Identifier: MIT
#include "appearance/glare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/transfer.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

struct Lamps {
  double core_px = 0.7, share = 0.05, sigma_px = 6;
  double dimmest = 2, brightest = 20;  // linear light, the sum over all pixels
  double noise_codes = 1;
  double sky = 0.002;  // linear light
  int count = 40;
};

// What a Gaussian around a place leaves in a pixel, by the error function.
double in_pixel(double center, double sigma, int n) {
  const auto below = [&](double edge) { return 0.5 * std::erfc((center - edge) / (sigma * std::numbers::sqrt2)); };
  return below(n + 0.5) - below(n - 0.5);
}

// Lamps on a grid, none beside another, at parts of pixels; gray, 8 bits, full range.
Frame night(const Lamps& lamps, int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat light(800, 1000, CV_64FC1, cv::Scalar(lamps.sky));
  for (int i = 0; i < lamps.count; ++i) {
    const cv::Point2d at(100 + i % 8 * 110 + random.uniform(-2.0, 2.0), 100 + i / 8 * 130 + random.uniform(-2.0, 2.0));
    const double all = lamps.dimmest * std::pow(lamps.brightest / lamps.dimmest, random.uniform(0.0, 1.0));
    for (const auto& [part, sigma] : {std::pair(1 - lamps.share, lamps.core_px), {lamps.share, lamps.sigma_px}})
      for (int y = static_cast<int>(at.y) - 45; y <= static_cast<int>(at.y) + 45; ++y)
        for (int x = static_cast<int>(at.x) - 45; x <= static_cast<int>(at.x) + 45; ++x)
          light.at<double>(y, x) += all * part * in_pixel(at.x, sigma, x) * in_pixel(at.y, sigma, y);
  }
  Frame frame;
  frame.layout = PixelLayout::gray;
  frame.color.range = ColorRange::full;
  frame.planes[0] = cv::Mat(light.size(), CV_8UC1);
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x)
      frame.planes[0].at<uchar>(y, x) = cv::saturate_cast<uchar>(
          255 * display_of_linear(static_cast<float>(light.at<double>(y, x))) + random.gaussian(lamps.noise_codes));
  return frame;
}

GlareFound found_in(const Lamps& lamps) {
  Glare glare;
  for (int seed = 1; seed <= 3; ++seed) glare.add(night(lamps, seed));
  return glare.finish();
}

}  // namespace

TEST_CASE("the glare of a lens is found by lamps in the dark") {
  for (const Lamps& lamps :
       {Lamps{}, Lamps{.share = 0.15, .sigma_px = 4}, Lamps{.core_px = 1.2, .share = 0.1, .sigma_px = 10}}) {
    const GlareFound found = found_in(lamps);
    REQUIRE_MESSAGE(found.sigma_px.is_known, found.sigma_px.why);
    REQUIRE_MESSAGE(found.share.is_known, found.share.why);
    CHECK(found.sigma_px.value == doctest::Approx(lamps.sigma_px).epsilon(0.15));
    CHECK(found.share.value == doctest::Approx(lamps.share).epsilon(0.25));
  }
}

TEST_CASE("lamps without glare have none") {
  const GlareFound found = found_in({.share = 0});
  CHECK_FALSE(found.share.is_known);
  CHECK(found.share.value == AppearanceSettings{}.glare);
}

TEST_CASE("lamps that are clipped to discs tell how wide the glare is") {
  const GlareFound found = found_in({.core_px = 1, .share = 0.08, .sigma_px = 6, .dimmest = 300, .brightest = 3000});
  REQUIRE_MESSAGE(found.sigma_px.is_known, found.sigma_px.why);
  CHECK(found.sigma_px.value == doctest::Approx(6).epsilon(0.15));
}

TEST_CASE("by day, without lamps and behind the own body no glare is looked for") {
  Glare day;
  day.add(night({.sky = 0.3}, 1));
  CHECK_FALSE(day.has_dark_frames());
  CHECK_FALSE(day.finish().share.is_known);
  CHECK(found_in({.count = 0}).share.why == "no bright points that stand alone");
  Glare hidden;
  const Frame frame = night({}, 1);
  hidden.add(frame, cv::Mat(frame.planes[0].size(), CV_8UC1, cv::Scalar(255)));
  CHECK_FALSE(hidden.finish().sigma_px.is_known);
}
