// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
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

namespace {

// A flat bar across y, 2 by 0.2 units in the plane x = 9, which faces +x and -x: a propeller of two blades.
std::string bar_obj(int first, double y) {
  std::string text;
  for (const auto& [dy, dz] : {std::pair{-1.0, -0.1}, {1.0, -0.1}, {1.0, 0.1}, {-1.0, 0.1}})
    text += fmt::format("v 9 {} {}\n", y + dy, dz);
  return text + fmt::format("f {0} {1} {2} {3}\nf {3} {2} {1} {0}\n", first, first + 1, first + 2, first + 3);
}

Result<Mesh> with_rotors(const std::string& parts, const std::vector<StatedRotor>& rotors) {
  const TemporaryFolder folder;
  return read_obj(written(folder / "model.obj", box_obj() + parts), {}, {.rotors = rotors});
}

std::vector<Rotor> rotors_of(const Mesh& mesh) {
  std::vector<Rotor> rotors;
  for (const Material& material : mesh.materials)
    if (material.rotor) rotors.push_back(*material.rotor);
  return rotors;
}

}  // namespace

TEST_CASE("a stated rotor takes the place of blades that are modelled, found by material, group or object") {
  for (const char* const line : {"usemtl prop\n", "g prop\n", "g prop other\n", "o prop\n", "g prop\no bar\n"}) {
    const Result<Mesh> mesh =
        with_rotors(line + bar_obj(9, 5), {{.part = "prop", .blade_count = 2, .rpm = -2400, .axis = {2, 0, 0}}});
    REQUIRE(mesh);
    const std::vector<Rotor> rotors = rotors_of(*mesh);
    REQUIRE(rotors.size() == 1);
    CHECK(rotors[0].blade_count == 2);
    CHECK(rotors[0].rpm == -2400);
    CHECK(glm::distance(rotors[0].hub_m, glm::dvec3(9, -5, 0)) < 1e-6);  // the body's right is the file's -y
    CHECK(rotors[0].axis == glm::dvec3(1, 0, 0));
    CHECK(rotors[0].across == glm::dvec3(0, 0, -1));
    CHECK(rotors[0].tip_m == doctest::Approx(std::hypot(1, 0.1)));
    CHECK(rotors[0].tip_chord_m == doctest::Approx(rotors[0].tip_m / 15));
    // The blades are gone, the disc is there: all beyond x = 5 lies in its plane, around its hub.
    double farthest_m = 0;
    for (const Vertex& vertex : mesh->vertices) {
      if (vertex.position_m.x < 5) continue;
      CHECK(vertex.position_m.x == doctest::Approx(9));
      farthest_m = std::max(farthest_m, glm::distance(glm::dvec3(vertex.position_m), rotors[0].hub_m));
    }
    CHECK(farthest_m == doctest::Approx(rotors[0].tip_m / std::cos(std::numbers::pi / 48)));
    CHECK(mesh->high_m.x == doctest::Approx(9));
  }
}

TEST_CASE("of two propellers in one group each is stated by its hub, and blades cone towards the axis") {
  const std::string both = "g prop\n" + bar_obj(9, -5) + bar_obj(13, 5);
  const Result<Mesh> mesh =
      with_rotors(both, {{.part = "prop", .coning_rad = 0.1, .axis = {-1, 0, 0}, .radius_m = 1.1, .hub_m = {9, 5, 0}},
                         {.part = "prop", .axis = {1, 0, 0}, .radius_m = 1.2, .hub_m = {9, -5, 0}}});
  REQUIRE(mesh);
  const std::vector<Rotor> rotors = rotors_of(*mesh);
  REQUIRE(rotors.size() == 2);
  CHECK(rotors[0].tip_m == 1.1);
  CHECK(rotors[0].rpm == doctest::Approx(200 / 1.1 * 60 / (2 * std::numbers::pi)));
  CHECK(rotors[1].hub_m == glm::dvec3(9, -5, 0));
  for (const Vertex& vertex : mesh->vertices)
    if (vertex.position_m.x > 5 && vertex.position_m.y > 0) {
      const double radius_m = std::hypot(vertex.position_m.y - 5.0, double(vertex.position_m.z));
      CHECK(vertex.position_m.x == doctest::Approx(9 - std::tan(0.1) * radius_m));
    }
  // Without hubs they look like one rotor with nothing in its middle.
  const Result<Mesh> one = with_rotors(both, {{.part = "prop", .axis = {1, 0, 0}}});
  REQUIRE_FALSE(one);
  CHECK(one.error().kind == ErrorKind::bad_project);
  CHECK(one.error().where == "rotors[0].radius_m");
}

TEST_CASE("a part without blades is left out") {
  const Mesh mesh = with_rotors("g prop\n" + bar_obj(9, 5), {{.part = "prop", .blade_count = 0}}).value();
  CHECK(mesh.high_m.x == doctest::Approx(4));
  CHECK_FALSE(has_rotors(mesh));
  const TemporaryFolder folder;
  const Result<Mesh> nothing = read_obj(written(folder / "model.obj", "g prop\n" + bar_obj(1, 5)), {},
                                        {.rotors = {{.part = "prop", .blade_count = 0}}});
  REQUIRE_FALSE(nothing);
  CHECK(nothing.error().text() == "rotors[0].blades: leave nothing of the model");
}

TEST_CASE("a stated rotor that cannot be is refused by its setting") {
  const auto refused = [](const StatedRotor& rotor) {
    const Result<Mesh> mesh = with_rotors("g prop\n" + bar_obj(9, 5), {{.part = "prop", .axis = {1, 0, 0}}, rotor});
    REQUIRE_FALSE(mesh);
    CHECK(mesh.error().kind == ErrorKind::bad_project);
    return mesh.error().text();
  };
  CHECK(refused({.part = "rotor"}) ==
        "rotors[1].part: the model has no material, group or object \"rotor\"; materials: none; groups: prop; objects: "
        "none");
  CHECK(refused({.part = "prop"}).starts_with("rotors[1].part: no face of \"prop\" can be seen"));
  const Result<Mesh> no_axis = with_rotors("g prop\n" + bar_obj(9, 5), {{.part = "prop"}});
  REQUIRE_FALSE(no_axis);
  CHECK(no_axis.error().text().starts_with("rotors[0].axis: the faces of \"prop\" form no disc"));
}

TEST_CASE("gloss is a factor of highlights alone") {
  const TemporaryFolder folder;
  written(folder / "model.mtl", "newmtl disc\nKd 0.5 0.6 0.7\nKs 0.2 0.3 0.4\nNs 50\n");
  const std::filesystem::path obj = written(folder / "model.obj", kDisc);
  const Mesh plain = read_obj(obj).value();
  const Mesh glossy = read_obj(obj, {}, {.gloss = 2}).value();
  CHECK(glossy.materials.at(0).diffuse == plain.materials.at(0).diffuse);
  CHECK(glossy.materials[0].specular == 2.0F * plain.materials[0].specular);
  CHECK(glossy.materials[0].shininess == plain.materials[0].shininess);
  CHECK(read_obj(obj, {}, {.gloss = 0}).value().materials[0].specular == glm::vec3(0));
}

}  // namespace sigs::test
