// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/image.h"
#include "camera/camera.h"
#include "compositor/warp.h"
#include "video/frame.h"

namespace sigs::test {

// The same premultiplied colour everywhere, wholly covered.
[[nodiscard]] Layer even_layer(const cv::Rect& rect, const cv::Vec4f& color);

// Opacity, colour and coverage of soft blobs, zero round the edge; the same on every machine.
[[nodiscard]] Layer cloudy_layer(const cv::Rect& rect, unsigned seed);

// A view straight along the camera's axis that shows the layer (whose size it takes).
[[nodiscard]] RenderedView view_ahead(Layer layer, double focal_px, const glm::dvec2& center_px);

[[nodiscard]] Lens lens_of(LensModel model, double focal_px, const glm::dvec2& center_px,
                           const std::vector<double>& coefficients);

struct NamedCamera {
  std::string name;
  Camera camera;
};

// Brown-Conrady with 5 and 8 coefficients, fisheye and omnidirectional, all with a ray for every pixel.
// The whole image has to lie within the view that tests of the warp fill with one colour: 1.6 focal lengths to each
// side, 58 degrees from the axis.
[[nodiscard]] std::vector<NamedCamera> distorting_cameras(cv::Size size_px);

// No NaN and no infinity; opacity and coverage from 0 to 1.
[[nodiscard]] bool is_valid(const Layer& layer);

[[nodiscard]] bool same_bytes(const cv::Mat& a, const cv::Mat& b);

}  // namespace sigs::test
