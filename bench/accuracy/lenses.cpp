// SPDX-License-Identifier: MIT
#include "accuracy/lenses.h"

#include <utility>

#include "accuracy/csv.h"
#include "accuracy/scenes.h"
#include "reference/exact_lens.h"

namespace sigs::accuracy {

namespace {

NamedLens named(std::string name, LensParameters parameters, cv::Size size_px) {
  Result<Lens> lens = Lens::make(std::move(parameters));
  if (!lens) stop(name + ": " + lens.error().text());
  return {std::move(name), std::move(*lens), size_px};
}

}  // namespace

std::vector<NamedLens> lenses() {
  constexpr LensModel kBrown = LensModel::brown_conrady;
  const cv::Size vga(640, 480);
  return {named("moderate",
                {kBrown, 535.9, 535.9, 342.3, 235.6, {-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839}}, vga),
          named("tangential", tangential_lens(), kImageSize_px),
          named("wide; folds", {kBrown, 233.6, 233.6, 320, 240, {-0.32744, 0.12814, 0, 0, -0.023876}}, vga),
          named("rational; large numbers",
                {kBrown,
                 202.6,
                 202.6,
                 124.3,
                 127.3,
                 {-3.4751670360565186, -38.5734748840332, 0.00034309603506699204, 9.377215610584244e-05,
                  286.4400939941406, -3.6408045291900635, -36.68898010253906, 279.0523681640625}},
                {250, 250}),
          named("sample clip (fisheye)", sample_lens(), kImageSize_px),
          named("fisheye of 170 degrees", fisheye_170_lens(), kImageSize_px)};
}

std::vector<Known> known_rays(const NamedLens& lens, int across) {
  const truth::ExactLens<Real> exact(lens.lens.parameters());
  std::vector<Known> known;
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i) {
      const glm::dvec2 pixel((i + 0.5) / across * lens.size_px.width - 0.5,
                             (j + 0.5) / across * lens.size_px.height - 0.5);
      const auto ray = exact.ray(glm::vec<2, Real>(pixel));
      if (!ray) continue;
      const double px_per_rad = lens.lens.pixels_per_radian(glm::dvec3(*ray));
      known.push_back({pixel, *ray, px_per_rad});
    }
  return known;
}

}  // namespace sigs::accuracy
