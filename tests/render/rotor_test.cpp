// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "render/scenes.h"

namespace sigs {

using namespace test;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

const Rotor kThreeBlades{.blade_count = 3,
                         .root_m = 0.4,
                         .tip_m = 5.3,
                         .root_chord_m = 0.30,
                         .tip_chord_m = 0.35,
                         .rpm = -390,
                         .phase_rad = 0.7,
                         .hub_m = {0.5, -0.2, -1.8},
                         .axis = glm::normalize(glm::dvec3(0.1, 0.05, -1)),
                         .across = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), glm::dvec3(0.1, 0.05, -1)))};

// A square around the disc, whose material is the rotor.
Mesh square_of(const Rotor& rotor) {
  const auto size_m = static_cast<float>(2.1 * rotor.tip_m);
  const glm::vec3 u = size_m * glm::vec3(rotor.across);
  const glm::vec3 v = size_m * glm::vec3(glm::cross(rotor.axis, rotor.across));
  Mesh mesh;
  mesh.materials.push_back(paint({0.2F, 0.2F, 0.2F}, 0.3F));
  mesh.materials.back().rotor = rotor;
  add_quad(mesh, glm::vec3(rotor.hub_m) - 0.5F * (u + v), u, v, 0);
  return measured(std::move(mesh));
}

struct Case {
  Pose<frame::Camera, frame::Body> camera_from_body;
  VirtualCamera view;
  Shutter shutter;
};

// Where the ray through a place of the view meets the disc, in its own axes, metres.
std::optional<glm::dvec2> on_disc(const Rotor& rotor, const Case& it, const glm::dvec2& at_px) {
  const Pose<frame::Body, frame::View> body_from_view = inverse(it.view.view_from_camera * it.camera_from_body);
  const glm::dvec2 at = (at_px - it.view.center_px) / it.view.focal_px;
  const glm::dvec3 ray = body_from_view.rotation * glm::dvec3(1, at.x, at.y);
  const glm::dvec3 eye = body_from_view.translation_m - rotor.hub_m;
  const double t = -glm::dot(eye, rotor.axis) / glm::dot(ray, rotor.axis);
  if (!(t > 0)) return std::nullopt;
  const glm::dvec3 p = eye + t * ray;
  return glm::dvec2(glm::dot(p, rotor.across), glm::dot(p, glm::cross(rotor.axis, rotor.across)));
}

// In how many of the instants, spread evenly over the exposure, a blade is at a place of the disc.
int instants_with_blade(const Rotor& rotor, const glm::dvec2& p, double middle_s, double exposure_s, int instants) {
  const double radius = glm::length(p);
  if (radius < rotor.root_m || radius > rotor.tip_m) return 0;
  const double along = (radius - rotor.root_m) / (rotor.tip_m - rotor.root_m);
  const double chord = rotor.root_chord_m + along * (rotor.tip_chord_m - rotor.root_chord_m);
  // Counted in blades: a blade is there where the count is near a whole number.
  const double per_blade = rotor.blade_count / kTurn;
  const double half_width = chord / 2 / radius * per_blade;
  const double first = (std::atan2(p.y, p.x) - rotor.phase_rad) * per_blade;
  const double blades_per_s = rotor.rpm / 60 * rotor.blade_count;
  int hits = 0;
  for (int i = 0; i < instants; ++i) {
    const double place = first - blades_per_s * (middle_s + exposure_s * ((i + 0.5) / instants - 0.5));
    hits += std::abs(place - std::round(place)) < half_width ? 1 : 0;
  }
  return hits;
}

// Brute force: 500 instants of 4 x 4 places of each pixel.
cv::Mat averaged_instants(const Rotor& rotor, const Case& it) {
  constexpr int kInstants = 500, kPlaces = 4;
  cv::Mat share = cv::Mat::zeros(it.view.size_px, CV_32FC1);
  for (int y = 0; y < share.rows; ++y)
    for (int x = 0; x < share.cols; ++x) {
      const glm::dvec2 pixel(x, y);
      const double middle_s =
          it.shutter.time_s + it.shutter.center_s + glm::dot(it.shutter.s_per_px, pixel - it.view.center_px);
      int hits = 0;
      for (int place = 0; place < kPlaces * kPlaces; ++place) {
        const glm::dvec2 shift((place % kPlaces + 0.5) / kPlaces - 0.5, (place / kPlaces + 0.5) / kPlaces - 0.5);
        if (const std::optional<glm::dvec2> p = on_disc(rotor, it, pixel + shift))
          hits += instants_with_blade(rotor, *p, middle_s, it.shutter.exposure_s, kInstants);
      }
      share.at<float>(y, x) = static_cast<float>(hits) / (kInstants * kPlaces * kPlaces);
    }
  return share;
}

Layer drawn_rotor(const Mesh& mesh, const Case& it, const Light& light = ambient_only()) {
  Result<Layer> layer = renderer().draw(mesh, it.camera_from_body, light, it.view, it.shutter);
  renderer().forget(mesh);
  REQUIRE(layer.has_value());
  CHECK(is_valid(*layer));
  return std::move(*layer);
}

cv::Mat opacity_of(const Layer& layer) {
  cv::Mat opacity;
  cv::extractChannel(layer.color, opacity, 3);
  return opacity;
}

// Seen from below at an angle, some 12 pixels a metre.
Case seen_from_below(double exposure_s) {
  const glm::dquat turned = glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.2, 1, 0.3)));
  return {Pose<frame::Camera, frame::Body>{turned, {20, 0, 0}}, view_of({150, 150}, 240), {12.345, exposure_s}};
}

}  // namespace

TEST_CASE("turning blades are as opaque as the average of 500 instants, at three shutter speeds, global and rolling") {
  for (const double exposure_s : {1e-3, 4e-3, 1.0 / 60})
    for (const bool is_rolling : {false, true}) {
      Case it = seen_from_below(exposure_s);
      // Of a shutter that reads 1080 rows in 20 ms, turned by a tenth against the view.
      if (is_rolling) it.shutter = {12.345, exposure_s, 2e-3, {2e-6, 18.5e-6}};
      const Mesh mesh = square_of(kThreeBlades);
      const cv::Mat drawn_share = opacity_of(drawn_rotor(mesh, it));
      const cv::Mat truth = averaged_instants(kThreeBlades, it);
      const double blades_px = cv::sum(truth)[0];
      REQUIRE(blades_px > 200);
      CAPTURE(exposure_s);
      CAPTURE(is_rolling);
      CAPTURE(cv::norm(drawn_share, truth, cv::NORM_L1) / blades_px);
      CAPTURE(cv::norm(drawn_share, truth, cv::NORM_INF));
      // Off by what a pixel is taken to span along the circle, and by the blades' ends: a pixel's average is not a
      // box's.
      CHECK(cv::sum(drawn_share)[0] == doctest::Approx(blades_px).epsilon(0.01));
      CHECK(cv::norm(drawn_share, truth, cv::NORM_L1) < 0.05 * blades_px);
      CHECK(cv::norm(drawn_share, truth, cv::NORM_INF) < 0.2);
    }
}

TEST_CASE(
    "blades that stand, one blade, blades wider than their circle, and a disc seen edge on are drawn all the same") {
  Rotor standing = kThreeBlades;
  standing.rpm = 0;
  Rotor single = kThreeBlades;
  single.blade_count = 1;
  Rotor wide = kThreeBlades;
  wide.root_m = 0;
  wide.root_chord_m = wide.tip_chord_m = 50;
  const Case frozen = seen_from_below(0);
  for (const Rotor& rotor : {standing, single}) {
    const cv::Mat share = opacity_of(drawn_rotor(square_of(rotor), frozen));
    CHECK(cv::norm(share, averaged_instants(rotor, frozen), cv::NORM_L1) < 0.06 * cv::sum(share)[0]);
  }
  // All of the disc is covered, up to its rim.
  const cv::Mat covered = opacity_of(drawn_rotor(square_of(wide), frozen));
  CHECK(cv::norm(covered, averaged_instants(wide, frozen), cv::NORM_L1) < 0.01 * cv::sum(covered)[0]);

  const Pose<frame::Camera, frame::Body> edge_on{glm::dquat(1, 0, 0, 0), {20, 0, 0}};
  Rotor level = kThreeBlades;
  level.hub_m = {0, 0, 0};
  level.axis = {0, 0, -1};
  level.across = {1, 0, 0};
  const Case grazing{edge_on, view_of({150, 150}, 240), {1e7, 1e-3}};
  CHECK(cv::sum(opacity_of(drawn_rotor(square_of(level), grazing)))[0] < 150);  // a line of pixels across the view
}

TEST_CASE("after a hundred days the blades stand where they should, and after whole turns where they stood") {
  Rotor slow = kThreeBlades;
  slow.rpm = 60;  // one turn a second
  Case it = seen_from_below(1e-3);
  it.shutter.time_s = 0.25;
  const cv::Mat early = opacity_of(drawn_rotor(square_of(slow), it));
  it.shutter.time_s += 8'640'000;
  CHECK(cv::norm(early, opacity_of(drawn_rotor(square_of(slow), it)), cv::NORM_INF) < 1e-3);
  it.shutter.time_s += 0.1;
  CHECK(cv::norm(early, opacity_of(drawn_rotor(square_of(slow), it)), cv::NORM_INF) > 0.5);
}

TEST_CASE("a body hides the blades behind it and is seen through those before it, in the sun too") {
  Rotor facing = kThreeBlades;
  facing.hub_m = {0, 0, 0};
  facing.axis = {-1, 0, 0};
  facing.across = {0, 1, 0};
  const Light sun{.color = glm::dvec3(1), .kind = Light::Kind::sun, .to_sun = {-1, 0, 0}};
  for (const Light& light : {ambient_only(), sun})
    for (const float wall_x_m : {-1.0F, 1.0F}) {
      Mesh mesh = square_of(facing);
      mesh.materials.push_back(paint({1, 1, 1}));
      add_quad(mesh, {wall_x_m, -2, 2}, {0, 4, 0}, {0, 0, -4}, 1);
      mesh = measured(std::move(mesh));
      const Case it{at({50, 0, 0}), view_of({91, 91}, 400), {0, 1e-3}};
      const Layer layer = drawn_rotor(mesh, it, light);
      const cv::Mat wall = layer.color(cv::Rect(38, 38, 15, 15));
      double darkest = 0;
      cv::minMaxIdx(wall.reshape(1), &darkest, nullptr);
      CHECK((darkest < 0.5) == (wall_x_m > 0));  // what is dark before the white wall is a blade
    }
}

}  // namespace sigs
