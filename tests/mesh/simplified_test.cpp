// SPDX-License-Identifier: MIT
#include "mesh/simplified.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "deviation.h"

namespace sigs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Surface {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

// A square of 1 m, cut steps by steps, of a height that bulges by so much, with u bent by bend in the middle.
Surface sheet(int steps, double bulge_m, double bend = 0) {
  Surface result;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i) {
      const double x = double(i) / steps;
      const double y = double(j) / steps;
      const double z = bulge_m * std::sin(M_PI * x) * std::sin(M_PI * y);
      result.vertices.push_back({{x, y, z}, {0, 0, 1}, {x + bend * std::sin(M_PI * x) * std::sin(M_PI * y), y}});
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (steps + 1) + i); };
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i)
      for (const std::uint32_t index :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        result.indices.push_back(index);
  return result;
}

std::vector<std::uint32_t> simple(const Surface& surface, double error_m, Keep keep = Keep::place) {
  return simplified(surface.vertices, surface.indices, std::vector<Keep>(surface.indices.size() / 3, keep), error_m)
      .indices;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// Edges of one triangle only.
std::vector<Edge> rim_of(const std::vector<std::uint32_t>& indices) {
  std::map<Edge, int> uses;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint32_t a = indices[i];
    const std::uint32_t b = indices[i % 3 == 2 ? i - 2 : i + 1];
    ++uses[{std::min(a, b), std::max(a, b)}];
  }
  std::vector<Edge> rim;
  for (const auto& [edge, count] : uses)
    if (count == 1) rim.push_back(edge);
  return rim;
}

// Straight down the sheet: the height of the simplified surface over (x, y).
double height_over(const Surface& surface, const std::vector<std::uint32_t>& indices, double x, double y) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(surface.vertices[indices[i + k]].position_m); };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 b = corner(1) - a;
    const glm::dvec3 c = corner(2) - a;
    const double area = b.x * c.y - b.y * c.x;
    const double s = ((x - a.x) * c.y - (y - a.y) * c.x) / area;
    const double t = (b.x * (y - a.y) - b.y * (x - a.x)) / area;
    if (s >= -1e-9 && t >= -1e-9 && s + t <= 1 + 1e-9) return a.z + s * b.z + t * c.z;
  }
  return kInfinity;
}

}  // namespace

TEST_CASE("a flat sheet keeps its rim and loses what lies within") {
  const Surface flat = sheet(20, 0);
  const std::vector<std::uint32_t> fewer = simple(flat, 1e-3);
  CHECK(fewer.size() < flat.indices.size() / 4);
  CHECK(rim_of(fewer) == rim_of(flat.indices));
  CHECK(deviation_m(flat.vertices, flat.indices, fewer, true, 1) < 1e-6);  // floats of 1 m
}

TEST_CASE("a bulging sheet lies as far off as a look straight down at every vertex says") {
  const Surface bulging = sheet(32, 0.1);
  for (const double aim_m : {1e-4, 1e-3, 1e-2}) {
    CAPTURE(aim_m);
    const std::vector<std::uint32_t> fewer = simple(bulging, aim_m);
    CHECK(fewer.size() < bulging.indices.size());
    CHECK(fewer.size() < (aim_m > 1e-3 ? 0.2 : 0.95) * double(bulging.indices.size()));
    CHECK(deviation_m(bulging.vertices, bulging.indices, fewer, false, 1) <= aim_m);
    double worst_m = 0;
    for (const Vertex& vertex : bulging.vertices)
      worst_m = std::max(worst_m, std::abs(height_over(bulging, fewer, vertex.position_m.x, vertex.position_m.y) -
                                           vertex.position_m.z));
    const double measured_m = deviation_m(bulging.vertices, bulging.indices, fewer, false, 1);
    CHECK(measured_m <= worst_m + 1e-6);
    // The slope is at most 0.1 pi: straight down is longer than the shortest way by less than a twentieth.
    CHECK(measured_m >= 0.95 * worst_m - 1e-6);
  }
}

TEST_CASE("a texture that is stretched unevenly counts as being off") {
  const Surface flat = sheet(16, 0, 0.05);
  const std::vector<std::uint32_t> fewer = simple(flat, 1e-3);
  CHECK(deviation_m(flat.vertices, flat.indices, fewer, false, 1) < 1e-6);
  CHECK(deviation_m(flat.vertices, flat.indices, fewer, true, 1) > 1e-3);
  for (const double aim_m : {1e-2, 1e-3, 1e-4}) {
    CAPTURE(aim_m);
    const std::vector<std::uint32_t> textured = simple(flat, aim_m, Keep::texture);
    CHECK(deviation_m(flat.vertices, flat.indices, textured, true, 1) <= aim_m);
    CHECK(textured.size() > fewer.size());
    if (aim_m > 1e-3) CHECK(textured.size() < flat.indices.size() / 2);
  }
}

TEST_CASE("a flat sheet whose shading bends keeps what the shading needs") {
  Surface flat = sheet(32, 0);
  for (Vertex& vertex : flat.vertices) {
    const float turn = 0.5F * std::sin(2 * float(M_PI) * vertex.position_m.x);
    vertex.normal = {std::sin(turn), 0, std::cos(turn)};
  }
  const std::vector<std::uint32_t> fewer = simple(flat, 0.01);
  CHECK(fewer.size() < flat.indices.size() / 4);
  const auto share_of = [](const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    return (p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x);
  };
  for (const Vertex& vertex : flat.vertices) {
    const glm::dvec3 p(vertex.position_m);
    double min_sine = kInfinity;
    for (std::size_t i = 0; i + 2 < fewer.size(); i += 3) {
      glm::dvec3 corners[3];
      for (std::size_t k = 0; k < 3; ++k) corners[k] = flat.vertices[fewer[i + k]].position_m;
      const double area = share_of(corners[2], corners[0], corners[1]);
      glm::dvec3 normal(0);
      bool is_inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = share_of(p, corners[(k + 1) % 3], corners[(k + 2) % 3]) / area;
        is_inside = is_inside && share >= -1e-9;
        normal += share * glm::dvec3(flat.vertices[fewer[i + k]].normal);
      }
      if (is_inside)
        min_sine = std::min(min_sine, glm::length(glm::cross(glm::normalize(normal), glm::dvec3(vertex.normal))));
    }
    REQUIRE(min_sine <= 0.1001);
  }
}

TEST_CASE("two sheets that meet at a seam still meet there and keep their own vertices") {
  // The same square twice, the second turned over the seam x = 1: equal places, vertices of its own, another texture.
  Surface both = sheet(16, 0);
  const std::size_t count = both.vertices.size();
  const std::size_t index_count = both.indices.size();
  for (std::size_t v = 0; v < count; ++v) {
    Vertex other = both.vertices[v];
    other.position_m.x += 1;
    other.uv.x += 5;
    both.vertices.push_back(other);
  }
  for (std::size_t i = 0; i < index_count; ++i)
    both.indices.push_back(both.indices[i] + static_cast<std::uint32_t>(count));
  const Simplified fewer =
      simplified(both.vertices, both.indices, std::vector<Keep>(both.indices.size() / 3, Keep::texture), 1e-3);
  CHECK(fewer.indices.size() < both.indices.size() / 4);
  CHECK(deviation_m(both.vertices, both.indices, fewer.indices, true, 1) < 1e-5);
  std::set<float> seams[2];
  for (std::size_t i = 0; i < fewer.indices.size(); ++i) {
    const Vertex& vertex = both.vertices[fewer.indices[i]];
    const bool is_second = fewer.originals[i / 3] >= index_count / 3;
    REQUIRE((fewer.indices[i] >= count) == is_second);
    if (vertex.position_m.x == 1) seams[is_second ? 1 : 0].insert(vertex.position_m.y);
  }
  CHECK(seams[0] == seams[1]);
  CHECK(seams[0].size() < 9);  // of 17: the seam itself is straight and was thinned, on both sides alike
}

TEST_CASE("what is missing or further off than asked for is infinitely far off") {
  const Surface bulging = sheet(16, 0.1);
  const std::vector<std::uint32_t> half(bulging.indices.begin(), bulging.indices.begin() + 3 * 256);
  CHECK(deviation_m(bulging.vertices, bulging.indices, {}, false, 1) == kInfinity);
  CHECK(deviation_m(bulging.vertices, bulging.indices, half, false, 0.1) == kInfinity);
  CHECK(deviation_m(bulging.vertices, bulging.indices, half, false, 2) == doctest::Approx(0.5).epsilon(0.1));
  CHECK(deviation_m(bulging.vertices, {}, {}, false, 1) == 0);
}

TEST_CASE("no error allowed leaves every triangle") {
  const Surface flat = sheet(4, 0);
  for (const double none : {0.0, -1.0, std::nan("")}) CHECK(simple(flat, none) == flat.indices);
  CHECK(simple(flat, 1, Keep::all) == flat.indices);
  CHECK(simplified(flat.vertices, {}, {}, 1).indices.empty());
  const std::vector<Vertex> point(3, flat.vertices.front());  // no extent at all
  CHECK(simple({point, {0, 1, 2}}, 1).size() == 3);
}

}  // namespace sigs
