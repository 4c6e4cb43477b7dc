// SPDX-License-Identifier: MIT
// Every method in every scene against the truth: scenes.csv, frames.csv.

#include <cstdio>

#include "accuracy/csv.h"
#include "accuracy/errors.h"
#include "accuracy/runner.h"
#include "accuracy/scenes.h"
#include "base/statistics.h"

namespace sigs::accuracy {

namespace {

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const auto& [name, choice] :
       {std::pair{"plain", MethodChoice::plain}, {"classic", MethodChoice::classic}, {"direct", MethodChoice::direct}})
    for (const int samples : {1, 4})
      for (const int supersampling : {1, 2, 3, 4})
        methods.push_back({.name = name, .choice = choice, .supersampling = supersampling, .samples = samples});
  return methods;
}

// Lower bounds for every method: the truth rounded to 8 bits, and the truth of half as many samples each way (what
// the truth itself is good for).
void write_floors(Csv& csv, const Recipe& recipe, const Standard& standard, const Standard& coarse) {
  const auto row = [&](const char* name, const cv::Mat& codes) {
    const CodeErrors errors = code_errors(standard, codes);
    csv.row(recipe.name, name, 0, 0, errors.root_mean_square, errors.of_999, errors.largest, 0, 0, 0, 0, 0, 0, 0);
  };
  cv::Mat rounded;
  standard.codes.convertTo(rounded, CV_8UC3);
  rounded.convertTo(rounded, CV_64FC3);
  row("rounded", rounded);
  row("truth", coarse.codes);
}

void write_row(Csv& csv, const Recipe& recipe, const Runner& runner, const CodeErrors& codes,
               const ShapeErrors& shape) {
  csv.row(recipe.name, runner.method.name, runner.method.supersampling, runner.method.samples, codes.root_mean_square,
          codes.of_999, codes.largest, shape.box_px, shape.centroid_px, shape.area_percent, median(runner.draw_ms),
          median(runner.composite_ms), median(runner.total_ms), median(runner.cpu_ms));
}

void measure(const Recipe& recipe, const Call& call, Benches& benches, Csv& titles, Csv& csv) {
  const Frame sky = background(kImageSize_px);
  const Scene scene = made_scene(recipe, call.folder / "projects");
  const Effort effort = effort_of(call);
  const Standard standard = standard_of(scene, kFrame, sky, effort.samples_per_side);
  titles.row(recipe.name, recipe.title, recipe.size_px, setup_of(scene, kFrame).sigma_px);
  write_floors(csv, recipe, standard, standard_of(scene, kFrame, sky, effort.samples_per_side / 2, standard.region));
  std::vector<Runner> runners = runners_of(scene, all_methods());
  for (Runner& runner : runners)
    if (runner.method.choice != MethodChoice::direct) runner.skip = 3;  // whole images, many times slower
  time(runners, sky, benches, effort.rounds);
  for (const Runner& runner : runners) {
    const ComposedFrame frame = composed(runner, sky, benches);
    write_row(csv, recipe, runner, code_errors(standard, codes_in(frame.image, standard.region)),
              shape_errors(standard, runner.scene, kFrame, frame, benches.of(runner.method)));
  }
  benches.forget(scene);
}

}  // namespace

void measure_scenes(const Call& call, Benches& benches) {
  Csv titles(call.folder / "scenes.csv", "scene,title,size_px,sigma_px");
  Csv frames(call.folder / "frames.csv",
             "scene,method,supersampling,samples,rmse,p999,max,box_px,centroid_px,area_percent,draw_ms,composite_ms,"
             "total_ms,cpu_ms");
  for (const Recipe& recipe : recipes()) {
    std::printf("%s\n", recipe.title.c_str());
    std::fflush(stdout);
    measure(recipe, call, benches, titles, frames);
  }
}

}  // namespace sigs::accuracy
