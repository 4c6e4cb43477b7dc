// SPDX-License-Identifier: MIT
#include "camera/scaled_calibration.h"

#include <cmath>
#include <string>
#include <utility>

namespace sigs::calibration {
namespace {

std::string text_of(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// Half a pixel of rounding, and the last bits of the quotient.
bool rounds_to(double length_px, int rounded_px) {
  return std::abs(length_px - rounded_px) <= 0.5 + 1e-9;
}

bool same_shape(cv::Size a, cv::Size b) {
  const double x = static_cast<double>(b.width) / a.width;
  const double y = static_cast<double>(b.height) / a.height;
  return rounds_to(a.height * x, b.height) || rounds_to(a.width * y, b.width) ||  //
         rounds_to(b.height / x, a.height) || rounds_to(b.width / y, a.width);
}

}  // namespace

Result<Camera> scaled_calibration(LensParameters lens, cv::Size own_size_px, std::optional<cv::Size> footage_size_px,
                                  const std::string& file_name) {
  const cv::Size to = footage_size_px.value_or(own_size_px);
  if (to.width < 1 || to.height < 1) return fail(file_name, "cannot be scaled to footage of " + text_of(to));
  if (!same_shape(own_size_px, to))
    return fail(file_name,
                "made for " + text_of(own_size_px) + ", which is not the shape of the footage, " + text_of(to));
  // Pixel centres are whole numbers, so the picture's left edge is at -0.5 and stays there: x' + 0.5 = (x + 0.5) *
  // scale. A side that was rounded to whole pixels has its own scale.
  const double x = static_cast<double>(to.width) / own_size_px.width;
  const double y = static_cast<double>(to.height) / own_size_px.height;
  if (to != own_size_px) {
    lens.fx *= x;
    lens.fy *= y;
    lens.cx = (lens.cx + 0.5) * x - 0.5;
    lens.cy = (lens.cy + 0.5) * y - 0.5;
  }
  Result<Lens> made = Lens::make(std::move(lens));
  if (!made) return fail(file_name, made.error().what);
  return Camera{.lens = *std::move(made), .size_px = to};
}

}  // namespace sigs::calibration
