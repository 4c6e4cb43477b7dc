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

Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                          const std::string& file_name) {
  if (to_px.width < 1 || to_px.height < 1) return fail(file_name, "cannot be scaled to footage of " + text_of(to_px));
  if (to_px == from_px) return lens;
  if (!same_shape(from_px, to_px))
    return fail(file_name,
                "made for " + text_of(from_px) + ", which is not the shape of the footage, " + text_of(to_px));
  // Pixel centres are whole numbers, so the picture's left edge is at -0.5 and stays there: with the scale s,
  // x' + 0.5 = (x + 0.5) s. A side that was rounded to whole pixels has its own scale.
  const double x = static_cast<double>(to_px.width) / from_px.width;
  const double y = static_cast<double>(to_px.height) / from_px.height;
  lens.fx *= x;
  lens.fy *= y;
  lens.cx = (lens.cx + 0.5) * x - 0.5;
  lens.cy = (lens.cy + 0.5) * y - 0.5;
  return lens;
}

}  // namespace sigs::calibration
