// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "frame/synthetic_scenes.h"
#include "frame/truth_scenes.h"
#include "scene/opened_project.h"

// 360 degree footage. Its image is a cylinder: what holds in its middle holds at its sides, and a pole is one place.
namespace sigs::test {
namespace {

const cv::Size kSphere_px(1024, 512);
constexpr double kPi = std::numbers::pi;

glm::dvec3 sphere_direction(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kPi / 180, e = elevation_deg * kPi / 180;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e)};
}

Sight sight_towards(const glm::dvec3& direction, double extent_px) {
  return {.model = "light-aircraft/light-aircraft.obj",
          .lens = sphere_lens(kSphere_px),
          .size_px = kSphere_px,
          .direction = direction,
          .extent_px = extent_px,
          .supersampling = 4,
          .samples_per_pixel = 4};
}

void tell_sphere(const std::string& name, const Compared& result) {
  MESSAGE(name << ": RMSE " << result.rmse() << ", 99.9 % under " << result.percentile(0.999) << ", worst "
               << result.worst() << ", bias " << result.bias() << ", area " << result.reference.area_px);
}

// What counts as visible is what rays hit: no other pixel, and each of the part's that they hit by a twentieth. Slivers
// of rays between pixels are seen by one of both alone.
void check_visible(const Compared& result) {
  const IntruderTruth& truth = result.annotation;
  REQUIRE(truth.visible_box.has_value());
  CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(1e-3));
  int wrong = 0, hit = 0;
  for (int y = 0; y < truth.visible_box->height; ++y)
    for (int x = 0; x < truth.visible_box->width; ++x) {
      const cv::Point at = truth.visible_box->tl() + cv::Point(x, y) - result.reference.rect.tl();
      const bool is_there = cv::Rect({0, 0}, result.reference.coverage.size()).contains(at);
      const double covered = is_there ? result.reference.coverage.at<double>(at) : 0;
      const bool is_visible = truth.visible.at<uchar>(y, x) != 0;
      hit += covered > 0 ? 1 : 0;
      wrong += (is_visible && !(covered > 0)) || (!is_visible && covered > 0.05) ? 1 : 0;
    }
  CAPTURE(hit);
  CHECK(wrong <= hit / 50);
}

}  // namespace

TEST_CASE("aircraft in a 360 degree image agree with ray tracing: ahead, across its side, over the poles, behind") {
  struct Place {
    std::string name;
    glm::dvec3 direction;
  };
  for (const Place& place :
       {Place{"ahead", sphere_direction(5, 3)}, Place{"at 60 degrees", sphere_direction(-100, 60)},
        Place{"across the side", sphere_direction(180, 10)}, Place{"at 80 degrees", sphere_direction(130, 80)},
        Place{"at the zenith", sphere_direction(0, 90)}, Place{"beside the zenith", sphere_direction(40, 87)},
        Place{"at the nadir", sphere_direction(0, -89.5)}}) {
    const Compared result = compared(sight_towards(place.direction, 50), {.samples_per_side = 8});
    tell_sphere(place.name, result);
    CHECK(result.rmse() < 2.55);  // as of sharp edges in truth_agreement_test.cpp: one percent of the range
    CHECK(std::abs(result.bias()) < 0.5);
    check_visible(result);
  }
}

namespace {

constexpr int kTurnFrames = 3;

// An aircraft 60 m from a camera that yaws, in 360 degree footage: the world turns through the image.
void prepare_turn(Scenario& scenario, const glm::dvec3& direction) {
  scenario.project.footage.calibration = "";
  scenario.project.footage.lens_model = LensModel::equirectangular;
  scenario.project.camera.position_m = {0, 0, -150};
  scenario.project.appearance.psf_sigma_px = 0.8;
  write_obj(scenario.path("aircraft.obj"), aircraft(), 2);
  IntruderSettings& intruder = scenario.add("aircraft.obj", {});
  const glm::dvec3 place = glm::dvec3(0, 0, -150) + 60.0 * direction;
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = place - glm::dvec3(1, 2, 0)},
                                   {.frame = 2, .position_m = place + glm::dvec3(1, 2, 0)}};
}

// The frame that a camera which yaws to the left by so many columns of the image takes.
ComposedFrame turned_by(Scenario& scenario, int columns, const cv::Mat& own_body = {}) {
  const int width = scenario.size_px().width;
  scenario.project.camera.yaw_deg = std::remainder(-columns * 360.0 / width, 360.0);
  Scene scene = scenario.opened();
  if (!own_body.empty()) scene.own_body = own_body;
  return composed(scene, 1, even_frame(scenario.size_px(), 120, PixelLayout::yuv444));
}

// The image with its columns moved to the right by so many, those that leave it coming in on the left.
cv::Mat rolled_by(const cv::Mat& image, int columns) {
  const int by = ((columns % image.cols) + image.cols) % image.cols;
  cv::Mat out = image.clone();
  if (by == 0) return out;
  image.colRange(0, image.cols - by).copyTo(out.colRange(by, image.cols));
  image.colRange(image.cols - by, image.cols).copyTo(out.colRange(0, by));
  return out;
}

struct Differs {
  double most = 0;   // codes
  double share = 0;  // of the pixels that the intruder changes: those that differ by more than two codes
};

Differs differing(const ComposedFrame& a, const ComposedFrame& b, int columns) {
  constexpr int kFew_codes = 2;
  Differs differs;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    cv::Mat apart;
    cv::absdiff(rolled_by(a.image.planes[plane], columns), b.image.planes[plane], apart);
    differs.most = std::max(differs.most, cv::norm(apart, cv::NORM_INF));
    differs.share = std::max(differs.share, double(cv::countNonZero(apart > kFew_codes)) / cv::countNonZero(b.mask));
  }
  return differs;
}

}  // namespace

// Floats differ in their last digits between columns, so that codes halfway round either way; views of a turned camera
// are drawn with other pixels, which moves edges by hundredths of a pixel.
TEST_CASE("a camera that yaws sees the same image, rolled: nothing shows where its sides join") {
  for (const double elevation_deg : {0.0, 35.0, -70.0, 84.0, 90.0}) {
    CAPTURE(elevation_deg);
    Scenario scenario(cv::Size(512, 256), kTurnFrames);
    prepare_turn(scenario, sphere_direction(0, elevation_deg));
    const ComposedFrame middle = turned_by(scenario, 0);
    REQUIRE(cv::countNonZero(middle.mask) > 100);
    for (const int columns : {256, 250, 262, -101}) {
      CAPTURE(columns);
      const Differs differs = differing(middle, turned_by(scenario, columns), columns);
      CHECK(differs.most <= 6);
      CHECK(differs.share < 0.03);
    }
  }
}

TEST_CASE(
    "all that is drawn of an intruder goes round: trail, lights, shadow, haze, motion, behind body and occluder") {
  Scenario scenario(cv::Size(512, 256), kTurnFrames);
  prepare_turn(scenario, sphere_direction(0, 15));
  scenario.project.camera.exposure_s = 0.02;
  scenario.project.appearance.haze.visibility_m = 400;
  scenario.project.light = {.kind = LightKind::sun, .sun = {30, 60}, .ground_shadow = 0.8};
  IntruderSettings& intruder = scenario.project.intruders.front();
  intruder.contrail = {.strands = 2, .length_m = 400, .width_m = 4};
  intruder.lights = {.position_cd = 40000, .strobe_cd = 0, .beacon_cd = 0, .landing_cd = 0};
  cv::Mat body = cv::Mat::zeros(256, 512, CV_32FC1);
  body(cv::Rect(240, 100, 14, 20)).setTo(1);  // a part of the aircraft
  const ComposedFrame middle = turned_by(scenario, 0, body);
  const IntruderTruth& whole = middle.truth.intruders.front();
  REQUIRE(whole.has_contrail);
  REQUIRE(whole.has_shadow);
  REQUIRE(whole.lights.size() >= 1);
  REQUIRE(whole.visible_fraction < 0.99);
  for (const int columns : {256, 244, 270}) {
    CAPTURE(columns);
    const ComposedFrame side = turned_by(scenario, columns, rolled_by(body, columns));
    const Differs differs = differing(middle, side, columns);
    CHECK(differs.most <= 8);
    CHECK(differs.share < 0.01);
    const IntruderTruth& truth = side.truth.intruders.front();
    CHECK(truth.visible_fraction == doctest::Approx(whole.visible_fraction).epsilon(0.01));
    CHECK(truth.inside_fraction == doctest::Approx(1).epsilon(1e-3));
    CHECK((truth.has_contrail && truth.has_shadow));
    REQUIRE(truth.lights.size() == whole.lights.size());
    for (std::size_t i = 0; i < truth.lights.size(); ++i) {
      const double column = std::fmod(whole.lights[i].pixel.x + columns + 0.5 + 512, 512) - 0.5;
      CHECK(truth.lights[i].pixel.x == doctest::Approx(column).epsilon(1e-6));
    }
  }
}

TEST_CASE("boxes across the sides: the visible one is of the larger part, the amodal one is whole and beside it") {
  Scenario scenario(cv::Size(512, 256), kTurnFrames);
  prepare_turn(scenario, sphere_direction(0, 5));
  const ComposedFrame middle = turned_by(scenario, 0);
  const IntruderTruth& whole = middle.truth.intruders.front();
  REQUIRE(whole.visible_box.has_value());
  int on_left = 0, on_right = 0;
  for (int columns = 236; columns <= 276; columns += 4) {
    CAPTURE(columns);
    const ComposedFrame side = turned_by(scenario, columns);
    const IntruderTruth& truth = side.truth.intruders.front();
    // Counted in the rolled truth: the columns of each part.
    const cv::Rect there = *whole.visible_box + cv::Point(columns, 0);
    const cv::Rect image(0, 0, 512, 256);
    const cv::Rect at_right = there & image, at_left = (there - cv::Point(512, 0)) & image;
    REQUIRE(truth.visible_box.has_value());
    CHECK((*truth.visible_box & image) == *truth.visible_box);
    const bool is_right = (*truth.visible_box & at_right).area() > 0;
    ++(is_right ? on_right : on_left);
    // The box of a part: that of the whole one's visible pixels in its columns.
    const auto box_of_part = [&](const cv::Rect& part, int moved_by) {
      if (part.empty()) return cv::Rect();
      const cv::Rect columns_of(part.x - moved_by - whole.visible_box->x, 0, part.width, whole.visible_box->height);
      const cv::Rect box = cv::boundingRect(whole.visible(columns_of));
      return box.empty() ? box : box + columns_of.tl() + whole.visible_box->tl() + cv::Point(moved_by, 0);
    };
    const auto check_near = [](const cv::Rect& box, const cv::Rect& expected) {
      CHECK(std::abs(box.x - expected.x) <= 1);
      CHECK(std::abs(box.y - expected.y) <= 1);
      CHECK(std::abs(box.br().x - expected.br().x) <= 1);
      CHECK(std::abs(box.br().y - expected.br().y) <= 1);
    };
    const cv::Rect right_box = box_of_part(at_right, columns), left_box = box_of_part(at_left, columns - 512);
    check_near(*truth.visible_box, is_right ? right_box : left_box);
    const cv::Rect& other = is_right ? left_box : right_box;
    if (other.width > 1) {
      REQUIRE(truth.other_box.has_value());
      check_near(*truth.other_box, other);
      CHECK(truth.other_pixels > 0);
      CHECK(truth.other_pixels <= truth.visible_pixels);
      CHECK(std::abs(truth.other_pixels + truth.visible_pixels - whole.visible_pixels) <= whole.visible_pixels / 20);
    }
    CHECK(cv::countNonZero(truth.visible) == truth.visible_pixels);
    REQUIRE(truth.amodal_box.has_value());
    CHECK(truth.amodal_box->width == doctest::Approx(whole.amodal_box->width).epsilon(1e-6));
    CHECK(truth.amodal_box->x - (is_right ? columns : columns - 512) ==
          doctest::Approx(whole.amodal_box->x).epsilon(1e-6));
    CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(0.01));
  }
  CHECK(on_left > 2);
  CHECK(on_right > 2);
}

TEST_CASE("without its rotors an aircraft has the same boxes across the sides as in the middle") {
  Scenario scenario(cv::Size(512, 256), kTurnFrames);
  prepare_turn(scenario, sphere_direction(0, 5));
  scenario.project.intruders.front().model = {.file =
                                                  (source_dir() / "assets/models/helicopter/helicopter.obj").string()};
  scenario.project.output.label_rotors = LabelRotorsChoice::none;
  const IntruderTruth whole = turned_by(scenario, 0).truth.intruders.front();
  REQUIRE((whole.visible_box && whole.amodal_box));
  scenario.project.output.label_rotors = LabelRotorsChoice::seen;
  CHECK(turned_by(scenario, 0).truth.intruders.front().amodal_box->width > 1.05 * whole.amodal_box->width);
  scenario.project.output.label_rotors = LabelRotorsChoice::none;
  for (const int columns : {255, 256, 257}) {
    CAPTURE(columns);
    const IntruderTruth truth = turned_by(scenario, columns).truth.intruders.front();
    REQUIRE((truth.visible_box && truth.other_box && truth.amodal_box));
    CHECK(truth.amodal_box->width == doctest::Approx(whole.amodal_box->width).epsilon(1e-6));
    CHECK(truth.amodal_box->height == doctest::Approx(whole.amodal_box->height).epsilon(1e-6));
    const double moved = truth.amodal_box->x - whole.amodal_box->x;  // beside the box of the larger part
    CHECK(std::abs(moved - (truth.visible_box->x > 256 ? columns : columns - 512)) < 1e-6);
    CHECK(std::abs(truth.visible_box->width + truth.other_box->width - whole.visible_box->width) <= 2);
    CHECK(std::abs(truth.visible_pixels + truth.other_pixels - whole.visible_pixels) <= whole.visible_pixels / 20 + 2);
    CHECK(truth.visible_fraction == doctest::Approx(whole.visible_fraction).epsilon(0.02));
  }
}

TEST_CASE("an intruder over a pole has all columns, down from the pole's row, and one that is beside it has not") {
  Scenario scenario(cv::Size(512, 256), kTurnFrames);
  prepare_turn(scenario, sphere_direction(0, 90));
  const IntruderTruth over = turned_by(scenario, 0).truth.intruders.front();
  REQUIRE((over.amodal_box && over.visible_box));
  CHECK(over.amodal_box->x == -0.5);
  CHECK(over.amodal_box->width == 512);
  CHECK(over.amodal_box->y == -0.5);
  CHECK(over.visible_box->width == 512);
  CHECK(over.visible_box->y == 0);
  CHECK(over.visible_fraction == doctest::Approx(1).epsilon(0.01));
  scenario.project.intruders.clear();
  prepare_turn(scenario, sphere_direction(0, -75));
  const IntruderTruth beside = turned_by(scenario, 0).truth.intruders.front();
  REQUIRE(beside.amodal_box.has_value());
  CHECK(beside.amodal_box->width < 256);
  CHECK(beside.amodal_box->y + beside.amodal_box->height < 255);
}

TEST_CASE("what needs a flat image or rows of one exposure is refused for 360 degree footage, with its field") {
  Scenario scenario(cv::Size(512, 256), kTurnFrames);
  prepare_turn(scenario, sphere_direction(0, 0));
  const FootageShape footage{.size_px = {512, 256}, .times_s = {0, 0.04, 0.08}};
  const auto error = [&] {
    const Result<Scene> scene = open_scene(scenario.project, footage);
    return scene ? std::string() : scene.error().text();
  };
  CHECK(error().empty());
  FootageShape cropped = footage;
  cropped.part = ImagePart{{1024, 512}, {0, 0}};
  const Result<Scene> of_part = open_scene(scenario.project, cropped);
  REQUIRE_FALSE(of_part);
  CHECK(of_part.error().text().find("footage.crop") != std::string::npos);
  for (const MethodChoice method : {MethodChoice::classic, MethodChoice::plain}) {
    scenario.project.compositing.method = method;
    CHECK(error().find("compositing.method") != std::string::npos);
  }
  scenario.project.compositing.method = MethodChoice::direct;
  scenario.project.camera.readout_s = 0.02;
  CHECK(error().find("camera.readout_s") != std::string::npos);
}

}  // namespace sigs::test
