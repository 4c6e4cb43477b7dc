// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "extremes/validity.h"

namespace sigs::test {
namespace {

struct Place {
  std::string name;
  glm::dvec3 from_eye_m;
  bool can_be_seen;  // through a pinhole
};

// The aircraft is 12 m long and extends 7 m to its right.
std::vector<Place> places() {
  return {{"behind", {-80, 5, 5}, false},
          {"far behind", {-1e7, 0, 0}, false},
          {"its tail half a metre ahead", {6.5, 0, 0}, true},
          {"its nose half a metre behind the camera", {-6.5, 0, 0}, false},
          {"beside the camera, straddling the image plane", {0, 9, 0}, false},
          {"below, straddling the image plane, ahead into the image", {3, 0, 3}, true},
          {"on the image plane itself", {0, 60, 0}, false},
          {"around the camera", {0, 0, 0}, true},
          {"its skin a hundredth of a millimetre from the camera", {0, 0, -0.75 - 1e-5}, true},
          {"100 km away", {1e5, 1e3, -500}, true},
          {"ten thousand kilometres away", {1e7, 0, 0}, true},
          {"as far as the format allows", {9e7, 9e7, -9e7}, false}};
}

double area_of(const std::vector<cv::Point2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const cv::Point2d& a = polygon[i];
    const cv::Point2d& b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

// A cube's silhouette through a pinhole is the hull of its corners' images. In units of `unit_px`, which floats hold.
double cube_area_px(double side_m, const glm::dvec3& from_eye_m, double focal_px, double unit_px) {
  std::vector<cv::Point2f> images;
  const glm::dvec2 center = glm::dvec2(from_eye_m.y, from_eye_m.z) / from_eye_m.x;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p =
        from_eye_m +
        0.5 * side_m * glm::dvec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const glm::dvec2 off = (glm::dvec2(p.y, p.z) / p.x - center) * (focal_px / unit_px);
    images.emplace_back(static_cast<float>(off.x), static_cast<float>(off.y));
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(images, hull);
  return area_of({hull.begin(), hull.end()}) * unit_px * unit_px;
}

}  // namespace

TEST_CASE("wherever the intruder is all outputs are valid") {
  const struct {
    MethodChoice method;
    bool is_fisheye;
    double blur_px_per_m;
  } ways[] = {
      {MethodChoice::direct, false, 0}, {MethodChoice::direct, true, 0.01}, {MethodChoice::classic, false, 0.01}};
  for (const auto& way : ways) {
    Scenario scenario({96, 72});
    const double focal_px = way.is_fisheye ? 30 : 90;
    set_lens(scenario, {focal_px, 0, 47.5, 0, focal_px, 35.5, 0, 0, 1}, {0, 0, 0, 0}, way.is_fisheye);
    scenario.project.compositing = {.method = way.method, .blur_px_per_m = way.blur_px_per_m, .supersampling = 1};
    add_aircraft(scenario, kEye_m);
    for (const Place& place : places()) {
      INFO(place.name << ", fisheye " << way.is_fisheye << ", method " << static_cast<int>(way.method));
      scenario.project.intruders[0].trajectory.waypoints = {{.frame = 0, .position_m = kEye_m + place.from_eye_m}};
      const ValidFrame valid = valid_frame(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1));
      const IntruderTruth& truth = valid.composed.truth.intruders[0];
      CHECK(length(truth.position_m - place.from_eye_m) <= 1e-8 * (1 + length(place.from_eye_m)));
      if (!way.is_fisheye) CHECK(truth.in_image == place.can_be_seen);
    }
  }
}

TEST_CASE("an image on a surface that is seen edge on from a hundredth of a millimetre stays an image") {
  Scenario scenario({96, 72});
  set_lens(scenario, {90, 0, 47.5, 0, 90, 35.5, 0, 0, 1}, {0, 0, 0, 0});
  scenario.project.compositing.supersampling = 1;
  cv::imwrite(scenario.path("image.png").string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar(40, 120, 220)));
  add_aircraft(scenario, kEye_m);
  std::ofstream paint(scenario.path("aircraft.mtl"));
  for (std::size_t i = 0; i < aircraft().size(); ++i) paint << "newmtl paint" << i << "\nKd 1 1 1\nmap_Kd image.png\n";
  paint.close();
  for (const double above_m : {1e-5, -1e-5, 1e-7, 1e-3, 0.0}) {
    CAPTURE(above_m);
    // The fuselage's belly above the camera by so much.
    scenario.project.intruders[0].trajectory.waypoints[0].position_m = kEye_m + glm::dvec3(0, 0, -0.75 - above_m);
    (void)valid_frame(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1));
  }
}

TEST_CASE("a scene ten thousand kilometres from the world's origin is valid and the same") {
  for (const Place& place : places()) {
    if (length(place.from_eye_m) > 1e6 || (!place.can_be_seen && length(place.from_eye_m) < 20)) continue;
    INFO(place.name);
    std::vector<ComposedFrame> frames;
    for (const glm::dvec3& origin_m : {glm::dvec3(0), glm::dvec3(1e7, -1e7, 1e7)}) {
      Scenario scenario({96, 72});
      set_lens(scenario, {90, 0, 47.5, 0, 90, 35.5, 0, 0, 1}, {0, 0, 0, 0});
      scenario.project.compositing.supersampling = 1;
      scenario.project.camera.position_m = origin_m;
      scenario.project.light.position_m = origin_m + glm::dvec3(-2000, 1000, -3000);
      // Thousandths of a millimetre are lost at 1e7 m: eighths of a metre are not.
      add_aircraft(scenario, origin_m + glm::round(place.from_eye_m * 8.0) / 8.0);
      frames.push_back(valid_frame(scenario.opened(), 0, grainy_frame(scenario.size_px(), 0)).composed);
    }
    CHECK(same_planes(frames[0].image, frames[1].image));
    CHECK(frames[0].truth.intruders[0].position_m == frames[1].truth.intruders[0].position_m);
  }
}

TEST_CASE("a target of a hundredth of a pixel covers its true area within a hundredth") {
  // 3 m at 90 km: 0.01 px. The closed form is a square; the cube's outline a polygon.
  const double distance_m = 90'000;
  for (const double supersampling : {1.0, 2.0, 4.0})
    for (const glm::dvec2 offset_px : {glm::dvec2(0, 0), glm::dvec2(0.5, 0.5), glm::dvec2(-61.37, 40.81),
                                       glm::dvec2(100.499, -80.501), glm::dvec2(0.49, -0.02)}) {
      CAPTURE(supersampling);
      CAPTURE(offset_px.x);
      const glm::dvec3 from_eye_m =
          distance_m * glm::dvec3(1, offset_px.x / Scenario::kFocal_px, offset_px.y / Scenario::kFocal_px);
      for (const bool is_plate : {true, false}) {
        Scenario scenario;
        scenario.project.compositing.supersampling = static_cast<int>(supersampling);
        if (is_plate)
          add_plate(scenario, 3, kEye_m + from_eye_m);
        else
          add_cube(scenario, 3, kEye_m + from_eye_m);
        const double true_px = is_plate ? 1e-4 : cube_area_px(3, from_eye_m, Scenario::kFocal_px, 0.01);
        const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
        REQUIRE(valid.layers.size() == 1);
        REQUIRE(!valid.layers[0].warped.empty());
        CHECK(cv::sum(valid.layers[0].warped.coverage)[0] == doctest::Approx(true_px).epsilon(0.01));
        CHECK(opacity_px(valid.layers[0].occluded) == doctest::Approx(true_px).epsilon(0.01));
      }
    }
}

TEST_CASE("a target of a hundredth of a pixel keeps its area through a distorting lens") {
  // Where a lens magnifies by its Jacobian's determinant, areas grow by that: here the closed form of one coefficient,
  // r -> r (1 + k r^2), which stretches radially by 1 + 3 k r^2 and across by 1 + k r^2.
  const double k1 = -0.25;
  for (const double slope : {0.0, 0.2, 0.45}) {
    CAPTURE(slope);
    Scenario scenario;
    set_lens(scenario, {300, 0, 159.5, 0, 300, 119.5, 0, 0, 1}, {k1, 0, 0, 0});
    add_plate(scenario, 3, kEye_m + 90'000.0 * glm::dvec3(1, slope, 0));
    const double determinant = (1 + 3 * k1 * slope * slope) * (1 + k1 * slope * slope);
    const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
    REQUIRE(!valid.layers[0].warped.empty());
    CHECK(cv::sum(valid.layers[0].warped.coverage)[0] == doctest::Approx(1e-4 * determinant).epsilon(0.01));
  }
}

TEST_CASE("from a hundredth of a pixel to a hundred pixels the area is correct at every supersampling") {
  for (int supersampling = 1; supersampling <= 8; ++supersampling)
    for (const double side_px : {0.01, 0.3, 1.0, 7.3, 100.0}) {
      CAPTURE(supersampling);
      CAPTURE(side_px);
      Scenario scenario({160, 120});
      set_lens(scenario, {300, 0, 79.8, 0, 300, 59.6, 0, 0, 1}, {0, 0, 0, 0});
      scenario.project.compositing.supersampling = supersampling;
      add_plate(scenario, side_px, kEye_m + glm::dvec3(300, 0, 0));
      const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(scenario.size_px(), 100));
      REQUIRE(!valid.layers[0].warped.empty());
      const double area_px = cv::sum(valid.layers[0].warped.coverage)[0];
      CHECK(area_px == doctest::Approx(side_px * side_px).epsilon(0.01));
      CHECK(valid.composed.truth.intruders[0].in_image);
    }
}

}  // namespace sigs::test
