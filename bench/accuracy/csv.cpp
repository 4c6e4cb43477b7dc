// SPDX-License-Identifier: MIT
#include "accuracy/csv.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "base/ensure.h"

namespace sigs::accuracy {

Csv::Csv(const std::filesystem::path& path, std::string_view header) : out_(path) {
  out_.precision(6);
  out_ << header << std::endl;
  if (!out_) stop(path.string() + ": cannot be written");
}

Call call_of(int argc, char** argv) {
  if (argc < 2) stop("FOLDER [quick]");
  Call call{.folder = argv[1], .quick = argc > 2 && std::string_view(argv[2]) == "quick"};
  std::filesystem::create_directories(call.folder);
  return call;
}

void stop(const std::string& why) {
  std::fprintf(stderr, "error: %s\n", why.c_str());
  std::fflush(nullptr);
  std::_Exit(EXIT_FAILURE);  // other threads may still use what std::exit would destroy
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_s() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace sigs::accuracy
