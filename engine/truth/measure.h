// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>

#include "base/image.h"
#include "base/pose.h"
#include "camera/camera.h"
#include "camera/row_motion.h"
#include "truth/annotation.h"

namespace sigs {

// Points whose pixel lies farther from the first one, along either axis, are not told of: a pinhole shows what passes
// beside it at a distance without limit, which says nothing of the body.
inline constexpr double kFarthestTold_px = 1e5;

// The whole silhouette through the lens.
struct Silhouette {
  Box box;                           // of all points that have an image
  bool all_have_image = true;        // false: some lie behind the camera or beyond the lens' valid field
  bool is_cut = false;               // some lie farther than kFarthestTold_px
  std::optional<Box> near_box = {};  // where some do: of the others; none: all do
};

// The smallest box around the images of the points. Nothing where no point has an image. Where the lens' columns repeat
// (Lens::period_px), the smallest on the cylinder: in one piece, also where it extends beyond the image's side.
//   points_in_body  the model's vertices, metres
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                      const Lens& lens);

// As a rolling shutter sees it.
[[nodiscard]] std::optional<Silhouette> silhouette_of(std::span<const glm::vec3> points_in_body,
                                                      const RowMotion& motion, const Lens& lens);

// A pixel is the intruder's where its coverage is at least this share of what its most covered pixel has: small enough
// for the tips of thin wings. What rendering spills beyond the silhouette's own pixels is larger and removed
// separately.
inline constexpr float kMinCoverageShare = 1.0F / 64.0F;

// Less than half a code value is invisible.
inline constexpr float kMinVisibleCoverage = 0.5F / 255.0F;

// Largest coverage of any pixel, 0 for none. coverage is CV_32FC1.
[[nodiscard]] float max_coverage(const cv::Mat& coverage);

// Smallest box of whole pixels around those covered by at least `min_coverage` and by more than nothing; coverage is
// CV_32FC1 over rect.
[[nodiscard]] std::optional<cv::Rect> covered_box(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage);

// Which pixels of box are covered by at least `min_coverage` and by more than nothing: CV_8UC1 of its size, 255 or 0.
// coverage is CV_32FC1 over rect, which holds box.
[[nodiscard]] cv::Mat covered_pixels(const cv::Mat& coverage, const cv::Rect& rect, float min_coverage,
                                     const cv::Rect& box);

// The side of the level plane through the camera on which points lie. No points count as on it.
//   up_in_camera  unit vector, away from the ground
[[nodiscard]] HorizonSide horizon_side_of(std::span<const glm::vec3> points_in_body,
                                          const Pose<frame::Camera, frame::Body>& camera_from_body,
                                          const glm::dvec3& up_in_camera);

// Sum of the coverage, in pixels.
[[nodiscard]] double area_px(const cv::Mat& coverage);

// coverage (CV_32FC1 over rect) without what a nearer intruder's layer hides: times (1 - its opacity).
void occlude_coverage(cv::Mat& coverage, const cv::Rect& rect, const Layer& nearer);

// One intruder as it was composited, for measuring. Layers share their samples with those that were composited.
struct MeasuredLayers {
  int id = 0;
  std::string name;
  Pose<frame::Camera, frame::Body> camera_from_body;
  glm::dquat world_from_body{1, 0, 0, 0};
  std::optional<Silhouette> silhouette;    // none where no point of the model has an image
  std::span<const glm::vec3> outermost_m;  // vertices that bound the model, body axes
  double whole_area_px = 0;                // of the silhouette, the part outside the image included
  Layer inside;                            // warped, not blurred, clipped to the image
  float max_coverage = 0;                  // of the warped layer, the part outside the image included
  Layer occluded;                          // as it was blended: blurred, without what the own body hides
};

// What can be measured of an intruder.
//   nearer        intruders that hide it, far to near
//   mask          ComposedFrame::mask; what was not composited is not visible in it (the classic method cannot show
//                 what lies beyond the edge of its undistorted image). Empty: nothing is visible
//   up_in_camera  unit vector away from the ground, camera frame; none: where the horizon lies is not known
[[nodiscard]] IntruderTruth measured(const MeasuredLayers& layers, std::span<const MeasuredLayers> nearer,
                                     const cv::Mat& mask, const std::optional<glm::dvec3>& up_in_camera);

// The share of an intruder's part in the image that the own body or nearer intruders hide: 0 to 1. 0 where
// nothing of it lies there.
[[nodiscard]] double occluded_fraction(const IntruderTruth& truth);

// Hidden by more than a twentieth, as Pascal VOC's guidelines (2008 and later) draw the line: smaller shares occur at
// the soft edges of masks.
[[nodiscard]] bool is_occluded(const IntruderTruth& truth);

// Linear luminance, 0 (black) to 1 (white), of each 8-bit code of luma.
using LuminanceOfCode = std::array<float, 256>;

// The part of the image that counts as an intruder's background: its rectangle, grown on each side by half of its
// larger extent, by 4 pixels at least and 64 at most.
[[nodiscard]] cv::Rect background_rect(const cv::Rect& intruder, cv::Size image_size_px);

// How well an intruder stands out. Background is the footage's own image over background.rect, behind the intruder too,
// without what the own body covers. Luminance is that of luma alone, which is exact for grey.
//   image       luma of the composed frame, CV_8UC1, over truth.visible_box
//   background  luma of the footage, CV_8UC1, over background_rect
//   own_body    CV_32FC1 of the whole image, 0..1, or empty
// None where no pixel shows the intruder. The background counts as no darker than code 1 in light, its deviation as no
// smaller than that of rounding (1 / sqrt(12)): numbers stay finite.
[[nodiscard]] std::optional<Detectability> detectability(const IntruderTruth& truth, const cv::Mat& image,
                                                         const cv::Mat& background, const cv::Rect& background_rect,
                                                         const cv::Mat& own_body, const LuminanceOfCode& luminance);

}  // namespace sigs
