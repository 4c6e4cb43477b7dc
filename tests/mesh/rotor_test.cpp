// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <numbers>

#include "mesh/mesh.h"
#include "mesh/written.h"

namespace sigs::test {
namespace {

// A disc of radius 2 units around (10, 0, 5), which faces +z, in the material "disc".
constexpr char kDisc[] = "mtllib model.mtl\nusemtl disc\nv 12 0 5\nv 10 2 5\nv 8 0 5\nv 10 -2 5\nf 1 2 3\nf 1 3 4\n";

Mesh disc_with(const std::string& statements, const ModelAxes& axes = {}, const std::string& obj = kDisc) {
  const TemporaryFolder folder;
  written(folder / "model.mtl", "newmtl disc\nKd 0 0 0\nd 0.2\n" + statements);
  return read_obj(written(folder / "model.obj", obj), axes).value();
}

}  // namespace

TEST_CASE("a rotor of an MTL file lies on its material's disc, in body axes and metres") {
  const Mesh mesh =
      disc_with("rotor_blades 3\nrotor_rpm -390\nrotor_radii 0.5 1.9\nrotor_chords 0.3 0.4\nrotor_phase 90\n",
                {.forward = "+y", .up = "+z", .scale = 0.5});
  CHECK(mesh.warnings.empty());
  REQUIRE(mesh.materials.at(0).rotor);
  const Rotor& rotor = *mesh.materials[0].rotor;
  CHECK(rotor.blade_count == 3);
  CHECK(rotor.rpm == -390);
  CHECK(rotor.root_m == doctest::Approx(0.25));
  CHECK(rotor.tip_m == doctest::Approx(0.95));
  CHECK(rotor.root_chord_m == doctest::Approx(0.15));
  CHECK(rotor.tip_chord_m == doctest::Approx(0.2));
  CHECK(rotor.phase_rad == doctest::Approx(std::numbers::pi / 2));
  // The file's x is the body's right, its z the body's up.
  CHECK(glm::distance(rotor.hub_m, glm::dvec3(0, 5, -2.5)) < 1e-6);
  CHECK(glm::distance(rotor.axis, glm::dvec3(0, 0, -1)) < 1e-6);
  CHECK(glm::distance(rotor.across, glm::dvec3(1, 0, 0)) < 1e-6);
}

TEST_CASE("what is not said of a rotor is taken from its disc") {
  const Mesh mesh = disc_with("rotor_blades 2\nrotor_rpm 2400\n");
  REQUIRE(mesh.materials.at(0).rotor);
  CHECK(mesh.materials[0].rotor->tip_m == doctest::Approx(2));
  CHECK(mesh.materials[0].rotor->tip_chord_m == doctest::Approx(2.0 / 15));
  CHECK(mesh.materials[0].rotor->phase_rad == 0);
  // A propeller's axis is the way it faces; phases count from the body's top.
  const Mesh propeller = disc_with("rotor_blades 2\nrotor_rpm 2400\n", {.forward = "+z", .up = "+x"});
  CHECK(glm::distance(propeller.materials.at(0).rotor.value().axis, glm::dvec3(1, 0, 0)) < 1e-6);
  CHECK(glm::distance(propeller.materials.at(0).rotor.value().across, glm::dvec3(0, 0, -1)) < 1e-6);
}

TEST_CASE("wrong statements of a rotor are named, and the material is drawn as an ordinary one") {
  const auto warning_of = [](const std::string& statements) {
    const Mesh mesh = disc_with(statements);
    CHECK_FALSE(mesh.materials.at(0).rotor);
    REQUIRE(mesh.warnings.size() == 1);
    return mesh.warnings[0].text();
  };
  CHECK(warning_of("rotor_rpm 100\n") == "model.obj: material disc: rotor_blades is missing; its blades do not turn");
  CHECK(warning_of("rotor_blades 2\n").find("rotor_rpm is missing") != std::string::npos);
  for (const std::string blades : {"0", "17", "2.5", "-1", "two", "", "nan", "1e99", "2 3"})
    CHECK(warning_of("rotor_blades " + blades + "\nrotor_rpm 100\n").find("rotor_blades") != std::string::npos);
  const std::string good = "rotor_blades 2\nrotor_rpm 100\n";
  for (const std::string radii : {"2 1", "1 1", "-1 2", "1", "1 inf", "a b"})
    CHECK(warning_of(good + "rotor_radii " + radii + "\n").find("rotor_radii") != std::string::npos);
  for (const std::string chords : {"0 0", "-1 2", "1"})
    CHECK(warning_of(good + "rotor_chords " + chords + "\n").find("rotor_chords") != std::string::npos);
  CHECK(warning_of(good + "rotor_coning 3\n").find("rotor_coning is not known") != std::string::npos);
}

TEST_CASE("a rotor whose faces form no disc does not turn, and says so") {
  const std::string box = "mtllib model.mtl\nusemtl disc\n" + box_obj();
  const Mesh mesh = disc_with("rotor_blades 2\nrotor_rpm 100\n", {}, box);
  CHECK_FALSE(mesh.materials.at(0).rotor);
  REQUIRE(mesh.warnings.size() == 1);
  CHECK(mesh.warnings[0].text() == "model.obj: material disc: its faces form no disc; its blades do not turn");
}

}  // namespace sigs::test
