// SPDX-License-Identifier: MIT
#include "camera/calibration_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/pose.h"

namespace sigs::calibration {
namespace {

constexpr std::size_t kAmbiguous = 4;       // coefficients
constexpr double kLargestTangential = 0.1;  // p1, p2; real ones are up to some 0.03
constexpr double kFarFromMiddle = 0.1;      // of the image's side; real lenses are within some 0.05
constexpr double kWidestPinhole_rad = 2.9;  // 166 degrees; the image is then 16 focal lengths wide
constexpr double kNarrowest_rad = 1 * std::numbers::pi / 180;
constexpr double kWidestFisheye_rad = 2 * std::numbers::pi;

std::string text_of(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string short_text(double number, int digits = 6) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

std::string degrees_text(double angle_rad) {
  const double angle_deg = deg_of_rad(angle_rad);
  return angle_deg >= 1000 ? std::to_string(std::llround(angle_deg)) : short_text(angle_deg, 4);
}

std::string principal_point(const LensParameters& lens) {
  return "the principal point (" + short_text(lens.cx) + ", " + short_text(lens.cy) + ")";
}

bool is_outside(const LensParameters& lens, cv::Size size) {
  return lens.cx < -0.5 || lens.cy < -0.5 || lens.cx > size.width - 0.5 || lens.cy > size.height - 0.5;
}

bool is_far_from_middle(double center, int side) {
  return std::abs(center - (side - 1) / 2.0) > kFarFromMiddle * side;
}

// Most principal points lie near the middle: twice as far is the image's other end.
std::string likely_size(const LensParameters& lens) {
  if (lens.cx < 1 || lens.cy < 1) return "";
  return ", as if made for about " + std::to_string(std::lround(2 * lens.cx + 1)) + "x" +
         std::to_string(std::lround(2 * lens.cy + 1));
}

std::string state_the_size() {
  return "; state the size that it was made for (image_width, image_height) in the file";
}

double field_rad(const LensParameters& lens, double focal_px, int side_px) {
  if (lens.model == LensModel::kannala_brandt) return side_px / focal_px;
  return 2 * std::atan(side_px / (2 * focal_px));
}

// Of one side of the image; empty: the focal length is a sound one.
std::string focal_length_warning(const LensParameters& lens, double focal_px, int side_px, const char* name) {
  const double seen_rad = field_rad(lens, focal_px, side_px);
  const double widest_rad = lens.model == LensModel::kannala_brandt ? kWidestFisheye_rad : kWidestPinhole_rad;
  if (seen_rad >= kNarrowest_rad && seen_rad <= widest_rad) return "";
  return std::string(name) + " is " + short_text(focal_px) + " px, with which " + std::to_string(side_px) + " px see " +
         degrees_text(seen_rad) +
         " degrees; a focal length is stated in pixels (millimetres times pixels a millimetre of the sensor)";
}

}  // namespace

AssumedModel assumed_model(std::span<const double> coefficients) {
  const auto is_zero = [](double coefficient) { return coefficient == 0; };
  if (coefficients.size() != kAmbiguous || std::ranges::all_of(coefficients, is_zero)) return {};
  if (std::max(std::abs(coefficients[2]), std::abs(coefficients[3])) > kLargestTangential)
    return {LensModel::kannala_brandt, "the last two are too large for a tangential distortion"};
  return {LensModel::brown_conrady, "OpenCV reads four so"};
}

std::string why_not_made_for(const LensParameters& lens, cv::Size size_px) {
  if (!is_outside(lens, size_px)) return "";
  return principal_point(lens) + " lies outside the footage's " + text_of(size_px) + likely_size(lens) +
         state_the_size();
}

std::vector<std::string> matrix_warnings(const LensParameters& lens, cv::Size size_px, bool size_is_stated) {
  std::vector<std::string> warnings;
  const bool is_far = is_far_from_middle(lens.cx, size_px.width) || is_far_from_middle(lens.cy, size_px.height);
  if (is_outside(lens, size_px))
    warnings.push_back(principal_point(lens) + " lies outside the image of " + text_of(size_px));
  else if (is_far && !size_is_stated)
    warnings.push_back(principal_point(lens) + " lies far from the middle of the footage's " + text_of(size_px) +
                       likely_size(lens) + state_the_size());
  for (const std::string& warning : {focal_length_warning(lens, lens.fx, size_px.width, "fx"),
                                     focal_length_warning(lens, lens.fy, size_px.height, "fy")})
    if (!warning.empty()) warnings.push_back(warning);
  return warnings;
}

}  // namespace sigs::calibration
