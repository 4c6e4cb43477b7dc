// SPDX-License-Identifier: MIT
// The files of tests/fuzz/cases, each of which a fuzzer once broke a reader with, or which is a small sound example.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <string>

#include "fuzz/fuzz_input.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

using Target = void (*)(const fuzz::FuzzInput&);

const std::map<std::string, Target>& fuzz_targets() {
  static const std::map<std::string, Target> kAll{{"project", fuzz::try_project},
                                                  {"calibration", fuzz::try_calibration},
                                                  {"model", fuzz::try_model},
                                                  {"image", fuzz::try_image},
                                                  {"text_log", fuzz::try_text_log},
                                                  {"binary_log", fuzz::try_binary_log},
                                                  {"results", fuzz::try_results},
                                                  {"truth", fuzz::try_truth},
                                                  {"recipe", fuzz::try_recipe},
                                                  {"recorded_path", fuzz::try_recorded_path},
                                                  {"encounter", fuzz::try_encounter},
                                                  {"encounter_model", fuzz::try_encounter_model},
                                                  {"sensor_model", fuzz::try_sensor_model},
                                                  {"video", fuzz::try_video}};
  return kAll;
}

}  // namespace

TEST_CASE("every reader takes or refuses the kept cases and keeps its promises") {
  const std::filesystem::path cases = source_dir() / "tests" / "fuzz" / "cases";
  for (const auto& [folder_name, target] : fuzz_targets()) {
    const std::string name = folder_name;
    REQUIRE_MESSAGE(std::filesystem::is_directory(cases / name), name);
    const TemporaryFolder folder;
    for (const std::string& file : files_below(cases / name)) {
      CAPTURE(name);
      CAPTURE(file);
      const std::string bytes = text_of(cases / name / file);
      target({.bytes = bytes, .folder = folder.path()});
      target({.bytes = std::string_view(bytes).substr(0, bytes.size() / 2), .folder = folder.path()});
    }
  }
}

TEST_CASE("every folder of cases is that of a target") {
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "tests" / "fuzz" / "cases"))
    CHECK_MESSAGE(fuzz_targets().contains(entry.path().filename().string()), entry.path().string());
}
