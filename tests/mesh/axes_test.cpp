// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <cmath>
#include <limits>

#include "mesh/geometry.h"
#include "mesh/mesh.h"
#include "mesh/written.h"
#include "support/test_data.h"

namespace sigs {
namespace {

const std::string kDirections[] = {"+x", "-x", "+y", "-y", "+z", "-z"};

glm::dvec3 unit(const std::string& text) {
  glm::dvec3 direction{0, 0, 0};
  direction[text[1] - 'x'] = text[0] == '-' ? -1 : 1;
  return direction;
}

}  // namespace

TEST_CASE("every pair of perpendicular axes rotates the model without mirroring it") {
  int count = 0;
  for (const std::string& forward : kDirections)
    for (const std::string& up : kDirections) {
      if (forward[1] == up[1]) continue;
      const Result<glm::dmat3> rotation = body_from_model({.forward = forward, .up = up});
      REQUIRE(rotation);
      ++count;
      // Signed permutations: all products are exact.
      CHECK(glm::determinant(*rotation) == 1);
      CHECK(*rotation * unit(forward) == glm::dvec3{1, 0, 0});
      CHECK(*rotation * unit(up) == glm::dvec3{0, 0, -1});
    }
  CHECK(count == 24);  // the rotations of a cube
}

TEST_CASE("a model with its nose along minus x and up along y has its left wing along z") {
  const Result<glm::dmat3> rotation = body_from_model({.forward = "-x", .up = "+y"});
  REQUIRE(rotation);
  CHECK(*rotation * glm::dvec3{0, 0, 1} == glm::dvec3{0, -1, 0});
}

TEST_CASE("invalid axes are refused by name") {
  const auto refused = [](const ModelAxes& axes, const char* where) {
    const Result<glm::dmat3> rotation = body_from_model(axes);
    REQUIRE_FALSE(rotation);
    CHECK(rotation.error().where == where);
    CHECK(rotation.error().kind == ErrorKind::bad_project);
    CHECK_FALSE(rotation.error().what.empty());
  };
  for (const char* text : {"", "x", "+w", "*x", "+xx", "+X", "forward"}) {
    refused({.forward = text}, "forward");
    refused({.up = text}, "up");
  }
  refused({.forward = "+x", .up = "+x"}, "up");
  refused({.forward = "+x", .up = "-x"}, "up");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double scale : {0.0, -1.0, infinity, std::nan("")}) refused({.scale = scale}, "scale");
  for (const double length_m : {-1.0, infinity, std::nan("")}) refused({.length_m = length_m}, "length_m");
}

TEST_CASE("the box lies in body axes with the wanted scale") {
  const test::TemporaryFolder folder;
  const auto path = test::written(folder / "box.obj", test::box_obj());
  const Result<Mesh> mesh = read_obj(path, {.forward = "+y", .up = "+x", .scale = 0.5});
  REQUIRE(mesh);
  // Model 4 x 2 x 1: forward y is 2 long, up x is 4 high and points to -Z, right is Z cross X = (-x) cross y = -z.
  // Halves of small integers are exact.
  CHECK(mesh->low_m == glm::vec3{0, -0.5F, -2});
  CHECK(mesh->high_m == glm::vec3{1, 0, 0});
  CHECK(mesh->radius_m == doctest::Approx(std::sqrt(1 + 0.25 + 4)));
}

TEST_CASE("a given length sets the scale and overrides it") {
  const test::TemporaryFolder folder;
  const auto path = test::written(folder / "box.obj", test::box_obj());
  const Result<Mesh> mesh = read_obj(path, {.scale = 100, .length_m = 33.4});
  REQUIRE(mesh);
  CHECK(mesh->high_m.x - mesh->low_m.x == doctest::Approx(33.4).epsilon(1e-6));  // float coordinates
  CHECK(mesh->high_m.y - mesh->low_m.y == doctest::Approx(16.7).epsilon(1e-6));
}

TEST_CASE("a model that is flat across its axis cannot be given a length") {
  const test::TemporaryFolder folder;
  const auto path = test::written(folder / "flat.obj", "v 1 0 0\nv 1 1 0\nv 1 0 1\nf 1 2 3\n");
  const Result<Mesh> mesh = read_obj(path, {.length_m = 10});
  REQUIRE_FALSE(mesh);
  CHECK(mesh.error().kind == ErrorKind::bad_data);
  CHECK(mesh.error().text().find("flat.obj") != std::string::npos);
  CHECK(read_obj(path, {}));
}

TEST_CASE("anchored at its bounds the model lies around the origin") {
  const test::TemporaryFolder folder;
  const auto path = test::written(folder / "box.obj", test::box_obj());
  const Result<Mesh> mesh = read_obj(path, {.anchor_at_bounds = true});
  REQUIRE(mesh);
  CHECK(mesh->low_m == glm::vec3{-2, -1, -0.5F});
  CHECK(mesh->high_m == glm::vec3{2, 1, 0.5F});
  CHECK(mesh->radius_m == doctest::Approx(std::sqrt(4 + 1 + 0.25)));
}

}  // namespace sigs
