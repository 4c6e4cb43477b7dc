// SPDX-License-Identifier: MIT
#include <string_view>

#include "ego_motion/measures.h"

// bench_ego_motion cases|sweep FOLDER [quick]
int main(int argc, char** argv) {
  using namespace sigs;
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (argc < 3 || (what != "cases" && what != "sweep")) accuracy::stop("cases|sweep FOLDER [quick]");
  const accuracy::Call call = accuracy::call_of(argc - 1, argv + 1);
  what == "cases" ? bench::measure_cases(call) : bench::measure_sweep(call);
}
