// SPDX-License-Identifier: MIT
#include <string_view>

#include "ego_motion/measures.h"

// bench_ego_motion cases|sweep FOLDER [quick]
// bench_ego_motion horizons CSV
int main(int argc, char** argv) {
  using namespace sigs;
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (argc == 3 && what == "horizons") {
    bench::measure_horizons(argv[2]);
    return 0;
  }
  if (argc < 3 || (what != "cases" && what != "sweep")) accuracy::stop("cases|sweep FOLDER [quick], or horizons CSV");
  const accuracy::Call call = accuracy::call_of(argc - 1, argv + 1);
  what == "cases" ? bench::measure_cases(call) : bench::measure_sweep(call);
}
