// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "camera/virtual_camera.h"
#include "compositor/blend.h"
#include "frame/render_plan.h"
#include "frame/synthetic_scenes.h"
#include "project/json.h"
#include "scene/opened_project.h"

namespace sigs::test {
namespace {

// Weights of `in` samples from first_in in `out` samples from first_out: the Gaussian of whole
// pixels, cut at three sigmas.
cv::Mat kernel(int first_out, int out, int first_in, int in, double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma_px * sigma_px));
  cv::Mat weights = cv::Mat::zeros(out, in, CV_64FC1);
  for (int o = 0; o < out; ++o)
    for (int i = 0; i < in; ++i) {
      const double apart = first_out + o - first_in - i;
      if (std::abs(apart) <= reach)
        weights.at<double>(o, i) = std::exp(-0.5 * apart * apart / (sigma_px * sigma_px)) / sum;
    }
  return weights;
}

// The blur by its definition, in doubles: every pixel of the sharp layer to every pixel of the image.
Layer blurred_in_full(const Layer& sharp, double sigma_px, cv::Size image_size_px) {
  const cv::Mat down = kernel(0, image_size_px.height, sharp.rect.y, sharp.rect.height, sigma_px);
  const cv::Mat across = kernel(0, image_size_px.width, sharp.rect.x, sharp.rect.width, sigma_px);
  std::vector<cv::Mat> channels;
  cv::split(sharp.color, channels);
  for (cv::Mat& channel : channels) {
    channel.convertTo(channel, CV_64F);
    channel = down * channel * across.t();
    channel.convertTo(channel, CV_32F);
  }
  Layer out{{{0, 0}, image_size_px}, {}, cv::Mat::zeros(image_size_px, CV_32FC1)};
  cv::merge(channels, out.color);
  return out;
}

struct Looked {
  Scene scene;
  SceneMoment moment;
  Camera camera;
};

Looked looked(Scene scene, int frame) {
  SceneMoment moment = scene_at(scene, frame);
  Camera camera = compositing_camera(scene);
  return {std::move(scene), std::move(moment), std::move(camera)};
}

// Drawn and warped at full resolution over all that blur carries into the image.
Layer sharp_in_full(const Looked& look, const PlacedIntruder& placed, double sigma_px, ComposeContext& context) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  const cv::Size size = look.scene.footage.size_px;
  const cv::Rect grown(-reach, -reach, size.width + 2 * reach, size.height + 2 * reach);
  const Model& model = *look.scene.intruders[static_cast<std::size_t>(placed.id)].model;
  const auto silhouette = silhouette_of(model.points_m, placed.camera_from_body, look.camera.lens);
  REQUIRE(silhouette);
  REQUIRE(silhouette->all_have_image);
  const cv::Rect target = pixels_touched(silhouette->box, 1, grown);
  IntruderLayers layers = placed_layers(look.scene, look.moment, placed, look.camera);
  LensTable lens(look.camera);
  const RenderPlan plan = render_plan_for(layers, lens, look.scene, look.moment);
  const auto views = virtual_cameras(look.camera, plan.corners, target, look.scene.compositing.supersampling, 4096);
  const auto drawn = rendered_views(views, plan, look.scene, layers, *context.renderer().value());
  REQUIRE(drawn.has_value());
  return warped(*drawn, look.camera, target);
}

Project read_sample(const std::string& name) {
  Result<ReadProject> read = read_project(source_dir() / "projects" / name / (name + ".json"));
  if (!read) FAIL(read.error().text());
  return std::move(read->project);
}

Scene sample_scene(const std::string& name) {
  FootageShape shape{.size_px = {1280, 960}};
  for (int n = 0; n < 200; ++n) shape.times_s.push_back(n / 25.0);
  Result<Scene> scene = open_scene(read_sample(name), shape);
  if (!scene) FAIL(scene.error().text());
  scene->own_body = cv::Mat();
  return std::move(*scene);
}

double rmse(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L2) / std::sqrt(static_cast<double>(a.total()));
}

// How far the layer blended over a background is from the one made by the definition, in code values of the first
// plane.
void check_against_full(const Layer& soft, const Layer& full, double sigma_px, const Frame& background) {
  Frame wanted = cloned(background);
  blend_over(wanted, full, BlendChoice::linear);
  Frame got = cloned(background);
  if (!soft.empty()) blend_over(got, soft, BlendChoice::linear);
  const double off = rmse(got.planes[0], wanted.planes[0]);
  const double maximum = cv::norm(got.planes[0], wanted.planes[0], cv::NORM_INF);
  MESSAGE("sigma " << sigma_px << ": off by " << off << " code values (root of mean square), at most " << maximum
                   << "; the blurred intruder moves them by "
                   << cv::norm(background.planes[0], wanted.planes[0], cv::NORM_INF));
  CHECK(off <= 0.5);
  CHECK(maximum <= 2);
  if (soft.empty()) CHECK(maximum <= 1);
}

// Over even images of these lumas.
void check_against_full(Looked look, const PlacedIntruder& placed, double sigma_px, std::span<const uchar> lumas) {
  const cv::Size size_px = look.scene.footage.size_px;
  ComposeContext context;
  look.scene.compositing.blur_px_per_m = sigma_px / placed.distance_m();
  const Result<IntruderLayers> layers = intruder_layers(look.scene, look.moment, placed, context);
  REQUIRE(layers.has_value());
  const Layer full = blurred_in_full(sharp_in_full(look, placed, sigma_px, context), sigma_px, size_px);
  for (const uchar luma : lumas) check_against_full(layers->occluded, full, sigma_px, even_frame(size_px, luma));
}

double seconds_for(const Scenario& scenario, ComposedFrame& frame) {
  const Scene scene = scenario.opened();
  ComposeContext context;
  REQUIRE(context.renderer().has_value());
  const Frame background = even_frame(scenario.size_px(), 100);
  const auto start = std::chrono::steady_clock::now();
  Result<ComposedFrame> made = compose_frame(scene, 1, background, context);
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!made) FAIL(made.error().text());
  frame = std::move(*made);
  return s;
}

}  // namespace

TEST_CASE("wide blur of the sample projects is that of the full resolution") {
  const struct {
    const char* project;
    int frame;
  } all[] = {{"crossing", 90}, {"head-on", 120}, {"two-intruders", 60}};
  for (const auto& sample : all)
    for (const double sigma_px : {16.0, 16.01, 50.0, 150.0}) {
      CAPTURE(sample.project);
      const Looked look = looked(sample_scene(sample.project), sample.frame);
      check_against_full(look, look.moment.intruders.back(), sigma_px, std::array<uchar, 2>{20, 180});
    }
}

TEST_CASE("wide blur of a near aircraft, also one across the edge or beside it, is that of the full resolution") {
  for (const double right_m : {3.0, 14.0, 22.0}) {
    CAPTURE(right_m);
    Scenario scenario;
    add_aircraft(scenario, {26, right_m, -152});
    for (const double sigma_px : {16.0, 16.01, 33.0, 50.0, 150.0}) {
      const Looked look = looked(scenario.opened(), 1);
      check_against_full(look, look.moment.intruders[0], sigma_px, std::array<uchar, 2>{0, 100});
    }
  }
}

TEST_CASE("wide blur keeps the energy within a thousandth") {
  for (const double sigma_px : {16.01, 20.0, 33.3, 60.0, 100.0}) {
    CAPTURE(sigma_px);
    Scenario scenario({960, 720});
    add_aircraft(scenario, {40, 1.3, -149.2});
    scenario.project.compositing.blur_px_per_m = sigma_px / std::hypot(40, 1.3, 0.8);
    const Looked look = looked(scenario.opened(), 1);
    ComposeContext context;
    const Result<IntruderLayers> layers = intruder_layers(look.scene, look.moment, look.moment.intruders[0], context);
    REQUIRE(layers.has_value());
    const cv::Scalar before = cv::sum(layers->warped.color);
    const cv::Scalar after = cv::sum(layers->occluded.color);
    for (int c = 0; c < 4; ++c) CHECK(after[c] == doctest::Approx(before[c]).epsilon(0.001));
    CHECK(cv::sum(layers->occluded.coverage)[0] == doctest::Approx(cv::sum(layers->warped.coverage)[0]).epsilon(1e-9));
  }
}

TEST_CASE("the truth does not depend on how far the light is blurred") {
  std::vector<IntruderTruth> truths;
  for (const double sigma_px : {15.0, 17.0, 40.0}) {
    Scenario scenario;
    add_aircraft(scenario, {26, 12, -152});
    scenario.project.compositing.blur_px_per_m = sigma_px / std::hypot(26, 12, 2);
    truths.push_back(composed(scenario.opened(), 1, even_frame(scenario.size_px(), 100)).truth.intruders[0]);
    CHECK(truths.back().in_image);
    REQUIRE(truths.back().visible_box);
    CHECK(truths.back().visible_box == truths.front().visible_box);
    CHECK(truths.back().amodal_box == truths.front().amodal_box);
    CHECK(truths.back().visible_fraction == doctest::Approx(truths.front().visible_fraction).epsilon(0.01));
  }
}

TEST_CASE("whatever the blur and the distance, a frame takes little time") {
  for (const MethodChoice method : {MethodChoice::direct, MethodChoice::classic})
    for (const double blur_px_per_m : {0.5, 10.0})
      for (const double ahead_m : {20.0, 60.0, 550.0, 1e5, 1e7, 1e8}) {
        CAPTURE(static_cast<int>(method));
        CAPTURE(blur_px_per_m);
        CAPTURE(ahead_m);
        Scenario scenario;
        scenario.project.compositing = {.method = method, .blur_px_per_m = blur_px_per_m};
        add_aircraft(scenario, {ahead_m, 0, -150});
        ComposedFrame frame;
        CHECK(seconds_for(scenario, frame) < 5);  // milliseconds; but the machine may be busy
        CHECK(frame.truth.intruders[0].in_image);
      }
}

TEST_CASE("an intruder blurred until no sample can change is left out, and no other") {
  for (const double sigma_px : {100.0, 200.0, 400.0, 800.0, 1e4, 1e6, 1e9}) {
    CAPTURE(sigma_px);
    Scenario scenario;
    write_obj(scenario.path("plate.obj"), {{{-0.01, -3, -3}, {0.01, 3, 3}, {1, 1, 1}}}, 1);
    scenario.add("plate.obj", {90, 0, -150});  // 20 by 20 px
    Scene scene = scenario.opened();
    scene.compositing.blur_px_per_m = sigma_px / 90;
    scene.light.ambient = 1;
    const Frame black = even_frame(scenario.size_px(), 16);  // where samples are most sensitive
    const ComposedFrame frame = composed(scene, 1, black);
    const double change = 400 / (2 * 3.14159265 * sigma_px * sigma_px) * 12.92 * 255;  // of opaque white
    if (change < 0.45) CHECK(frame.mask.empty());
    if (change < 0.45) CHECK(same_planes(frame.image, black));
    if (change > 1.2) CHECK(!same_planes(frame.image, black));
    const IntruderTruth& truth = frame.truth.intruders[0];
    CHECK(truth.in_image);
    CHECK(truth.visible_fraction == doctest::Approx(frame.mask.empty() ? 0 : 1).epsilon(0.01));
  }
}

TEST_CASE("around the camera a sphere stays opaque before a wide blur") {
  Scenario scenario;
  write_sphere_obj(scenario.path("sphere.obj"), 8);
  scenario.add("sphere.obj", {4, 0, -150});
  scenario.project.compositing.supersampling = 1;
  Scene scene = scenario.opened();
  scene.compositing.blur_px_per_m = 100.0 / 4;
  const ComposedFrame frame = composed(scene, 1, even_frame(scenario.size_px(), 100));
  double minimum = 0;
  cv::minMaxIdx(frame.mask, &minimum);
  CHECK(minimum >= 254);
  CHECK(frame.truth.intruders[0].in_image);
}

}  // namespace sigs::test
