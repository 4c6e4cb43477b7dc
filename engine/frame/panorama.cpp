// SPDX-License-Identifier: MIT
#include "frame/panorama.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compositor/blend.h"

namespace sigs {

namespace {

// Whether a direction lies within the cone of three others, which do not lie in one plane.
bool is_between(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double whole = glm::dot(a, glm::cross(b, c));
  return whole != 0 && glm::dot(direction, glm::cross(b, c)) / whole >= 0 &&
         glm::dot(direction, glm::cross(c, a)) / whole >= 0 && glm::dot(direction, glm::cross(a, b)) / whole >= 0;
}

bool covers(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body, const glm::dvec3& direction) {
  std::vector<glm::dvec3> corners;
  corners.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) corners.push_back(camera_from_body * glm::dvec3(vertex.position_m));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (is_between(direction, corners[mesh.indices[i]], corners[mesh.indices[i + 1]], corners[mesh.indices[i + 2]]))
      return true;
  return false;
}

Layer moved(const Layer& layer, int by_px) {
  Layer there = layer;
  if (!there.empty()) there.rect.x += by_px;
  return there;
}

// The part of an intruder that lies within the image once it is moved by so many columns.
IntruderLayers part_of(const IntruderLayers& whole, int by_px, const cv::Rect& image) {
  IntruderLayers part = whole;
  const auto cut = [&](Layer& layer) { layer = clipped(moved(layer, by_px), image); };
  if (part.silhouette) part.silhouette->box.x += by_px;
  if (part.body) part.body->box.x += by_px;
  part.warped = moved(clipped(whole.warped, whole.window), by_px);
  for (Layer* const layer : {&part.hazed, &part.motion_blurred}) *layer = moved(*layer, by_px);
  for (Layer* const layer : {&part.blurred, &part.occluded, &part.contrail, &part.shadow}) cut(*layer);
  for (LampLayer& lamp : part.lamps) cut(lamp.layer);
  std::erase_if(part.lamps, [](const LampLayer& lamp) { return lamp.layer.empty(); });
  part.window = image;
  return part;
}

bool has_any(const IntruderLayers& part, const cv::Rect& image) {
  return !(part.warped.rect & image).empty() || !part.contrail.empty() || !part.shadow.empty() || !part.lamps.empty();
}

}  // namespace

cv::Rect window_around(double column_px, const Lens& lens, cv::Size image_size_px) {
  const cv::Rect image({0, 0}, image_size_px);
  if (!(lens.period_px() > 0)) return image;
  const auto first = static_cast<int>(std::lround(column_px - (image_size_px.width - 1) / 2.0));
  return {first, 0, image_size_px.width, image_size_px.height};
}

cv::Rect window_of(const std::optional<Silhouette>& silhouette, double margin_px, const Lens& lens,
                   cv::Size image_size_px) {
  if (!silhouette || silhouette->box.width + 2 * (margin_px + 2) >= image_size_px.width) return {{0, 0}, image_size_px};
  return window_around(silhouette->box.x + silhouette->box.width / 2, lens, image_size_px);
}

std::optional<Silhouette> with_covered_poles(std::optional<Silhouette> silhouette, const Mesh& mesh,
                                             const Pose<frame::Camera, frame::Body>& camera_from_body, const Lens& lens,
                                             cv::Size image_size_px) {
  if (!silhouette || !(lens.period_px() > 0) || silhouette->box.width <= lens.period_px() / 2) return silhouette;
  Box& box = silhouette->box;
  const double low = box.y + box.height;
  const bool zenith = covers(mesh, camera_from_body, {0, 0, -1});
  const bool nadir = covers(mesh, camera_from_body, {0, 0, 1});
  if (zenith) box = {-0.5, -0.5, double(image_size_px.width), low + 0.5};
  if (nadir) box = {-0.5, box.y, double(image_size_px.width), image_size_px.height - 0.5 - box.y};
  return silhouette;
}

cv::Rect larger_part(const cv::Rect& rect, const Lens& lens, cv::Size image_size_px) {
  if (!(lens.period_px() > 0)) return rect;
  const cv::Rect image({0, 0}, image_size_px);
  cv::Rect largest;
  for (const int turn : {0, -1, 1}) {
    const cv::Rect part = (rect + cv::Point(turn * image_size_px.width, 0)) & image;
    if (part.area() > largest.area()) largest = part;
  }
  return largest;
}

std::vector<IntruderLayers> parts_in_image(IntruderLayers layers, const Lens& lens, cv::Size image_size_px) {
  std::vector<IntruderLayers> parts;
  const cv::Rect image({0, 0}, image_size_px);
  if (!(lens.period_px() > 0)) {
    parts.push_back(std::move(layers));
    return parts;
  }
  for (LampTruth& lamp : layers.lamp_truths)
    lamp.pixel.x -= image.width * std::floor((lamp.pixel.x + 0.5) / image.width);
  const int middle = layers.window.x + image.width / 2;
  const int own = column_round(middle, image.width) - middle;  // brings the window's middle into the image
  for (const int turn : {0, -1, 1}) {
    IntruderLayers part = part_of(layers, own + turn * image.width, image);
    if (turn == 0) {
      parts.push_back(std::move(part));
      layers.lamp_truths.clear();
      layers.given_up.clear();
      layers.op_counts = {};
      layers.draw_s = 0;
    } else if (has_any(part, image)) {
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

IntruderTruth joined(std::span<const IntruderTruth> parts) {
  const auto shows_less = [](const IntruderTruth& a, const IntruderTruth& b) {
    return std::pair(a.visible_pixels, a.inside_fraction) < std::pair(b.visible_pixels, b.inside_fraction);
  };
  IntruderTruth truth = *std::max_element(parts.begin(), parts.end(), shows_less);
  if (parts.size() == 1) return truth;
  truth.inside_fraction = truth.visible_fraction = 0;
  truth.lights.clear();
  for (const IntruderTruth& part : parts) {
    if (part.visible_box && *part.visible_box != *truth.visible_box && part.visible_pixels > truth.other_pixels) {
      truth.other_box = part.visible_box;
      truth.other_pixels = part.visible_pixels;
    }
    truth.in_image = truth.in_image || part.in_image;
    truth.inside_fraction = std::min(truth.inside_fraction + part.inside_fraction, 1.0);
    truth.visible_fraction = std::min(truth.visible_fraction + part.visible_fraction, 1.0);
    truth.has_contrail = truth.has_contrail || part.has_contrail;
    truth.has_shadow = truth.has_shadow || part.has_shadow;
    truth.lights.insert(truth.lights.end(), part.lights.begin(), part.lights.end());
  }
  return truth;
}

}  // namespace sigs
