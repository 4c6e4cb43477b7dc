// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "editor/geometry/rulers.h"
#include "tests/editor/geometry/cameras.h"

namespace sigs::editor {
namespace {

using test::kInfinity;
using test::kNan;

std::vector<TimeRuler> example_rulers() {
  std::vector<TimeRuler> rulers;
  for (double count = 4; count < 3e6; count *= 1.31)
    for (const double width : {37.0, 640.0, 2400.0}) rulers.push_back({80.25, width, count / 7, count});
  return rulers;
}

bool is_round_step(double step) {
  const double decade = std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  const double mantissa = step / decade;
  return mantissa == 1 || mantissa == 2 || mantissa == 5;
}

}  // namespace

TEST_CASE("frames and places on the strip are each other's inverse") {
  const TimeRuler ruler{100, 500, 50, 250};
  CHECK(ruler.x_of(50) == 100);
  CHECK(ruler.x_of(300) == 600);
  CHECK(ruler.x_of(175) == 350);
  for (const double frame : {-3.0, 50.5, 123.456, 1e7})
    CHECK(ruler.frame_at(ruler.x_of(frame)) == doctest::Approx(frame).epsilon(1e-12));
}

TEST_CASE("a frame owns its cell from the first pixel to the next frame's, at every zoom") {
  for (const TimeRuler& ruler : example_rulers())
    for (int i = 0; i < 40; ++i) {
      const int frame = static_cast<int>(std::ceil(ruler.first)) + static_cast<int>(i * ruler.count / 50);
      CHECK(ruler.nearest_frame(ruler.x_of(frame), 0, 10000000) == frame);
      CHECK(ruler.nearest_frame(std::nextafter(ruler.x_of(frame + 1), 0), 0, 10000000) == frame);
    }
}

TEST_CASE("the frame under the mouse is one of the footage's, wherever the mouse is") {
  const TimeRuler ruler{100, 500, 0, 250};
  CHECK(ruler.nearest_frame(-1e9, 3, 200) == 3);
  CHECK(ruler.nearest_frame(1e9, 3, 200) == 200);
  CHECK(ruler.nearest_frame(kInfinity, 3, 200) == 200);
  CHECK(ruler.nearest_frame(-kInfinity, 3, 200) == 3);
  CHECK(ruler.nearest_frame(kNan, 3, 200) == 3);
  CHECK(TimeRuler{100, 0, 7, 250}.nearest_frame(100, 0, 200) == 7);
}

TEST_CASE("zooming keeps the frame under the mouse where the footage's ends allow it") {
  const TimeRuler ruler{100, 500, 400, 200};
  for (const double factor : {0.7, 1.1, 3.0}) {
    const TimeRuler nearer = zoomed(ruler, factor, 333, 10000);
    CHECK(nearer.frame_at(333) == doctest::Approx(ruler.frame_at(333)).epsilon(1e-12));
    CHECK(nearer.count == doctest::Approx(200 / factor));
  }
}

TEST_CASE("zoom ends at four frames and at four thirds of the footage, and the footage stays in the strip") {
  for (const int frames : {1, 2, 3, 100, 1000000}) {
    const TimeRuler nearest = zoomed({0, 500, 0, 50}, 1e12, 499, frames);
    CHECK(nearest.count == 4);
    const TimeRuler farthest = zoomed({0, 500, 0, 50}, 1e-12, 499, frames);
    CHECK(farthest.count == doctest::Approx(std::max(4.0, frames * 4.0 / 3)));
    CHECK(farthest.first <= 0);
    CHECK(farthest.first + farthest.count >= frames);
    if (frames >= 4) CHECK(nearest.first >= 0);
    if (frames >= 4) CHECK(nearest.first + nearest.count <= frames);
  }
  CHECK(zoomed({0, 500, 10, 50}, kNan, 3, 100).count == 50);
  CHECK(zoomed({0, 500, 10, 50}, 2, kNan, 100).count == 50);
}

TEST_CASE("panning stops at the ends of the footage") {
  const TimeRuler ruler{0, 500, 10, 50};
  CHECK(panned(ruler, 5, 100).first == 15);
  CHECK(panned(ruler, 1e9, 100).first == 50);
  CHECK(panned(ruler, -1e9, 100).first == 0);
  CHECK(panned(ruler, kInfinity, 100).first == 50);
  CHECK(panned(ruler, kNan, 100).first == 10);
  CHECK(panned({0, 500, 0, 130}, 1e9, 100).first == 0);     // all of it in view,
  CHECK(panned({0, 500, 0, 130}, -1e9, 100).first == -30);  // wherever it lies
}

TEST_CASE("a frame is scrolled into view by the shortest way, with its whole cell") {
  const TimeRuler ruler{0, 500, 10, 50};
  CHECK(with_frame_in_sight(ruler, 10, 100).first == 10);
  CHECK(with_frame_in_sight(ruler, 59, 100).first == 10);
  CHECK(with_frame_in_sight(ruler, 60, 100).first == 11);
  CHECK(with_frame_in_sight(ruler, 9, 100).first == 9);
  CHECK(with_frame_in_sight(ruler, 99, 100).first == 50);
  CHECK(with_frame_in_sight(ruler, 1e9, 100).first == 50);
  CHECK(with_frame_in_sight(ruler, -5, 100).first == 0);
  CHECK(with_frame_in_sight(ruler, kNan, 100).first == 10);
}

TEST_CASE("ticks and labels keep their spacing at all zooms, and are no sparser than necessary") {
  for (const TimeRuler& ruler : example_rulers()) {
    const std::vector<Tick> all = ticks(ruler, 70);
    CAPTURE(ruler.count);
    CAPTURE(ruler.width);
    CHECK(all.size() <= ruler.width / 6 + 1);
    double last_label_x = -kInfinity;
    for (std::size_t i = 0; i < all.size(); ++i) {
      CHECK(all[i].frame == std::round(all[i].frame));
      CHECK(all[i].frame >= ruler.first);
      CHECK(all[i].frame <= ruler.first + ruler.count);
      if (i > 0) CHECK(ruler.x_of(all[i].frame) - ruler.x_of(all[i - 1].frame) >= 6 - 1e-6);
      if (i > 0) CHECK(is_round_step(all[i].frame - all[i - 1].frame));
      if (!all[i].labelled) continue;
      CHECK(ruler.x_of(all[i].frame) - last_label_x >= 70 - 1e-6);
      last_label_x = ruler.x_of(all[i].frame);
    }
    // The next step of 1, 2, 5 is at most 2.5 times larger; that the labels' step is a multiple can cost it once more.
    const double fewest = std::floor(std::min(ruler.count, ruler.width / (6 * 2.5 * 2.5)));
    CHECK(all.size() >= fewest);
  }
}

TEST_CASE("labelled frames are multiples of one round step from frame 0 on") {
  for (const TimeRuler& ruler : example_rulers()) {
    std::vector<double> labelled;
    for (const Tick& tick : ticks(ruler, 50))
      if (tick.labelled) labelled.push_back(tick.frame);
    for (std::size_t i = 1; i < labelled.size(); ++i) {
      const double step = labelled[i] - labelled[i - 1];
      CHECK(is_round_step(step));
      CHECK(std::fmod(labelled[i], step) == 0);
    }
    if (ruler.width > 500) CHECK(labelled.size() >= 2);
  }
}

TEST_CASE("four frames across have one tick each, and frame 0 is one of them") {
  const std::vector<Tick> all = ticks({0, 400, 0, 4}, 60);
  REQUIRE(all.size() == 5);
  for (int i = 0; i < 5; ++i) CHECK((all[i].frame == i && all[i].labelled));
}

TEST_CASE("a strip of no width has no ticks") {
  CHECK(ticks({0, 0, 0, 100}, 60).empty());
  CHECK(ticks({0, -5, 0, 100}, 60).empty());
  CHECK(ticks({0, 500, kNan, 100}, 60).empty());
  CHECK(ticks({0, kInfinity, 0, 100}, 60).empty());
  CHECK_FALSE(ticks({0, 500, 0, 100}, kNan).empty());
}

TEST_CASE("times are written in minutes, seconds and hundredths, and carry") {
  CHECK(time_text(0) == "0:00.00");
  CHECK(time_text(62.48) == "1:02.48");
  CHECK(time_text(59.9949) == "0:59.99");
  CHECK(time_text(59.9951) == "1:00.00");
  CHECK(time_text(3599.996) == "1:00:00.00");
  CHECK(time_text(3723.45) == "1:02:03.45");
  CHECK(time_text(360000) == "100:00:00.00");
}

TEST_CASE("negative times have a sign, and what rounds to zero has none") {
  CHECK(time_text(-62.48) == "-1:02.48");
  CHECK(time_text(-0.004) == "0:00.00");
  CHECK(time_text(-0.0) == "0:00.00");
  CHECK(time_text(-59.9951) == "-1:00.00");
}

TEST_CASE("a time that is not finite or too large is shown as dashes") {
  CHECK(time_text(kNan) == "--:--.--");
  CHECK(time_text(-kInfinity) == "--:--.--");
  CHECK(time_text(1e300) == "--:--.--");
}

TEST_CASE("a round step is 1, 2 or 5 times a power of ten and the minimum that suffices") {
  for (double minimum = 1e-6; minimum < 1e9; minimum *= 1.07) {
    const double step = round_step(minimum);
    CAPTURE(minimum);
    CHECK(step >= minimum * (1 - 1e-11));
    CHECK(step < minimum * 2.5000001);
    const double mantissa = step / std::pow(10.0, std::floor(std::log10(step * 1.000001)));
    const bool is_round =
        std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9;
    CHECK(is_round);
  }
}

TEST_CASE("a step that is round already is kept, in spite of the last digit") {
  for (const double step : {1e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 1000.0, 5e6}) {
    CHECK(round_step(step) == doctest::Approx(step).epsilon(1e-12));
    CHECK(round_step(std::nextafter(step, 1e9)) == doctest::Approx(step).epsilon(1e-12));
    CHECK(round_step(std::nextafter(step, 0)) == doctest::Approx(step).epsilon(1e-12));
  }
  CHECK(round_step(1.01) == 2);
  CHECK(round_step(2.01) == 5);
  CHECK(round_step(5.01) == 10);
}

TEST_CASE("a minimum that is not positive and finite gives the step 1") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double none : {0.0, -3.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    CHECK(round_step(none) == 1);
}

TEST_CASE("rounded values have the digits of their step") {
  CHECK(rounded_to(0.31, 0.1) == 0.3);
  CHECK(rounded_to(0.29, 0.05) == 0.3);
  CHECK(rounded_to(-17.4, 5) == -15);
  CHECK(rounded_to(12345678, 1000) == 12346000);
  CHECK(rounded_to(0.44, 0.3) == doctest::Approx(0.3));
  CHECK(rounded_to(100, 40) == 120);
}

TEST_CASE("the grid is on the ground, on round metres, and never more than 200 lines") {
  for (OrbitCamera camera : test::example_cameras())
    for (const double target_z_m : {0.0, -150.0, 1e7}) {
      camera.target_m.z = target_z_m;
      const GroundGrid grid = ground_grid(camera, test::kRect);
      CHECK(grid.lines.size() <= 200);
      CHECK(grid.lines.size() > 20);
      for (const GridLine& line : grid.lines) {
        CHECK((line.ends_m[0].z == 0 && line.ends_m[1].z == 0));
        CHECK(std::abs(std::remainder(line.at_m, grid.step_m)) < 1e-6 * grid.step_m);
        CHECK((line.is_of_x ? line.ends_m[0].x : line.ends_m[0].y) == line.at_m);
        const double decade = std::pow(10.0, std::floor(std::log10(grid.step_m) + 1e-9));
        const double bold_m = std::lround(grid.step_m / decade) == 5 ? 50 * decade : 10 * decade;
        CHECK(line.bold == (std::abs(std::remainder(line.at_m, bold_m)) < 1e-6 * bold_m));
      }
    }
}

TEST_CASE("from above, grid lines are 40 to 100 pixels apart and cover the screen") {
  for (double distance_m = 5; distance_m < 1e6; distance_m *= 1.7) {
    const OrbitCamera camera{.distance_m = distance_m, .elevation_rad = 1.5707963};
    const GroundGrid grid = ground_grid(camera, test::kRect);
    const double apart_px = grid.step_m * camera.pixels_per_metre({0, 0, 0}, test::kRect);
    CHECK(apart_px >= 40 * (1 - 1e-9));
    CHECK(apart_px <= 100 * (1 + 1e-9));
    const double reach_px = 49 * apart_px;
    CHECK(reach_px > glm::length(test::kRect.size()) / 2);
  }
}

TEST_CASE("distances are written in metres and kilometres") {
  CHECK(round_distance_text(0) == "0");
  CHECK(round_distance_text(-250) == "-250 m");
  CHECK(round_distance_text(0.05) == "0.05 m");
  CHECK(round_distance_text(1500) == "1.5 km");
}

}  // namespace sigs::editor
