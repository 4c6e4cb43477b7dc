// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "appearance/estimate.h"
#include "video/color_space.h"

namespace sigs {

// Straight, strong, isolated edges of an image, and the profile across each of them, sampled finer than the pixels as
// in ISO 12233 (slanted-edge method): an edge that lies oblique to the rows passes them at every fraction of a pixel.

// A piece of a straight line. Positions are of samples: (0, 0) is the centre of the first pixel.
struct EdgeLine {
  glm::dvec2 at_px{0, 0};   // its middle
  glm::dvec2 normal{1, 0};  // unit vector, from the dark side to the bright one
  double half_length_px = 0;
};

// Where the samples of a plane lie among the luma samples: at step * index + offset.
struct PlaneGrid {
  glm::dvec2 step_px{1, 1};
  glm::dvec2 offset_px{0, 0};
};

// The mean code value by distance from a line; distances beyond 0 lie on the normal's side.
struct EdgeBins {
  std::vector<double> distance_px;  // mean distance of the samples of each bin, rising; luma samples
  std::vector<double> code;         // mean of the samples
  std::vector<double> count;        // number of samples, at least 1
  double noise = 0;                 // standard deviation of a sample about the profile
};

struct StraightEdge {
  EdgeLine line;
  EdgeBins bins;
  double dark = 0;  // code values of the two sides
  double bright = 0;
  double steepness = 0;  // largest slope over the contrast, 1/px: the sharper the greater
};

// The samples of a plane within half_width_px of a line, in bins of bin_px.
[[nodiscard]] EdgeBins binned(const cv::Mat& plane, const PlaneGrid& grid, const EdgeLine& line, double half_width_px,
                              double bin_px);

inline constexpr double kEdgeHalfWidth_px = 8;  // of the profiles

// Up to max_count edges of a luma plane, CV_8UC1, the steepest first. Each has an even dark and an even bright side
// whose difference is at least 30 codes and 12 times the noise, is straight within 0.15 px over at least 24 px, and
// meets the pixels at enough fractions of a pixel to be sampled every quarter of one.
//   lowest, highest  code values of black and white: edges that are clipped there are left out
[[nodiscard]] std::vector<StraightEdge> straight_edges(const cv::Mat& luma, int lowest, int highest, int max_count);

// How a camera shows a perfect edge, and the fit of that to measured profiles.

// A Gaussian of the lens over the linear light, the mean over each pixel's square, the transfer curve, then sharpening
// in code values: code += sharpening * (code - code blurred by a Gaussian of sharpening_px). These are the settings
// appearance.psf_sigma_px, .sharpening, .sharpening_px of a project. The order follows the camera's: light is
// blurred before it becomes code values, and cameras sharpen what they are about to encode.
struct EdgeShape {
  double sigma_px = 0.5;
  double sharpening = 0;
  double sharpening_px = 1;
};

// What a profile consists of besides its shape.
struct EdgeLevels {
  double dark = 0;  // display values of the sides, 0..1
  double bright = 1;
  TransferFunction transfer = TransferFunction::srgb;
  double pixel_px = 1;  // width of the sample's square
};

// The profile across the edge: 0 far on the dark side, 1 far on the bright one. Linear between a table's entries; the
// table ends 12 px from the edge.
class EdgeCurve {
 public:
  EdgeCurve(const EdgeShape& shape, const EdgeLevels& levels, glm::dvec2 normal);
  // From the table of the curve that has the same sigma and no sharpening.
  EdgeCurve(std::vector<double> unsharpened, const EdgeShape& shape);
  [[nodiscard]] double operator()(double distance_px) const;

 private:
  std::vector<double> values_;
};

struct EdgeSample {
  EdgeBins bins;
  EdgeLevels levels;
  glm::dvec2 normal{1, 0};
  double tolerance = 1;  // code values by which a sample may differ from the model
};

// The sigma that fits one edge best, sharpening being known. 0.02 to 8.
[[nodiscard]] Fitted fitted_sigma(const EdgeSample& edge, const EdgeShape& shape);

struct ShapeFit {
  EdgeShape shape;
  double misfit = 0;  // mean square of residuals over tolerances
};

// The shape that fits all edges best, from a start.
//   with_sharpening  false: sharpening stays 0
[[nodiscard]] ShapeFit fitted_shape(std::span<const EdgeSample> edges, const EdgeShape& start, bool with_sharpening);

// The profile of one edge brought to 0..1 as the fit sees it: distances from the fitted middle, and values.
struct AlignedProfile {
  std::vector<double> distance_px;
  std::vector<double> value;
};
[[nodiscard]] AlignedProfile aligned_profile(const EdgeSample& edge, const EdgeShape& shape);

}  // namespace sigs
