// SPDX-License-Identifier: MIT

#include <unistd.h>

#include <doctest/doctest.h>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "mesh/mesh.h"
#include "mesh/obj_file.h"
#include "mesh/written.h"
#include "support/test_data.h"

namespace sigs {
namespace {

using test::mesh_of;

void refused(const std::string& text, const std::string& part_of_message) {
  CAPTURE(text);
  const Result<Mesh> mesh = mesh_of(text);
  REQUIRE_FALSE(mesh);
  CHECK(mesh.error().kind == ErrorKind::bad_data);
  CAPTURE(mesh.error().text());
  CHECK(mesh.error().text().find("model.obj") != std::string::npos);
  CHECK(mesh.error().text().find(part_of_message) != std::string::npos);
}

double area_m2(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t corner) { return glm::dvec3(mesh.vertices[mesh.indices[i + corner]].position_m); };
    sum += 0.5 * glm::length(glm::cross(p(1) - p(0), p(2) - p(0)));
  }
  return sum;
}

// Positive where the surface is closed and wound counter-clockwise seen from outside (divergence theorem).
double volume_m3(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t corner) { return glm::dvec3(mesh.vertices[mesh.indices[i + corner]].position_m); };
    sum += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
  }
  return sum;
}

constexpr char kTriangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a file of another format is named in the error") {
  const auto utf16 = [](const std::string& text) {
    std::string wide = "\xFF\xFE";
    for (const char c : text) wide.append(1, c).append(1, '\0');
    return wide;
  };
  const std::string obj = std::string(kTriangle) + "f 1 2 3\n";
  refused(utf16(obj), "UTF-16");
  refused(utf16(obj).substr(2), "not text");
  refused("solid cube\n facet normal 0 0 1\n  outer loop\n  vertex 0 0 0\nendsolid\n", "STL");
  std::string stl(80, ' ');
  stl += std::string("\2\0\0\0", 4) + std::string(100, '\0');
  refused(stl, "STL");
  refused("ply\nformat ascii 1.0\n", "PLY");
  refused("glTF\2", "glTF");
  CHECK(mesh_of("\xEF\xBB\xBF" + obj));  // the mark of UTF-8 before the first vertex
}

TEST_CASE("colours of vertices are ignored with a warning") {
  const Result<Mesh> colored = mesh_of("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 1\nf 1 2 3\n");
  REQUIRE(colored);
  REQUIRE(colored->warnings.size() == 1);
  CHECK(colored->warnings[0].text().find("colours of 2 vertices") != std::string::npos);
  const Result<Mesh> weighted = mesh_of("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n");
  REQUIRE(weighted);
  CHECK(weighted->warnings.empty());
}

TEST_CASE("a box becomes twelve triangles with its area and volume and four vertices a side") {
  const Result<Mesh> mesh = mesh_of(test::box_obj());
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 36);
  CHECK(mesh->vertices.size() == 24);  // each corner has three normals
  REQUIRE(mesh->parts.size() == 1);
  CHECK(mesh->parts[0].index_count == 36);
  CHECK(area_m2(*mesh) == doctest::Approx(28));
  CHECK(volume_m3(*mesh) == doctest::Approx(8));
  CHECK(mesh->warnings.empty());
}

TEST_CASE("the volume stays positive in any axes because nothing is mirrored") {
  const test::TemporaryFolder folder;
  const auto path = test::written(folder / "box.obj", test::box_obj());
  for (const char* forward : {"+x", "-x", "+y", "-y", "+z", "-z"})
    for (const char* up : {"+x", "-x", "+y", "-y", "+z", "-z"})
      if (forward[1] != up[1]) CHECK(volume_m3(read_obj(path, {.forward = forward, .up = up}).value()) > 7.9);
}

TEST_CASE("a concave polygon is cut into triangles that stay inside it") {
  // An L of area 3, seen along z, with a notch that a fan from the first corner would cover.
  const Result<Mesh> mesh = mesh_of("v 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nf 1 2 3 4 5 6\n");
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 12);
  CHECK(area_m2(*mesh) == doctest::Approx(3));
}

TEST_CASE("a polygon of three hundred corners keeps its area") {
  std::ostringstream text;
  constexpr int kCorners = 300;
  for (int i = 0; i < kCorners; ++i)
    text << "v " << std::cos(2 * M_PI * i / kCorners) << " " << std::sin(2 * M_PI * i / kCorners) << " 5\n";
  text << "f";
  for (int i = 1; i <= kCorners; ++i) text << " " << i;
  const Result<Mesh> mesh = mesh_of(text.str() + "\n");
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 3 * (kCorners - 2));
  // Area of the regular polygon; the coordinates above are written with six digits.
  CHECK(area_m2(*mesh) == doctest::Approx(0.5 * kCorners * std::sin(2 * M_PI / kCorners)).epsilon(1e-5));
}

// One polygon, its corners at equal angles, as far from the middle as radius_m(i) says.
std::string ring_obj(int corners, double (*radius_m)(int)) {
  std::ostringstream text;
  text.precision(9);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i / corners;
    text << "v " << radius_m(i) * std::cos(angle) << " " << radius_m(i) * std::sin(angle) << " 0\n";
  }
  text << "f";
  for (int i = 1; i <= corners; ++i) text << " " << i;
  text << "\n";
  return text.str();
}

// The shoelace formula on the corners that ring_obj() writes.
double ring_area_m2(int corners, double (*radius_m)(int)) {
  const double step = 2 * 3.14159265358979 / corners;
  double sum = 0;
  for (int i = 0; i < corners; ++i) sum += 0.5 * radius_m(i) * radius_m((i + 1) % corners) * std::sin(step);
  return sum;
}

TEST_CASE("polygons of up to a hundred thousand corners keep their area whatever their outline") {
  alarm(300);  // a hang, not a measurement
  double (*const outlines[])(int) = {[](int) { return 100.0; }, [](int i) { return i % 2 == 0 ? 100.0 : 97.0; },
                                     [](int i) { return i % 20 < 10 ? 100.0 : 80.0; },
                                     [](int i) { return 60 + 30 * std::sin(i * 0.01); }};
  for (const int corners : {200, 260, 2000, 20'000, 100'000})
    for (const auto& outline : outlines) {
      CAPTURE(corners);
      const Result<Mesh> mesh = mesh_of(ring_obj(corners, outline));
      REQUIRE_MESSAGE(mesh.has_value(), mesh.error().text());
      // Overlapping triangles would add up to more. Coordinates are floats.
      CHECK(area_m2(*mesh) == doctest::Approx(ring_area_m2(corners, outline)).epsilon(1e-4));
    }
  alarm(0);
}

TEST_CASE("triangulation of a polygon that crosses itself a hundred thousand times ends") {
  alarm(300);
  const Result<Mesh> mesh = mesh_of(ring_obj(100'000, [](int i) { return i % 3 == 0 ? 100.0 : -50.0; }));
  if (!mesh) CHECK(mesh.error().text().find("100000 corners") != std::string::npos);
  alarm(0);
}

TEST_CASE("negative indices count back from the end") {
  const Result<Mesh> mesh = mesh_of(std::string(kTriangle) + "f -3 -2 -1\nv 9 9 9\n");
  REQUIRE(mesh);
  CHECK(mesh->low_m == glm::vec3{0, -1, 0});  // by default +y of the model is the left wing
  CHECK(mesh->high_m == glm::vec3{1, 0, 0});
}

TEST_CASE("Windows line ends and continued lines and blanks are read") {
  const Result<Mesh> mesh = mesh_of("v 0 0 0\r\n  v 1 0 0\r\nv\t0 1 0 \r\nf 1 \\\r\n 2 3\r\n");
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 3);
}

TEST_CASE("faces without area are left out and the others stay") {
  const Result<Mesh> mesh = mesh_of(std::string(kTriangle) + "v 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2\n");
  REQUIRE(mesh);
  CHECK(mesh->indices.size() == 3);
  CHECK(mesh->warnings.empty());
}

TEST_CASE("vertices that no face uses do not count for the bounds") {
  const Result<Mesh> mesh = mesh_of(std::string(kTriangle) + "v 100 100 100\nf 1 2 3\n");
  REQUIRE(mesh);
  CHECK(mesh->low_m == glm::vec3{0, -1, 0});
  CHECK(mesh->high_m == glm::vec3{1, 0, 0});
  CHECK(mesh->radius_m == 1);
}

TEST_CASE("equal corners are one vertex, and another uv gives another one") {
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n";
  CHECK(mesh_of(quad + "f 1/1 2/1 3/1\nf 1/1 3/1 4/1\n").value().vertices.size() == 4);
  CHECK(mesh_of(quad + "f 1/1 2/1 3/1\nf 1/1 3/2 4/1\n").value().vertices.size() == 5);
}

TEST_CASE("files without a surface are refused") {
  refused("", "no faces");
  refused("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces");
  refused("v 0 0 0\nv 1 0 0\nl 1 2\n", "no faces");
  refused(std::string(kTriangle) + "f 1 1 1\n", "no faces with an area");
}

TEST_CASE("indices out of range are counted") {
  const std::string start = std::string(kTriangle) + "vt 0 0\nvn 0 0 1\nf 1 2 3\n";
  refused(start + "f 1 2 4\n", "1 of 2 faces");
  refused(start + "f 1 2 -4\nf 1 2 3 99\n", "2 of 3 faces");
  refused(start + "f 0 1 2\n", "1 of 2 faces");
  refused(start + "f 1/1 2/2 3/1\n", "1 of 2 faces");
  refused(start + "f 1//1 2//-2 3//1\n", "1 of 2 faces");
  refused(start + "f a b c\n", "1 of 2 faces");
  refused(start + "f 1 2 2147483647\n", "1 of 2 faces");
}

TEST_CASE("coordinates that are not finite numbers are refused with their line") {
  for (const char* bad : {"v nan 0 0", "v 0 -nan 0", "v 0 0 inf", "v 1e999 0 0", "v 1 2", "v a b c", "v 1,5 0 0"})
    refused("v 1 0 0\n" + std::string(bad) + "\nv 0 1 0\nf 1 2 3\n", "line 2");
  refused("v 1e39 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "too large");  // a double, but no float
}

TEST_CASE("a missing file cannot be read") {
  const test::TemporaryFolder folder;
  const Result<Mesh> mesh = read_obj(folder / "nowhere.obj");
  REQUIRE_FALSE(mesh);
  CHECK(mesh.error().kind == ErrorKind::cannot_read);
  CHECK(mesh.error().text().find("nowhere.obj") != std::string::npos);
  CHECK_FALSE(read_obj(folder.path()));
}

TEST_CASE("a triangle more than are read is refused before the faces are kept") {
  // Polygons of a thousand corners have 998 triangles each.
  std::string face = "f";
  for (int corner = 0; corner < 1000; ++corner) face += " 1";
  std::string text = kTriangle;
  for (std::size_t triangles = 0; triangles <= kMaxTriangles; triangles += 998) text.append(face).append("\n");
  const Result<ObjFile> refused_file = parse_obj(text, "model.obj");
  REQUIRE_FALSE(refused_file);
  CHECK(refused_file.error().kind == ErrorKind::bad_data);
  CHECK(refused_file.error().text().starts_with("model.obj: has more than 10000000 triangles"));
}

TEST_CASE("any bytes are read or refused and never cause a crash") {
  std::uint32_t state = 1;
  const std::string letters = "vfnt mlub0123456789-+./\n\n\n  \\eE#dKN\r";
  for (int round = 0; round < 200; ++round) {
    std::string text = kTriangle;
    for (int i = 0; i < 400; ++i) {
      state = state * 1664525U + 1013904223U;
      text += letters[(state >> 16) % letters.size()];
    }
    const Result<Mesh> mesh = mesh_of(text + "\nf 1 2 3\n");
    if (mesh) CHECK(mesh->indices.size() % 3 == 0);
    if (!mesh) CHECK_FALSE(mesh.error().text().empty());
  }
}

}  // namespace sigs
