// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "mesh/geometry.h"
#include "support/test_data.h"

using namespace sigs;

namespace {

// Reads with the axes in which nothing is changed but names, and says what the shape tells.
std::string shape_text(const std::filesystem::path& file, const ModelAxes& axes = {}) {
  const Result<Mesh> mesh = read_obj(file, axes);
  REQUIRE(mesh);
  const ModelShape shape = shape_of(*mesh);
  return file_axis(shape.nose, axes) + (shape.nose_is_sure ? "! " : "? ") + file_axis(shape.top, axes) +
         (shape.top_is_sure ? "!" : "?");
}

}  // namespace

TEST_CASE("the nose and the top of aircraft are found in their shape, whatever axes they were read with") {
  for (const char* const name : {"light-aircraft", "airliner"}) {
    CAPTURE(name);
    const auto file = test::source_dir() / "assets/models" / name / (std::string(name) + ".obj");
    for (const auto& [forward, up] : {std::pair{"+x", "+z"}, {"-x", "+y"}, {"+y", "-x"}, {"-z", "-y"}})
      CHECK(shape_text(file, {.forward = forward, .up = up}) == "+x! +z!");
  }
}

TEST_CASE("models of others, with the nose along -x and the top along +y, are recognised") {
  if (!test::has_real_data()) return;
  for (const char* const name : {"boeing737-300", "cessna172p-hires", "glider-centrair101", "helicopter-dauphin"}) {
    CAPTURE(name);
    CHECK(shape_text(test::real_data() / "models" / name / (std::string(name) + ".obj")) == "-x! +y!");
  }
}
TEST_CASE("a quadcopter has no tail that would tell its nose") {
  const auto file = test::source_dir() / "assets/models/quadcopter/quadcopter.obj";
  const Result<Mesh> mesh = read_obj(file);
  REQUIRE(mesh);
  CHECK_FALSE(shape_of(*mesh).nose_is_sure);
}
