// SPDX-License-Identifier: MIT
#include "accuracy/csv.h"

#include <cstdio>
#include <cstdlib>

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

}  // namespace sigs::accuracy
