// SPDX-License-Identifier: MIT
#include "scene/visibility_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ensure.h"
#include "frame/render_plan.h"
#include "truth/measure.h"

namespace sigs {

namespace {

constexpr std::array<double, 4> kShares{1, 0.75, 0.5, 0.25};  // of the way from the middle to an outermost point
constexpr float kOccludes = 0.5F;
constexpr int kMaxEstimates = 100'000;  // at an intruder in a frame
constexpr int kMinFrames = 2;

std::vector<glm::dvec2> images_of(const std::vector<glm::vec3>& points_m,
                                  const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens) {
  std::vector<glm::dvec2> images;
  images.reserve(points_m.size());
  for (const glm::vec3& point : points_m)
    if (const std::optional<glm::dvec2> pixel = lens.pixel(camera_from_body * glm::dvec3(point)))
      images.push_back(*pixel);
  return images;
}

Box box_around(const std::vector<glm::dvec2>& images) {
  glm::dvec2 low = images.front();
  glm::dvec2 high = images.front();
  for (const glm::dvec2& pixel : images) {
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  return {low.x, low.y, high.x - low.x, high.y - low.y};
}

struct Count {
  int inside = 0;  // the image
  int behind = 0;  // of these, the own body
};

void count(const glm::dvec2& pixel, cv::Size size_px, const cv::Mat& own_body, Count& counted) {
  // Compared before the conversion: near the plane of a lens, pixels are beyond what an int holds.
  if (!(pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < size_px.width - 0.5 && pixel.y < size_px.height - 0.5)) return;
  ++counted.inside;
  if (own_body.empty()) return;
  const int x = static_cast<int>(std::floor(pixel.x + 0.5));
  const int y = static_cast<int>(std::floor(pixel.y + 0.5));
  counted.behind += own_body.at<float>(y, x) >= kOccludes ? 1 : 0;
}

VisibilityState sighting_of(const std::vector<glm::dvec2>& images, cv::Size size_px, const cv::Mat& own_body) {
  glm::dvec2 middle(0);
  for (const glm::dvec2& pixel : images) middle += pixel / double(images.size());
  Count counted;
  for (const double share : kShares)
    for (const glm::dvec2& pixel : images) count(middle + share * (pixel - middle), size_px, own_body, counted);
  if (counted.inside == 0) return VisibilityState::out_of_view;
  if (counted.behind == 0) return VisibilityState::in_view;
  return counted.behind == counted.inside ? VisibilityState::occluded : VisibilityState::partly_occluded;
}

// The footage's frames, spread evenly with first and last.
std::vector<Visibility> sampled_visibilities(const VisibilityEstimator& points, const Scene& scene, int frames) {
  const int length = scene.last_frame - scene.first_frame;
  std::vector<Visibility> visibilities(scene.intruders.size(), Visibility{.frames = length + 1, .is_estimate = true});
  for (int i = 0; i < frames; ++i) {
    const double share = frames > 1 ? double(i) / (frames - 1) : 0;
    const int frame = scene.first_frame + static_cast<int>(std::lround(share * length));
    const std::vector<VisibilityEstimate> estimates = points.all_at(frame);
    for (std::size_t j = 0; j < visibilities.size(); ++j) add(visibilities[j], estimates[j]);
  }
  return visibilities;
}

}  // namespace

VisibilityEstimator::VisibilityEstimator(const Scene& scene) : scene_(&scene), camera_(compositing_camera(scene)) {}

VisibilityEstimate VisibilityEstimator::of(const PlacedIntruder& placed, int frame) const {
  VisibilityEstimate estimate{.frame = frame, .distance_m = placed.distance_m()};
  const Model* const model = scene_->intruders[static_cast<std::size_t>(placed.id)].model;
  if (model == nullptr) return estimate;
  estimate.is_behind_camera = placed.camera_from_body.translation_m.x < -double(model->mesh.radius_m);
  const std::vector<glm::dvec2> images = images_of(model->outermost_m, placed.camera_from_body, camera_.lens);
  if (images.empty()) return estimate;
  estimate.silhouette = box_around(images);
  estimate.size_px = std::max(estimate.silhouette->width, estimate.silhouette->height);
  estimate.visibility_state = sighting_of(images, scene_->footage.size_px, scene_->own_body);
  return estimate;
}

VisibilityEstimate VisibilityEstimator::at(int intruder, int frame) const {
  const SceneMoment moment = scene_at(*scene_, frame);
  const auto placed = std::find_if(moment.intruders.begin(), moment.intruders.end(),
                                   [&](const PlacedIntruder& candidate) { return candidate.id == intruder; });
  ENSURE(placed != moment.intruders.end());
  return of(*placed, frame);
}

std::vector<VisibilityEstimate> VisibilityEstimator::all_at(int frame) const {
  std::vector<VisibilityEstimate> estimates(scene_->intruders.size());
  for (const PlacedIntruder& placed : scene_at(*scene_, frame).intruders)
    estimates[static_cast<std::size_t>(placed.id)] = of(placed, frame);
  return estimates;
}

void add(Visibility& visibility, const VisibilityEstimate& estimate) {
  visibility.is_estimate = true;
  ++visibility.frames_checked;
  if (estimate.visibility_state == VisibilityState::in_view ||
      estimate.visibility_state == VisibilityState::partly_occluded)
    visibility.count_visible(estimate.size_px);
  visibility.behind_camera += estimate.is_behind_camera ? 1 : 0;
  visibility.occluded += estimate.visibility_state == VisibilityState::occluded ? 1 : 0;
}

std::vector<Visibility> estimated_visibilities(const Scene& scene, int max_frames) {
  const int frames = scene.last_frame - scene.first_frame + 1;
  const auto intruders = static_cast<int>(std::clamp<std::size_t>(scene.intruders.size(), 1, kMaxEstimates));
  const int affordable = std::max(kMinFrames, kMaxEstimates / intruders);
  const VisibilityEstimator points(scene);
  std::vector<Visibility> visibilities =
      sampled_visibilities(points, scene, std::min({frames, max_frames, affordable}));
  const auto is_never_visible = [](const Visibility& visibility) { return visibility.visible == 0; };
  if (std::none_of(visibilities.begin(), visibilities.end(), is_never_visible) ||
      max_frames >= std::min(frames, affordable))
    return visibilities;
  const std::vector<Visibility> all = sampled_visibilities(points, scene, std::min(frames, affordable));
  for (std::size_t i = 0; i < visibilities.size(); ++i)
    if (is_never_visible(visibilities[i])) visibilities[i] = all[i];
  return visibilities;
}

std::optional<Problem> never_visible(const Visibility& visibility, const std::string& name, std::size_t intruder) {
  if (visibility.visible > 0 || visibility.frames_checked == 0) return std::nullopt;
  const int outside = visibility.frames_checked - visibility.occluded - visibility.behind_camera;
  std::string why;
  const auto add = [&](int count, const char* where) {
    if (count > 0) why += (why.empty() ? " (" : ", ") + std::string(where) + " in " + std::to_string(count);
  };
  add(visibility.behind_camera, "behind the camera");
  add(outside, "outside the image");
  add(visibility.occluded, "behind the own body");
  why += ")";
  if (visibility.behind_camera + outside > 0)
    why += "; the camera looks along world X where it has no attitude, Y is to its right, Z down";
  return Problem{"intruders[" + std::to_string(intruder) + "].trajectory",
                 "\"" + name + "\" is " + text_of(visibility) + why};
}

}  // namespace sigs
