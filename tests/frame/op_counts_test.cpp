// SPDX-License-Identifier: MIT
#include "frame/composed_frame.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

constexpr double kRadius_m = 5;
const cv::Size kSize(640, 480);

std::string text(const OpCounts& counts) {
  return "lens " + std::to_string(counts.lens_evaluations) + ", drawn " + std::to_string(counts.pixels_drawn) +
         ", triangles " + std::to_string(counts.triangles_drawn) + ", bytes " + std::to_string(counts.bytes_uploaded) +
         ", warped " + std::to_string(counts.pixels_warped) + ", blurred " + std::to_string(counts.pixels_blurred) +
         ", blended " + std::to_string(counts.pixels_blended) + ", converted " +
         std::to_string(counts.pixels_converted) + ", coded " + std::to_string(counts.pixels_coded);
}

enum class Glass { pinhole, distorting };

// The same lens before images of any size: its centre stays where it is from the upper left corner.
void put_lens(Scenario& scenario, Glass glass) {
  const std::vector<double> coefficients =
      glass == Glass::distorting ? std::vector<double>{-0.2, 0.05, 0.001, -0.001, 0} : std::vector<double>(5, 0.0);
  write_calibration(scenario.path("lens.xml"), {Scenario::kFocal_px, 0, 319.5, 0, Scenario::kFocal_px, 239.5, 0, 0, 1},
                    coefficients, scenario.size_px());
  scenario.project.footage.calibration = "lens.xml";
}

double distance_for(double diameter_px) {
  return Scenario::kFocal_px * 2 * kRadius_m / diameter_px;
}

// A ball of so many pixels across, somewhat right of the axis.
struct Ball {
  double diameter_px = 60;
  double sigma_px = 0;
  Glass glass = Glass::distorting;
  MethodChoice method = MethodChoice::direct;
};

IntruderSettings& add_ball(Scenario& scenario, const glm::dvec3& position_m) {
  write_sphere_obj(scenario.path("ball.obj"), kRadius_m);
  return scenario.add("ball.obj", position_m);
}

Scene scene_of(Scenario& scenario, const Ball& ball) {
  put_lens(scenario, ball.glass);
  const glm::dvec3 from_camera = glm::normalize(glm::dvec3(1, 0.15, 0.05)) * distance_for(ball.diameter_px);
  add_ball(scenario, glm::dvec3(0, 0, -150) + from_camera);
  scenario.project.compositing.method = ball.method;
  scenario.project.compositing.blur_px_per_m = ball.sigma_px / distance_for(ball.diameter_px);
  return scenario.opened();
}

ComposedFrame made(const Scene& scene, int frame, ComposeContext& context) {
  Result<ComposedFrame> composed = compose_frame(scene, frame, even_frame(scene.footage.size_px, 100), context);
  if (!composed) FAIL(composed.error().text());
  return std::move(*composed);
}

ComposedFrame made(const Ball& ball, cv::Size size_px = kSize) {
  Scenario scenario(size_px);
  ComposeContext context;
  return made(scene_of(scenario, ball), 0, context);
}

}  // namespace

TEST_CASE("operation counts add up field by field") {
  const OpCounts one{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  OpCounts sum{10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110};
  sum += one;
  CHECK(sum == OpCounts{11, 22, 33, 44, 55, 66, 77, 88, 99, 110, 121});
}

TEST_CASE("for an intruder out of view only its position is computed") {
  const std::pair<const char*, glm::dvec3> places[] = {{"behind", {-300, 20, -140}},
                                                       {"beside", {100, 900, -150}},
                                                       {"above", {100, 0, -900}},
                                                       {"far behind", {-1e5, 0, -150}},
                                                       {"at 85 degrees", {50, 600, -150}}};
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain})
    for (const Glass glass : {Glass::pinhole, Glass::distorting})
      for (const auto& [label, place] : places) {
        const std::string name = label;
        CAPTURE(static_cast<int>(method));
        CAPTURE(name);
        Scenario scenario(kSize);
        put_lens(scenario, glass);
        add_ball(scenario, place);
        scenario.project.compositing.method = method;
        const Scene scene = scenario.opened();
        ComposeContext context;
        const ComposedFrame frame = made(scene, 0, context);
        CAPTURE(text(frame.op_counts));
        // The annotation covers intruders outside the image too: at most one evaluation for each of its points.
        const auto points = static_cast<std::int64_t>(scene.intruders[0].model->points_m.size());
        CHECK(frame.op_counts.lens_evaluations <= (glass == Glass::distorting ? points : 0));
        OpCounts rest = frame.op_counts;
        rest.lens_evaluations = 0;
        CHECK(rest == OpCounts{});
        CHECK(context.renderer_description() == "");
        CHECK(frame.mask.empty());
      }
}

TEST_CASE("a pinhole lens is never evaluated") {
  for (const double sigma_px : {0.0, 2.0}) {
    const OpCounts straight = made({.sigma_px = sigma_px, .glass = Glass::pinhole}).op_counts;
    CHECK(straight.lens_evaluations == 0);
    CHECK(straight.pixels_blended > 1000);
    CHECK(made({.sigma_px = sigma_px, .glass = Glass::distorting}).op_counts.lens_evaluations > 0);
    // `plain` knows no lens.
    CHECK(made({.glass = Glass::distorting, .method = MethodChoice::plain}).op_counts.lens_evaluations == 0);
  }
}

TEST_CASE("where there is no blur no pixel is blurred") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic}) {
    CHECK(made({.sigma_px = 0, .method = method}).op_counts.pixels_blurred == 0);
    CHECK(made({.sigma_px = 0.3, .method = method}).op_counts.pixels_blurred > 1000);
  }
  CHECK(made({.sigma_px = 2, .method = MethodChoice::plain}).op_counts.pixels_blurred == 0);
}

TEST_CASE("the direct method converts no whole image and the others one for each intruder") {
  for (const double sigma_px : {0.0, 2.0, 20.0}) CHECK(made({.sigma_px = sigma_px}).op_counts.pixels_converted == 0);
  CHECK(made({.method = MethodChoice::classic}).op_counts.pixels_converted == kSize.area());
  CHECK(made({.method = MethodChoice::plain}).op_counts.pixels_converted == kSize.area());
}

TEST_CASE("the pixels that are rewritten are those of the mask") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain})
    for (const double sigma_px : {0.0, 2.0}) {
      CAPTURE(static_cast<int>(method));
      const ComposedFrame frame = made({.sigma_px = sigma_px, .method = method});
      CHECK(frame.op_counts.pixels_blended == cv::countNonZero(frame.mask));
    }
}

TEST_CASE("the work is proportional to the intruder's pixels") {
  for (const Glass glass : {Glass::pinhole, Glass::distorting})
    for (const double diameter_px : {20.0, 40.0, 80.0, 160.0}) {
      CAPTURE(diameter_px);
      const ComposedFrame sharp = made({.diameter_px = diameter_px, .glass = glass});
      CAPTURE(text(sharp.op_counts));
      const double pixels = cv::countNonZero(sharp.mask);
      REQUIRE(pixels > 0.7 * diameter_px * diameter_px);
      // The box around a disk, 4 / pi, and a pixel on each side of it.
      const double box = 4 / 3.14159265 * pixels;
      const auto warped = static_cast<double>(sharp.op_counts.pixels_warped);
      CHECK(warped >= box);
      CHECK(warped <= 1.1 * std::pow(std::sqrt(box) + 2, 2));
      const ComposedFrame blurry = made({.diameter_px = diameter_px, .sigma_px = 2, .glass = glass});
      CAPTURE(text(blurry.op_counts));
      const auto blurred = static_cast<double>(blurry.op_counts.pixels_blurred);
      CHECK(blurred > warped);
      CHECK(blurred <= 1.1 * std::pow(std::sqrt(box) + 2 + 2 * 6, 2));  // three sigmas more on each side
      CHECK(blurry.op_counts.pixels_warped == sharp.op_counts.pixels_warped);
    }
}

TEST_CASE("the lens is evaluated for the intruder's points and at its place, not for each of its pixels") {
  for (const double diameter_px : {20.0, 40.0, 80.0, 160.0}) {
    CAPTURE(diameter_px);
    Scenario scenario(kSize);
    const Scene scene = scene_of(scenario, {.diameter_px = diameter_px});
    ComposeContext context;
    const ComposedFrame frame = made(scene, 0, context);
    CAPTURE(text(frame.op_counts));
    // Of the points only groups at the outline are asked, or all and a middle for each group.
    const auto points = static_cast<double>(scene.intruders[0].model->points_m.size());
    const auto asked = static_cast<double>(frame.op_counts.lens_evaluations);
    CHECK(asked >= 4);
    // A few hundred to choose the view; exact rays would need one for each pixel corner, tables need some 1 in 30.
    CHECK(asked <= 1.25 * points + 600 + 0.15 * static_cast<double>(frame.op_counts.pixels_warped));
  }
}

TEST_CASE("the work does not depend on the size of the image") {
  for (const Glass glass : {Glass::pinhole, Glass::distorting})
    for (const auto& [diameter_px, sigma_px] : {std::pair(20.0, 2.0), std::pair(160.0, 0.0)}) {
      const Ball ball{.diameter_px = diameter_px, .sigma_px = sigma_px, .glass = glass};
      const OpCounts small = made(ball, {640, 480}).op_counts;
      const OpCounts large = made(ball, {2560, 1920}).op_counts;
      CAPTURE(text(small));
      CAPTURE(text(large));
      CHECK(small == large);
      CHECK(small.pixels_blended > 0);
    }
}

TEST_CASE("the lens is evaluated again only where the intruder has moved to") {
  Scenario scenario(kSize);
  put_lens(scenario, Glass::distorting);
  // 200 px to the right in two frames.
  add_ball(scenario, {}).trajectory.waypoints = {{.frame = 0, .position_m = {50, -16, -150}},
                                                 {.frame = 2, .position_m = {50, 17, -150}}};
  scenario.project.compositing.blur_px_per_m = 0;
  const Scene scene = scenario.opened();
  ComposeContext context;
  std::vector<OpCounts> first;
  for (const int n : {0, 1, 2}) first.push_back(made(scene, n, context).op_counts);
  for (const int n : {0, 1, 2}) {
    CAPTURE(n);
    const OpCounts again = made(scene, n, context).op_counts;
    CAPTURE(text(first[static_cast<std::size_t>(n)]));
    CAPTURE(text(again));
    CHECK(again.lens_evaluations < first[static_cast<std::size_t>(n)].lens_evaluations);
    CHECK(again.pixels_warped == first[static_cast<std::size_t>(n)].pixels_warped);
    CHECK(made(scene, n, context).op_counts == again);
    ComposeContext fresh;
    CHECK(made(scene, n, fresh).op_counts.lens_evaluations >= first[static_cast<std::size_t>(n)].lens_evaluations);
  }
}

TEST_CASE("the rendered region is the box around the intruder and grows with it") {
  for (const double diameter_px : {20.0, 40.0, 80.0, 160.0}) {
    CAPTURE(diameter_px);
    const OpCounts counts = made({.diameter_px = diameter_px}).op_counts;
    CAPTURE(text(counts));
    // Supersampling 3, and the box's near side as perspective shows it. Small ones are drawn up to some 195 px large.
    const double near_px = Scenario::kFocal_px * 2 * kRadius_m / (distance_for(diameter_px) - kRadius_m);
    const double side_px = std::max(3 * near_px, 195.0);
    CHECK(counts.pixels_drawn >= 4 * 3.14159265 / 4 * diameter_px * diameter_px);
    CHECK(counts.pixels_drawn <= 1.3 * side_px * side_px);
    CHECK(counts.triangles_drawn > 100);
    CHECK(counts.triangles_drawn <= 2 * 24 * 48);
  }
}

TEST_CASE("a ball too near for one view is rendered only within the image and at the needed resolution") {
  const OpCounts counts = made({.diameter_px = 320}).op_counts;  // its middle is not two radii away
  CAPTURE(text(counts));
  // Supersampling 3 is 9 drawn pixels a pixel; faces of a cube are finer than needed towards their edges, and cut by a
  // grid.
  CHECK(counts.pixels_drawn >= 9 * counts.pixels_warped / 2);
  CHECK(counts.pixels_drawn <= 4 * 9 * counts.pixels_warped);
}

TEST_CASE("a mesh is uploaded once") {
  Scenario scenario(kSize);
  const Scene scene = scene_of(scenario, {});
  ComposeContext context;
  CHECK(made(scene, 0, context).op_counts.bytes_uploaded > 24 * 48 * 12);  // at the least its vertices
  for (const int n : {1, 2, 0}) CHECK(made(scene, n, context).op_counts.bytes_uploaded == 0);
}

}  // namespace sigs::test
