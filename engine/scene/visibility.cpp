// SPDX-License-Identifier: MIT
#include "scene/visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ensure.h"
#include "base/text.h"
#include "scene/scene_parts.h"

namespace sigs {

namespace {

// One decimal below 10 px, none above, and no trailing ".0".
std::string pixels_text(double size_px) {
  const std::string text = fmt::format("{:.{}f}", size_px, size_px < 9.95 ? 1 : 0);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string frames_text(const Visibility& visibility) {
  const int checked = visibility.frames_checked;
  const std::string text = count_text(checked, "frame");
  return checked >= visibility.frames ? text : fmt::format("{} looked at (of {})", text, visibility.frames);
}

std::string size_text(const Visibility& visibility) {
  if (visibility.largest_px <= 0) return "";
  const std::string low = pixels_text(visibility.smallest_px);
  const std::string high = pixels_text(visibility.largest_px);
  return low == high ? fmt::format(", {} px across", low) : fmt::format(", {} to {} px across", low, high);
}

constexpr std::array<double, 4> kShares{1, 0.75, 0.5,
                                        0.25};  // of the way from the mean of the points to an outermost point
constexpr int kMaxEstimates = 100'000;          // of one intruder in one frame
constexpr int kMinSampledFrames = 2;
constexpr double kMinSize_px = 1;  // what is smaller throughout leaves no mark in the image

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

// Numbers of points.
struct PointCounts {
  int inside = 0;    // in the image
  int occluded = 0;  // of these, behind the own body
};

void count_point(glm::dvec2 pixel, cv::Size size_px, const Lens& lens, const cv::Mat& own_body, PointCounts& counts) {
  if (lens.period_px() > 0) pixel.x -= size_px.width * std::floor((pixel.x + 0.5) / size_px.width);
  // Compared before the conversion: near the plane of a lens, pixels are beyond what an int holds.
  if (!(pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < size_px.width - 0.5 && pixel.y < size_px.height - 0.5)) return;
  ++counts.inside;
  if (own_body.empty()) return;
  const int x = static_cast<int>(std::floor(pixel.x + 0.5));
  const int y = static_cast<int>(std::floor(pixel.y + 0.5));
  counts.occluded += own_body.at<float>(y, x) >= kOccludingOpacity ? 1 : 0;
}

VisibilityState state_of(const std::vector<glm::dvec2>& images, cv::Size size_px, const Lens& lens,
                         const cv::Mat& own_body) {
  glm::dvec2 mean(0);
  for (const glm::dvec2& pixel : images) mean += pixel / double(images.size());
  PointCounts counts;
  for (const double share : kShares)
    for (const glm::dvec2& pixel : images) count_point(mean + share * (pixel - mean), size_px, lens, own_body, counts);
  if (counts.inside == 0) return VisibilityState::out_of_view;
  if (counts.occluded == 0) return VisibilityState::in_view;
  return counts.occluded == counts.inside ? VisibilityState::occluded : VisibilityState::partly_occluded;
}

// Visibilities by so many frames, spread evenly over the range with first and last.
std::vector<Visibility> sampled_visibilities(const VisibilityEstimator& estimator, const Scene& scene, int frames) {
  const int length = scene.last_frame - scene.first_frame;
  const bool has_attitude = scene.horizon_is_known || !scene.motion.source.attitude.empty();
  std::vector<Visibility> visibilities(scene.intruders.size(),
                                       {.frames = length + 1, .is_estimate = true, .has_attitude = has_attitude});
  for (int i = 0; i < frames; ++i) {
    const double share = frames > 1 ? double(i) / (frames - 1) : 0;
    const int frame = scene.first_frame + static_cast<int>(std::lround(share * length));
    const std::vector<VisibilityEstimate> estimates = estimator.all_at(frame);
    for (std::size_t j = 0; j < visibilities.size(); ++j) add(visibilities[j], estimates[j]);
  }
  return visibilities;
}

}  // namespace

void Visibility::count_visible(double size_px) {
  ++visible;
  if (size_px <= 0) return;
  smallest_px = largest_px > 0 ? std::min(smallest_px, size_px) : size_px;
  largest_px = std::max(largest_px, size_px);
}

std::string text_of(const Visibility& visibility) {
  if (visibility.visible == 0) return "never visible in " + frames_text(visibility);
  return fmt::format("visible in {}{} of {}{}", visibility.is_estimate ? "about " : "", visibility.visible,
                     frames_text(visibility), size_text(visibility));
}

VisibilityEstimator::VisibilityEstimator(const Scene& scene) : scene_(&scene), camera_(compositing_camera(scene)) {}

VisibilityEstimate VisibilityEstimator::of(const PlacedIntruder& placed, int frame) const {
  VisibilityEstimate estimate{.frame = frame, .distance_m = placed.distance_m()};
  const Model* const model = scene_->intruders[static_cast<std::size_t>(placed.id)].model;
  if (model == nullptr) return estimate;
  const Lens lens = camera_.lens.around(placed.camera_from_body.translation_m);
  const std::vector<glm::dvec2> images = images_of(model->outermost_m, placed.camera_from_body, lens);
  estimate.is_behind_camera = images.empty() && placed.camera_from_body.translation_m.x < -double(model->mesh.radius_m);
  if (images.empty()) return estimate;
  estimate.silhouette = box_around(images);
  estimate.size_px = std::max(estimate.silhouette->width, estimate.silhouette->height);
  estimate.visibility_state = state_of(images, scene_->footage.size_px, lens, scene_->own_body);
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

bool any_in_view(const Scene& scene, int frame) {
  const std::vector<VisibilityEstimate> estimates = VisibilityEstimator(scene).all_at(frame);
  return std::any_of(estimates.begin(), estimates.end(), [](const VisibilityEstimate& estimate) {
    return estimate.visibility_state != VisibilityState::out_of_view;
  });
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
  const int affordable = std::max(kMinSampledFrames, kMaxEstimates / intruders);
  const VisibilityEstimator estimator(scene);
  std::vector<Visibility> visibilities =
      sampled_visibilities(estimator, scene, std::min({frames, max_frames, affordable}));
  const auto is_never_visible = [](const Visibility& visibility) { return visibility.visible == 0; };
  if (std::none_of(visibilities.begin(), visibilities.end(), is_never_visible) ||
      max_frames >= std::min(frames, affordable))
    return visibilities;
  const std::vector<Visibility> all = sampled_visibilities(estimator, scene, std::min(frames, affordable));
  for (std::size_t i = 0; i < visibilities.size(); ++i)
    if (is_never_visible(visibilities[i])) visibilities[i] = all[i];
  return visibilities;
}

std::optional<Problem> never_visible(const Visibility& visibility, const std::string& name, std::size_t intruder) {
  if (visibility.frames_checked == 0) return std::nullopt;
  if (visibility.visible > 0) {
    if (visibility.largest_px >= kMinSize_px || visibility.largest_px <= 0) return std::nullopt;
    return Problem{key_of_intruder(intruder) + ".trajectory",
                   fmt::format("\"{}\" is too small to be seen, at most {:.2g} px large; bring it nearer, or check its "
                               "model's scale",
                               name, visibility.largest_px)};
  }
  const int outside = visibility.frames_checked - visibility.occluded - visibility.behind_camera;
  std::string reasons;
  const auto add_reason = [&](int count, const char* where) {
    if (count > 0) reasons += fmt::format("{}{} in {}", reasons.empty() ? "" : ", ", where, count);
  };
  add_reason(visibility.behind_camera, "behind the camera");
  add_reason(outside, "outside the image");
  add_reason(visibility.occluded, "behind the own body");
  const char* const axes = visibility.behind_camera + outside > 0 && !visibility.has_attitude
                               ? "; the camera looks along world X, Y is to its right, Z down"
                               : "";
  return Problem{key_of_intruder(intruder) + ".trajectory",
                 fmt::format("\"{}\" is {} ({}){}", name, text_of(visibility), reasons, axes)};
}

}  // namespace sigs
