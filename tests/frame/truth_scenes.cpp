// SPDX-License-Identifier: MIT
#include "frame/truth_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "camera/calibration_text.h"
#include "camera/camera.h"
#include "frame/synthetic_scenes.h"
#include "scene/scene_at.h"

namespace sigs::test {
namespace {

const cv::Scalar kSky(122, 151, 190);  // red, green, blue

Frame sky(cv::Size size_px) {
  Frame frame{.layout = PixelLayout::rgb};
  for (int plane = 0; plane < 3; ++plane)
    frame.planes[static_cast<std::size_t>(plane)] = cv::Mat(size_px, CV_8UC1, cv::Scalar(kSky[plane]));
  return frame;
}

// At the place at 0.04 s, the time of frame 1.
Trajectory straight_flight(const glm::dvec3& p_in_world_m, const glm::dvec3& velocity_mps) {
  Result<Trajectory> flight = Trajectory::make(
      {TimedWaypoint{0, p_in_world_m - 0.04 * velocity_mps}, TimedWaypoint{0.08, p_in_world_m + 0.04 * velocity_mps}},
      {});
  REQUIRE(flight.has_value());
  return *flight;
}

cv::Mat right_half(const Sight& sight, const Lens& lens) {
  const std::optional<glm::dvec2> middle_px = lens.pixel(sight.direction);
  REQUIRE(middle_px.has_value());
  const int first = static_cast<int>(std::lround(middle_px->x));
  cv::Mat mask = cv::Mat::zeros(sight.size_px, CV_32FC1);
  mask.colRange(first, mask.cols).setTo(1);
  return mask;
}

Scene scene_of(const Sight& sight, Scenario& scenario) {
  const LensParameters& lens = sight.lens;
  if (needs_calibration(lens.model)) {
    std::ofstream(scenario.path("lens.xml"))
        << calibration_xml({.lens = lens, .size_px = sight.size_px, .comment = "", .numbers = {}});
    scenario.project.footage.calibration = "lens.xml";
  } else {
    scenario.project.footage.calibration = "";
    scenario.project.footage.lens_model = lens.model;
  }
  scenario.project.light = {.kind = sight.light,
                            .position_m = sight.light_m,
                            .ambient = sight.ambient,
                            .sun = {sight.sun_azimuth_deg, sight.sun_elevation_deg},
                            .exposure = 0.9};
  scenario.project.compositing.supersampling = sight.supersampling;
  IntruderSettings& intruder = scenario.add((source_dir() / "assets/models" / sight.model).string(), {500, 0, -150});
  intruder.model.up = "+z";
  Scene scene = scenario.opened();
  const double distance_m = 2 * double{scene.models.front()->mesh.radius_m} * lens.fx / sight.extent_px;
  const glm::dvec3 camera_m = scene.motion.world_from_camera_at_start.translation_m;
  scene.intruders.front().trajectory = straight_flight(camera_m + glm::normalize(sight.direction) * distance_m,
                                                       sight.speed_mps * glm::normalize(sight.heading));
  scene.appearance = sight.look;
  if (sight.exposure_s > 0) scene.motion.exposures = {{0, sight.exposure_s}};
  scene.compositing.blur_px_per_m = sight.sigma_px / distance_m;
  if (sight.half_hidden) scene.own_body = right_half(sight, scene.camera.lens);
  return scene;
}

// Of the exposure, if it is known, the part of `moments` around since_s.
truth::Setup setup_of(const Scene& scene, const Sight& sight, double since_s = 0, int moments = 1) {
  const SceneMoment moment = scene_at(scene, 1);
  return {.mesh = &scene.models.front()->mesh,
          .camera_from_body = camera_from_body_at(scene, 0, moment.time_s + since_s),
          .light_in_camera = moment.light_in_camera,
          .light_color = scene.light.color,
          .ambient = scene.light.ambient,
          .in_sun = scene.light.kind == LightKind::sun,
          .to_sun_in_camera = moment.to_sun_in_camera,
          .up_in_camera = {0, 0, -1},  // the camera is level
          .sky_color = scene.light.sky_color,
          .ground_color = scene.light.ground_color,
          .exposure = scene.light.exposure,
          .time_s = moment.time_s + since_s,
          .blades_seen_s = sight.exposure_s > 0 ? sight.exposure_s / moments : 0.002,
          .lens = sight.lens,
          .size_px = sight.size_px,
          .sigma_px = std::hypot(sight.sigma_px, sight.look.psf_sigma_px),
          .own_body = scene.own_body};
}

// The mean of many moments while the shutter is open.
truth::ReferenceImage exposed(const Scene& scene, const Sight& sight, const truth::Settings& settings) {
  if (!(sight.exposure_s > 0)) return truth::reference_image(setup_of(scene, sight), settings);
  constexpr int kMoments = 24;
  cv::Mat sum = cv::Mat::zeros(sight.size_px, CV_64FC4);
  cv::Rect rect;
  for (int i = 0; i < kMoments; ++i) {
    const double since_s = sight.exposure_s * ((i + 0.5) / kMoments - 0.5);
    const truth::ReferenceImage one = truth::reference_image(setup_of(scene, sight, since_s, kMoments), settings);
    sum(one.rect) += one.color / kMoments;
    rect = rect.empty() ? one.rect : rect | one.rect;
  }
  truth::ReferenceImage mean = truth::reference_image(setup_of(scene, sight), settings);
  mean.rect = rect;
  mean.color = sum(rect).clone();
  return mean;
}

// Tones and haze as the formulas of docs/formulas.md have them. BT.709's luminance.
void put_behind_haze(truth::ReferenceImage& image, const AppearanceSettings& look, double distance_m) {
  const double through = look.haze.visibility_m ? std::exp(-3 * distance_m / *look.haze.visibility_m) : 1;
  image.color.forEach<cv::Vec4d>([&](cv::Vec4d& color, const int*) {
    const double gray = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    for (int c = 0; c < 3; ++c) {
      const double own = gray + look.saturation * (color[c] - gray) + look.black * color[3];
      color[c] = through * own + (1 - through) * look.haze.airlight_color[c] * color[3];
    }
  });
}

cv::Mat codes_of(const Frame& frame, const cv::Rect& rect) {
  cv::Mat codes;
  cv::merge(std::vector<cv::Mat>{frame.planes[0](rect), frame.planes[1](rect), frame.planes[2](rect)}, codes);
  codes.convertTo(codes, CV_64FC3);
  return codes;
}

cv::Mat reached(const cv::Mat& color) {
  cv::Mat opacity;
  cv::extractChannel(color, opacity, 3);
  cv::Mat near;
  cv::dilate(opacity > 1e-4, near, cv::Mat::ones(5, 5, CV_8UC1));
  return near;
}

}  // namespace

Compared compared(const Sight& sight, const truth::Settings& settings) {
  Scenario scenario(sight.size_px);
  const Scene scene = scene_of(sight, scenario);
  const Frame background = sky(sight.size_px);
  ComposeContext context(ComposeSettings{.samples_per_pixel = sight.samples_per_pixel});
  const Result<ComposedFrame> composed = compose_frame(scene, 1, background, context);
  REQUIRE(composed.has_value());
  const ComposedFrame& frame = *composed;
  Compared result{.reference = exposed(scene, sight, settings), .annotation = frame.truth.intruders.front()};
  put_behind_haze(result.reference, sight.look, glm::length(result.annotation.position_m));
  REQUIRE_FALSE(result.reference.rect.empty());
  const cv::Mat below(sight.size_px, CV_8UC3, kSky);
  result.truth = truth::over_background(result.reference, below);
  result.engine = codes_of(frame.image, result.reference.rect);
  result.near = reached(result.reference.color);
  return result;
}

double Compared::rmse() const {
  return cv::norm(engine, truth, cv::NORM_L2, near) / std::sqrt(3.0 * cv::countNonZero(near));
}

double Compared::worst() const {
  return cv::norm(engine, truth, cv::NORM_INF, near);
}

double Compared::percentile(double p) const {
  std::vector<double> apart;
  for (int y = 0; y < near.rows; ++y)
    for (int x = 0; x < near.cols; ++x) {
      if (near.at<uchar>(y, x) == 0) continue;
      const cv::Vec3d difference = engine.at<cv::Vec3d>(y, x) - truth.at<cv::Vec3d>(y, x);
      for (int c = 0; c < 3; ++c) apart.push_back(std::abs(difference[c]));
    }
  if (apart.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(p * double(apart.size() - 1));
  std::nth_element(apart.begin(), apart.begin() + at, apart.end());
  return apart[static_cast<std::size_t>(at)];
}

double Compared::bias() const {
  const cv::Scalar mean = cv::mean(engine - truth, near);
  return (mean[0] + mean[1] + mean[2]) / 3;
}

LensParameters pinhole_lens() {
  return {.fx = 535, .fy = 535, .cx = 319.5, .cy = 239.5, .coefficients = {0, 0, 0, 0}};
}

LensParameters tangential_lens() {
  return {.fx = 535, .fy = 535, .cx = 319.5, .cy = 239.5, .coefficients = {-0.1, 0.02, 0.05, -0.08}};
}

LensParameters sphere_lens(cv::Size size_px) {
  return equirectangular_camera(size_px).lens.parameters();
}

LensParameters omnidirectional_lens() {
  return {.model = LensModel::omnidirectional,
          .fx = 220,
          .fy = 220,
          .cx = 319.5,
          .cy = 319.5,
          .coefficients = {0.954589, -0.0226, 0.00167, 0.00018, 0.00044, 0.00047}};
}

LensParameters fisheye_lens() {
  return {.model = LensModel::kannala_brandt,
          .fx = 215,
          .fy = 215,
          .cx = 319.5,
          .cy = 319.5,
          .coefficients = {-0.01, 0.002, -0.0003, 0.00001}};
}

}  // namespace sigs::test
