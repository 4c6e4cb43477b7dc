// SPDX-License-Identifier: MIT
// What tabulated rays change in an image, and what they save: tolerance.csv.

#include "accuracy/csv.h"
#include "accuracy/errors.h"
#include "accuracy/runner.h"
#include "accuracy/scenes.h"
#include "base/statistics.h"

namespace sigs::accuracy {

namespace {

void measure(const Recipe& recipe, const Call& call, Csv& csv) {
  Benches benches;  // no tile of another scene is in them
  const Frame sky = background(kImageSize_px);
  const Scene scene = made_scene(recipe, call.folder / "projects");
  const Standard standard = standard_of(scene, kFrame, sky, effort_of(call).samples_per_side);
  std::vector<Method> methods;
  for (const double tolerance_px : {0.0, 1e-4, 1e-3, 1e-2, 1.0}) methods.push_back({.lens_tolerance_px = tolerance_px});
  std::vector<Runner> runners = runners_of(scene, methods);
  time(runners, sky, benches, effort_of(call).rounds);
  const cv::Mat exact = codes_in(composed(runners[0], sky, benches).image, standard.region);
  for (const Runner& runner : runners) {
    const cv::Mat codes = codes_in(composed(runner, sky, benches).image, standard.region);
    csv.row(recipe.name, runner.method.lens_tolerance_px, code_errors(standard, codes).root_mean_square,
            cv::norm(codes, exact, cv::NORM_INF), median(runner.composite_ms), runner.first_composite_ms);
  }
}

}  // namespace

void measure_tolerances(const Call& call) {
  Csv csv(call.folder / "tolerance.csv", "scene,tolerance_px,rmse,step,composite_ms,first_composite_ms");
  for (const Recipe& recipe : recipes())
    if (recipe.name == "near" || recipe.name == "mid" || recipe.name == "fisheye-edge" || recipe.name == "tangential")
      measure(recipe, call, csv);
}

}  // namespace sigs::accuracy
