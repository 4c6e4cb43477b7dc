// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace sigs::accuracy {

// A table in a file, row by row. Stops the program where the file cannot be made.
class Csv {
 public:
  Csv(const std::filesystem::path& path, std::string_view header);

  template <class First, class... Others>
  void row(const First& first, const Others&... others) {
    out_ << first;
    ((out_ << ',' << others), ...);
    out_ << std::endl;  // an interrupted run leaves complete rows
  }

 private:
  std::ofstream out_;
};

// The arguments of every bench here: FOLDER [quick].
struct Call {
  std::filesystem::path folder;  // where the tables go; made where it is not there
  bool quick = false;            // few repetitions and a coarse truth: only shows that the bench runs
};
[[nodiscard]] Call call_of(int argc, char** argv);

// Says why on standard error and ends the program, from any thread.
[[noreturn]] void stop(const std::string& why);

// Seconds since some moment: of the clock on the wall, and of all this process' threads.
[[nodiscard]] double wall_s();
[[nodiscard]] double cpu_s();

// Wall seconds of one call among `calls`, as the minimum of `rounds` rounds: for work without randomness.
template <class Function>
[[nodiscard]] double min_s(int rounds, double calls, const Function& function) {
  double minimum = 1e300;
  for (int round = 0; round < rounds; ++round) {
    const double start = wall_s();
    function();
    const double taken = (wall_s() - start) / calls;
    minimum = taken < minimum ? taken : minimum;
  }
  return minimum;
}

}  // namespace sigs::accuracy
