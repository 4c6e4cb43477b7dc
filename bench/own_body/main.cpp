// SPDX-License-Identifier: MIT
#include <functional>
#include <map>
#include <string>

#include "own_body/measures.h"

// bench_own_body flights|limits|time|early|real|reliability|images FOLDER [quick]
int main(int argc, char** argv) {
  using namespace sigs;
  const std::map<std::string, std::function<void(const accuracy::Call&)>> measures{
      {"flights", bench::measure_flights}, {"limits", bench::measure_limits},
      {"time", bench::measure_time},       {"early", bench::measure_early_stop},
      {"real", bench::measure_real_clips}, {"reliability", bench::measure_reliability},
      {"images", bench::draw_images}};
  const auto measure = measures.find(argc > 1 ? argv[1] : "");
  if (argc < 3 || measure == measures.end())
    accuracy::stop("flights|limits|time|early|real|reliability|images FOLDER [quick]");
  measure->second(accuracy::call_of(argc - 1, argv + 1));
}
