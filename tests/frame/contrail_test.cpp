// SPDX-License-Identifier: MIT
#include "frame/contrail.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "base/image.h"
#include "export/frame_renderer.h"
#include "frame/synthetic_scenes.h"
#include "scene/opened_project.h"

namespace sigs::test {
namespace {

const cv::Rect kTrailImage(0, 0, 200, 120);

float opacity_at(const Layer& layer, int x, int y) {
  if (!layer.rect.contains({x, y})) return 0;
  return layer.color.at<cv::Vec4f>(y - layer.rect.y, x - layer.rect.x)[3];
}

double depth_sum_of(const Layer& layer) {
  double sum = 0;
  for (int y = 0; y < layer.rect.height; ++y)
    for (int x = 0; x < layer.rect.width; ++x) sum += -std::log(1 - double(layer.color.at<cv::Vec4f>(y, x)[3]));
  return sum;
}

constexpr int kJetFrames = 6;
const cv::Size kJetImage(320, 240);

// A jet that crosses 400 m ahead of a camera that stands still, from left to right at 200 m/s.
void prepare_jet(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), kJetImage, kJetFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  IntruderSettings& jet = scenario.add("aircraft.obj", {});
  jet.trajectory.waypoints = {{.frame = 0, .position_m = {400, 0, -150}}, {.frame = 5, .position_m = {400, 40, -150}}};
  jet.contrail.strands = 2;
}

Scene opened_jet(const Project& project) {
  Result<OpenedProject> all = open_project(project, nullptr);
  REQUIRE_MESSAGE(all, all.error().text());
  return std::move(all->scene);
}

}  // namespace

TEST_CASE("the opacity of a straight strand is that of a Gaussian's depth, at any slope") {
  for (const double slope_deg : {0.0, 20.0, 45.0, 90.0, 130.0}) {
    CAPTURE(slope_deg);
    const double slope = slope_deg * std::numbers::pi / 180;
    const glm::dvec2 way(std::cos(slope), std::sin(slope)), middle(100.3, 60.4);
    TrailStrand strand;
    for (int i = -40; i <= 40; ++i) strand.push_back({middle + 10.0 * i * way, 2.5, 0.9});
    const Layer layer = trail_of({{strand}}, {0.5, 0.6, 0.7}, kTrailImage).layer;
    for (int y = 0; y < kTrailImage.height; y += 3)
      for (int x = 0; x < kTrailImage.width; x += 3) {
        const glm::dvec2 off = glm::dvec2(x, y) - middle;
        const double across = off.x * way.y - off.y * way.x;
        const double expected = 1 - std::exp(-0.9 * std::exp(-across * across / (2 * 2.5 * 2.5)));
        CHECK(std::abs(opacity_at(layer, x, y) - expected) < 0.003);  // cut at 3.5 sigmas
      }
    CHECK(cv::countNonZero(layer.coverage) == 0);
    const cv::Vec4f& pixel = layer.color.at<cv::Vec4f>(layer.rect.height / 2, layer.rect.width / 2);
    CHECK(pixel[1] == doctest::Approx(0.6 * pixel[3]));
  }
}

TEST_CASE("strands add up in depth, and one far thinner than a pixel keeps its depth times its width") {
  const auto strand_of = [](double sigma_px, double depth) {
    return TrailStrand{{{-500, 60.2}, sigma_px, depth}, {{700, 60.2}, sigma_px, depth}};
  };
  const Layer one = trail_of({{strand_of(2, 0.4)}}, {1, 1, 1}, kTrailImage).layer;
  const Layer two = trail_of({{strand_of(2, 0.4), strand_of(2, 0.4)}}, {1, 1, 1}, kTrailImage).layer;
  CHECK(depth_sum_of(two) == doctest::Approx(2 * depth_sum_of(one)).epsilon(1e-5));
  const double root = std::sqrt(2 * std::numbers::pi);
  CHECK(depth_sum_of(one) == doctest::Approx(200 * 0.4 * 2 * root).epsilon(0.002));
  const Layer thin = trail_of({{strand_of(0.01, 0.4)}}, {1, 1, 1}, kTrailImage).layer;
  CHECK(depth_sum_of(thin) == doctest::Approx(200 * 0.4 * 0.01 * root).epsilon(0.02));
}

TEST_CASE("each pixel's ice is as far as the strand is there, two strands by their depths") {
  const auto strand_of = [](double depth, double begin_m, double end_m) {
    return TrailStrand{{{0, 60}, 3, depth, begin_m}, {{200, 60}, 3, depth, end_m}};
  };
  const Trail one = trail_of({{strand_of(0.4, 1000, 3000)}}, {1, 1, 1}, kTrailImage);
  const Trail two = trail_of({{strand_of(0.4, 1000, 3000), strand_of(1.2, 2000, 2000)}}, {1, 1, 1}, kTrailImage);
  REQUIRE(one.distance_m.size() == one.layer.rect.size());
  for (const int x : {10, 100, 180}) {
    const cv::Point place = cv::Point(x, 61) - one.layer.rect.tl();
    CHECK(one.distance_m.at<float>(place) == doctest::Approx(1000 + 10 * x));
    CHECK(two.distance_m.at<float>(place) == doctest::Approx(0.25 * (1000 + 10 * x) + 0.75 * 2000));
  }
  CHECK(one.distance_m.at<float>(cv::Point(100, 60 + 10) - one.layer.rect.tl()) ==
        doctest::Approx(opacity_at(one.layer, 100, 70) > 0 ? 2000 : 0));
}

TEST_CASE("places at any distance and sizes without end give a layer within its bounds") {
  for (const double far_px : {1e3, 1e6, 1e9, 1e12}) {
    const TrailStrand strand{{{10, 10}, 1, 0.5}, {{far_px, far_px}, far_px, 0.5}};
    const Layer layer = trail_of({{strand}}, {1, 1, 1}, kTrailImage).layer;
    CHECK((layer.rect & kTrailImage) == layer.rect);
    CHECK(cv::checkRange(layer.color));
  }
  CHECK(trail_of({}, {1, 1, 1}, kTrailImage).layer.empty());
  CHECK(trail_of({{TrailStrand{{{-90, -90}, 1, 1}, {{-80, -80}, 1, 1}}}}, {1, 1, 1}, kTrailImage).layer.empty());
}

TEST_CASE("strands begin behind the aircraft, at its engines, widen with age and end where their length says") {
  Scenario scenario(kJetImage, kJetFrames);
  prepare_jet(scenario);
  ContrailSettings& contrail = scenario.project.intruders.front().contrail;
  contrail.length_m = 100;
  const Scene scene = opened_jet(scenario.project);
  const SceneMoment moment = scene_at(scene, 3);
  const Lens& lens = compositing_camera(scene).lens;
  const std::vector<TrailStrand> strands = contrail_strands(scene, moment, moment.intruders.front(), lens);
  REQUIRE(strands.size() == 2);
  const Mesh& mesh = scene.intruders.front().model->mesh;
  const glm::dvec3 at = moment.intruders.front().camera_from_body.translation_m;
  for (const TrailStrand& strand : strands) {
    const double length_m = double(mesh.high_m.x) - double(mesh.low_m.x);
    const double engine_m =
        (&strand == &strands.front() ? -0.17 : 0.17) * (double(mesh.high_m.y) - double(mesh.low_m.y));
    // It flies to the right: its own right is towards the camera, which looks along x.
    const double begin_m = -double(mesh.low_m.x) + 0.1 * length_m;
    const glm::dvec2 begin = *lens.pixel(at + glm::dvec3(-engine_m, -begin_m, 0));
    const glm::dvec2 end = *lens.pixel(at + glm::dvec3(-engine_m, -begin_m - 100, 0));
    CHECK(glm::distance(strand.front().pixel, begin) < 1e-6);
    CHECK(glm::distance(strand.back().pixel, end) < 1e-6);
    CHECK(strand.front().depth == 0);  // the ice forms
    CHECK(strand.back().depth == 0);   // and is gone
    const double px_per_m = lens.pixels_per_radian(at) / glm::length(at);
    CHECK(strand.front().sigma_px == doctest::Approx(px_per_m).epsilon(0.02));  // a quarter of 4 m
    CHECK(strand.back().sigma_px == doctest::Approx(px_per_m * std::hypot(1, 100 / 200.0)).epsilon(0.05));
  }
  contrail.strands = 0;
  const Scene without = opened_jet(scenario.project);
  CHECK(contrail_strands(without, moment, moment.intruders.front(), lens).empty());
}

TEST_CASE("a hovering body leaves no trail, and one that starts behind the camera is drawn as far as it is seen") {
  Scenario scenario(kJetImage, kJetFrames);
  prepare_jet(scenario);
  auto& waypoints = scenario.project.intruders.front().trajectory.waypoints;
  waypoints[1].position_m = {400, 0.1, -150};
  const auto strands_in = [&](int frame) {
    const Scene scene = opened_jet(scenario.project);
    const SceneMoment moment = scene_at(scene, frame);
    return contrail_strands(scene, moment, moment.intruders.front(), compositing_camera(scene).lens);
  };
  CHECK(strands_in(3).empty());
  waypoints = {{.frame = 0, .position_m = {30, 2, -153}}, {.frame = 5, .position_m = {70, 2, -153}}};
  const std::vector<TrailStrand> strands = strands_in(5);
  REQUIRE(strands.size() == 2);
  CHECK(strands.front().size() < 100);
  for (const TrailPoint& point : strands.front()) CHECK(std::isfinite(point.pixel.x + point.sigma_px + point.depth));
}

TEST_CASE("a contrail brightens the sky behind the aircraft, and changes neither its box nor its share of the image") {
  Scenario scenario(kJetImage, kJetFrames);
  prepare_jet(scenario);
  FrameRenderer renderer;
  const auto rendered = [&] { return std::move(*renderer.render(scenario.project, 3)); };
  const ComposedFrame with = rendered();
  scenario.project.intruders.front().contrail.strands = 0;
  const ComposedFrame without = rendered();
  const IntruderTruth& seen = with.truth.intruders.front();
  CHECK(seen.has_contrail);
  CHECK_FALSE(without.truth.intruders.front().has_contrail);
  CHECK(seen.visible_box == without.truth.intruders.front().visible_box);
  CHECK(seen.amodal_box == without.truth.intruders.front().amodal_box);
  CHECK(seen.visible_pixels == without.truth.intruders.front().visible_pixels);
  cv::Mat changed = with.image.planes[0] != without.image.planes[0];
  const cv::Rect box = cv::boundingRect(changed);
  REQUIRE_FALSE(box.empty());
  CHECK(box.x == 0);  // 4 km of trail to the left
  CHECK(box.x + box.width <= seen.visible_box->x + seen.visible_box->width);
  CHECK(cv::countNonZero(with.mask) > cv::countNonZero(without.mask));
}

TEST_CASE("haze and occluders come before each place of a trail by its own distance") {
  // It flies away and to the right.
  const glm::dvec3 begin_m(400, -60, 0), end_m(1400, 60, 0);  // from the camera
  Scenario scenario(kJetImage, kJetFrames);
  prepare_jet(scenario);
  IntruderSettings& jet = scenario.project.intruders.front();
  const glm::dvec3 camera_m(0, 0, -150);
  jet.trajectory.waypoints = {{.frame = 0, .position_m = camera_m + begin_m},
                              {.frame = 5, .position_m = camera_m + end_m}};
  jet.contrail.opacity = 0.9;
  HazeSettings& haze = scenario.project.appearance.haze;
  haze = {.airlight = AirlightChoice::color, .airlight_color = {0, 0, 0}};
  const Lens lens = compositing_camera(opened_jet(scenario.project)).lens;
  const auto light_of_trail = [&](double occluder_m) {
    Scene scene = opened_jet(scenario.project);
    const SceneMoment moment = scene_at(scene, 5);
    if (occluder_m > 0)
      scene.occluder = {cv::Mat(kJetImage, CV_32FC1, cv::Scalar(1)), moment.world_from_camera, occluder_m};
    ComposeContext context;
    const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders.front(), context);
    REQUIRE(layers);
    std::vector<double> light;
    for (const double share : {0.05, 0.3, 0.6, 0.8}) {
      const glm::dvec2 pixel = glm::round(*lens.pixel(glm::mix(begin_m, end_m, share)));
      const cv::Point at = cv::Point(int(pixel.x), int(pixel.y)) - layers->contrail.rect.tl();
      REQUIRE(cv::Rect({0, 0}, layers->contrail.rect.size()).contains(at));
      light.push_back(layers->contrail.color.at<cv::Vec4f>(at)[1]);
    }
    return light;
  };
  const std::vector<double> clear = light_of_trail(0), behind_trees = light_of_trail(800);
  haze.visibility_m = 2000;
  const std::vector<double> hazed = light_of_trail(0);
  for (std::size_t i = 0; i < clear.size(); ++i) {
    CAPTURE(i);
    const double distance_m = glm::length(glm::mix(begin_m, end_m, std::vector{0.05, 0.3, 0.6, 0.8}[i]));
    REQUIRE(clear[i] > 0.01);
    CHECK(hazed[i] / clear[i] == doctest::Approx(std::exp(-3 * distance_m / 2000)).epsilon(0.03));
    CHECK(behind_trees[i] == doctest::Approx(distance_m < 800 ? clear[i] : 0));
  }
}

TEST_CASE("what a trail before its own aircraft hides counts as hidden") {
  Scenario scenario(kJetImage, kJetFrames);
  prepare_jet(scenario);
  IntruderSettings& jet = scenario.project.intruders.front();
  // It flies away below the camera: the trail is before it.
  jet.trajectory.waypoints = {{.frame = 0, .position_m = {100, 0, -148}}, {.frame = 5, .position_m = {140, 0, -148}}};
  FrameRenderer renderer;
  const auto fraction_with = [&](int strands, double opacity) {
    jet.contrail.strands = strands;
    jet.contrail.opacity = opacity;
    jet.contrail.width_m = 12;
    const Result<ComposedFrame> composed = renderer.render(scenario.project, 5);
    REQUIRE(composed);
    return composed->truth.intruders.front().visible_fraction;
  };
  const double clear = fraction_with(0, 0.5);
  CHECK(clear == doctest::Approx(1).epsilon(0.01));
  CHECK(fraction_with(3, 0.2) < 0.95 * clear);
  CHECK(fraction_with(3, 0.999) < 0.1);
  // Towards the camera the trail is behind.
  std::swap(jet.trajectory.waypoints[0].position_m, jet.trajectory.waypoints[1].position_m);
  CHECK(fraction_with(3, 0.999) == doctest::Approx(1).epsilon(0.01));
}

}  // namespace sigs::test
