// SPDX-License-Identifier: MIT
#include "scene/visibility.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "frame/render_plan.h"
#include "frame/synthetic_scenes.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "scene/scene_at.h"
#include "truth/measure.h"

namespace sigs::test {
namespace {

double apart_px(const Box& a, const Box& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.x + a.width - b.x - b.width),
                   std::abs(a.y + a.height - b.y - b.height)});
}

double allowed_px(const Box& truth) {
  return std::max(0.5, 0.01 * std::max(truth.width, truth.height));
}

// Of all measuring points, as the annotation has it.
std::optional<Silhouette> whole_silhouette(const Scene& scene, int intruder, int frame) {
  const SceneMoment moment = scene_at(scene, frame);
  for (const PlacedIntruder& placed : moment.intruders)
    if (placed.id == intruder)
      return silhouette_of(scene.intruders[static_cast<std::size_t>(intruder)].model->points_m, placed.camera_from_body,
                           compositing_camera(scene).lens);
  return std::nullopt;
}

Trajectory hovering_at(const glm::dvec3& p_in_world, const Attitude& course) {
  // Flies along a course so slowly that it stays where it is.
  const glm::dvec3 along = rotation_of(course) * glm::dvec3(1, 0, 0);
  return Trajectory::make({{0, p_in_world - 1e-3 * along}, {2e-3, p_in_world + 1e-3 * along}}, {}).value();
}

// A plate of 20 x 20 px in the middle of the image, before a camera with the mask.
struct Plate {
  explicit Plate(const cv::Mat& mask, const glm::dvec3& p_in_camera = {300, 0, 0}) {
    write_obj(scenario.path("plate.obj"), {{{-1, -10, -10}, {1, 10, 10}}}, 1);
    scenario.add("plate.obj", p_in_camera + glm::dvec3(0, 0, -150));
    scene = scenario.opened();
    scene->own_body = mask;
  }
  [[nodiscard]] VisibilityEstimate estimate() const { return VisibilityEstimator(*scene).at(0, 0); }

  Scenario scenario;
  std::optional<Scene> scene;
};

cv::Mat mask_over(const cv::Rect& rect, float opacity = 1) {
  cv::Mat mask = cv::Mat::zeros(240, 320, CV_32FC1);
  mask(rect & cv::Rect(0, 0, 320, 240)) = opacity;
  return mask;
}

}  // namespace

TEST_CASE("the estimate's box is the annotation's in every frame of the samples") {
  for (const char* const name : kSampleProjects) {
    const Scene scene = open_scene(sample_project(name), sample_footage()).value();
    const VisibilityEstimator points(scene);
    for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
      const int id = static_cast<int>(i);
      CHECK(scene.intruders[i].model->outermost_m.size() <= 200);
      for (int frame = 0; frame < 200; ++frame) {
        CAPTURE(name);
        CAPTURE(frame);
        const VisibilityEstimate estimate = points.at(id, frame);
        const std::optional<Silhouette> truth = whole_silhouette(scene, id, frame);
        REQUIRE(truth.has_value() == estimate.silhouette.has_value());
        if (!truth) continue;
        CHECK(apart_px(*estimate.silhouette, truth->box) <= allowed_px(truth->box));
        CHECK(estimate.size_px == std::max(estimate.silhouette->width, estimate.silhouette->height));
        CHECK(estimate.frame == frame);
      }
    }
  }
}

TEST_CASE("from two lengths to twenty kilometres and from every side the box stays the annotation's") {
  Scene scene = open_scene(sample_project("two-intruders"), sample_footage()).value();
  double worst = 0;
  for (const double lengths : {2.0, 5.0, 30.0, 500.0})
    for (int view = 0; view < 60; ++view) {
      for (SceneIntruder& intruder : scene.intruders) {
        const double length_m = intruder.model->mesh.high_m.x - intruder.model->mesh.low_m.x;
        const double off_axis = -0.9 + 0.03 * view;
        const glm::dvec3 towards(std::cos(off_axis), std::sin(off_axis), 0.3 * std::sin(5.0 * view));
        intruder.trajectory = hovering_at(scene.motion.world_from_camera_at_start * (lengths * length_m * towards),
                                          {0, 0.4 * std::sin(3.0 * view), 0.7 * view});
      }
      const VisibilityEstimator points(scene);
      for (int id = 0; id < 2; ++id) {
        const VisibilityEstimate estimate = points.at(id, 0);
        const std::optional<Silhouette> truth = whole_silhouette(scene, id, 0);
        REQUIRE(truth.has_value());
        REQUIRE(estimate.silhouette.has_value());
        const double share = apart_px(*estimate.silhouette, truth->box) / allowed_px(truth->box);
        worst = std::max(worst, share);
        CHECK_MESSAGE(share <= 1, lengths, " lengths, view ", view, ", intruder ", id);
      }
    }
  MESSAGE("worst: ", worst, " of what is allowed");
}

TEST_CASE("the distance is that of the truth") {
  const Plate plate(cv::Mat(), {300, 40, -30});
  CHECK(plate.estimate().distance_m == doctest::Approx(std::sqrt(300.0 * 300 + 40 * 40 + 30 * 30)));
}

TEST_CASE("an intruder behind the camera has no image") {
  const Plate plate(cv::Mat(), {-300, 0, 0});
  const VisibilityEstimate estimate = plate.estimate();
  CHECK_FALSE(estimate.silhouette.has_value());
  CHECK(estimate.size_px == 0);
  CHECK(estimate.visibility_state == VisibilityState::out_of_view);
  CHECK(estimate.distance_m == doctest::Approx(300));
}

TEST_CASE("beside the image it is out of view, on its edge in view") {
  CHECK(Plate(cv::Mat(), {300, 200, 0}).estimate().visibility_state == VisibilityState::out_of_view);
  CHECK(Plate(cv::Mat(), {300, 0, -140}).estimate().visibility_state == VisibilityState::out_of_view);
  CHECK(Plate(cv::Mat(), {300, 160, 0}).estimate().visibility_state == VisibilityState::in_view);
  CHECK(Plate(cv::Mat(), {300, 0, 0}).estimate().visibility_state == VisibilityState::in_view);
}

TEST_CASE("larger than the image it is in view though its outline is not") {
  const VisibilityEstimate estimate = Plate(cv::Mat(), {9, 0, 0}).estimate();
  CHECK(estimate.size_px > 320);
  CHECK(estimate.visibility_state == VisibilityState::in_view);
}

TEST_CASE("the own body hides what lies behind it, wholly or in part") {
  CHECK(Plate(mask_over({0, 0, 320, 240})).estimate().visibility_state == VisibilityState::occluded);
  CHECK(Plate(mask_over({0, 0, 160, 240})).estimate().visibility_state == VisibilityState::partly_occluded);
  CHECK(Plate(mask_over({0, 0, 140, 240})).estimate().visibility_state == VisibilityState::in_view);
  CHECK(Plate(mask_over({156, 116, 8, 8})).estimate().visibility_state ==
        VisibilityState::partly_occluded);  // its middle alone
  CHECK(Plate(mask_over({0, 0, 320, 240}, 0.4F)).estimate().visibility_state ==
        VisibilityState::in_view);  // a soft shadow
}

TEST_CASE("an intruder half outside the image counts by its part inside") {
  // The right half lies outside; the left half is behind the body, or is not.
  CHECK(Plate(mask_over({300, 0, 20, 240}), {300, 160, 0}).estimate().visibility_state == VisibilityState::occluded);
  CHECK(Plate(mask_over({0, 0, 300, 240}), {300, 160, 0}).estimate().visibility_state == VisibilityState::in_view);
}

TEST_CASE("the estimate for the plain method is without the lens") {
  Scene scene = open_scene(sample_project("crossing"), sample_footage()).value();
  const Box warped = VisibilityEstimator(scene).at(0, 0).silhouette.value_or(Box{});
  scene.compositing.method = MethodChoice::plain;
  const Box straight = VisibilityEstimator(scene).at(0, 0).silhouette.value_or(Box{});
  CHECK(apart_px(warped, straight) > 5);
  CHECK(apart_px(straight, whole_silhouette(scene, 0, 0)->box) <= allowed_px(straight));
}

TEST_CASE("a tiny intruder far away is in view and small") {
  const VisibilityEstimate estimate = Plate(cv::Mat(), {1e7, 0, 0}).estimate();
  CHECK(estimate.visibility_state == VisibilityState::in_view);
  CHECK(estimate.size_px == doctest::Approx(300 * 20 / 1e7).epsilon(1e-3));
}

}  // namespace sigs::test
