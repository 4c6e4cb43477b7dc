// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sigs;
using namespace sigs::editor;

namespace {

FoundLine line_of(const Appearance& appearance, const std::string& name) {
  const std::vector<FoundLine> lines = found_lines(appearance);
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const FoundLine& line) { return line.name == name; });
  REQUIRE_MESSAGE(found != lines.end(), name);
  return *found;
}

}  // namespace

TEST_CASE("a quantity that was found has its deviation and unit, without an exponent however large") {
  Appearance found;
  found.point_spread.sigma_px = {.value = 0.6213, .sd = 0.0312, .is_known = true};
  found.surroundings.haze.visibility_m = {.value = 30612, .sd = 6730, .is_known = true};
  CHECK(line_of(found, "Point spread").value == "0.621 \u00b1 0.031 px");
  CHECK(line_of(found, "Visibility").value == "30612 \u00b1 6730 m");
  CHECK(line_of(found, "Visibility").why.empty());
}

TEST_CASE("a quantity that is not known has what is taken for it, and why") {
  Appearance found;
  found.point_spread.sigma_px = {.value = 0.45, .why = "only 3 edges"};
  found.surroundings.haze.visibility_m = {.why = "no horizon"};
  CHECK(line_of(found, "Point spread").value == "not known; 0.45 px");
  CHECK(line_of(found, "Point spread").why == "only 3 edges");
  CHECK(line_of(found, "Visibility").value == "not known; clear air");
}

TEST_CASE("the three parts of a colour share a line") {
  Appearance found;
  const double light[] = {0.271, 0.342, 0.462};
  for (std::size_t i = 0; i < 3; ++i)
    found.surroundings.light.sky_color[i] = {.value = light[i], .sd = 0.01 * double(i + 5), .is_known = true};
  CHECK(line_of(found, "Sky").value == "0.27 0.34 0.46 \u00b1 0.07");
  for (const FoundLine& line : found_lines(found)) CHECK(line.name.find(", red") == std::string::npos);
  CHECK(found_lines(found).size() + 8 == quantities_of(found).size());  // four colours
}
