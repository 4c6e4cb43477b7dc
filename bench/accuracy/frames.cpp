// SPDX-License-Identifier: MIT
// Whole frames against the truth, and what they take.
//   bench_accuracy_frames FOLDER [quick]

#include "accuracy/csv.h"
#include "accuracy/runner.h"

int main(int argc, char** argv) {
  using namespace sigs::accuracy;
  const Call call = call_of(argc, argv);
  std::filesystem::create_directories(call.folder / "projects");
  Benches benches;
  const Method as_given;
  Csv machine(call.folder / "machine.csv", "supersampling,samples,lens_tolerance_px,renderer");
  machine.row(as_given.supersampling, as_given.samples, as_given.lens_tolerance_px,
              '"' + benches.of(as_given).renderer_description() + '"');
  measure_sizes(call, benches);
  measure_tolerances(call);
  measure_scenes(call, benches);
  return 0;
}
