// SPDX-License-Identifier: MIT
#include "camera/calibration_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/pose.h"
#include "base/text.h"

namespace sigs::calibration {
namespace {

constexpr std::size_t kAmbiguous = 4;       // coefficients
constexpr double kLargestTangential = 0.1;  // p1, p2; real ones are up to some 0.03
constexpr double kFarFromMiddle = 0.1;      // of the image's side; real lenses are within some 0.05
constexpr double kWidestPinhole_rad = 2.9;  // 166 degrees; the image is then 16 focal lengths wide
constexpr double kNarrowest_rad = 1 * std::numbers::pi / 180;
constexpr double kWidestFisheye_rad = 2 * std::numbers::pi;

std::string degrees_text(double angle_rad) {
  const double angle_deg = deg_of_rad(angle_rad);
  return angle_deg >= 1000 ? std::to_string(std::llround(angle_deg)) : fmt::format("{:.4g}", angle_deg);
}

std::string principal_point(const LensParameters& lens) {
  return fmt::format("the principal point ({:.6g}, {:.6g})", lens.cx, lens.cy);
}

bool is_outside(const LensParameters& lens, cv::Size size) {
  return lens.cx < -0.5 || lens.cy < -0.5 || lens.cx > size.width - 0.5 || lens.cy > size.height - 0.5;
}

bool is_far_from_middle(double center, int side) {
  return std::abs(center - (side - 1) / 2.0) > kFarFromMiddle * side;
}

// Most principal points lie near the middle, so that the image is about twice as large.
std::string likely_size(const LensParameters& lens) {
  if (lens.cx < 1 || lens.cy < 1) return "";
  return fmt::format(", as if made for about {}x{}", std::lround(2 * lens.cx + 1), std::lround(2 * lens.cy + 1));
}

std::string state_the_size() {
  return "; state the size that it was made for (image_width, image_height) in the file";
}

// The angle that a side of the image sees without distortion, as far as the model's middle tells.
double field_rad(const LensParameters& lens, double focal_px, int side_px) {
  return 2 * plain_angle_rad(lens, side_px / (2 * focal_px));
}

// For one side of the image; empty where the focal length is plausible.
std::string focal_length_warning(const LensParameters& lens, double focal_px, int side_px, const char* name) {
  const double field_of_view_rad = field_rad(lens, focal_px, side_px);
  const double widest_rad = is_fisheye(lens.model) ? kWidestFisheye_rad : kWidestPinhole_rad;
  if (field_of_view_rad >= kNarrowest_rad && field_of_view_rad <= widest_rad) return "";
  return fmt::format(
      "{} is {:.6g} px, with which {} px see {} degrees; a focal length is stated in pixels (millimetres times pixels "
      "a "
      "millimetre of the sensor)",
      name, focal_px, side_px, degrees_text(field_of_view_rad));
}

// Within half a pixel of rounding and the last bits of the quotient.
bool rounds_to(double length_px, int rounded_px) {
  return std::abs(length_px - rounded_px) <= 0.5 + 1e-9;
}

// Whether one size follows from the other by a common scale, except for the rounding of a side.
bool is_rounded(cv::Size a, cv::Size b) {
  const double x = static_cast<double>(b.width) / a.width;
  const double y = static_cast<double>(b.height) / a.height;
  return rounds_to(a.height * x, b.height) || rounds_to(a.width * y, b.width) ||  //
         rounds_to(b.height / x, a.height) || rounds_to(b.width / y, a.width);
}

constexpr double kSameShape = 0.01;  // of the ratio of width to height

// The warning that the sides have different scales x and y. If the camera has cropped instead, the larger scale
// holds for both, and the side with the smaller one has been cut.
Warning squeezed(cv::Size from_px, cv::Size to_px, double x, double y, const std::string& file_name) {
  const double cut_px = x < y ? (from_px.width * y - to_px.width) / 2 : (from_px.height * x - to_px.height) / 2;
  return {
      file_name,
      fmt::format("made for {}, the footage is {}, {:.2f} % off its shape: scaled by {:.5f} across and {:.5f} down; if "
                  "the camera cut the image instead, its edges are {:.1f} px off",
                  image_size_text(from_px), image_size_text(to_px), 100 * std::abs(x / y - 1), x, y, cut_px)};
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
  return fmt::format("{} lies outside the footage's {}{}{}", principal_point(lens), image_size_text(size_px),
                     likely_size(lens), state_the_size());
}

std::vector<std::string> matrix_warnings(const LensParameters& lens, cv::Size size_px, bool size_is_stated) {
  std::vector<std::string> warnings;
  const bool is_far = is_far_from_middle(lens.cx, size_px.width) || is_far_from_middle(lens.cy, size_px.height);
  if (is_outside(lens, size_px))
    warnings.push_back(fmt::format("{} lies outside the image of {}", principal_point(lens), image_size_text(size_px)));
  else if (is_far && !size_is_stated)
    warnings.push_back(fmt::format("{} lies far from the middle of the footage's {}{}{}", principal_point(lens),
                                   image_size_text(size_px), likely_size(lens), state_the_size()));
  for (const std::string& warning : {focal_length_warning(lens, lens.fx, size_px.width, "fx"),
                                     focal_length_warning(lens, lens.fy, size_px.height, "fy")})
    if (!warning.empty()) warnings.push_back(warning);
  return warnings;
}

bool has_shape_of(cv::Size made_px, cv::Size size_px) {
  const double x = static_cast<double>(size_px.width) / made_px.width;
  const double y = static_cast<double>(size_px.height) / made_px.height;
  return is_rounded(made_px, size_px) || std::abs(x / y - 1) <= kSameShape;
}

Result<LensParameters> scaled_calibration(LensParameters lens, cv::Size from_px, cv::Size to_px,
                                          const cv::Point2d& stretch, const std::string& file_name,
                                          std::vector<Warning>& warnings) {
  if (to_px.width < 1 || to_px.height < 1)
    return fail(file_name, "cannot be scaled to footage of " + image_size_text(to_px));
  // As the footage would be without the stretch.
  const cv::Size shape_px(cvRound(from_px.width / stretch.x), cvRound(from_px.height / stretch.y));
  if (shape_px.empty()) return fail(file_name, "is stretched too far");
  if (to_px == from_px && shape_px == from_px) return lens;
  const double shape_x = static_cast<double>(to_px.width) / shape_px.width;
  const double shape_y = static_cast<double>(to_px.height) / shape_px.height;
  if (!has_shape_of(shape_px, to_px))
    return fail(file_name, fmt::format("made for {}, which is not the shape of the footage, {}",
                                       image_size_text(shape_px), image_size_text(to_px)));
  if (!is_rounded(shape_px, to_px)) warnings.push_back(squeezed(shape_px, to_px, shape_x, shape_y, file_name));
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

void crop(LensParameters& lens, cv::Size size_px, double kept_share) {
  lens.fx /= kept_share;
  lens.fy /= kept_share;
  lens.cx = (lens.cx + 0.5 - size_px.width / 2.0) / kept_share + size_px.width / 2.0 - 0.5;
  lens.cy = (lens.cy + 0.5 - size_px.height / 2.0) / kept_share + size_px.height / 2.0 - 0.5;
}

Result<bool> is_made_for_whole(cv::Size made_px, cv::Size part_px, const ImagePart& part,
                               const std::string& file_name) {
  if (made_px == part_px) return false;
  if (made_px == part.whole_px) return true;
  if (!has_shape_of(made_px, part.whole_px)) return false;
  if (!has_shape_of(made_px, part_px)) return true;
  return fail(file_name,
              fmt::format("made for {}, which has the shape of the whole footage, {}, and of the part that "
                          "is left of it, {}: scale its matrix and its size to the one that it is meant for",
                          image_size_text(made_px), image_size_text(part.whole_px), image_size_text(part_px)));
}

}  // namespace sigs::calibration
