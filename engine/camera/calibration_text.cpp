// SPDX-License-Identifier: MIT
#include "camera/calibration_text.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "base/text.h"

namespace sigs {

namespace {

std::string matrix_xml(const char* key, int rows, int cols, std::span<const double> numbers) {
  std::string data;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    data += (i % static_cast<std::size_t>(cols) == 0 ? "\n    " : " ") + exact_text(numbers[i]);
  return fmt::format(
      "<{0} type_id=\"opencv-matrix\">\n  <rows>{1}</rows>\n  <cols>{2}</cols>\n  <dt>d</dt>\n  "
      "<data>{3}</data></{0}>\n",
      key, rows, cols, data);
}

// A comment of XML must not contain two hyphens in a row.
std::string comment_xml(std::string text) {
  for (std::size_t at = 0; (at = text.find("--", at)) != std::string::npos;) text[at] = ' ';
  return text.empty() ? text : fmt::format("<!-- {} -->\n", text);
}

}  // namespace

std::string calibration_xml(const CalibrationText& calibration) {
  const LensParameters& lens = calibration.lens;
  const double matrix[] = {lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1};
  std::string xml = "<?xml version=\"1.0\"?>\n<opencv_storage>\n" + comment_xml(calibration.comment);
  xml += fmt::format("<image_width>{}</image_width>\n<image_height>{}</image_height>\n", calibration.size_px.width,
                     calibration.size_px.height);
  xml += matrix_xml("camera_matrix", 3, 3, matrix);
  // OpenCV cannot read a matrix without elements: no distortion is four zeros.
  const std::vector<double> coefficients = lens.coefficients.empty() ? std::vector<double>(4, 0.0) : lens.coefficients;
  xml += matrix_xml("distortion_coefficients", static_cast<int>(coefficients.size()), 1, coefficients);
  if (lens.model == LensModel::brown_conrady || lens.model == LensModel::kannala_brandt)
    xml += fmt::format("<fisheye_model>{}</fisheye_model>\n", lens.model == LensModel::kannala_brandt ? 1 : 0);
  else
    xml += fmt::format("<distortion_model>{}</distortion_model>\n", traits_of(lens.model).names_in_files.front());
  for (const auto& [key, number] : calibration.numbers)
    if (const std::string text = exact_text(number); !text.empty()) xml += fmt::format("<{0}>{1}</{0}>\n", key, text);
  return xml + "</opencv_storage>\n";
}

}  // namespace sigs
