// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "appearance/estimate.h"
#include "appearance/straight_edges.h"
#include "video/color_space.h"

namespace sigs {

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
