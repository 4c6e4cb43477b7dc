// SPDX-License-Identifier: MIT

#include <algorithm>
#include <vector>

#include "accuracy/csv.h"
#include "accuracy/lenses.h"
#include "base/statistics.h"
#include "camera/lens_table.h"
#include "reference/exact_lens.h"

namespace sigs::accuracy {

namespace {

// A corner of a pixel, and the exact ray there.
struct Corner {
  int x = 0;
  int y = 0;
  Real3 ray{1, 0, 0};
  double px_per_rad = 0;
};

// On a grid that has no step in common with the tables' own.
std::vector<Corner> corners_of(const NamedLens& named, int step_px) {
  const truth::ExactLens<Real> exact(named.lens.parameters());
  std::vector<Corner> corners;
  for (int y = 0; y <= named.size_px.height; y += step_px)
    for (int x = 0; x <= named.size_px.width; x += step_px) {
      const auto ray = exact.ray({x - 0.5L, y - 0.5L});
      if (ray) corners.push_back({x, y, *ray, named.lens.pixels_per_radian(glm::dvec3(*ray))});
    }
  return corners;
}

// Seconds that a row of corners takes, over the whole image.
double whole_image_s(LensTable& table, const cv::Size& size_px) {
  const double start = wall_s();
  for (int y = 0; y <= size_px.height; ++y) (void)table.corner_rays(0, y, size_px.width + 1);
  return wall_s() - start;
}

std::vector<double> errors_px(LensTable& table, const std::vector<Corner>& corners) {
  std::vector<double> errors;
  for (const Corner& corner : corners) {
    const glm::dvec3 ray = table.corner_rays(corner.x, corner.y, 1)[0];
    if (ray != glm::dvec3(0)) errors.push_back(angle_rad(ray, corner.ray) * corner.px_per_rad);
  }
  return errors;
}

void measure(const NamedLens& named, double tolerance_px, const std::vector<Corner>& corners, bool quick, Csv& csv) {
  const Camera camera{named.lens, named.size_px};
  double first_s = 1e300;
  for (int round = 0; round < (quick ? 1 : 3); ++round) {
    LensTable fresh(camera, tolerance_px);
    first_s = std::min(first_s, whole_image_s(fresh, named.size_px));
  }
  LensTable table(camera, tolerance_px);
  (void)whole_image_s(table, named.size_px);
  const auto evaluations = static_cast<double>(table.evaluations());
  const double kept_s = min_s(quick ? 1 : 5, 1, [&] { (void)whole_image_s(table, named.size_px); });
  const double pixels = (named.size_px.width + 1.0) * (named.size_px.height + 1.0);
  const std::vector<double> errors = errors_px(table, corners);
  csv.row(named.name, tolerance_px, 1e9 * first_s / pixels, 1e9 * kept_s / pixels, evaluations / pixels,
          static_cast<double>(table.bytes()) / 1024, median(errors), quantile(errors, 0.99),
          *std::ranges::max_element(errors));
}

}  // namespace

void measure_lens_tables(const Call& call) {
  Csv csv(call.folder / "lens_table.csv",
          "lens,tolerance_px,first_ns,kept_ns,evaluations,kbytes,median_px,p99_px,max_px");
  for (const NamedLens& named : lenses()) {
    const std::vector<Corner> corners = corners_of(named, call.quick ? 41 : 11);
    for (const double tolerance_px : {0.0, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0})
      measure(named, tolerance_px, corners, call.quick, csv);
  }
}

}  // namespace sigs::accuracy
