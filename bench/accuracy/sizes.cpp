// SPDX-License-Identifier: MIT
// Time of direct and classic, by the size of the intruder: sizes.csv.

#include "accuracy/csv.h"
#include "accuracy/errors.h"
#include "accuracy/runner.h"
#include "accuracy/scenes.h"
#include "base/statistics.h"

namespace sigs::accuracy {

namespace {

void measure_size(double size_px, const Call& call, Benches& benches, Csv& csv) {
  const Scene scene = made_scene({.name = "size", .size_px = size_px, .lens = sample_lens()}, call.folder / "projects");
  std::vector<Runner> runners = runners_of(scene, {{}, {.name = "classic", .choice = MethodChoice::classic}});
  time(runners, background(kImageSize_px), benches, effort_of(call).rounds);
  const Runner& direct = runners[0];
  const Runner& classic = runners[1];
  std::vector<double> ratios;  // interleaved, so that load on the machine affects both
  for (std::size_t i = 0; i < direct.total_ms.size(); ++i) ratios.push_back(classic.total_ms[i] / direct.total_ms[i]);
  csv.row(size_px, setup_of(scene, kFrame).sigma_px, median(direct.draw_ms), median(direct.composite_ms),
          median(direct.total_ms), median(classic.total_ms), median(ratios), median(direct.cpu_ms),
          median(classic.cpu_ms));
  benches.forget(scene);
}

}  // namespace

void measure_sizes(const Call& call, Benches& benches) {
  Csv csv(call.folder / "sizes.csv",
          "size_px,sigma_px,direct_draw_ms,direct_composite_ms,direct_ms,classic_ms,ratio,direct_cpu_ms,"
          "classic_cpu_ms");
  for (const double size_px : {1, 2, 4, 8, 16, 30, 60, 100, 150, 200, 300, 400})
    measure_size(size_px, call, benches, csv);
}

}  // namespace sigs::accuracy
