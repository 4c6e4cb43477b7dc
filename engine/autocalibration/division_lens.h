// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/least_squares.h"
#include "base/result.h"
#include "camera/lens.h"

namespace sigs {

// A lens of two numbers, as much as footage of no board shows: the focal length, and a distortion that grows with the
// square of the distance from the image's centre. It is the division model (Fitzgibbon 2001, "Simultaneous linear
// estimation of multiple view geometry and lens distortion"): a pixel at the distance r from the centre shows what a
// pinhole of the same focal length has at the distance
//   r / (1 + distortion (r / radius)^2)
// where `radius` is half of the image's diagonal. 0: a pinhole. Below 0: barrel. With
// distortion = -(radius / (2 focal))^2 it is the stereographic fisheye exactly; both directions have a closed form.
struct DivisionLens {
  cv::Size size_px;
  double focal_px = 1;    // also px per radian at the image's centre
  double distortion = 0;  // without unit; above -1

  // (X forward, Y right, Z down); not of unit length. A pixel of the lens' own, as in base/image.h.
  [[nodiscard]] glm::dvec3 ray(const glm::dvec2& pixel) const;

  // The pixel of a direction of any length; nothing where none shows it.
  [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const;

  [[nodiscard]] double radius_px() const;

  // Angle between the middles of the left and the right border, radians; 0 to 2 pi.
  [[nodiscard]] double horizontal_field_rad() const;
};

// The lens whose image is `field_rad` wide, between 0 and 2 pi, with this distortion. Nothing where there is none.
[[nodiscard]] std::optional<DivisionLens> division_lens_of_field(cv::Size size_px, double field_rad, double distortion);

// The same lens in a model of OpenCV's: Brown-Conrady with k1, k2 and k3 fitted to it by least squares where that
// follows it to 0.2 px over the whole image, else Kannala-Brandt with its four coefficients.
// Error bad_data where neither has the image's corners in its valid field.
[[nodiscard]] Result<LensParameters> parameters_of(const DivisionLens& lens);

// What is believed of the distortion before anything is looked at: lenses from a pinhole to an action camera's.
struct DistortionPrior {
  double mean = -0.05;
  double sd = 0.15;
};

// A lens found, and how certain it is.
struct LensEstimate {
  DivisionLens lens;
  double distortion_sd = 0;
  double field_low_rad = 0;  // of the horizontal field of view; with 95 % it lies between them
  double field_high_rad = 0;
  int parts = 0;           // of the footage that were taken as independent of each other
  double residual_px = 0;  // median miss of what was fitted

  // Half of the interval over the field itself, of the focal length: 0.05 means 5 %.
  [[nodiscard]] double relative_uncertainty() const;
};

// A fit, or the reason why there is none, for people: "the camera turns too little".
struct LensAnswer {
  std::optional<LensEstimate> fit;
  std::string reason;
};

// Covariance of the solution from how much the parts disagree: (sum N)^-1 (sum g g') (sum N)^-1, which holds whatever
// the errors within one part have in common (Liang, Zeger 1986).
//   parts  of the data: the equations at the solution
//   known  what is known beforehand
[[nodiscard]] cv::Mat_<double> clustered_covariance(const std::vector<NormalEquations>& parts,
                                                    const NormalEquations& known);

// The value that Student's t of so many degrees of freedom exceeds in absolute value with 5 %.
[[nodiscard]] double student_95(int degrees);

// The lens of some parameters, of which the first two are the focal length's and the distortion.
using LensOf = std::function<DivisionLens(std::span<const double>)>;

// The fit with limits of the field: how far it moves along the axes of the covariance, times t of the parts.
//   min_relative  standard deviation of the focal length that no data can take away, 0.01: 1 %
[[nodiscard]] LensEstimate fit_of(const LensOf& lens_of, const std::vector<double>& found,
                                  const cv::Mat_<double>& covariance, int parts, double min_relative);

// The scale of robust weights: the median length of the misses, but no less than min_px.
[[nodiscard]] double scale_of(std::vector<double> lengths, double min_px);

// The field of view that a camera has written into its file: not measured, and of a mode that the footage may have been
// cropped from since.
//   GoPro GPMF ZFOV  diagonal field of view in degrees
//   DJI subtitles    focal_len, in millimetres for an image 36 mm wide, some in tenths: "24.00", "240"
// The distortion is the prior's.
//   file  the video, or a file of subtitles
// Refused where it states neither. Never an error: a file that cannot be read states nothing.
[[nodiscard]] LensAnswer stated_lens(const std::filesystem::path& file, cv::Size size_px, const DistortionPrior& prior);

// The focal length for an image 36 mm wide that DJI's subtitles state first, mm; between 10 and 300.
[[nodiscard]] std::optional<double> dji_focal_mm(std::string_view subtitles);

// The first diagonal field of view in a payload of GPMF, radians; between 5 and 180 degrees.
[[nodiscard]] std::optional<double> gopro_diagonal_field_rad(std::string_view payload);

}  // namespace sigs
