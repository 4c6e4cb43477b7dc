// SPDX-License-Identifier: MIT
#include "camera/scaled_calibration.h"

#include <array>
#include <cmath>
#include <cstdio>
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

// One size follows from the other, but for the rounding of a side.
bool is_rounded(cv::Size a, cv::Size b) {
  const double x = static_cast<double>(b.width) / a.width;
  const double y = static_cast<double>(b.height) / a.height;
  return rounds_to(a.height * x, b.height) || rounds_to(a.width * y, b.width) ||  //
         rounds_to(b.height / x, a.height) || rounds_to(b.width / y, a.width);
}

constexpr double kSameShape = 0.01;  // of the ratio of width to height

std::string fixed(double number, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, number);
  return text.data();
}

// Between the sides' scales lies what the camera may have cut from the longer one.
Warning squeezed(cv::Size from_px, cv::Size to_px, double x, double y, const std::string& file_name) {
  const double cut_px = x < y ? (from_px.width * y - to_px.width) / 2 : (from_px.height * x - to_px.height) / 2;
  return {file_name, "made for " + text_of(from_px) + ", the footage is " + text_of(to_px) + ", " +
                         fixed(100 * std::abs(x / y - 1), 2) + " % off its shape: scaled by " + fixed(x, 5) +
                         " across and " + fixed(y, 5) + " down; if the camera cut the image instead, its edges are " +
                         fixed(cut_px, 1) + " px off"};
}

}  // namespace

Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                          const cv::Point2d& stretch, const std::string& file_name,
                                          std::vector<Warning>& warnings) {
  if (to_px.width < 1 || to_px.height < 1) return fail(file_name, "cannot be scaled to footage of " + text_of(to_px));
  // As the footage would be without the stretch.
  const cv::Size shape_px(cvRound(from_px.width / stretch.x), cvRound(from_px.height / stretch.y));
  if (shape_px.empty()) return fail(file_name, "is stretched too far");
  if (to_px == from_px && shape_px == from_px) return lens;
  const double shape_x = static_cast<double>(to_px.width) / shape_px.width;
  const double shape_y = static_cast<double>(to_px.height) / shape_px.height;
  if (!is_rounded(shape_px, to_px)) {
    if (std::abs(shape_x / shape_y - 1) > kSameShape)
      return fail(file_name,
                  "made for " + text_of(shape_px) + ", which is not the shape of the footage, " + text_of(to_px));
    warnings.push_back(squeezed(shape_px, to_px, shape_x, shape_y, file_name));
  }
  // Pixel centres are whole numbers, so the image's left edge is at -0.5 and stays there: with the scale s,
  // x' + 0.5 = (x + 0.5) s. A side that was rounded to whole pixels or blocks has its own scale.
  const double x = static_cast<double>(to_px.width) / from_px.width;
  const double y = static_cast<double>(to_px.height) / from_px.height;
  lens.fx *= x;
  lens.fy *= y;
  lens.cx = (lens.cx + 0.5) * x - 0.5;
  lens.cy = (lens.cy + 0.5) * y - 0.5;
  return lens;
}

}  // namespace sigs::calibration
