// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

// A plate 20.67 m square across the axis of Scenario's camera at 200 m, f = 300 px: 31 px square around (159.5, 119.5),
// so its edges cut the middle of pixels 144 and 175, 104 and 135.
constexpr double kHalfPlate_m = 15.5 * 200 / 300;
const cv::Rect kPlateBox(144, 104, 32, 32);

// At an edge 31 px long, drawing with 16 samples a pixel is right to some 1/16 px.
constexpr double kEdge = 0.0625 / 31;

void write_plate(const Scenario& scenario, const char* name, const glm::dvec2& low_m, const glm::dvec2& high_m) {
  write_obj(scenario.path(name), {{{-1e-4, low_m.x, low_m.y}, {1e-4, high_m.x, high_m.y}}}, 1);
}

void add_plate(Scenario& scenario) {
  write_plate(scenario, "plate.obj", glm::dvec2(-kHalfPlate_m), glm::dvec2(kHalfPlate_m));
  scenario.add("plate.obj", {200, 0, -150});
}

// White from column `from` on to the right.
cv::Mat white_right_of(int from, cv::Size size, int type) {
  cv::Mat mask = cv::Mat::zeros(size, type);
  mask.colRange(from, size.width).setTo(type == CV_16UC1 ? 65535 : 255);
  return mask;
}

ComposedFrame with_body(Scenario& scenario, const cv::Mat& mask, const Frame& background) {
  cv::imwrite(scenario.path("body.png").string(), mask);
  scenario.project.footage.own_body_mask = "body.png";
  return composed(scenario.opened(), 1, background);
}

}  // namespace

TEST_CASE("a nearer intruder hides a farther one whichever is named first") {
  for (const bool near_first : {true, false}) {
    CAPTURE(near_first);
    Scenario scenario;
    write_plate(scenario, "wall.obj", {0.5 * 100 / 300, -30}, {40, 30});
    if (near_first) scenario.add("wall.obj", {100, 0, -150});
    add_plate(scenario);
    if (!near_first) scenario.add("wall.obj", {100, 0, -150});
    const ComposedFrame frame = composed(scenario);
    REQUIRE(frame.truth.intruders.size() == 2);
    const IntruderTruth& plate = frame.truth.intruders[near_first ? 1 : 0];
    const IntruderTruth& wall = frame.truth.intruders[near_first ? 0 : 1];
    CHECK(plate.id == (near_first ? 1 : 0));
    // The wall's left edge lies at column 160.0: it hides the plate from there on.
    CHECK(std::abs(plate.visible_fraction - 16.0 / 31) < 2 * kEdge);
    CHECK(plate.visible_box == cv::Rect(kPlateBox.x, kPlateBox.y, 17, kPlateBox.height));
    CHECK(wall.visible_fraction == doctest::Approx(1.0));
    REQUIRE(plate.amodal_box);
    CHECK(plate.amodal_box->width == doctest::Approx(31).epsilon(1e-4));
    CHECK(plate.in_image);
  }
}

TEST_CASE("an intruder wholly behind another is in the image and not visible") {
  Scenario scenario;
  write_plate(scenario, "wall.obj", {-30, -30}, {30, 30});
  add_plate(scenario);
  scenario.add("wall.obj", {100, 0, -150});
  const IntruderTruth plate = composed(scenario).truth.intruders.front();
  CHECK(plate.in_image);
  CHECK(plate.visible_fraction == 0);
  CHECK(!plate.visible_box);
  CHECK(plate.amodal_box);
}

TEST_CASE("the own body hides its part of an intruder from image and mask and truth") {
  Scenario scenario;
  add_plate(scenario);
  const Frame background = grainy_frame(scenario.size_px(), 1);
  const ComposedFrame frame = with_body(scenario, white_right_of(160, scenario.size_px(), CV_8UC1), background);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(std::abs(truth.visible_fraction - 0.5) < 2 * kEdge);
  CHECK(truth.visible_box == cv::Rect(kPlateBox.x, kPlateBox.y, 16, kPlateBox.height));
  CHECK(truth.visible_pixels == 16 * kPlateBox.height);
  CHECK(cv::countNonZero(truth.visible) == truth.visible_pixels);
  CHECK(truth.visible.size() == truth.visible_box->size());
  CHECK(cv::countNonZero(frame.mask.colRange(160, 320)) == 0);
  CHECK(frame.mask.at<uchar>(120, 150) == 255);
  CHECK(same_bytes(frame.image.planes[0].colRange(160, 320), background.planes[0].colRange(160, 320)));
  // The chroma sample that lies on column 160 has a quarter of its weight on column 159, which is covered.
  CHECK(same_bytes(frame.image.planes[1].colRange(81, 160), background.planes[1].colRange(81, 160)));
  CHECK(!same_bytes(frame.image.planes[0], background.planes[0]));
}

TEST_CASE("an intruder wholly behind the own body leaves the image unchanged") {
  Scenario scenario;
  add_plate(scenario);
  const Frame background = grainy_frame(scenario.size_px(), 1);
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain}) {
    CAPTURE(static_cast<int>(method));
    scenario.project.compositing.method = method;
    scenario.project.compositing.blur_px_per_m = 0.005;
    const ComposedFrame frame = with_body(scenario, white_right_of(0, scenario.size_px(), CV_8UC1), background);
    const IntruderTruth& truth = frame.truth.intruders.front();
    CHECK(truth.in_image);
    CHECK(truth.visible_fraction == 0);
    CHECK(!truth.visible_box);
    CHECK(truth.amodal_box);
    CHECK(box_of(frame.mask).empty());
    CHECK(same_planes(frame.image, background));
  }
}

TEST_CASE("the own body's mask occludes alike in 8 and 16 bits and in colour") {
  Scenario scenario;
  add_plate(scenario);
  const Frame background = grainy_frame(scenario.size_px(), 1);
  cv::Mat eight = white_right_of(165, scenario.size_px(), CV_8UC1);
  eight.colRange(150, 165).setTo(77);
  cv::Mat sixteen;
  eight.convertTo(sixteen, CV_16U, 257);
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>{eight, eight, eight}, colour);
  const ComposedFrame a = with_body(scenario, eight, background);
  const ComposedFrame b = with_body(scenario, sixteen, background);
  const ComposedFrame c = with_body(scenario, colour, background);
  CHECK(same_planes(a.image, b.image));
  CHECK(same_bytes(a.mask, b.mask));
  CHECK(same_planes(a.image, c.image));
  CHECK(same_bytes(a.mask, c.mask));
}

TEST_CASE("a soft edge of the own body's mask lets its share through") {
  Scenario scenario;
  add_plate(scenario);
  const Frame background = even_frame(scenario.size_px(), 60);
  cv::Mat soft = cv::Mat::zeros(scenario.size_px(), CV_8UC1);
  for (int x = 150; x < 170; ++x) soft.col(x).setTo(12 * (x - 150));
  const ComposedFrame frame = with_body(scenario, soft, background);
  for (int x = 151; x < 170; ++x) {
    const double through = 1 - 12 * (x - 150) / 255.0;
    CHECK(std::abs(frame.mask.at<uchar>(120, x) - 255 * through) < 0.51);
    // Less and less of the bright plate before the dark sky.
    CHECK(frame.image.planes[0].at<uchar>(120, x) <= frame.image.planes[0].at<uchar>(120, x - 1));
  }
  double sum = 0;
  for (int x = 144; x <= 175; ++x)
    sum += (x == 144 || x == 175 ? 0.5 : 1) * (1 - (x >= 150 && x < 170 ? 12 * (x - 150) / 255.0 : 0));
  CHECK(std::abs(frame.truth.intruders.front().visible_fraction - sum / 31) < 2 * kEdge);
}

TEST_CASE("an intruder half or three quarters outside the image is visible by the rest") {
  // The plate's centre lies on the image's right edge, 160 px from the axis, or on its lower right corner.
  struct Case {
    glm::dvec3 position_m;
    double fraction;
  };
  const Case cases[] = {{{200, 160 / 1.5, -150}, 0.5},
                        {{200, 0, -150 - 120 / 1.5}, 0.5},
                        {{200, -160 / 1.5, -150 + 120 / 1.5}, 0.25},
                        {{200, 160 / 1.5 + 11.4, -150}, 0},
                        {{200, 160 / 1.5 - 11.4, -150}, 1}};
  for (const Case& c : cases) {
    CAPTURE(c.position_m.y);
    CAPTURE(c.position_m.z);
    Scenario scenario;
    add_plate(scenario);
    scenario.project.intruders.front().trajectory.waypoints.front().position_m = c.position_m;
    const IntruderTruth truth = composed(scenario).truth.intruders.front();
    CHECK(std::abs(truth.visible_fraction - c.fraction) < 2 * kEdge);
    CHECK(truth.in_image == (c.fraction > 0));
    CHECK(truth.visible_box.has_value() == (c.fraction > 0));
    REQUIRE(truth.amodal_box);
    CHECK(truth.amodal_box->width == doctest::Approx(31).epsilon(1e-4));
  }
}

TEST_CASE("a large intruder far outside the image is visible by the share that the image holds") {
  // A wall of 60 by 40 m at 20 m: 900 by 600 px around the axis, of which the image holds 320 by 240.
  Scenario scenario;
  write_plate(scenario, "wall.obj", {-30, -20}, {30, 20});
  scenario.add("wall.obj", {20, 0, -150});
  const ComposedFrame frame = composed(scenario);
  const IntruderTruth& truth = frame.truth.intruders.front();
  CHECK(truth.visible_fraction == doctest::Approx(320.0 * 240 / (900 * 600)).epsilon(0.02));  // 256 steps across
  CHECK(truth.visible_box == cv::Rect({0, 0}, scenario.size_px()));
  CHECK(cv::countNonZero(frame.mask == 255) == scenario.size_px().area());
}

}  // namespace sigs::test
