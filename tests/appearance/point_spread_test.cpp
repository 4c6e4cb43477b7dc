// SPDX-License-Identifier: MIT
#include "appearance/point_spread.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "appearance/slanted_target.h"
#include "support/test_data.h"
#include "video/frame_quantisers.h"
#include "video/frame_source.h"

using namespace sigs;
using namespace sigs::test;

namespace {

PointSpreadFound spread_of_target(TargetCamera camera, int frames = 2) {
  PointSpread estimator;
  for (int n = 0; n < frames; ++n) {
    camera.turn_deg = 1.7 * n;
    camera.seed = 1 + n;
    estimator.add(slanted_target(camera));
  }
  return estimator.finish();
}

// Quadrilaterals over a frame, turned at random, as roofs and fields are. Half of them have perfect edges, the others
// are softer by up to 1.5 px of their own.
void draw_objects(cv::Mat& image, cv::RNG& random) {
  constexpr int kFiner = 4;
  int n = 0;
  for (int y = 50; y < image.rows - 40; y += 78) {
    for (int x = 50; x < image.cols - 40; x += 78) {
      cv::Mat cover(76 * kFiner, 76 * kFiner, CV_8UC1, cv::Scalar(0));
      cv::Point2f corners[4];
      const auto side = static_cast<float>(random.uniform(44.0, 48.0) * kFiner);
      const cv::Point2f middle(38 * kFiner, 38 * kFiner);
      cv::RotatedRect(middle, {side, side}, static_cast<float>(random.uniform(0.0, 90.0))).points(corners);
      cv::fillConvexPoly(cover, std::vector<cv::Point>(corners, corners + 4), 255);
      cv::resize(cover, cover, {76, 76}, 0, 0, cv::INTER_AREA);
      cv::Mat share;
      cover.convertTo(share, CV_32F, 1 / 255.0);
      if (++n % 2 == 0) cv::GaussianBlur(share, share, {}, random.uniform(0.4, 1.5));
      // Onto an even patch: what lies below would be texture beside the edge.
      const double dark = random.uniform(60.0, 90.0), bright = dark + random.uniform(50.0, 90.0);
      cv::Mat(dark + share * (bright - dark)).copyTo(image(cv::Rect(x - 38, y - 38, 76, 76)));
    }
  }
}

// Frames of the synthetic sample at half size, with such objects over their lower part, then blurred by OpenCV.
PointSpreadFound spread_of_footage(double sigma_px) {
  Result<FrameSource> footage = FrameSource::open(source_dir() / "assets/footage/sample.mp4");
  REQUIRE(footage);
  PointSpread estimator;
  cv::RNG random(11);
  for (int n = 0; n < 3; ++n) {
    Frame frame = footage->read(5 * n).value();
    cv::Mat image;
    cv::resize(frame.planes[0], image, {640, 480}, 0, 0, cv::INTER_AREA);
    image.convertTo(image, CV_32F);
    cv::Mat land = image.rowRange(200, 480);
    draw_objects(land, random);
    cv::GaussianBlur(image, image, {}, sigma_px);
    cv::Mat noise(image.size(), CV_32FC1);
    random.fill(noise, cv::RNG::NORMAL, 0, 0.7);
    cv::Mat(image + noise).convertTo(frame.planes[0], CV_8U);
    for (const int plane : {1, 2})
      cv::resize(frame.planes[plane], frame.planes[plane], {320, 240}, 0, 0, cv::INTER_AREA);
    estimator.add(frame);
  }
  return estimator.finish();
}

}  // namespace

TEST_CASE("the blur of footage is found within 10 percent where half of its objects are softer by themselves") {
  for (const double sigma_px : {0.7, 1.0, 1.6}) {
    const PointSpreadFound found = spread_of_footage(sigma_px);
    CAPTURE(sigma_px);
    CAPTURE(found.edges_found);
    CAPTURE(found.edges_used);
    CAPTURE(found.sigma_px.value);
    CAPTURE(found.sigma_px.sd);
    REQUIRE_MESSAGE(found.sigma_px.is_known, found.sigma_px.why);
    CHECK(std::abs(found.sigma_px.value - sigma_px) < 0.1 * sigma_px);
    CHECK(found.sharpening.value < 0.1);
  }
}

TEST_CASE("the blur of a slanted-edge target is found within 3 percent") {
  for (const double sigma_px : {0.5, 0.8, 1.2, 2.0}) {
    const PointSpreadFound found = spread_of_target({.sigma_px = sigma_px, .noise = 0.7});
    CAPTURE(sigma_px);
    CAPTURE(found.sigma_px.value);
    CAPTURE(found.sigma_px.sd);
    CAPTURE(found.sharpening.value);
    REQUIRE_MESSAGE(found.sigma_px.is_known, found.sigma_px.why);
    CHECK(std::abs(found.sigma_px.value - sigma_px) < 0.03 * sigma_px);
    CHECK(found.sigma_px.sd < 0.1 * sigma_px);
  }
}

TEST_CASE("sharpening of a slanted-edge target is distinguished from its blur") {
  for (const double sharpening : {0.3, 0.8, 1.5}) {
    const PointSpreadFound found =
        spread_of_target({.sigma_px = 0.8, .sharpening = sharpening, .sharpening_px = 1.4, .noise = 0.7});
    CAPTURE(sharpening);
    CAPTURE(found.sharpening.value);
    CAPTURE(found.sharpening.sd);
    CAPTURE(found.sharpening_px.value);
    CAPTURE(found.sigma_px.value);
    CAPTURE(found.sigma_px.sd);
    REQUIRE_MESSAGE(found.sharpening.is_known, found.sharpening.why);
    CHECK(std::abs(found.sigma_px.value - 0.8) < 0.03 * 0.8);
    CHECK(std::abs(found.sharpening.value - sharpening) < 0.04 + 0.05 * sharpening);  // its sd is 0.04
    CHECK(std::abs(found.sharpening_px.value - 1.4) < 0.15 * 1.4);  // of weak sharpening, its width is less sure
  }
}

TEST_CASE("where no edge tells it, chroma of JPEG images is taken to be sharper than that of videos") {
  const auto taken = [](std::optional<QuantiserKind> kind) {
    const cv::Size size(64, 48), half(32, 24);
    Frame frame{.layout = PixelLayout::yuv420,
                .planes = {cv::Mat(size, CV_8UC1, 150), cv::Mat(half, CV_8UC1, 120), cv::Mat(half, CV_8UC1, 130)}};
    if (kind) frame.quantisers = std::make_shared<FrameQuantisers>(FrameQuantisers{.kind = *kind});
    PointSpread spread;
    spread.add(frame);
    const PointSpreadFound found = spread.finish();
    CHECK_FALSE(found.chroma_blur_px.is_known);
    return found.chroma_blur_px.value;
  };
  // Linear reading between samples 2 px apart: a triangle of variance 2 * 2 / 6 px^2; a sample of 4:2:0 is 2 px wide.
  CHECK(taken(QuantiserKind::jpeg) == doctest::Approx(std::sqrt(4 / 6.0) / 2).epsilon(0.03));
  CHECK(taken(QuantiserKind::h264) == 0.9);
  CHECK(taken(std::nullopt) == 0.9);
}

TEST_CASE("chroma blur beyond luma's is found in samples of the chroma planes") {
  for (const double sigma : {0.6, 1.2, 2.0}) {
    const PointSpreadFound found = spread_of_target({.sigma_px = 0.8, .chroma_sigma = sigma});
    CAPTURE(sigma);
    CAPTURE(found.chroma_blur_px.value);
    REQUIRE_MESSAGE(found.chroma_blur_px.is_known, found.chroma_blur_px.why);
    // Averaging two rows and 1 2 1 columns widens chroma by up to sqrt(1/8) of its samples besides.
    CHECK(std::abs(found.chroma_blur_px.value - sigma) < 0.1 * sigma + 0.06);
  }
}
