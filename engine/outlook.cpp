// SPDX-License-Identifier: MIT
#include "outlook.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "annotation/measure.h"
#include "base/ensure.h"
#include "scene/scene_at.h"
#include "see_intruder.h"

namespace sigs {

namespace {

constexpr std::array<double, 4> kShares{1, 0.75, 0.5, 0.25};  // of the way from the middle to an outermost point
constexpr float kHides = 0.5F;

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
  int inside = 0;  // the picture
  int behind = 0;  // of these, the own body
};

void count(const glm::dvec2& pixel, cv::Size size_px, const cv::Mat& own_body, Count& counted) {
  // Compared before the conversion: near the plane of a lens, pixels are beyond what an int holds.
  if (!(pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x < size_px.width - 0.5 && pixel.y < size_px.height - 0.5)) return;
  ++counted.inside;
  if (own_body.empty()) return;
  const int x = static_cast<int>(std::floor(pixel.x + 0.5));
  const int y = static_cast<int>(std::floor(pixel.y + 0.5));
  counted.behind += own_body.at<float>(y, x) >= kHides ? 1 : 0;
}

Sighting sighting_of(const std::vector<glm::dvec2>& images, cv::Size size_px, const cv::Mat& own_body) {
  glm::dvec2 middle(0);
  for (const glm::dvec2& pixel : images) middle += pixel / double(images.size());
  Count counted;
  for (const double share : kShares)
    for (const glm::dvec2& pixel : images) count(middle + share * (pixel - middle), size_px, own_body, counted);
  if (counted.inside == 0) return Sighting::out_of_view;
  if (counted.behind == 0) return Sighting::in_view;
  return counted.behind == counted.inside ? Sighting::hidden : Sighting::partly_hidden;
}

}  // namespace

OutlookPoints::OutlookPoints(const Scene& scene) : scene_(&scene), camera_(seeing_camera(scene)) {}

Outlook OutlookPoints::at(int intruder, int frame) const {
  const SceneMoment moment = scene_at(*scene_, frame);
  const auto placed = std::find_if(moment.intruders.begin(), moment.intruders.end(),
                                   [&](const PlacedIntruder& candidate) { return candidate.id == intruder; });
  ENSURE(placed != moment.intruders.end());
  Outlook outlook{.frame = frame, .distance_m = placed->distance_m()};
  const Model* const model = scene_->intruders[static_cast<std::size_t>(intruder)].model;
  if (model == nullptr) return outlook;
  const std::vector<glm::dvec2> images = images_of(model->outermost_m, placed->camera_from_body, camera_.lens);
  if (images.empty()) return outlook;
  outlook.silhouette = box_around(images);
  outlook.size_px = std::max(outlook.silhouette->width, outlook.silhouette->height);
  outlook.sighting = sighting_of(images, scene_->footage.size_px, scene_->own_body);
  return outlook;
}

}  // namespace sigs
