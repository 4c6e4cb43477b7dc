// SPDX-License-Identifier: MIT
#include "accuracy/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "accuracy/csv.h"
#include "base/statistics.h"
#include "frame/compose_frame.h"

namespace sigs::accuracy {

namespace {

// Pixels that the box touches, grown.
cv::Rect region_around(const Box& box, double sigma_px, cv::Size size_px) {
  const double grow_px = 0.25 * std::max(box.width, box.height) + 8 + 3 * sigma_px;
  const Box grown{box.x - grow_px, box.y - grow_px, box.width + 2 * grow_px, box.height + 2 * grow_px};
  return pixels_touched(grown, 0, {{0, 0}, size_px});
}

struct Moments {
  double area_px = 0;
  glm::dvec2 centroid_px{0, 0};
};

// coverage: CV_64FC1 over rect.
Moments moments_of(const cv::Mat& coverage, const cv::Rect& rect) {
  Moments moments;
  glm::dvec2 sum(0);
  for (int j = 0; j < coverage.rows; ++j)
    for (int i = 0; i < coverage.cols; ++i) {
      const double covered = coverage.at<double>(j, i);
      moments.area_px += covered;
      sum += covered * glm::dvec2(rect.x + i, rect.y + j);
    }
  moments.centroid_px = sum / moments.area_px;  // NaN where there is nothing
  return moments;
}

cv::Mat without_own_body(const cv::Mat& coverage, const cv::Rect& rect, const cv::Mat& own_body) {
  if (own_body.empty() || rect.empty()) return coverage;
  cv::Mat left;
  cv::Mat(1.0 - own_body(rect)).convertTo(left, CV_64F);
  return coverage.mul(left);
}

// The box's part within the image.
Box inside(const Box& box, cv::Size size_px) {
  const double x = std::max(box.x, -0.5);
  const double y = std::max(box.y, -0.5);
  const double right = std::min(box.x + box.width, size_px.width - 0.5);
  const double lower = std::min(box.y + box.height, size_px.height - 0.5);
  return {x, y, right - x, lower - y};
}

double edge_error(const Box& a, const Box& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.x + a.width - b.x - b.width),
                   std::abs(a.y + a.height - b.y - b.height)});
}

Moments shown(const Scene& scene, int frame, const ComposedFrame& composed, ComposeContext& context) {
  cv::Mat coverage;
  if (scene.compositing.method != MethodChoice::direct) {
    if (composed.mask.empty()) return moments_of({}, {});
    composed.mask.convertTo(coverage, CV_64F, 1.0 / 255);
    return moments_of(coverage, {{0, 0}, composed.mask.size()});
  }
  const SceneMoment moment = scene_at(scene, frame);
  const Result<IntruderLayers> layers = intruder_layers(scene, moment, moment.intruders[0], context);
  if (!layers) stop(layers.error().text());
  if (layers->occluded.empty()) return moments_of({}, {});
  layers->occluded.coverage.convertTo(coverage, CV_64F);
  return moments_of(coverage, layers->occluded.rect);
}

}  // namespace

truth::Setup setup_of(const Scene& scene, int frame) {
  const SceneMoment moment = scene_at(scene, frame);
  const PlacedIntruder& placed = moment.intruders[0];
  return {.mesh = &scene.intruders[static_cast<std::size_t>(placed.id)].model->mesh,
          .camera_from_body = placed.camera_from_body,
          .light_in_camera = moment.light_in_camera,
          .light_color = scene.light.color,
          .ambient = scene.light.ambient,
          .lens = scene.camera.lens.parameters(),
          .size_px = scene.footage.size_px,
          .sigma_px = blur_by_distance_px_per_m(scene.compositing) * placed.distance_m(),
          .own_body = scene.own_body};
}

cv::Mat codes_in(const Frame& image, const cv::Rect& region) {
  std::vector<cv::Mat> planes;
  for (const cv::Mat& plane : image.planes) planes.push_back(plane(region));
  cv::Mat codes;
  cv::merge(planes, codes);
  codes.convertTo(codes, CV_64F);
  return codes;
}

Standard standard_of(const Scene& scene, int frame, const Frame& background, int samples_per_side,
                     std::optional<cv::Rect> region) {
  const truth::Setup setup = setup_of(scene, frame);
  Standard standard{.image = reference_image(setup, {.samples_per_side = samples_per_side}),
                    .own_body = scene.own_body};
  const truth::ReferenceImage& image = standard.image;
  if (image.rect.empty()) stop("the truth shows nothing");
  standard.region = region.value_or(region_around(image.silhouette, setup.sigma_px, setup.size_px));
  cv::Mat rgb;
  cv::merge(std::vector<cv::Mat>(background.planes.begin(), background.planes.end()), rgb);
  cv::Mat whole;
  rgb.convertTo(whole, CV_64F);
  over_background(image, rgb).copyTo(whole(image.rect));
  standard.codes = whole(standard.region).clone();
  const Moments visible = moments_of(without_own_body(image.coverage, image.rect, scene.own_body), image.rect);
  standard.visible_px = visible.area_px;
  standard.centroid_px = visible.centroid_px;
  return standard;
}

CodeErrors code_errors(const Standard& standard, const cv::Mat& codes) {
  std::vector<double> errors;
  double squares = 0;
  for (int j = 0; j < codes.rows; ++j)
    for (int i = 0; i < codes.cols; ++i)
      for (int c = 0; c < 3; ++c) {
        errors.push_back(std::abs(codes.at<cv::Vec3d>(j, i)[c] - standard.codes.at<cv::Vec3d>(j, i)[c]));
        squares += errors.back() * errors.back();
      }
  return {.root_mean_square = std::sqrt(squares / static_cast<double>(errors.size())),
          .of_999 = quantile(errors, 0.999),
          .largest = *std::ranges::max_element(errors)};
}

ShapeErrors shape_errors(const Standard& standard, const Scene& scene, int frame, const ComposedFrame& composed,
                         ComposeContext& context) {
  const Moments moments = shown(scene, frame, composed, context);
  ShapeErrors errors{.box_px = std::numeric_limits<double>::quiet_NaN()};
  if (const auto& silhouette = composed.truth.intruders[0].amodal_box)
    errors.box_px = edge_error(inside(*silhouette, scene.footage.size_px), standard.image.silhouette);
  errors.centroid_px = glm::length(moments.centroid_px - standard.centroid_px);
  errors.area_percent = 100 * (moments.area_px / standard.visible_px - 1);
  return errors;
}

}  // namespace sigs::accuracy
