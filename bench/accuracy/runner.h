// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "accuracy/csv.h"
#include "frame/compose_frame.h"

namespace sigs::accuracy {

struct Effort {
  int rounds = 9;             // of timing
  int samples_per_side = 24;  // of the truth, a pixel
};
[[nodiscard]] Effort effort_of(const Call& call);

// A way to make a frame. Other settings have the defaults of a project and a context.
struct Method {
  std::string name = "direct";
  MethodChoice choice = MethodChoice::direct;
  int supersampling = CompositingSettings{}.supersampling;
  QualityChoice quality = CompositingSettings{}.quality;
  int samples = ComposeSettings{}.samples_per_pixel;
  double lens_tolerance_px = ComposeSettings{}.lens_tolerance_px;
};

// One context for each setting of benches; kept from scene to scene, as an export keeps its own.
class Benches {
 public:
  [[nodiscard]] ComposeContext& of(const Method& method);

  // To be called before the scene's models go away.
  void forget(const Scene& scene);

 private:
  std::map<std::tuple<int, double, int, QualityChoice>, ComposeContext> benches_;
};

// A method in a scene, and the times of its runs.
struct Runner {
  Method method;
  Scene scene;
  int skip = 1;                   // takes part in every skip-th round
  double first_composite_ms = 0;  // of the frame that finds no table of the lens
  std::vector<double> draw_ms;
  std::vector<double> composite_ms;
  std::vector<double> total_ms;
  std::vector<double> cpu_ms;
};
[[nodiscard]] std::vector<Runner> runners_of(const Scene& scene, const std::vector<Method>& methods);

[[nodiscard]] ComposedFrame composed(const Runner& runner, const Frame& background, Benches& benches);

// One warm-up run of everything, then interleaved: load on the machine affects all alike.
void time(std::vector<Runner>& runners, const Frame& background, Benches& benches, int rounds);

// What bench_accuracy_frames is made of; each makes the tables that its source file names.
void measure_sizes(const Call& call, Benches& benches);
void measure_tolerances(const Call& call);
void measure_scenes(const Call& call, Benches& benches);

}  // namespace sigs::accuracy
