// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "frame/compose_frame.h"
#include "reference/reference.h"

namespace sigs::accuracy {

// The intruder in a scene's frame, for the truth.
[[nodiscard]] truth::Setup setup_of(const Scene& scene, int frame);

// A truth made ready for comparing.
struct Standard {
  truth::ReferenceImage image;
  cv::Mat own_body;              // of the scene
  cv::Rect region;               // the silhouette's box grown by a quarter, 8 px and 3 sigma, clipped to the image
  cv::Mat codes;                 // CV_64FC3 over region: red, green, blue, not rounded
  double visible_px = 0;         // area of the silhouette that is in the image and not hidden
  glm::dvec2 centroid_px{0, 0};  // of that part
};

// region: in place of its own, so that two truths can be compared.
[[nodiscard]] Standard standard_of(const Scene& scene, int frame, const Frame& background, int samples_per_side,
                                   std::optional<cv::Rect> region = std::nullopt);

// Of codes, over the region, all three colours alike.
struct CodeErrors {
  double root_mean_square = 0;
  double of_999 = 0;  // 99.9 % are no larger
  double largest = 0;
};
[[nodiscard]] CodeErrors code_errors(const Standard& standard, const cv::Mat& codes);  // CV_64FC3 over region

// The region of an image in PixelLayout::rgb, CV_64FC3.
[[nodiscard]] cv::Mat codes_in(const Frame& image, const cv::Rect& region);

struct ShapeErrors {
  double box_px = 0;        // largest distance between an edge of the annotated silhouette and the true one's
  double centroid_px = 0;   // distance; NaN where the method shows nothing
  double area_percent = 0;  // of the true visible area, with its sign
};

// How much of each pixel the method gives to the intruder: its layer's coverage where it has one (direct), else its
// mask (classic and plain: they have nothing but the key).
[[nodiscard]] ShapeErrors shape_errors(const Standard& standard, const Scene& scene, int frame,
                                       const ComposedFrame& composed, ComposeContext& context);

}  // namespace sigs::accuracy
