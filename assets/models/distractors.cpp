// SPDX-License-Identifier: MIT
// What detectors should not take for an aircraft: a bird (a gull of 1.4 m; with the dark livery a crow's colours), a
// party balloon of 0.3 m, and an insect on the lens. Shapes and paint are our own.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "loft.h"
#include "model.h"
#include "paint.h"

namespace sigs::models {

namespace {

WingStation feathers(double forward_m, double left_m, double up_m, double chord_m) {
  return {.leading_edge_m = {forward_m, left_m, up_m},
          .chord_m = chord_m,
          .thickness = 0.06,
          .incidence_rad = 0.05,
          .camber = 0.05};
}

// Gliding, the wings raised to the wrist and lowered beyond it.
std::vector<Patch> wings() {
  const Patch arm = wing({feathers(0.075, 0.02, 0.020, 0.150), feathers(0.095, 0.12, 0.050, 0.155),
                          feathers(0.110, 0.28, 0.090, 0.140), feathers(0.085, 0.42, 0.095, 0.115)},
                         8, "wing");
  const Patch hand = wing({feathers(0.085, 0.42, 0.095, 0.115), feathers(0.040, 0.56, 0.085, 0.085),
                           feathers(-0.020, 0.66, 0.070, 0.055), feathers(-0.065, 0.71, 0.060, 0.020)},
                          8, "tip");
  return {arm, mirrored(arm, false), hand, mirrored(hand, false)};
}

std::vector<MaterialSpec> plumage(double body, double wing, double tip, const Colour& beak) {
  return {matt("body", grey(body)), matt("wing", grey(wing)), matt("tip", grey(tip)), matt("beak", beak)};
}

// A blurred spot: dark in the middle, fading from a quarter of the radius on. The opacity of ring r from the middle.
constexpr int kSpotRings = 18;

double spot_opacity(int ring) {
  const double share = std::clamp(((ring + 0.5) / kSpotRings - 0.25) / 0.75, 0.0, 1.0);
  return std::round(1000 * 0.985 * (1 - share * share * (3 - 2 * share))) / 1000;
}

constexpr double kSpotRadius_m = 0.0055;

std::string spot_material(int ring) {
  return "spot_" + std::to_string(ring + 1);
}

}  // namespace

Model bird() {
  const Patch body = revolved({{0.165, 0},
                               {0.160, 0.014},
                               {0.140, 0.026},
                               {0.110, 0.031},
                               {0.075, 0.040},
                               {0.020, 0.052},
                               {-0.050, 0.053},
                               {-0.120, 0.036},
                               {-0.180, 0.016},
                               {-0.200, 0}},
                              16, "body");
  const Patch beak = moved(teardrop({0.035, 0.007, 0.009}, 1.0, 8, "beak"), {0.172, 0, -0.004});
  const auto fan = [](double left_m, double chord_m) {
    return WingStation{.leading_edge_m = {-0.13, left_m, 0.004}, .chord_m = chord_m, .thickness = 0.04};
  };
  const Patch tail = wing({fan(-0.065, 0.115), fan(-0.03, 0.140), fan(0.03, 0.140), fan(0.065, 0.115)}, 6, "body");
  Model model{.name = "bird",
              .patches = {body, beak, tail},
              .liveries = {{.materials = plumage(0.72, 0.42, 0.06, {0.60, 0.38, 0.05})},
                           {.name = "dark", .materials = plumage(0.035, 0.03, 0.025, grey(0.04))}}};
  add(model, wings());
  return model;
}

Model balloon() {
  std::vector<glm::dvec2> profile;
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {  // from the crown down to the neck
    const double angle = std::numbers::pi * i / kSteps;
    const double x = std::cos(angle);
    const double r = i % kSteps == 0 ? 0.0 : 0.15 * std::pow(std::sin(angle), x < 0 ? 1.25 : 1.0);
    profile.emplace_back(x > 0 ? 0.15 * x : 0.20 * x, r);
  }
  const Patch skin_of_balloon = moved(revolved(profile, 28, "rubber"), kUpright, {0, 0, 0});
  const Patch knot = moved(teardrop({0.010, 0.010, 0.010}, 1.0, 8, "rubber"), kUpright, {0, 0, -0.205});
  const Patch string = strut({0, 0, -0.21}, {0.02, 0, -0.75}, 0.003, 0.003, "string");
  const auto painted_in = [](const Colour& colour) {
    return std::vector<MaterialSpec>{lacquer("rubber", colour), matt("string", grey(0.6))};
  };
  return {.name = "balloon",
          .patches = {skin_of_balloon, knot, string},
          .liveries = {{.materials = painted_in({0.55, 0.03, 0.03})},
                       {.name = "silver", .materials = painted_in(grey(0.62))}}};
}

Model insect() {
  constexpr int kSides = 36;
  std::vector<Ring> circles;
  for (int r = 0; r <= kSpotRings; ++r) {
    const double radius_m = kSpotRadius_m * r / kSpotRings;
    Ring circle;
    for (int i = 0; i <= kSides; ++i) {
      const double angle = 2 * std::numbers::pi * (i % kSides) / kSides;
      const double out_of_round = 1 + 0.22 * std::cos(2 * angle) + 0.06 * std::cos(3 * angle + 1);
      circle.emplace_back(0, -radius_m * out_of_round * std::sin(angle), radius_m * out_of_round * std::cos(angle));
    }
    circles.push_back(std::move(circle));
  }
  Model model{.name = "insect",
              .patches = {skin(circles, untextured, [](int r, int) { return spot_material(r); })},
              .liveries = {{}}};
  for (int r = 0; r < kSpotRings; ++r) {
    model.liveries.front().materials.push_back(matt(spot_material(r), grey(0.02)));
    model.liveries.front().materials.back().opacity = spot_opacity(r);
  }
  return model;
}

}  // namespace sigs::models
