// SPDX-License-Identifier: MIT
// What each setting of quality, supersampling and samples changes against compositing.quality `exact`, and what it
// takes: quality.csv.
//   bench_accuracy_quality FOLDER [quick] [WORD]...     WORDs: only the scenes whose names contain all of them

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/csv.h"
#include "accuracy/errors.h"
#include "accuracy/runner.h"
#include "accuracy/scenes.h"
#include "base/statistics.h"

namespace {

using namespace sigs;
using namespace sigs::accuracy;

constexpr double kFilling_px = 1400;  // of an image 1280 px wide
constexpr double kLargestTraced_px = 400;

struct View {
  Recipe recipe;
  bool in_sun = false;
};

// Of the models, light aircraft and airliner are those that the settings of `auto` were chosen on.
std::vector<View> all_views() {
  std::vector<View> views;
  for (const std::string aircraft : {"airliner", "light-aircraft", "airliner-dark", "helicopter", "multirotor-octo"})
    for (const double size_px : {8.0, 60.0, 200.0, 400.0, kFilling_px})
      for (const bool in_sun : {false, true}) {
        const std::string size = size_px == kFilling_px ? "filling" : std::to_string(static_cast<int>(size_px)) + "px";
        Recipe recipe{.name = aircraft + "-" + size + (in_sun ? "-sun" : "-point"),
                      .size_px = size_px,
                      .aircraft = aircraft,
                      .lens = sample_lens(),
                      .sigma_px = 0,
                      .in_sun = in_sun};
        if (size_px == kFilling_px) recipe.pixel = {620, 470};
        views.push_back({recipe, in_sun});
      }
  return views;
}

std::vector<Method> all_methods() {
  std::vector<Method> methods{{.name = "exact"},
                              {.name = "auto", .quality = QualityChoice::automatic},
                              {.name = "draft", .quality = QualityChoice::draft}};
  // Software drivers take four samples at most; with them, supersampling 3 and 4 take several times as long as exact.
  for (const auto& [supersampling, samples] : {std::pair{1, 1}, {2, 1}, {4, 1}, {1, 4}, {2, 4}})
    methods.push_back({.name = "all alike", .supersampling = supersampling, .samples = samples});
  return methods;
}

// Of all three colours over the pixels where either frame shows the intruder.
struct Difference {
  double rmse = 0;
  double largest = 0;
};

Difference difference(const ComposedFrame& a, const ComposedFrame& b) {
  double squares = 0;
  double largest = 0;
  std::int64_t count = 0;
  const cv::Mat none = cv::Mat::zeros(kImageSize_px, CV_8UC1);
  const cv::Mat shown = (a.mask.empty() ? none : a.mask) | (b.mask.empty() ? none : b.mask);
  for (int plane = 0; plane < 3; ++plane)
    for (int y = 0; y < shown.rows; ++y)
      for (int x = 0; x < shown.cols; ++x) {
        if (shown.at<uchar>(y, x) == 0) continue;
        const auto n = static_cast<std::size_t>(plane);
        const double step = double(a.image.planes[n].at<uchar>(y, x)) - b.image.planes[n].at<uchar>(y, x);
        squares += step * step;
        largest = std::max(largest, std::abs(step));
        ++count;
      }
  return {count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0, largest};
}

// Of the coverage of the visible part; and the edges of its box: where columns and rows have a tenth of a pixel.
struct Place {
  glm::dvec2 centroid_px{0, 0};
  glm::dvec4 edges_px{0, 0, 0, 0};
};

// Where the running sum of a profile passes `share` of a pixel, from its first entry on.
double where_reached(const std::vector<double>& profile, double share) {
  double sum = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (sum + profile[i] >= share) return static_cast<double>(i) + (share - sum) / profile[i];
    sum += profile[i];
  }
  return static_cast<double>(profile.size());
}

Place place_of(const Runner& runner, Benches& benches) {
  constexpr double kShare_px = 0.1;
  const SceneMoment moment = scene_at(runner.scene, kFrame);
  const auto layers = intruder_layers(runner.scene, moment, moment.intruders[0], benches.of(runner.method));
  if (!layers) stop(layers.error().text());
  const cv::Mat& coverage = layers->occluded.coverage;
  const cv::Rect& rect = layers->occluded.rect;
  std::vector<double> columns(static_cast<std::size_t>(coverage.cols), 0.0);
  std::vector<double> rows(static_cast<std::size_t>(coverage.rows), 0.0);
  glm::dvec2 sum(0);
  double area = 0;
  for (int j = 0; j < coverage.rows; ++j)
    for (int i = 0; i < coverage.cols; ++i) {
      const double covered = coverage.at<float>(j, i);
      columns[static_cast<std::size_t>(i)] += covered;
      rows[static_cast<std::size_t>(j)] += covered;
      sum += covered * glm::dvec2(i, j);
      area += covered;
    }
  Place place{.centroid_px = sum / area + glm::dvec2(rect.x, rect.y)};
  place.edges_px[0] = where_reached(columns, kShare_px);
  place.edges_px[1] = where_reached(rows, kShare_px);
  std::ranges::reverse(columns);
  std::ranges::reverse(rows);
  place.edges_px[2] = where_reached(columns, kShare_px);
  place.edges_px[3] = where_reached(rows, kShare_px);
  return place;
}

void write_row(Csv& csv, const View& view, const Runner& runner, const Runner& exact, const Frame& sky,
               const std::optional<Standard>& truth, Benches& benches) {
  const ComposedFrame frame = composed(runner, sky, benches);
  const ComposedFrame reference = composed(exact, sky, benches);
  const Difference against_exact = difference(frame, reference);
  const Place place = place_of(runner, benches);
  const Place of_exact = place_of(exact, benches);
  const glm::dvec4 edges = glm::abs(place.edges_px - of_exact.edges_px);
  std::string against_truth;
  if (truth) against_truth = std::to_string(code_errors(*truth, codes_in(frame.image, truth->region)).root_mean_square);
  const Recipe& recipe = view.recipe;
  csv.row(recipe.name, recipe.aircraft, recipe.size_px, view.in_sun ? "sun" : "point", runner.method.name,
          runner.method.supersampling, runner.method.samples, against_exact.rmse, against_exact.largest,
          std::max(std::max(edges[0], edges[1]), std::max(edges[2], edges[3])),
          glm::length(place.centroid_px - of_exact.centroid_px), against_truth, median(runner.draw_ms),
          median(runner.composite_ms), median(runner.total_ms), median(runner.cpu_ms),
          median(runner.cpu_ms) / median(exact.cpu_ms));
}

void measure(const View& view, const Call& call, Benches& benches, Csv& csv) {
  const Frame sky = background(kImageSize_px);
  const Scene scene = made_scene(view.recipe, call.folder / "projects");
  std::optional<Standard> truth;
  if (!view.in_sun && view.recipe.size_px <= kLargestTraced_px)
    truth = standard_of(scene, kFrame, sky, call.quick ? 4 : 12);
  std::vector<Runner> runners = runners_of(scene, all_methods());
  time(runners, sky, benches, call.quick ? 1 : 5);
  for (const Runner& runner : runners) write_row(csv, view, runner, runners[0], sky, truth, benches);
  benches.forget(scene);
}

}  // namespace

int main(int argc, char** argv) {
  const Call call = call_of(std::min(argc, 3), argv);
  const std::vector<std::string> words(argv + std::min(argc, 3), argv + argc);
  std::filesystem::create_directories(call.folder / "projects");
  Benches benches;
  Csv csv(call.folder / "quality.csv",
          "scene,aircraft,size_px,light,way,supersampling,samples,rmse,largest,box_px,centroid_px,rmse_truth,draw_ms,"
          "composite_ms,total_ms,cpu_ms,cpu_ratio");
  for (const View& view : all_views()) {
    const auto is_in_name = [&](const std::string& word) { return view.recipe.name.find(word) != std::string::npos; };
    if (!std::ranges::all_of(words, is_in_name)) continue;
    std::printf("%s\n", view.recipe.name.c_str());
    std::fflush(stdout);
    measure(view, call, benches, csv);
  }
}
