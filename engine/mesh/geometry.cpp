// SPDX-License-Identifier: MIT
#include "mesh/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "base/disjoint_sets.h"
#include "base/pose.h"

namespace sigs {
namespace {

std::optional<glm::dvec3> axis_of(std::string_view text) {
  constexpr std::string_view kLetters = "xyz";
  if (text.size() != 2 || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::size_t axis = kLetters.find(text[1]);
  if (axis == std::string_view::npos) return std::nullopt;
  glm::dvec3 direction{0, 0, 0};
  direction[static_cast<int>(axis)] = text[0] == '+' ? 1 : -1;
  return direction;
}

tl::unexpected<Error> fail_axis(const char* setting, const std::string& text) {
  return fail(setting, fmt::format("expected one of +x -x +y -y +z -z, found \"{}\"", text), ErrorKind::bad_project);
}

constexpr double kCosOfCrease = 0.5;  // 60 degrees

struct HashOfPosition {
  std::size_t operator()(const glm::dvec3& p) const {
    const std::hash<double> hash;
    return hash(p.x) ^ (hash(p.y) * 0x9E3779B97F4A7C15ULL) ^ (hash(p.z) * 0xC2B2AE3D27D4EB4FULL);
  }
};

// The welded position of each corner.
std::vector<std::uint32_t> places_of(std::span<const Triangle> triangles) {
  std::vector<glm::dvec3> positions;
  positions.reserve(triangles.size() * 3);
  for (const Triangle& triangle : triangles) positions.insert(positions.end(), triangle.begin(), triangle.end());
  return welded(positions);
}

// The corners at each place.
std::vector<std::vector<int>> corners_by_place(const std::vector<std::uint32_t>& places) {
  if (places.empty()) return {};
  std::vector<std::vector<int>> corners(*std::max_element(places.begin(), places.end()) + 1);
  for (std::size_t corner = 0; corner < places.size(); ++corner)
    corners[places[corner]].push_back(static_cast<int>(corner));
  return corners;
}

double angle_at(const Triangle& triangle, int corner) {
  const glm::dvec3 a = triangle[(corner + 1) % 3] - triangle[corner];
  const glm::dvec3 b = triangle[(corner + 2) % 3] - triangle[corner];
  return angle_between(a, b);
}

// An edge of one of the corners that meet at a place, from there to another place.
struct Spoke {
  std::uint32_t other_place;
  std::uint32_t member;  // index into the corners that meet
};

std::vector<Spoke> spokes_of(const std::vector<int>& corners, const std::vector<std::uint32_t>& places) {
  std::vector<Spoke> spokes;
  for (std::size_t member = 0; member < corners.size(); ++member) {
    const int first = corners[member] / 3 * 3;
    const int corner = corners[member] % 3;
    spokes.push_back({places[first + (corner + 1) % 3], static_cast<std::uint32_t>(member)});
    spokes.push_back({places[first + (corner + 2) % 3], static_cast<std::uint32_t>(member)});
  }
  std::stable_sort(spokes.begin(), spokes.end(),
                   [](const Spoke& a, const Spoke& b) { return a.other_place < b.other_place; });
  return spokes;
}

}  // namespace

Result<glm::dmat3> body_from_model(const ModelAxes& axes) {
  const auto forward = axis_of(axes.forward);
  if (!forward) return fail_axis("forward", axes.forward);
  const auto up = axis_of(axes.up);
  if (!up) return fail_axis("up", axes.up);
  if (glm::dot(*forward, *up) != 0)
    return fail("up", fmt::format("lies along forward ({})", axes.forward), ErrorKind::bad_project);
  if (!std::isfinite(axes.scale) || axes.scale <= 0)
    return fail("scale", "must be a positive number", ErrorKind::bad_project);
  if (!std::isfinite(axes.length_m) || axes.length_m < 0)
    return fail("length_m", "must be a positive number, or 0 to use scale", ErrorKind::bad_project);

  const glm::dvec3 down = -*up;
  const glm::dvec3 right = glm::cross(down, *forward);
  return glm::transpose(glm::dmat3(*forward, right, down));
}

glm::dvec3 doubled_area(const Triangle& triangle) {
  return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

std::vector<std::uint32_t> welded(std::span<const glm::dvec3> positions) {
  std::unordered_map<glm::dvec3, std::uint32_t, HashOfPosition> place_of_position;
  place_of_position.reserve(positions.size() / 3);
  std::vector<std::uint32_t> places;
  places.reserve(positions.size());
  for (const glm::dvec3& position : positions) {
    const auto next = static_cast<std::uint32_t>(place_of_position.size());
    places.push_back(place_of_position.emplace(position, next).first->second);
  }
  return places;
}

std::vector<glm::dvec3> averaged_normals(std::span<const Triangle> triangles) {
  std::vector<glm::dvec3> face_normals;
  face_normals.reserve(triangles.size());
  for (const Triangle& triangle : triangles) face_normals.push_back(glm::normalize(doubled_area(triangle)));

  const std::vector<std::uint32_t> places = places_of(triangles);
  std::vector<glm::dvec3> normals(triangles.size() * 3);
  for (const std::vector<int>& corners : corners_by_place(places)) {
    DisjointSets groups(corners.size());
    const std::vector<Spoke> spokes = spokes_of(corners, places);
    for (std::size_t i = 1; i < spokes.size(); ++i) {
      if (spokes[i].other_place != spokes[i - 1].other_place) continue;
      const glm::dvec3& one = face_normals[corners[spokes[i - 1].member] / 3];
      const glm::dvec3& two = face_normals[corners[spokes[i].member] / 3];
      if (glm::dot(one, two) > kCosOfCrease) groups.join(spokes[i].member, spokes[i - 1].member);
    }
    std::vector<glm::dvec3> sums(corners.size(), glm::dvec3{0, 0, 0});
    for (std::size_t member = 0; member < corners.size(); ++member)
      sums[groups.root(static_cast<std::uint32_t>(member))] +=
          face_normals[corners[member] / 3] * angle_at(triangles[corners[member] / 3], corners[member] % 3);
    for (std::size_t member = 0; member < corners.size(); ++member) {
      const glm::dvec3 sum = sums[groups.root(static_cast<std::uint32_t>(member))];
      const double length = glm::length(sum);
      normals[corners[member]] = length > 1e-9 ? sum / length : face_normals[corners[member] / 3];
    }
  }
  return normals;
}

}  // namespace sigs
