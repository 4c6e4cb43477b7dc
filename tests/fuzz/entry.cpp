// SPDX-License-Identifier: MIT
// What libFuzzer calls, for the target that the build names (SIGS_FUZZ_TARGET: try_project ...).
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "fuzz/fuzz_input.h"

namespace {

// In the folder that scripts/fuzz.sh makes and removes, which is in memory; one for each process.
std::filesystem::path made_folder() {
  const char* const parent = std::getenv("SIGS_FUZZ_FOLDER");
  const std::filesystem::path folder =
      (parent != nullptr ? std::filesystem::path(parent) : std::filesystem::temp_directory_path()) /
      ("sigs-fuzz-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = made_folder();
  sigs::fuzz::SIGS_FUZZ_TARGET({.bytes = {reinterpret_cast<const char*>(data), size}, .folder = folder});
  return 0;
}
