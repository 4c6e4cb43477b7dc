// SPDX-License-Identifier: MIT
#include "mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <unordered_map>

namespace sigs {
namespace {

constexpr double kCosOfCrease = 0.5;  // 60 degrees

struct HashOfPosition {
  std::size_t operator()(const glm::dvec3& p) const {
    const std::hash<double> hash;
    return hash(p.x) ^ (hash(p.y) * 0x9E3779B97F4A7C15ULL) ^ (hash(p.z) * 0xC2B2AE3D27D4EB4FULL);
  }
};

// A number for each corner; corners at the same place have the same.
std::vector<int> places_of(std::span<const Triangle> triangles) {
  std::unordered_map<glm::dvec3, int, HashOfPosition> place_of_position;
  place_of_position.reserve(triangles.size());
  std::vector<int> places;
  places.reserve(triangles.size() * 3);
  for (const Triangle& triangle : triangles)
    for (const glm::dvec3& position : triangle)
      places.push_back(place_of_position.emplace(position, static_cast<int>(place_of_position.size())).first->second);
  return places;
}

// Corners by the place at which they meet.
std::vector<std::vector<int>> corners_by_place(const std::vector<int>& places) {
  if (places.empty()) return {};
  std::vector<std::vector<int>> corners(*std::max_element(places.begin(), places.end()) + 1);
  for (std::size_t corner = 0; corner < places.size(); ++corner)
    corners[places[corner]].push_back(static_cast<int>(corner));
  return corners;
}

double angle_at(const Triangle& triangle, int corner) {
  const glm::dvec3 a = triangle[(corner + 1) % 3] - triangle[corner];
  const glm::dvec3 b = triangle[(corner + 2) % 3] - triangle[corner];
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Sets that grow together (Tarjan).
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

// An edge from the place at which corners meet to another place, as seen by one of those corners.
struct Spoke {
  int other_place;
  int member;  // into the corners that meet
};

std::vector<Spoke> spokes_of(const std::vector<int>& corners, const std::vector<int>& places) {
  std::vector<Spoke> spokes;
  for (std::size_t member = 0; member < corners.size(); ++member) {
    const int first = corners[member] / 3 * 3;
    const int corner = corners[member] % 3;
    spokes.push_back({places[first + (corner + 1) % 3], static_cast<int>(member)});
    spokes.push_back({places[first + (corner + 2) % 3], static_cast<int>(member)});
  }
  std::stable_sort(spokes.begin(), spokes.end(),
                   [](const Spoke& a, const Spoke& b) { return a.other_place < b.other_place; });
  return spokes;
}

}  // namespace

glm::dvec3 doubled_area(const Triangle& triangle) {
  return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

std::vector<glm::dvec3> averaged_normals(std::span<const Triangle> triangles) {
  std::vector<glm::dvec3> face_normals;
  face_normals.reserve(triangles.size());
  for (const Triangle& triangle : triangles) face_normals.push_back(glm::normalize(doubled_area(triangle)));

  const std::vector<int> places = places_of(triangles);
  std::vector<glm::dvec3> normals(triangles.size() * 3);
  for (const std::vector<int>& corners : corners_by_place(places)) {
    Groups groups(corners.size());
    const std::vector<Spoke> spokes = spokes_of(corners, places);
    for (std::size_t i = 1; i < spokes.size(); ++i) {
      if (spokes[i].other_place != spokes[i - 1].other_place) continue;
      const glm::dvec3& one = face_normals[corners[spokes[i - 1].member] / 3];
      const glm::dvec3& two = face_normals[corners[spokes[i].member] / 3];
      if (glm::dot(one, two) > kCosOfCrease) groups.join(spokes[i].member, spokes[i - 1].member);
    }
    std::vector<glm::dvec3> sums(corners.size(), glm::dvec3{0, 0, 0});
    for (std::size_t member = 0; member < corners.size(); ++member)
      sums[groups.root(static_cast<int>(member))] +=
          face_normals[corners[member] / 3] * angle_at(triangles[corners[member] / 3], corners[member] % 3);
    for (std::size_t member = 0; member < corners.size(); ++member) {
      const glm::dvec3 sum = sums[groups.root(static_cast<int>(member))];
      const double length = glm::length(sum);
      normals[corners[member]] = length > 1e-9 ? sum / length : face_normals[corners[member] / 3];
    }
  }
  return normals;
}

}  // namespace sigs
