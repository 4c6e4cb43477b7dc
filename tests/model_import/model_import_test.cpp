// SPDX-License-Identifier: MIT
#include "model_import/import_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <numbers>

#include "mesh/mesh.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// An imported model, written and read as any OBJ.
struct Imported {
  ImportedModel model;
  Mesh mesh;
};

Imported imported(const ModelImport& request) {
  Result<ImportedModel> model = import_model(request, "model");
  if (!model) FAIL(model.error().text());
  const TemporaryFolder folder;
  for (const ImportedFile& file : model->files) write_file(folder / file.name, file.bytes);
  Result<Mesh> mesh = read_obj(folder / "model.obj");
  if (!mesh) FAIL(mesh.error().text());
  return {*std::move(model), *std::move(mesh)};
}

bool has_note(const ImportedModel& model, const std::string& part) {
  return std::any_of(model.notes.begin(), model.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// The sample light aircraft in another format, by the library's own writers.
void convert(const char* format, const fs::path& file) {
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(
      (source_dir() / "assets/models/light-aircraft/light-aircraft.obj").string(), aiProcess_JoinIdenticalVertices);
  REQUIRE(scene != nullptr);
  Assimp::Exporter exporter;
  REQUIRE(exporter.Export(scene, format, file.string()) == aiReturn_SUCCESS);
}

// An AC3D file: objects of triangles, y up, the nose along -x as FlightGear has it.
struct AcObject {
  std::string name;
  std::vector<glm::dvec3> points;  // three for each triangle
};

std::string ac_text(const std::vector<AcObject>& objects) {
  std::string text = "AC3Db\nMATERIAL \"paint\" rgb 0.8 0.1 0.1 amb 1 1 1 emis 0 0 0 spec 0.2 0.2 0.2 shi 64 trans 0\n";
  text += fmt::format("OBJECT world\nkids {}\n", objects.size());
  for (const AcObject& object : objects) {
    text += fmt::format("OBJECT poly\nname \"{}\"\nnumvert {}\n", object.name, object.points.size());
    for (const glm::dvec3& p : object.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    text += fmt::format("numsurf {}\n", object.points.size() / 3);
    for (std::size_t i = 0; i < object.points.size(); i += 3)
      text += fmt::format("SURF 0x20\nmat 0\nrefs 3\n{} 0 0\n{} 1 0\n{} 0 1\n", i, i + 1, i + 2);
    text += "kids 0\n";
  }
  return text;
}

// Triangles between the corners of a box.
std::vector<glm::dvec3> box(const glm::dvec3& low, const glm::dvec3& high) {
  const auto at = [&](int i) {
    return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  };
  std::vector<glm::dvec3> points;
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for (const int i : {a, b, c, a, c, d}) points.push_back(at(i));
  return points;
}

// 7 m long, 10 m across, 2.5 m high; nose at -x.
std::vector<AcObject> aircraft_objects() {
  return {{"fuselage", box({-2.5, -0.5, -0.5}, {4.5, 0.5, 0.5})},
          {"wing", box({-0.8, -0.1, -5}, {0.6, 0.1, 5})},
          {"tail", box({3.7, 0.2, -1.6}, {4.5, 0.3, 1.6})},
          {"fin", box({3.8, 0.5, -0.05}, {4.5, 2.0, 0.05})}};
}

}  // namespace

TEST_CASE("a model has its size, its nose and its top, in whatever format it comes") {
  const TemporaryFolder folder;
  const Mesh original = read_obj(source_dir() / "assets/models/light-aircraft/light-aircraft.obj").value();
  for (const auto& [format, name, unit_m] : {std::tuple{"glb2", "a.glb", 1.0},
                                             {"gltf2", "a.gltf", 1.0},
                                             {"collada", "a.dae", 1.0},
                                             {"fbxa", "a.fbx", 0.01},
                                             {"3ds", "a.3ds", 1.0}}) {
    convert(format, folder / name);
    const Imported got = imported({.file = folder / name, .turns_rotors = false});
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(got.mesh.low_m[axis] == doctest::Approx(unit_m * original.low_m[axis]).epsilon(0.002));
      CHECK(got.mesh.high_m[axis] == doctest::Approx(unit_m * original.high_m[axis]).epsilon(0.002));
    }
    // The wings tell nothing about left and right; the lamps do: red on the left, which is -y of body axes.
    const auto middle_of = [&](const std::string& part) {
      double sum = 0;
      int count = 0;
      for (const MeshPart& one : got.mesh.parts)
        if (got.mesh.materials[static_cast<std::size_t>(one.material)].name.find(part) != std::string::npos)
          for (std::uint32_t i = 0; i < one.index_count; ++i, ++count)
            sum += double(got.mesh.vertices[got.mesh.indices[one.first_index + i]].position_m.y);
      REQUIRE(count > 0);
      return sum / count;
    };
    CHECK(middle_of("light_red") < 0);
    CHECK(middle_of("light_green") > 0);
    CHECK(got.model.triangles == doctest::Approx(8376).epsilon(0.02));
  }
}

TEST_CASE("an AC3D model lies as FlightGear has it, and its propeller turns") {
  const TemporaryFolder folder;
  std::vector<AcObject> objects = aircraft_objects();
  objects.push_back({"Propeller.1", box({-2.7, -0.9, -0.08}, {-2.6, 0.9, 0.08})});
  write_file(folder / "a.ac", ac_text(objects));
  const Imported got = imported({.file = folder / "a.ac"});
  CHECK(has_note(got.model, "nose along -x of the file, top along +y"));
  CHECK(got.model.size_m.x == doctest::Approx(7.2).epsilon(0.02));
  CHECK(got.model.size_m.y == doctest::Approx(10));
  CHECK(has_note(got.model, "rotor_1: propeller of 1.8"));
  CHECK(has_note(got.model, "2 blades;"));
  const auto rotor = std::find_if(got.mesh.materials.begin(), got.mesh.materials.end(),
                                  [](const Material& m) { return m.rotor.has_value(); });
  REQUIRE(rotor != got.mesh.materials.end());
  CHECK(rotor->rotor->hub_m.x == doctest::Approx(2.65).epsilon(0.01));
  CHECK(std::abs(rotor->rotor->axis.x) == doctest::Approx(1));
  CHECK(rotor->rotor->tip_m == doctest::Approx(std::hypot(0.9, 0.08)).epsilon(0.01));
  const Imported still = imported({.file = folder / "a.ac", .turns_rotors = false});
  CHECK_FALSE(has_rotors(still.mesh));
}

// Blades longer than the fuselage would be taken for wings, and the boom for the nose.
TEST_CASE("a helicopter's nose is found by what is no rotor") {
  for (const double nose : {-1.0, 1.0}) {
    const TemporaryFolder folder;
    const auto along = [&](double from, double to) {
      return std::array{std::min(nose * from, nose * to), std::max(nose * from, nose * to)};
    };
    const auto part = [&](const char* name, double from, double to, const glm::dvec3& low, const glm::dvec3& high) {
      const std::array<double, 2> x = along(from, to);
      return AcObject{name, box({x[0], low.y, low.z}, {x[1], high.y, high.z})};
    };
    std::vector<AcObject> objects{part("cabin", -1, 1, {0, -0.6, -0.5}, {0, 0.6, 0.5}),
                                  part("boom", -5, -1, {0, 0.2, -0.1}, {0, 0.4, 0.1}),
                                  part("tailplane", -4.6, -4.2, {0, 0.3, -0.9}, {0, 0.35, 0.9}),
                                  part("fin", -5, -4.6, {0, 0.2, -0.05}, {0, 1.4, 0.05}),
                                  {"main_rotor", box({-5, 1.2, -0.1}, {5, 1.22, 0.1})}};
    for (const glm::dvec3& p : box({-0.1, 1.2, -5}, {0.1, 1.22, 5})) objects.back().points.push_back(p);
    write_file(folder / "a.ac", ac_text(objects));
    const Imported got = imported({.file = folder / "a.ac"});
    CHECK(has_note(got.model, nose < 0 ? "nose along -x" : "nose along +x"));
    CHECK(has_note(got.model, "main rotor of 10.0"));
  }
}

TEST_CASE("propellers left and right in one object are two, a main rotor is upright, a tail rotor across") {
  const TemporaryFolder folder;
  std::vector<AcObject> objects = aircraft_objects();
  AcObject both{"propellers", box({-1.2, -0.9, -2.58}, {-1.1, 0.9, -2.42})};
  for (const glm::dvec3& p : box({-1.2, -0.9, 2.42}, {-1.1, 0.9, 2.58})) both.points.push_back(p);
  objects.push_back(both);
  objects.push_back({"main_rotor", {}});
  for (int blade = 0; blade < 4; ++blade) {
    const double angle = blade * std::numbers::pi / 2;
    const glm::dvec3 along(std::cos(angle), 0, std::sin(angle)), across(-along.z, 0, along.x), up(0, 0.02, 0),
        hub(0, 1.6, 0);
    const auto at = [&](double r, double s) { return hub + r * along + s * across; };
    for (const glm::dvec3& p :
         {at(0.3, -0.15), at(4, -0.15), at(4, 0.15), at(0.3, -0.15), at(4, 0.15) + up, at(0.3, 0.15)})
      objects.back().points.push_back(p);
  }
  objects.push_back({"tail_rotor", box({3.4, 0.98, 0.15}, {4.6, 1.08, 0.2})});
  write_file(folder / "a.ac", ac_text(objects));
  const Imported got = imported({.file = folder / "a.ac", .forward = "-x", .up = "+y", .length_m = 7.5});
  CHECK(has_note(got.model, ", as stated"));
  int propellers = 0, upright = 0, across = 0;
  for (const Material& material : got.mesh.materials) {
    if (!material.rotor) continue;
    propellers += std::abs(material.rotor->axis.x) > 0.99 ? 1 : 0;
    upright += std::abs(material.rotor->axis.z) > 0.99 && material.rotor->blade_count == 4 ? 1 : 0;
    across += std::abs(material.rotor->axis.y) > 0.99 && material.rotor->blade_count == 2 ? 1 : 0;
  }
  CHECK(propellers == 2);
  CHECK(upright == 1);
  CHECK(across == 1);
}

TEST_CASE("what is no model, has no triangle or states no axes is an error that says so") {
  const TemporaryFolder folder;
  write_file(folder / "a.glb", "hello");
  write_file(folder / "empty.ac", "AC3Db\nOBJECT world\nkids 0\n");
  write_file(folder / "a.ac", ac_text(aircraft_objects()));
  CHECK(import_model({.file = folder / "none.glb"}, "m").error().kind == ErrorKind::cannot_read);
  CHECK(import_model({.file = folder / "a.glb"}, "m").error().text().find("is no model that can be read") !=
        std::string::npos);
  CHECK_FALSE(import_model({.file = folder / "empty.ac"}, "m"));
  CHECK(import_model({.file = folder / "a.ac", .forward = "up"}, "m").error().where == "forward");
  CHECK(import_model({.file = folder / "a.ac", .forward = "-x", .up = "+x"}, "m").error().where == "up");
}

TEST_CASE("a texture in SGI's format, as FlightGear has them, is written as PNG") {
  const TemporaryFolder folder;
  // 1 x 1, three planes of a byte: red 200, green 100, blue 50.
  std::string sgi("\x01\xDA\0\x01\0\x03\0\x01\0\x01\0\x03\0\0\0\0\0\0\0\xFF", 20);
  sgi.resize(512, '\0');
  write_file(folder / "paint.rgb", sgi + "\xC8\x64\x32");
  std::string text = ac_text(aircraft_objects());
  const std::string name = "name \"fuselage\"\n";
  text.insert(text.find(name) + name.size(), "texture \"paint.rgb\"\n");
  write_file(folder / "a.ac", text);
  const Imported got = imported({.file = folder / "a.ac"});
  CHECK(got.model.warnings.empty());
  CHECK(std::ranges::any_of(got.model.files, [](const ImportedFile& file) { return file.name == "paint.png"; }));
  const auto painted = std::ranges::find_if(got.mesh.materials, [](const Material& m) { return !m.texture.empty(); });
  REQUIRE(painted != got.mesh.materials.end());
  CHECK(painted->texture.at<cv::Vec4b>(0, 0) == cv::Vec4b(200, 100, 50, 255));
}

}  // namespace sigs::test
