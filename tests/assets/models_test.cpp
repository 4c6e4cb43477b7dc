// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <tuple>

#include "assets/obj_text.h"
#include "support/test_data.h"

namespace sigs::test {

namespace {

struct Sample {
  std::filesystem::path obj_path;
  ObjText obj;
  MtlText mtl;
};

Sample sample(const std::string& name) {
  const std::filesystem::path folder = source_dir() / "assets/models" / name;
  return {folder / (name + ".obj"), read_obj_text(folder / (name + ".obj")), read_mtl_text(folder / (name + ".mtl"))};
}

std::vector<Sample> samples() {
  return {sample("airliner"), sample("light-aircraft")};
}

std::pair<glm::dvec3, glm::dvec3> bounds(const ObjText& obj) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const glm::dvec3& p : obj.positions) low = glm::min(low, p), high = glm::max(high, p);
  return {low, high};
}

void check_extent(const ObjText& obj, const glm::dvec3& truth_m) {
  const auto [low, high] = bounds(obj);
  // 2 %: aircraft of one class differ by more than that.
  for (int k = 0; k < 3; ++k) CHECK(high[k] - low[k] == doctest::Approx(truth_m[k]).epsilon(0.02));
}

glm::dvec3 winding_normal(const ObjText& obj, const ObjText::Face& face) {
  const glm::dvec3 a = obj.positions[face.position[0] - 1];
  return glm::cross(obj.positions[face.position[1] - 1] - a, obj.positions[face.position[2] - 1] - a);
}

double uv_area(const ObjText& obj, const ObjText::Face& face) {
  const glm::dvec2 a = obj.uvs[face.uv[0] - 1];
  const glm::dvec2 b = obj.uvs[face.uv[1] - 1] - a, c = obj.uvs[face.uv[2] - 1] - a;
  return b.x * c.y - b.y * c.x;
}

}  // namespace

TEST_CASE("the airliner is as large as one of the 150 seat class with its gear up") {
  check_extent(sample("airliner").obj, {37.57, 34.0, 11.15});
}

TEST_CASE("the light aircraft is as large as a four seater on its gear") {
  check_extent(sample("light-aircraft").obj, {8.28, 11.0, 2.72});
}

TEST_CASE("the models are symmetric and the origin lies between nose and tail") {
  for (const Sample& s : samples()) {
    const auto [low, high] = bounds(s.obj);
    CHECK(low.y == doctest::Approx(-high.y).epsilon(1e-4));  // the file has four decimals
    // The centre of gravity lies in the front half; the nose is at +x.
    CHECK(high.x > 0.25 * (high.x - low.x));
    CHECK(high.x < 0.5 * (high.x - low.x));
    CHECK(low.z < 0);
    CHECK(high.z > 0);
  }
}

TEST_CASE("the models stay small") {
  for (const Sample& s : samples()) {
    CHECK(s.obj.faces.size() > 2000);
    CHECK(s.obj.faces.size() <= 12000);
    CHECK(std::filesystem::file_size(s.obj_path) <= 1024 * 1024);
  }
}

TEST_CASE("every index in the models refers to an existing element") {
  for (const Sample& s : samples()) {
    const auto within = [](const std::array<int, 3>& indices, std::size_t count) {
      return std::ranges::all_of(indices, [&](int i) { return i >= 1 && i <= static_cast<int>(count); });
    };
    for (const ObjText::Face& face : s.obj.faces) {
      REQUIRE(within(face.position, s.obj.positions.size()));
      REQUIRE(within(face.uv, s.obj.uvs.size()));
      REQUIRE(within(face.normal, s.obj.normals.size()));
      REQUIRE(s.mtl.materials.contains(face.material));
    }
    CHECK(std::filesystem::exists(s.obj_path.parent_path() / s.obj.mtllib));
  }
}

TEST_CASE("the normals of the models are unit and look to the side from which a triangle runs counter-clockwise") {
  for (const Sample& s : samples()) {
    // Three numbers rounded to four decimals: off by at most half a digit each, 0.87e-4 together.
    for (const glm::dvec3& normal : s.obj.normals) REQUIRE(std::abs(glm::length(normal) - 1) < 1e-4);
    for (const ObjText::Face& face : s.obj.faces)
      for (const int normal : face.normal)
        REQUIRE(glm::dot(winding_normal(s.obj, face), s.obj.normals[normal - 1]) > 0);
  }
}

TEST_CASE("the models are watertight and wound outwards") {
  for (const Sample& s : samples()) {
    std::map<std::pair<int, int>, int> edges;  // directed: each must have its opposite
    double volume_m3 = 0;
    for (const ObjText::Face& face : s.obj.faces) {
      for (int k = 0; k < 3; ++k) ++edges[{face.position[k], face.position[(k + 1) % 3]}];
      volume_m3 += glm::dot(s.obj.positions[face.position[0] - 1], winding_normal(s.obj, face)) / 6;
    }
    int open = 0, all = 0;
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      all += count;
      open += std::max(0, count - (back == edges.end() ? 0 : back->second));
    }
    // Windows of the cabin's lining and the discs within the engines are open; hulls are not.
    CHECK(open < 0.03 * all);
    CHECK(volume_m3 > 0);
  }
}

TEST_CASE("letters on fuselage and fin are not mirrored on either side") {
  for (const Sample& s : samples()) {
    int left = 0, right = 0;
    for (const ObjText::Face& face : s.obj.faces) {
      if (face.material != "fuselage" && face.material != "fin") continue;
      const glm::dvec3 normal = glm::normalize(winding_normal(s.obj, face));
      const double area = uv_area(s.obj, face);
      if (std::abs(normal.y) < 0.5 || std::abs(area) < 1e-6) continue;  // nearly horizontal, or without area
      // Counter-clockwise in the image as on the body: rotated at most, never mirrored.
      REQUIRE(area > 0);
      ++(normal.y > 0 ? left : right);
    }
    CHECK(left > 100);
    CHECK(right > 100);
  }
}

TEST_CASE("every texture of the models exists and is of moderate size") {
  for (const Sample& s : samples()) {
    int textured = 0;
    for (const auto& [name, material] : s.mtl.materials) {
      if (material.texture.empty()) continue;
      ++textured;
      const cv::Mat image = cv::imread((s.obj_path.parent_path() / material.texture).string(), cv::IMREAD_UNCHANGED);
      REQUIRE_FALSE(image.empty());
      CHECK(image.type() == CV_8UC3);
      CHECK(image.cols <= 1024);
      CHECK(image.rows <= 512);
    }
    CHECK(textured >= 4);
    for (const glm::dvec2& uv : s.obj.uvs) REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
  }
}

TEST_CASE("the glass of the light aircraft lets a third of the light through") {
  const Sample light = sample("light-aircraft");
  CHECK(light.mtl.materials.at("glass").opacity == 0.35);
  CHECK(std::ranges::count(light.obj.faces, "glass", &ObjText::Face::material) > 50);
}

}  // namespace sigs::test
