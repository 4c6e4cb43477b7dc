// SPDX-License-Identifier: MIT
#include "appearance/target_look.h"

#include <doctest/doctest.h>

using namespace sigs;

namespace {

// A bright sky in the upper half of the image, dark ground with a chessboard in the lower half.
Frame sky_and_ground() {
  Frame frame = blank_frame(PixelLayout::yuv420, {320, 240}, {});
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      frame.planes[0].at<uchar>(y, x) = static_cast<uchar>(y < 120 ? 180 : 60 + 30 * ((x / 4 + y / 4) % 2));
  return frame;
}

}  // namespace

TEST_CASE("beside a target in the sky there is sky, beside one on the ground there is ground") {
  const Frame frame = sky_and_ground();
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const auto in_sky = similar_place(frame, {40, 40, 30, 20}, {30, 20}, seed);
    REQUIRE(in_sky);
    CHECK(in_sky->y < 120 - 10);
    const auto on_ground = similar_place(frame, {40, 170, 30, 20}, {30, 20}, seed);
    REQUIRE(on_ground);
    CHECK(on_ground->y > 120 + 10);
  }
}

TEST_CASE("the place does not overlap the target and lies in the image with its surroundings") {
  const Frame frame = sky_and_ground();
  const Box box{150, 40, 30, 20};
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const auto place = similar_place(frame, box, {30, 20}, seed);
    REQUIRE(place);
    const bool is_beside = std::abs(place->x - 165) > 30 || std::abs(place->y - 50) > 20;
    CHECK(is_beside);
    CHECK(place->x >= 15 + 14 - 1);
    CHECK(place->x <= 320 - 15 - 14);
    CHECK(place->y >= 10 + 14 - 1);
    CHECK(place->y <= 240 - 10 - 14);
  }
}

TEST_CASE("where the target fills the image there is no other place") {
  CHECK_FALSE(similar_place(sky_and_ground(), {10, 10, 300, 220}, {300, 220}, 1).has_value());
  CHECK_FALSE(similar_place(sky_and_ground(), {40, 40, 30, 20}, {310, 20}, 1).has_value());
}
