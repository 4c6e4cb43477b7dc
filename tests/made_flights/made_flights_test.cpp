// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "base/pose.h"
#include "made_flights/made_cases.h"

namespace {

using namespace sigs;
using namespace sigs::made;

const cv::Size kSize_px{640, 480};

Camera camera_of(LensParameters parameters) {
  return {.lens = Lens::make(std::move(parameters)).value(), .size_px = kSize_px};
}
Camera fisheye() {
  return camera_of({LensModel::kannala_brandt, 281, 280.6, 321.1, 238.4, {0.0432, 0.0115, -0.0104, 0.0021}});
}
Camera barrel() {
  return camera_of({LensModel::brown_conrady, 430, 428, 315, 244, {-0.28, 0.09, 0.001, -0.0007}});
}

// OpenCV's projection of a direction in camera axes.
glm::dvec2 projected_by_opencv(const LensParameters& lens, const glm::dvec3& p_in_camera) {
  const cv::Matx33d matrix(lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
  const glm::dvec3 p = optical_of(p_in_camera);
  const std::vector<cv::Point3d> points{{p.x, p.y, p.z}};
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d zero(0, 0, 0);
  if (lens.model == LensModel::kannala_brandt)
    cv::fisheye::projectPoints(points, pixels, zero, zero, matrix, lens.coefficients);
  else
    cv::projectPoints(points, zero, zero, matrix, lens.coefficients, pixels);
  return {pixels[0].x, pixels[0].y};
}

// Where a lamp appears in a frame, from the truth: its row and the instant of that row must agree.
glm::dvec2 expected_px(const Flight& flight, int n, const Lamp& lamp) {
  glm::dvec2 pixel{0, 0.5 * (kSize_px.height - 1)};
  for (int i = 0; i < 20; ++i) {
    const double t_s = flight.time_s(n) + flight.settings().readout_s * (pixel.y / (kSize_px.height - 1) - 0.5);
    const glm::dvec3 way = lamp.at_infinity ? lamp.place : lamp.place - flight.motion().position_m(t_s);
    pixel = projected_by_opencv(flight.camera().lens.parameters(),
                                glm::conjugate(flight.motion().world_from_camera(t_s)) * way);
  }
  return pixel;
}

bool is_well_inside(const glm::dvec2& pixel) {
  return pixel.x > 40 && pixel.y > 40 && pixel.x < kSize_px.width - 41 && pixel.y < kSize_px.height - 41;
}

// Centre of mass of the light within 11 px.
glm::dvec2 centroid_px(const cv::Mat& luma, const glm::dvec2& near_px) {
  double mass = 0;
  glm::dvec2 sum{0};
  const glm::ivec2 middle(glm::round(near_px));
  for (int y = middle.y - 11; y <= middle.y + 11; ++y)
    for (int x = middle.x - 11; x <= middle.x + 11; ++x) {
      const double light = luma.at<std::uint8_t>(y, x) - 16.0;
      mass += light;
      sum += light * glm::dvec2(x, y);
    }
  return sum / mass;
}

std::vector<Lamp> lamps_around() {
  std::vector<Lamp> lamps;
  for (double azimuth_deg = -180; azimuth_deg < 180; azimuth_deg += 20)
    for (const double elevation_deg : {-30.0, -10.0, 10.0, 30.0}) {
      const double azimuth = rad_of_deg(azimuth_deg), elevation = rad_of_deg(elevation_deg);
      lamps.push_back(
          {{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)}});
    }
  for (const double x_m : {250.0, 500.0}) lamps.push_back({{x_m, -180, -20}, false});
  return lamps;
}

// Pixels at which corners of one frame are found again in another, by OpenCV's tracker.
struct Matches {
  std::vector<cv::Point2f> from, to;
};
Matches tracked(const cv::Mat& first, const cv::Mat& second, const cv::Mat& where) {
  Matches all, sound;
  std::vector<std::uint8_t> found;
  std::vector<float> error;
  cv::goodFeaturesToTrack(first, all.from, 400, 0.005, 8, where);
  const cv::TermCriteria fine(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.003);
  cv::calcOpticalFlowPyrLK(first, second, all.from, all.to, found, error, {15, 15}, 3, fine);
  for (std::size_t i = 0; i < all.from.size(); ++i)
    if (found[i] && error[i] < 6) {
      sound.from.push_back(all.from[i]);
      sound.to.push_back(all.to[i]);
    }
  return sound;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Flight flight_of(const char* name, std::uint32_t seed, const Camera& camera) {
  return {case_by_name(name, seed, camera).value(), camera};
}

glm::dvec3 world_ray(const Flight& flight, int n, const cv::Point2f& pixel) {
  return flight.motion().world_from_camera(flight.time_s(n)) * flight.camera().lens.ray({pixel.x, pixel.y}).value();
}

}  // namespace

TEST_CASE("a light of the world appears where OpenCV's lens and the truth at its row's instant put it") {
  for (const Camera& camera : {fisheye(), barrel()})
    for (const double readout_s : {0.0, 0.02}) {
      FlightSettings settings = case_by_name("rolling shutter", 1, camera).value();
      settings.readout_s = readout_s;
      settings.lamps = lamps_around();
      const Flight flight(settings, camera);
      int count = 0;
      for (const int n : {0, 77, 110, 249}) {
        const cv::Mat luma = flight.frame(n).planes[0];
        for (const Lamp& lamp : settings.lamps) {
          const glm::dvec3 way =
              lamp.at_infinity ? lamp.place : lamp.place - flight.motion().position_m(flight.time_s(n));
          const glm::dvec3 in_camera = glm::conjugate(flight.motion().world_from_camera(flight.time_s(n))) * way;
          if (angle_between(in_camera, {1, 0, 0}) > 0.8) continue;
          const glm::dvec2 expected = expected_px(flight, n, lamp);
          if (!is_well_inside(expected)) continue;
          ++count;
          CAPTURE(n);
          CAPTURE(expected.x);
          CAPTURE(expected.y);
          // Rounding to codes leaves 0.02 px of a spot this wide, the bend of the lens across it the rest.
          CHECK(glm::distance(centroid_px(luma, expected), expected) < 0.05);
        }
      }
      CHECK(count > 15);
    }
}

TEST_CASE("with a rolling shutter the truth at the frame's time alone misses lights by more than a pixel") {
  const Camera camera = fisheye();
  FlightSettings settings = case_by_name("rolling shutter", 1, camera).value();
  settings.lamps = lamps_around();
  const Flight rolling(settings, camera);
  settings.readout_s = 0;
  const Flight global(settings, camera);
  double largest_px = 0;
  for (const Lamp& lamp : settings.lamps) {
    const glm::dvec2 a = expected_px(rolling, 110, lamp), b = expected_px(global, 110, lamp);
    if (is_well_inside(a) && is_well_inside(b)) largest_px = std::max(largest_px, glm::distance(a, b));
  }
  CHECK(largest_px > 1);
}

TEST_CASE("mountains move through the image as the camera turns, without bias") {
  FlightSettings settings = case_by_name("vibrating", 2, fisheye()).value();
  settings.noise_codes = 0;  // the tracker's errors by noise would hide those of the images
  const Flight flight(settings, fisheye());
  std::vector<double> errors_px, right_px, down_px;
  for (const int n : {20, 100, 200}) {
    const cv::Mat first = flight.frame(n).planes[0], second = flight.frame(n + 1).planes[0];
    // Rays a little above the horizon: nothing but the panorama.
    cv::Mat_<std::uint8_t> far(first.size(), std::uint8_t{0});
    for (int y = 0; y < far.rows; ++y)
      for (int x = 0; x < far.cols; ++x) {
        const double z = world_ray(flight, n, cv::Point2f(static_cast<float>(x), static_cast<float>(y))).z;
        far(y, x) = z < -0.03 && z > -0.2 ? 255 : 0;
      }
    const Matches matches = tracked(first, second, far);
    const glm::dquat camera_from_world = glm::conjugate(flight.motion().world_from_camera(flight.time_s(n + 1)));
    for (std::size_t i = 0; i < matches.from.size(); ++i) {
      const auto pixel = flight.camera().lens.pixel(camera_from_world * world_ray(flight, n, matches.from[i]));
      if (!pixel) continue;
      const glm::dvec2 error = glm::dvec2(matches.to[i].x, matches.to[i].y) - *pixel;
      errors_px.push_back(glm::length(error));
      right_px.push_back(error.x);
      down_px.push_back(error.y);
    }
  }
  REQUIRE(errors_px.size() > 60);
  CHECK(median(errors_px) < 0.08);  // the tracker's own error on soft textures
  CHECK(std::abs(median(right_px)) < 0.04);
  CHECK(std::abs(median(down_px)) < 0.04);
}

TEST_CASE("points of the ground stay on their epipolar lines, those of moving water do not") {
  for (const char* name : {"vibrating", "water"}) {
    const Flight flight = flight_of(name, 1, fisheye());
    std::vector<double> on_land_rad, right_of_path_rad;
    for (const int n : {30, 150}) {
      const int later = n + 5;
      const cv::Mat first = flight.frame(n).planes[0], second = flight.frame(later).planes[0];
      const Matches matches = tracked(first, second, cv::Mat());
      const glm::dvec3 base_m =
          flight.motion().position_m(flight.time_s(later)) - flight.motion().position_m(flight.time_s(n));
      for (std::size_t i = 0; i < matches.from.size(); ++i) {
        const glm::dvec3 a = world_ray(flight, n, matches.from[i]), b = world_ray(flight, later, matches.to[i]);
        if (a.z < 0.3) continue;
        // Both rays and the way between them lie in one plane.
        const double off_rad = std::abs(glm::dot(glm::normalize(glm::cross(base_m, a)), b));
        (a.y > 0.2 ? right_of_path_rad : on_land_rad).push_back(off_rad);
      }
    }
    REQUIRE(right_of_path_rad.size() > 20);
    REQUIRE(on_land_rad.size() > 20);
    CHECK(median(on_land_rad) < 0.2 / 280);  // 0.2 px
    if (std::string_view(name) == "water")
      CHECK(median(right_of_path_rad) > 0.5 / 280);  // 9 m/s over 0.2 s, up to 500 m away
    else
      CHECK(median(right_of_path_rad) < 0.2 / 280);
  }
}

TEST_CASE("clouds and water move over about 30 % of the image, nothing does in the other cases") {
  for (const std::string& name : case_names()) {
    const double share = flight_of(name.c_str(), 1, fisheye()).moving_share(100);
    CAPTURE(name);
    CAPTURE(share);
    if (name == "clouds" || name == "water")
      CHECK((share > 0.2 && share < 0.4));
    else
      CHECK(share == 0);
  }
}

TEST_CASE("a made flight has the same bytes each time, and others with another seed") {
  const Frame a = flight_of("own body", 1, fisheye()).frame(9), b = flight_of("own body", 1, fisheye()).frame(9);
  const Frame other = flight_of("own body", 2, fisheye()).frame(9);
  for (int plane = 0; plane < 3; ++plane) CHECK(cv::norm(a.planes[plane], b.planes[plane], cv::NORM_INF) == 0);
  CHECK(cv::norm(a.planes[0], other.planes[0], cv::NORM_INF) > 20);
}

TEST_CASE("the own body hides the same pixels in every frame, and only these stand still") {
  const Flight flight = flight_of("own body", 1, fisheye());
  const cv::Mat mask = flight.own_body_mask();
  cv::Mat inner, difference;
  cv::erode(mask, inner, cv::Mat::ones(7, 7, CV_8U));
  cv::absdiff(flight.frame(10).planes[0], flight.frame(60).planes[0], difference);
  CHECK(cv::countNonZero(mask) > 0.08 * static_cast<double>(mask.total()));
  CHECK(cv::mean(difference, inner)[0] < 2.5);  // noise of 1.2 codes in both
  CHECK(cv::mean(difference, mask == 0)[0] > 8);
}
