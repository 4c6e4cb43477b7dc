// SPDX-License-Identifier: MIT
#include "appearance/point_spread.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "appearance/slanted_target.h"

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

}  // namespace

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

TEST_CASE("sharpening of a slanted-edge target is told apart from its blur") {
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

TEST_CASE("chroma spread beyond luma's is found in samples of the chroma planes") {
  for (const double sigma : {0.6, 1.2, 2.0}) {
    const PointSpreadFound found = spread_of_target({.sigma_px = 0.8, .chroma_sigma = sigma});
    CAPTURE(sigma);
    CAPTURE(found.chroma_spread_px.value);
    REQUIRE_MESSAGE(found.chroma_spread_px.is_known, found.chroma_spread_px.why);
    // Averaging two rows and 1 2 1 columns widens chroma by up to sqrt(1/8) of its samples besides.
    CHECK(std::abs(found.chroma_spread_px.value - sigma) < 0.1 * sigma + 0.06);
  }
}
