// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/views/timeline/lanes.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("an intruder out of view has no size, and does not stretch the scale of visible ones") {
  Survey survey;
  for (const double size_px : {12.0, 40.0, 3600.0, 20.0})
    survey.estimates.push_back({.distance_m = 100,
                                .size_px = size_px,
                                .visibility_state = size_px > 1000 ? VisibilityState::out_of_view
                                                    : size_px > 30 ? VisibilityState::occluded
                                                                   : VisibilityState::in_view});
  const LaneValues sizes = values_of(survey, Lane::size);
  REQUIRE(sizes.values.size() == 4);
  CHECK(sizes.values[1] == 40);
  CHECK(std::isnan(sizes.values[2]));
  CHECK(value_text(Lane::size, sizes.values[2]) == "-");
  CHECK(sizes.minimum == 12);
  CHECK(sizes.maximum == 40);
  CHECK(sizes.scale.high < 100);
  CHECK(values_of(survey, Lane::distance).values == std::vector<double>{100, 100, 100, 100});
}

TEST_CASE("an intruder that is never in view has an empty lane of sizes") {
  Survey survey;
  survey.estimates.resize(3);
  const LaneValues sizes = values_of(survey, Lane::size);
  CHECK(sizes.values.size() == 3);
  CHECK(sizes.minimum == sizes.maximum);
  CHECK(values_of(Survey(), Lane::speed).values.empty());
}

TEST_CASE("a strip has words instead of values, and a frame beyond the survey has neither") {
  Survey survey;
  survey.estimates = {{.distance_m = 933, .visibility_state = VisibilityState::in_view},
                      {.distance_m = 12.3, .visibility_state = VisibilityState::partly_occluded}};
  CHECK(values_of(survey, Lane::visibility).values.empty());
  CHECK(text_in(survey, Lane::visibility, 1) == "partly hidden");
  CHECK(text_in(survey, Lane::distance, 0) == "933 m");
  CHECK(text_in(survey, Lane::distance, 1) == "12.3 m");
  for (const LaneStyle& style : lane_styles()) CHECK(text_in(survey, style.lane, 2) == "-");
}

TEST_CASE("lanes of the camera are in degrees; yaw is told within 180 and drawn without jumps") {
  Survey survey;
  CHECK(values_of(survey, Lane::yaw).values.empty());
  CHECK(text_in(survey, Lane::yaw, 0) == "-");
  survey.camera = {{.attitude = {.roll_rad = 0.1, .pitch_rad = -0.2, .yaw_rad = 3.0}},
                   {.attitude = {.roll_rad = 0.1, .pitch_rad = -0.2, .yaw_rad = 3.5},
                    .sd = Attitude{.roll_rad = 0.01, .pitch_rad = 0.02, .yaw_rad = 0.03}}};
  const LaneValues yaw = values_of(survey, Lane::yaw);
  CHECK(yaw.maximum == doctest::Approx(200.535));  // 3.5 * 180 / pi
  REQUIRE(yaw.deviations.size() == 2);
  CHECK(std::isnan(yaw.deviations[0]));
  CHECK(yaw.deviations[1] == doctest::Approx(1.7189));
  CHECK(text_in(survey, Lane::yaw, 1) == "-159.5\u00b0 \u00b11.7\u00b0");
  CHECK(text_in(survey, Lane::roll, 0) == "5.7\u00b0");
  CHECK(text_in(survey, Lane::pitch, 0) == "-11.5\u00b0");
  survey.camera[1].sd.reset();
  CHECK(values_of(survey, Lane::yaw).deviations.empty());
}

TEST_CASE("a lane is found by its name, wherever it stands in the list") {
  for (const LaneStyle& style : lane_styles()) CHECK(style_of(style.lane).title == style.title);
}

namespace {

const TimeRuler kRuler{.left_x = 10, .width = 1000, .first = 0, .count = 1000};
const LaneBox kBox{.top_y = 100, .height = 50};

std::vector<double> wave(int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::sin(i * 0.01));
  return values;
}

// How far a line passes from a point, upright; infinity beside its ends.
double miss(const Polyline& line, double x, double y) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::vec2 a = line[i - 1];
    const glm::vec2 b = line[i];
    if (x >= a.x && x <= b.x) return std::abs(a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x) - y);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE("a curve passes its values within the tolerance with far fewer points") {
  TimeRuler near = kRuler;
  near.count = 200;  // 5 px a frame: each frame counts
  const std::vector<double> values = wave(200);
  const auto lines = curve_of(values, 0, near, {.low = -1, .high = 1}, kBox);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].size() < 60);
  for (int i = 0; i < 200; ++i)
    CHECK(miss(lines[0], near.x_of(i + 0.5), 125 - 25 * values[static_cast<std::size_t>(i)]) < 0.34);
}

TEST_CASE("a single spike among many frames still shows") {
  std::vector<double> values(100'000, 0.0);
  values[54'321] = 1;
  TimeRuler far = kRuler;
  far.count = 100'000;
  const auto lines = curve_of(values, 0, far, {.low = 0, .high = 1}, kBox);
  REQUIRE(lines.size() == 1);
  const auto top = std::min_element(lines[0].begin(), lines[0].end(), [](auto a, auto b) { return a.y < b.y; });
  CHECK(top->y == doctest::Approx(100));
  CHECK(top->x == doctest::Approx(far.x_of(54'321.5)));
}

TEST_CASE("values that are not finite leave gaps, and no values give no curve") {
  std::vector<double> values = wave(300);
  values[100] = std::numeric_limits<double>::quiet_NaN();
  values[200] = std::numeric_limits<double>::infinity();
  TimeRuler near = kRuler;
  near.count = 300;
  CHECK(curve_of(values, 0, near, {.low = -1, .high = 1}, kBox).size() == 3);
  CHECK(curve_of({}, 0, kRuler, {}, kBox).empty());
  CHECK(curve_of(values, 5000, kRuler, {}, kBox).empty());
  CHECK(curve_of(values, 0, {.width = 0}, {}, kBox).empty());
}

TEST_CASE("a scale holds all values, begins at zero where they come near it, and never magnifies noise") {
  const auto holds = [](std::vector<double> values) {
    const LaneScale scale = scale_for(values, 1);
    for (const double v : values) CHECK((v >= scale.low && v <= scale.high));
    CHECK(scale.high - scale.low >= 1);
    return scale;
  };
  CHECK(holds({1, 10}).low == 0);
  CHECK(holds({90, 100}).low > 80);
  CHECK(holds({-3, 2}).low < -3);
  CHECK(holds({7, 7, 7}).share_of(7) == doctest::Approx(0.5));
  holds({0, 0});
  holds({1e7, 1e7 + 1e-9});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(scale_for(std::vector{nan, 5.0, 10.0}, 1).high > 10);
  CHECK(scale_for({}, 2).high == 2);
}

TEST_CASE("a logarithmic scale has a place for zero and more space for small values") {
  const LaneScale scale = scale_for(std::vector{0.0, 1000.0}, 1, Scaling::logarithmic);
  CHECK(scale.share_of(0) == 0);
  CHECK(scale.share_of(10) > 0.3);
  CHECK(scale.share_of(1e9) == 1);
}
