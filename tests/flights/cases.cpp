// SPDX-License-Identifier: MIT
#include "flights/cases.h"

#include "flights/shapes.h"

namespace sigs::flights {

namespace {

// Each flight has its own starting point and phases of oscillation.
Path path(std::uint32_t seed) {
  return {.seed = seed};
}

Path sky_until(int frame, std::uint32_t seed) {
  return {.first_pitch_deg = 34, .level_from = frame, .seed = seed};
}

Path along_the_road(std::uint32_t seed) {
  return {.height_m = 60, .weave_m = 0, .sway = 0.15, .pitch_deg = -15, .first_pitch_deg = -15, .seed = seed};
}

Path standing(std::uint32_t seed) {
  return {.still = true, .seed = seed};
}

}  // namespace

std::vector<Case> cases(int frames) {
  const cv::Scalar white(244, 244, 244), grey(126, 134, 134);
  return {
      {.name = "tail boom", .parts = {tail_boom()}, .path = path(1)},
      {.name = "nose", .parts = {nose()}, .path = path(2)},
      {.name = "wing tip left", .parts = {wing_tip_left()}, .path = path(3)},
      {.name = "wing tip right", .parts = {wing_tip_right()}, .path = path(4)},
      {.name = "two parts", .parts = {tail_boom(), wing_tip_right()}, .path = path(5)},
      {.name = "propeller", .parts = {engine_cowl(), spinner()}, .path = path(6), .propeller = propeller()},
      {.name = "none", .path = path(7)},
      {.name = "letterbox", .parts = {tail_boom()}, .path = path(8), .bar_share = 0.11},
      {.name = "cockpit frame", .parts = {windscreen()}, .path = path(9)},
      {.name = "top", .parts = {strut(), belly()}, .path = path(10)},
      {.name = "exposure drift", .parts = {nose()}, .path = path(11), .exposure_drifts = true},
      {.name = "plain sky first", .parts = {tail_boom()}, .path = sky_until(frames / 2, 12), .cloudiness = 0},
      {.name = "still", .parts = {tail_boom()}, .path = standing(13)},
      {.name = "still, one mover", .parts = {tail_boom()}, .path = standing(14), .small_mover = true},
      {.name = "straight road below", .parts = {nose()}, .path = along_the_road(15), .roads = Roads::straight_below},
      {.name = "white before bright sky", .parts = {lifted(plain(wing_tip_right(), white), 0.24)}, .path = path(16)},
      {.name = "grey on grey", .parts = {plain(nose(), grey)}, .path = path(17)},
  };
}

std::vector<Case> hard_cases() {
  Path unmoved = path(20);
  unmoved.sway = 0;
  unmoved.weave_m = 0;
  Path hardly = path(21);
  hardly.sway = 0.1;
  hardly.weave_m = 5;
  const Path sky = sky_until(1 << 30, 22);
  return {
      {.name = "trembles by 1 to 4 px", .parts = {tail_boom(), wing_tip_left()}, .path = path(18), .shake = 2},
      {.name = "trembles by 2 to 8 px", .parts = {tail_boom(), wing_tip_left()}, .path = path(18), .shake = 4},
      {.name = "no sway at all", .parts = {nose()}, .path = unmoved},
      {.name = "a tenth of the sway", .parts = {nose()}, .path = hardly},
      {.name = "clouds and nothing else", .parts = {tail_boom()}, .path = sky},
      {.name = "clear sky and nothing else", .parts = {tail_boom()}, .path = sky, .cloudiness = 0},
      {.name = "grain of 8 codes", .parts = {wing_tip_right()}, .path = path(19), .grain_codes = 8},
  };
}

std::vector<Case> reflecting_cases() {
  const cv::Rect2d low(0, 0.45, 1, 0.55), all(-0.1, -0.1, 1.2, 1.2), left(0, 0.3, 0.55, 0.7);
  return {
      {.name = "faint reflection", .path = path(31), .reflection = {.codes = 30, .where = low, .seed = 31}},
      {.name = "strong reflection", .path = path(32), .reflection = {.codes = 80, .where = low, .seed = 32}},
      {.name = "reflection everywhere", .path = path(33), .reflection = {.codes = 50, .where = all, .seed = 33}},
      {.name = "creeping reflection",
       .path = path(34),
       .reflection = {.codes = 60, .where = low, .creep_px = 4, .seed = 34}},
      {.name = "sharp reflection",
       .path = path(35),
       .reflection = {.codes = 60, .where = low, .blur_px = 0.7, .things = 20, .seed = 35}},
      {.name = "nose, reflection",
       .parts = {nose()},
       .path = path(36),
       .reflection = {.codes = 60, .where = low, .seed = 36}},
      {.name = "wing tip, reflection",
       .parts = {wing_tip_left()},
       .path = path(37),
       .reflection = {.codes = 70, .where = left, .seed = 37}},
      {.name = "boom, creeping reflection",
       .parts = {tail_boom()},
       .path = path(38),
       .reflection = {.codes = 50, .where = low, .creep_px = 6, .seed = 38}},
      {.name = "windscreen, reflection",
       .parts = {windscreen()},
       .path = path(39),
       .reflection = {.codes = 50, .where = all, .seed = 39}},
      {.name = "road, reflection",
       .path = along_the_road(40),
       .roads = Roads::straight_below,
       .reflection = {.codes = 60, .where = low, .seed = 40}},
      {.name = "bonnet, road, reflection",
       .parts = {nose()},
       .path = along_the_road(41),
       .roads = Roads::straight_below,
       .reflection = {.codes = 60, .where = low, .seed = 41}},
  };
}

std::vector<Case> unseen_cases() {
  const cv::Rect2d low(0, 0.5, 1, 0.5), all(-0.1, -0.1, 1.2, 1.2), right(0.4, 0.35, 0.6, 0.65);
  return {
      {.name = "bonnet", .parts = {bonnet()}, .path = path(51)},
      {.name = "skids", .parts = skids(), .path = path(52)},
      {.name = "pod above", .parts = {pod()}, .path = path(53)},
      {.name = "float left", .parts = {side_float()}, .path = path(54)},
      {.name = "nothing, other terrain", .path = path(55)},
      {.name = "bonnet, lamps mirrored",
       .parts = {bonnet()},
       .path = path(56),
       .reflection = {.codes = 55, .where = low, .blur_px = 1, .things = 8, .seed = 56}},
      {.name = "skids behind glass",
       .parts = skids(),
       .path = path(57),
       .reflection = {.codes = 40, .where = all, .blur_px = 2.5, .things = 16, .seed = 57}},
      {.name = "float, creeping glare",
       .parts = {side_float()},
       .path = path(58),
       .reflection = {.codes = 75, .where = right, .creep_px = 5, .things = 9, .seed = 58}},
      {.name = "glare alone", .path = path(59), .reflection = {.codes = 90, .where = right, .things = 7, .seed = 59}},
      {.name = "dashboard mirrored", .path = path(60), .reflection = {.codes = 45, .where = low, .seed = 60}},
      {.name = "dashboard mirrored, sharp",
       .path = path(61),
       .reflection = {.codes = 70, .where = low, .blur_px = 0.6, .things = 18, .seed = 61}},
      {.name = "dashboard mirrored, road",
       .parts = {bonnet()},
       .path = along_the_road(62),
       .roads = Roads::straight_below,
       .reflection = {.codes = 60, .where = low, .things = 10, .seed = 62}},
  };
}

std::vector<cv::Rect> bars(const Case& scene, cv::Size size_px) {
  if (scene.bar_share <= 0) return {};
  const int height = cvRound(scene.bar_share * size_px.height);
  return {{0, 0, size_px.width, height}, {0, size_px.height - height, size_px.width, height}};
}

}  // namespace sigs::flights
