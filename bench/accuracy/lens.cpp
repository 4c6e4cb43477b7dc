// SPDX-License-Identifier: MIT
// From pixels to rays, against OpenCV and an exact inverse: lens.csv, lens_table.csv.
//   bench_accuracy_lens FOLDER [quick]

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/angle.h"
#include "accuracy/csv.h"
#include "accuracy/lenses.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "reference/opencv_lens.h"

namespace {

using namespace sigs;
using namespace sigs::accuracy;

using Rays = std::vector<glm::dvec3>;  // in the camera frame, any length; zero: none

struct Inverse {
  std::string name;
  std::function<Rays(const std::vector<glm::dvec2>& pixels)> rays;
};

// OpenCV gives x / z, y / z, for the fisheye too: its functions end at 90 degrees from the axis.
Rays rays_of(const std::vector<cv::Point2d>& tangents) {
  Rays rays;
  rays.reserve(tangents.size());
  for (const cv::Point2d& p : tangents) rays.push_back(camera_of({p.x, p.y, 1}));
  return rays;
}

std::vector<cv::Point2d> points_of(const std::vector<glm::dvec2>& pixels) {
  std::vector<cv::Point2d> points;
  points.reserve(pixels.size());
  for (const glm::dvec2& pixel : pixels) points.emplace_back(pixel.x, pixel.y);
  return points;
}

Inverse ours(const Lens& lens) {
  return {"Lens::ray", [&lens](const std::vector<glm::dvec2>& pixels) {
            Rays rays;
            rays.reserve(pixels.size());
            for (const glm::dvec2& pixel : pixels) rays.push_back(lens.ray(pixel).value_or(glm::dvec3(0)));
            return rays;
          }};
}

// epsilon 0: exactly that many iterations.
Inverse opencvs(const truth::OpencvLens& lens, int iterations, double epsilon) {
  const int type = cv::TermCriteria::COUNT | (epsilon > 0 ? cv::TermCriteria::EPS : 0);
  const std::string name = "OpenCV " + std::to_string(iterations) + (epsilon > 0 ? " or 1e-12" : "");
  return {name, [&lens, criteria = cv::TermCriteria(type, iterations, epsilon)](const auto& pixels) {
            return rays_of(lens.tangents(points_of(pixels), criteria));
          }};
}

struct GaussianWeights {
  double median_px = 0;
  double of_99_px = 0;
  double largest_px = 0;
};

// Distance of each ray's image from its pixel: angle times the lens' magnification there. Infinite where there is no
// ray.
GaussianWeights errors_of(const Rays& rays, const std::vector<Known>& known) {
  std::vector<double> errors_px;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool is_ray = std::isfinite(rays[i].x + rays[i].y + rays[i].z) && glm::length(rays[i]) > 0;
    errors_px.push_back(is_ray ? angle_rad(rays[i], known[i].ray) * known[i].px_per_rad : HUGE_VAL);
  }
  return {median(errors_px), quantile(errors_px, 0.99), *std::ranges::max_element(errors_px)};
}

}  // namespace

int main(int argc, char** argv) {
  const Call call = call_of(argc, argv);
  Csv csv(call.folder / "lens.csv", "lens,inverse,points,median_px,p99_px,max_px,ns_per_point");
  for (const NamedLens& named : lenses()) {
    const std::vector<Known> known = known_rays(named, call.quick ? 16 : 64);
    std::vector<glm::dvec2> pixels;
    for (const Known& one : known) pixels.push_back(one.pixel);
    const truth::OpencvLens opencv(named.lens.parameters());
    std::vector<Inverse> inverses{ours(named.lens)};
    if (opencv.is_opencvs())
      for (const auto& [iterations, epsilon] : {std::pair(5, 0.0), {20, 0.0}, {100, 0.0}, {100, 1e-12}})
        inverses.push_back(opencvs(opencv, iterations, epsilon));
    for (const Inverse& inverse : inverses) {
      const GaussianWeights spread = errors_of(inverse.rays(pixels), known);
      const double s =
          min_s(call.quick ? 1 : 9, static_cast<double>(pixels.size()), [&] { (void)inverse.rays(pixels); });
      csv.row(named.name, inverse.name, pixels.size(), spread.median_px, spread.of_99_px, spread.largest_px, 1e9 * s);
    }
  }
  measure_lens_tables(call);
  return 0;
}
