// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <tuple>

#include "assets/obj_text.h"
#include "support/files.h"
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
  const ObjText obj = read_obj_text(folder / (name + ".obj"));
  return {folder / (name + ".obj"), obj, read_mtl_text(folder / obj.mtllib)};
}

// The liveries in a folder of their own, which have the geometry of `airliner` and `light-aircraft`.
const std::vector<std::string> kLiveries = {"airliner-grey", "airliner-dark", "light-aircraft-grey",
                                            "light-aircraft-dark"};

// Helicopters and multirotors that generators make from a table: what is published of the class.
struct Rotorcraft {
  const char* name;
  double overall_m;  // with rotors turning; of a multirotor from motor to motor across its middle
  double rotor_m;    // diameter of the main rotor, or of each
  int blades;
};
const std::vector<Rotorcraft> kHelicopters = {
    {"helicopter-trainer", 8.76, 7.67, 2},    {"helicopter-utility", 17.40, 14.63, 2},
    {"helicopter-fenestron", 12.16, 10.2, 4}, {"helicopter-medium", 16.66, 13.8, 5},
    {"helicopter-military", 19.76, 16.36, 4}, {"helicopter-heavy", 25.35, 21.29, 5}};
const std::vector<Rotorcraft> kMultirotors = {{"multirotor-racer", 0.22, 0.127, 3},
                                              {"multirotor-hexa", 1.133, 0.533, 2},
                                              {"multirotor-octo", 1.045, 0.381, 2},
                                              {"multirotor-sprayer", 2.1, 0.965, 2}};

std::vector<Sample> samples() {
  std::vector<Sample> all{sample("airliner"), sample("light-aircraft"), sample("helicopter"), sample("quadcopter")};
  for (const Rotorcraft& craft : kHelicopters) all.push_back(sample(craft.name));
  for (const Rotorcraft& craft : kMultirotors) all.push_back(sample(craft.name));
  return all;
}

// What is no aircraft.
const std::vector<std::string> kDistractors = {"bird", "bird-dark", "balloon", "balloon-silver", "insect"};

std::vector<Sample> samples_and_liveries() {
  std::vector<Sample> all = samples();
  for (const std::string& name : kDistractors) all.push_back(sample(name));
  for (const std::string& name : kLiveries) all.push_back(sample(name));
  return all;
}

bool is_anything(const std::string&) {
  return true;
}

// Over the faces whose material is asked for.
template <class IsAskedFor>
std::pair<glm::dvec3, glm::dvec3> bounds(const ObjText& obj, const IsAskedFor& is_asked_for) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const ObjText::Face& face : obj.faces)
    for (const int corner : face.position)
      if (is_asked_for(face.material))
        low = glm::min(low, obj.positions[corner - 1]), high = glm::max(high, obj.positions[corner - 1]);
  return {low, high};
}

std::pair<glm::dvec3, glm::dvec3> bounds_of(const ObjText& obj, const std::string& material) {
  return bounds(obj, [&](const std::string& name) { return name == material; });
}

void check_extent(const ObjText& obj, const glm::dvec3& truth_m) {
  const auto [low, high] = bounds(obj, is_anything);
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

bool is_blade(const std::string& material) {
  return material.starts_with("rotor_") || material.ends_with("_rotor") || material == "propeller";
}

// Area of the blades' discs weighted with their opacity, of one layer.
double blade_area_m2(const Sample& s, double low_x_m, double high_x_m) {
  double area_m2 = 0;
  for (const ObjText::Face& face : s.obj.faces) {
    const double x_m = s.obj.positions[face.position[0] - 1].x;
    if (!is_blade(face.material) || x_m < low_x_m || x_m > high_x_m) continue;
    area_m2 += 0.5 * glm::length(winding_normal(s.obj, face)) * s.mtl.materials.at(face.material).opacity;
  }
  return area_m2;
}

double linear(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

// Median reflectance of the crown, which lies along the upper edge of the sides' image.
double crown_reflectance(const Sample& s, const std::string& material) {
  const std::filesystem::path path = s.obj_path.parent_path() / s.mtl.materials.at(material).texture;
  const cv::Mat grey = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  REQUIRE_FALSE(grey.empty());
  const cv::Mat crown = grey.rowRange(0, grey.rows / 10).clone();
  std::vector<uchar> codes(crown.begin<uchar>(), crown.end<uchar>());
  std::ranges::nth_element(codes, codes.begin() + static_cast<long>(codes.size() / 2));
  return linear(codes[codes.size() / 2] / 255.0);
}

}  // namespace

TEST_CASE("the airliner is as large as one of the 150 seat class with its gear up") {
  check_extent(sample("airliner").obj, {37.57, 34.0, 11.15});
}

TEST_CASE("the light aircraft is as large as a four seater on its gear") {
  check_extent(sample("light-aircraft").obj, {8.28, 11.0, 2.72});
}

TEST_CASE("the helicopter is as large as a light one with a single engine and three blades") {
  const Sample helicopter = sample("helicopter");
  const auto [low, high] = bounds(helicopter.obj, is_anything);
  // 12.94 m over both rotors; a rotor of 10.69 m; 3.34 m to its hub's top; the coned tips lie higher.
  CHECK(high.x - low.x == doctest::Approx(12.94).epsilon(0.03));
  double radius_m = 0;
  for (const ObjText::Face& face : helicopter.obj.faces)
    for (const int corner : face.position)
      if (is_blade(face.material) && helicopter.obj.positions[corner - 1].x > -5.4)
        radius_m = std::max(radius_m,
                            std::hypot(helicopter.obj.positions[corner - 1].x, helicopter.obj.positions[corner - 1].y));
  CHECK(radius_m == doctest::Approx(10.69 / 2).epsilon(0.01));
  const auto [skid_low, skid_high] = bounds_of(helicopter.obj, "skid");
  const auto [hub_low, hub_high] = bounds_of(helicopter.obj, "metal");
  CHECK(hub_high.z - skid_low.z == doctest::Approx(3.6).epsilon(0.05));
}

TEST_CASE("the quadcopter measures 0.35 m from motor to motor across its middle") {
  const Sample quadcopter = sample("quadcopter");
  const auto [low, high] = bounds_of(quadcopter.obj, "light_red");
  const auto [rear_low, rear_high] = bounds_of(quadcopter.obj, "light_green");
  const glm::dvec2 front_left(0.5 * (low.x + high.x), high.y), rear_right(0.5 * (rear_low.x + rear_high.x), rear_low.y);
  // A lamp is 12 mm across and hangs below the middle of its motor.
  CHECK(glm::distance(front_left, rear_right) == doctest::Approx(0.35).epsilon(0.04));
}

TEST_CASE("further helicopters and multirotors have the sizes, rotors and blades of their classes") {
  for (const Rotorcraft& craft : kHelicopters) {
    CAPTURE(craft.name);
    const Sample s = sample(craft.name);
    const auto [low, high] = bounds(s.obj, is_anything);
    CHECK(high.x - low.x == doctest::Approx(craft.overall_m).epsilon(0.02));
    const auto [disc_low, disc_high] = bounds_of(s.obj, "main_rotor");
    CHECK(disc_high.y - disc_low.y == doctest::Approx(craft.rotor_m).epsilon(0.01));
    CHECK(s.mtl.materials.at("main_rotor").opacity < 0.2);
    const std::string statements = text_of(s.obj_path.parent_path() / s.obj.mtllib);
    CHECK(statements.find("rotor_blades " + std::to_string(craft.blades) + "\n") != std::string::npos);
  }
  for (const Rotorcraft& craft : kMultirotors) {
    CAPTURE(craft.name);
    const Sample s = sample(craft.name);
    double reach_m = 0;
    for (const ObjText::Face& face : s.obj.faces)
      for (const int corner : face.position)
        if (face.material == "motor")
          reach_m = std::max(reach_m, std::hypot(s.obj.positions[corner - 1].x, s.obj.positions[corner - 1].y));
    CHECK(2 * reach_m == doctest::Approx(craft.overall_m).epsilon(0.1));  // motors are some centimetres wide
    const auto [disc_low, disc_high] = bounds_of(s.obj, "rotor_1");
    CHECK(disc_high.x - disc_low.x == doctest::Approx(craft.rotor_m).epsilon(0.02));
  }
}

TEST_CASE("the models are symmetric and the origin lies between nose and tail") {
  for (const Sample& s : samples()) {
    const bool is_quadcopter = s.obj.mtllib == "quadcopter.mtl" || s.obj.mtllib.starts_with("multirotor");
    const auto [body_low, body_high] = bounds_of(s.obj, is_quadcopter ? "shell" : "fuselage");
    CHECK(body_low.y == doctest::Approx(-body_high.y).epsilon(1e-4));  // the file has four decimals
    const auto [low, high] = bounds(s.obj, is_anything);
    // The centre of gravity lies in the front half; the nose is at +x. A quadcopter's lies in the middle.
    CHECK(high.x > 0.25 * (high.x - low.x));
    CHECK(high.x < (is_quadcopter ? 0.52 : 0.5) * (high.x - low.x));
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

TEST_CASE("distractors are small files, true to size, and fade out where they are to") {
  for (const std::string& name : kDistractors) {
    const Sample s = sample(name);
    CHECK(std::filesystem::file_size(s.obj_path) <= 128 * 1024);
    const auto [low, high] = bounds(s.obj, is_anything);
    const glm::dvec3 size_m = high - low;
    if (name.starts_with("bird")) CHECK((size_m.y > 1.2 && size_m.y < 1.6));  // a gull's span
    if (name.starts_with("balloon")) CHECK((size_m.y > 0.25 && size_m.y < 0.35));
    if (name == "insect") CHECK((size_m.x == 0 && size_m.y > 0.003 && size_m.z < 0.02));
  }
  const Sample insect = sample("insect");
  double before = 1;
  for (int ring = 1; ring <= 18; ++ring) {
    const double opacity = insect.mtl.materials.at("spot_" + std::to_string(ring)).opacity;
    CHECK(opacity <= before);
    before = opacity;
  }
  CHECK(before < 0.05);
}

TEST_CASE("every index in the models refers to an existing element") {
  for (const Sample& s : samples_and_liveries()) {
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
      if (is_blade(face.material)) continue;  // discs of one layer
      for (int k = 0; k < 3; ++k) ++edges[{face.position[k], face.position[(k + 1) % 3]}];
      volume_m3 += glm::dot(s.obj.positions[face.position[0] - 1], winding_normal(s.obj, face)) / 6;
    }
    int open = 0, all = 0;
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      all += count;
      open += std::max(0, count - (back == edges.end() ? 0 : back->second));
    }
    // Windows of the cabin's lining and discs within the engines are open; hulls are not.
    CHECK(open < 0.03 * all);
    CHECK(volume_m3 > 0);
  }
}

TEST_CASE("letters on fuselage and fin are not mirrored on either side") {
  for (const Sample& s :
       {sample("airliner"), sample("light-aircraft"), sample("helicopter"), sample("helicopter-medium")}) {
    const bool has_painted_fin = !s.mtl.materials.at("fin").texture.empty();
    int left = 0, right = 0;
    for (const ObjText::Face& face : s.obj.faces) {
      if (face.material != "fuselage" && (face.material != "fin" || !has_painted_fin)) continue;
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
  for (const Sample& s : samples_and_liveries()) {
    for (const auto& [name, material] : s.mtl.materials) {
      if (material.texture.empty()) continue;
      const cv::Mat image = cv::imread((s.obj_path.parent_path() / material.texture).string(), cv::IMREAD_UNCHANGED);
      REQUIRE_FALSE(image.empty());
      CHECK(image.type() == CV_8UC3);
      CHECK(image.cols <= 1024);
      CHECK(image.rows <= 512);
    }
    for (const glm::dvec2& uv : s.obj.uvs) REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
  }
}

TEST_CASE("the glass of the light aircraft lets a third of the light through") {
  const Sample light = sample("light-aircraft");
  CHECK(light.mtl.materials.at("glass").opacity == 0.35);
  CHECK(std::ranges::count(light.obj.faces, "glass", &ObjText::Face::material) > 50);
}

TEST_CASE("the liveries of a model share its geometry and its materials, and are white, grey and dark") {
  for (const std::string name : {"airliner", "light-aircraft"}) {
    const Sample white = sample(name), dull = sample(name + "-grey"), dark = sample(name + "-dark");
    for (const Sample* s : {&dull, &dark}) {
      CHECK(std::filesystem::equivalent(s->obj_path, white.obj_path));
      CHECK(s->mtl.materials.size() == white.mtl.materials.size());
      for (const auto& [material, unused] : white.mtl.materials) CHECK(s->mtl.materials.contains(material));
    }
    // White lacquer reflects 75 to 85 %, grey 40 to 50 %, dark 10 % at most.
    CHECK(crown_reflectance(white, "fuselage") > 0.75);
    CHECK(crown_reflectance(white, "fuselage") < 0.85);
    CHECK(crown_reflectance(dull, "fuselage") > 0.38);
    CHECK(crown_reflectance(dull, "fuselage") < 0.5);
    CHECK(crown_reflectance(dark, "fuselage") < 0.1);
  }
}

TEST_CASE("what every model has reflects as much as the real thing") {
  for (const Sample& s : samples_and_liveries())
    for (const auto& [name, material] : s.mtl.materials) {
      if (!material.texture.empty()) continue;
      const double reflectance = linear(material.diffuse.g);
      CHECK(reflectance <= 1);
      if (name == "tyre") CHECK(reflectance == doctest::Approx(0.05).epsilon(0.02));
      if (name == "glass") CHECK(reflectance < 0.03);
      if (name == "dark" || name == "glass" || is_blade(name)) CHECK(reflectance < 0.08);
      // The renderer reflects a quarter: 4 % of glass and lacquer; blades are no glass and have no highlight.
      if (name == "glass") CHECK(material.specular == 0.16);
      if (is_blade(name)) CHECK(material.specular == 0);
    }
}

TEST_CASE("a disc hides as much as its blades do on average, for programs that do not turn them") {
  // Number of blades, their mean chord, from root to tip. The discs' rims lie a little beyond the tips.
  CHECK(blade_area_m2(sample("light-aircraft"), -9, 9) == doctest::Approx(2 * 0.135 * 0.86).epsilon(0.02));
  CHECK(blade_area_m2(sample("quadcopter"), -9, 9) == doctest::Approx(4 * 2 * 0.019 * 0.107).epsilon(0.02));
  const Sample helicopter = sample("helicopter");
  CHECK(blade_area_m2(helicopter, -5.4, 9) == doctest::Approx(3 * 0.325 * 5.05).epsilon(0.02));
  CHECK(blade_area_m2(helicopter, -9, -5.4) == doctest::Approx(2 * 0.18 * 0.79).epsilon(0.02));
}

TEST_CASE("the red light is on the left, the green one on the right") {
  for (const std::string name : {"airliner", "light-aircraft", "helicopter"}) {
    const ObjText obj = sample(name).obj;
    const auto [red_low, red_high] = bounds_of(obj, "light_red");
    const auto [green_low, green_high] = bounds_of(obj, "light_green");
    CHECK(red_high.y > 1.2);  // +y: left
    CHECK(red_low.y > -0.2);  // beacons are red as well
    CHECK(green_high.y < -1.2);
  }
}

}  // namespace sigs::test
