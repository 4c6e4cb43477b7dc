// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "accuracy/angle.h"
#include "accuracy/csv.h"
#include "camera/lens.h"

namespace sigs::accuracy {

struct NamedLens {
  std::string name;
  Lens lens;
  cv::Size size_px;
};

// From weak to extreme distortion, each over its whole image.
[[nodiscard]] std::vector<NamedLens> lenses();

// A pixel whose ray is known to more than double's digits.
struct Known {
  glm::dvec2 pixel;
  Real3 ray{1, 0, 0};     // unit, camera frame
  double px_per_rad = 0;  // the lens' magnification there
};

// Rays over the part of the valid field that lies in the image, some `across` squared of them.
[[nodiscard]] std::vector<Known> known_rays(const NamedLens& lens, int across);

// Error, saved evaluations and memory of a tabulated lens, by tolerance: lens_table.csv.
void measure_lens_tables(const Call& call);

}  // namespace sigs::accuracy
