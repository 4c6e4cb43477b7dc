// SPDX-License-Identifier: MIT
#include "mesh/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

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

constexpr int kCells = 20;             // of the grid that is mirrored, along each axis
constexpr double kPoints = 30'000;     // by which the surface is sampled
constexpr double kEndShare = 0.12;     // of the length: what counts as nose and as tail
constexpr double kSureOverlap = 0.08;  // by how much more the wings' axis is mirrored than the others
constexpr double kSureLength = 1.25;   // how much longer than high
constexpr double kSureSpread = 1.25;   // how much wider the tail's end is than the nose's
constexpr double kSureFin = 1.6;       // how much farther the fin goes up than anything at the tail goes down
constexpr int kMaxSplits = 64;         // of one triangle, along each side

struct SurfacePoint {
  glm::dvec3 position;  // each part 0..1 within the bounds
  double area = 0;
};

// Points spread evenly over the surface, each with its share of the area.
// The first index of each triangle, without the discs of rotors where there is anything else: a disc tells neither nose
// nor top.
std::vector<std::size_t> triangles_of_the_body(const Mesh& mesh) {
  std::vector<std::size_t> all;
  std::vector<std::size_t> of_rotors;
  for (const MeshPart& part : mesh.parts) {
    const auto material = static_cast<std::size_t>(part.material);
    const bool is_rotor = material < mesh.materials.size() && mesh.materials[material].rotor;
    for (std::size_t i = 0; i + 2 < part.index_count; i += 3)
      (is_rotor ? of_rotors : all).push_back(part.first_index + i);
  }
  return all.empty() ? of_rotors : all;
}

std::vector<SurfacePoint> surface_points(const Mesh& mesh) {
  const glm::dvec3 low(mesh.low_m);
  const glm::dvec3 size = glm::max(glm::dvec3(mesh.high_m) - low, glm::dvec3(1e-30));
  const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.vertices[mesh.indices[i]].position_m); };
  const auto area_of = [&](std::size_t i) {
    return glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i))) / 2;
  };
  const std::vector<std::size_t> triangles = triangles_of_the_body(mesh);
  double total = 0;
  for (const std::size_t i : triangles) total += area_of(i);
  std::vector<SurfacePoint> points;
  for (const std::size_t i : triangles) {
    const double area = area_of(i);
    const double wanted = total > 0 ? std::sqrt(area / total * kPoints) : 1;
    const int n = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMaxSplits);
    // Middles of the n * n equal triangles, the upright ones and the inverted ones.
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < 2 * (n - a) - 1; ++b) {
        const double third = b % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const double u = (a + third) / n;
        const double v = (b / 2 + third) / n;
        const glm::dvec3 p = corner(i) * (1 - u - v) + corner(i + 1) * u + corner(i + 2) * v;
        points.push_back({(p - low) / size, area / (double(n) * n)});
      }
  }
  return points;
}

// Share of the surface that lies where its mirror image lies, for the mirror across the middle of each axis.
std::array<double, 3> mirror_overlaps(const std::vector<SurfacePoint>& points) {
  std::vector<double> grid(kCells * kCells * kCells, 0.0);
  const auto cell = [](double share) { return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1); };
  const auto at = [&](const std::array<int, 3>& c) -> double& { return grid[(c[0] * kCells + c[1]) * kCells + c[2]]; };
  double total = 0;
  for (const SurfacePoint& point : points) {
    at({cell(point.position.x), cell(point.position.y), cell(point.position.z)}) += point.area;
    total += point.area;
  }
  std::array<double, 3> overlaps{};
  for (int x = 0; x < kCells; ++x)
    for (int y = 0; y < kCells; ++y)
      for (int z = 0; z < kCells; ++z)
        for (int axis = 0; axis < 3; ++axis) {
          std::array<int, 3> mirrored{x, y, z};
          mirrored[axis] = kCells - 1 - mirrored[axis];
          overlaps[axis] += std::min(at({x, y, z}), at(mirrored)) / std::max(total, 1e-300);
        }
  return overlaps;
}

struct AxisOrder {
  int wings = 1, length = 0, height = 2;
  bool is_sure = false;
};

AxisOrder order_of(const std::array<double, 3>& overlaps, const glm::dvec3& size) {
  AxisOrder order;
  for (int axis : {0, 2})
    if (overlaps[axis] > overlaps[order.wings] + kSureOverlap) order.wings = axis;
  const int a = (order.wings + 1) % 3;
  const int b = (order.wings + 2) % 3;
  order.length = size[a] >= size[b] ? a : b;
  order.height = size[a] >= size[b] ? b : a;
  const double others = std::max(overlaps[a], overlaps[b]);
  order.is_sure =
      overlaps[order.wings] > others + kSureOverlap && size[order.length] > kSureLength * size[order.height];
  return order;
}

// The part of the model at one end of its length.
struct ModelEnd {
  double low = INFINITY, high = -INFINITY;  // along the height, in the bounds' unit
  double wide = 0;                          // from side to side

  [[nodiscard]] double spread() const { return std::max({wide, high - low, 0.0}); }
};

// at_high: the end of the greater coordinate.
ModelEnd end_of(const std::vector<SurfacePoint>& points, const AxisOrder& order, const glm::dvec3& size, bool at_high) {
  ModelEnd end;
  for (const SurfacePoint& point : points) {
    const double along = at_high ? 1 - point.position[order.length] : point.position[order.length];
    if (along > kEndShare) continue;
    const double height = point.position[order.height] * size[order.height];
    end.low = std::min(end.low, height);
    end.high = std::max(end.high, height);
    end.wide = std::max(end.wide, 2 * std::abs(point.position[order.wings] - 0.5) * size[order.wings]);
  }
  return end;
}

double mean_height(const std::vector<SurfacePoint>& points, const AxisOrder& order) {
  double sum = 0;
  double area = 0;
  for (const SurfacePoint& point : points) sum += point.position[order.height] * point.area, area += point.area;
  return area > 0 ? sum / area : 0.5;
}

glm::dvec3 axis_vector(int axis, double sign) {
  glm::dvec3 vector(0);
  vector[axis] = sign;
  return vector;
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

ModelShape shape_of(const Mesh& mesh) {
  const std::vector<SurfacePoint> points = surface_points(mesh);
  const glm::dvec3 size = glm::dvec3(mesh.high_m) - glm::dvec3(mesh.low_m);
  const AxisOrder order = order_of(mirror_overlaps(points), size);
  const ModelEnd low_end = end_of(points, order, size, false);
  const ModelEnd high_end = end_of(points, order, size, true);
  const bool nose_is_high = high_end.spread() < low_end.spread();
  const ModelEnd& nose = nose_is_high ? high_end : low_end;
  const ModelEnd& tail = nose_is_high ? low_end : high_end;
  const double middle = mean_height(points, order) * size[order.height];
  const double above = tail.high - middle;
  const double below = middle - tail.low;
  ModelShape shape{.wings_are_sure = order.is_sure};
  shape.nose_is_sure = order.is_sure && tail.spread() > kSureSpread * nose.spread();
  shape.top_is_sure = shape.nose_is_sure && std::max(above, below) > kSureFin * std::max(0.0, std::min(above, below));
  // What is not sure stays as the mesh has it: X forward, -Z up.
  shape.nose = axis_vector(order.length, shape.nose_is_sure ? (nose_is_high ? 1 : -1) : 1);
  shape.top = axis_vector(order.height, shape.top_is_sure ? (above > below ? 1 : -1) : (order.height == 2 ? -1 : 1));
  return shape;
}

std::string file_axis(const glm::dvec3& direction_in_body, const ModelAxes& axes) {
  const Result<glm::dmat3> body_from_file = body_from_model(axes);
  const glm::dvec3 in_file = body_from_file ? glm::transpose(*body_from_file) * direction_in_body : direction_in_body;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(in_file[i]) > std::abs(in_file[axis])) axis = i;
  return std::string(in_file[axis] < 0 ? "-" : "+") + "xyz"[axis];
}

}  // namespace sigs
