// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geo/geo_path.h"
#include "geo/recorded_examples.h"
#include "geo/recorded_path.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const std::vector<std::string>& all_examples() {
  static const std::vector<std::string> kAll{kGpxExample,    kKmlExample,   kAircraftExample,  kTraceExample,
                                             kStatesExample, kTrackExample, kOpenskyCsvExample};
  return kAll;
}

// What read_recorded_paths() promises, whatever the text.
void check_promises(const std::string& text) {
  const auto paths = recorded_paths_of(text, "file");
  if (!paths) {
    CHECK(paths.error().kind == ErrorKind::bad_data);
    CHECK(paths.error().text().starts_with("file: "));
    CHECK(paths.error().text().find('\n') == std::string::npos);
    return;
  }
  CHECK_FALSE(paths->empty());
  for (const RecordedPath& path : *paths) {
    CHECK_FALSE(path.points.empty());
    CHECK(path.name.find('\n') == std::string::npos);
    bool is_right = true;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      is_right &= check_place(path.points[i].place).has_value() && std::isfinite(path.points[i].time_s);
      if (i > 0) is_right &= path.points[i].time_s > path.points[i - 1].time_s;
    }
    CHECK(is_right);
  }
}

}  // namespace

TEST_CASE("a file cut off at any byte is refused or read as far as it goes") {
  for (const std::string& text : all_examples())
    for (std::size_t size = 0; size < text.size(); ++size) check_promises(text.substr(0, size));
}

TEST_CASE("flipped bits and bytes out of place do no harm") {
  std::mt19937 random(20260501);
  for (const std::string& text : all_examples())
    for (int round = 0; round < 400; ++round) {
      std::string broken = text;
      for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
        broken[random() % broken.size()] ^= static_cast<char>(1U << (random() % 8));
      if (round % 4 == 0) broken.erase(random() % broken.size(), random() % 20);
      if (round % 4 == 1) broken.insert(random() % broken.size(), broken.substr(random() % broken.size(), 30));
      check_promises(broken);
    }
}

TEST_CASE("the examples themselves are read") {
  for (const std::string& text : all_examples()) CHECK(recorded_paths_of(text, "file").has_value());
}
