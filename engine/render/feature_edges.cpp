// SPDX-License-Identifier: MIT
#include "render/feature_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "mesh/geometry.h"
#include "render/draw_list.h"

namespace sigs {
namespace {

// One side of a triangle, with its ends in the order of their positions' numbers.
struct Side {
  std::uint32_t low = 0, high = 0;                // numbers of positions
  std::uint32_t triangle = 0;                     // in the order of the mesh's parts
  std::uint32_t low_vertex = 0, high_vertex = 0;  // of the mesh
  int material = 0;

  [[nodiscard]] bool joins(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const Mesh& mesh) {
  std::vector<glm::dvec3> positions;
  for (const Vertex& vertex : mesh.vertices) positions.emplace_back(vertex.position_m);
  const std::vector<std::uint32_t> places = welded(positions);
  std::vector<Side> sides;
  std::uint32_t triangle = 0;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3, ++triangle)
      for (std::uint32_t n = 0; n < 3; ++n) {
        std::uint32_t a = mesh.indices[part.first_index + i + n];
        std::uint32_t b = mesh.indices[part.first_index + i + (n + 1) % 3];
        if (places[a] == places[b]) continue;
        if (places[a] > places[b]) std::swap(a, b);
        sides.push_back({places[a], places[b], triangle, a, b, part.material});
      }
  std::ranges::sort(sides,
                    [](const Side& a, const Side& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  return sides;
}

std::vector<glm::vec3> normals_of(const Mesh& mesh, const std::vector<CullFace>& hidden) {
  std::vector<glm::vec3> normals;
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3) {
      const auto corner = [&](std::uint32_t n) {
        return glm::dvec3(mesh.vertices[mesh.indices[part.first_index + i + n]].position_m);
      };
      const glm::vec3 normal(doubled_area({corner(0), corner(1), corner(2)}));
      normals.push_back(hidden[normals.size()] == CullFace::front ? -normal : normal);
    }
  return normals;
}

// Whether light and colour go on from one triangle to the other.
bool goes_on(const Mesh& mesh, const Side& a, const Side& b) {
  constexpr float kSameNormal = 0.9998F;  // cosine of 1.1 degrees
  const auto are_alike = [&](std::uint32_t i, std::uint32_t j) {
    return glm::dot(mesh.vertices[i].normal, mesh.vertices[j].normal) > kSameNormal;
  };
  return a.material == b.material && are_alike(a.low_vertex, b.low_vertex) && are_alike(a.high_vertex, b.high_vertex);
}

// The part of a line in front of the eye and within the window, in clip coordinates; none where there is none.
std::optional<std::array<glm::dvec4, 2>> clipped_line(glm::dvec4 from, glm::dvec4 to) {
  constexpr double kBeyond = 1.01;  // of the window: an edge outside of it may touch a pixel within
  double first = 0, last = 1;
  const auto cut = [&](double at_from, double at_to) {  // keeps what is not negative
    if (at_from < 0 && at_to < 0) last = -1;
    if (at_from < 0 && at_to >= 0) first = std::max(first, at_from / (at_from - at_to));
    if (at_from >= 0 && at_to < 0) last = std::min(last, at_from / (at_from - at_to));
  };
  cut(from.z + from.w, to.z + to.w);
  for (const int axis : {0, 1}) {
    cut(kBeyond * from.w - from[axis], kBeyond * to.w - to[axis]);
    cut(kBeyond * from.w + from[axis], kBeyond * to.w + to[axis]);
  }
  if (!(first <= last)) return std::nullopt;
  return std::array{from + first * (to - from), from + last * (to - from)};
}

// In pixels measured from the view's upper left corner; z: OpenGL's depth.
glm::dvec3 in_window(const glm::dvec4& clip, const cv::Size& size_px) {
  const glm::dvec3 at = 0.5 * glm::dvec3(clip) / clip.w + 0.5;
  return {at.x * size_px.width, at.y * size_px.height, at.z};
}

// Marks the pixels along a line, but those where everything around is nearer.
//   farthest  depth of the farthest of the nine pixels around each
void mark_line(const glm::dvec3& from, const glm::dvec3& to, const cv::Mat& farthest, cv::Mat& marks) {
  constexpr double kSlack = 1e-5;  // of depth: what float and the slope within a pixel take
  const double length_px = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  const int steps = static_cast<int>(std::ceil(length_px)) + 1;
  for (int n = 0; n <= steps; ++n) {
    const glm::dvec3 at = from + (to - from) * (double(n) / steps);
    const auto x = static_cast<int>(std::floor(at.x));
    const auto y = static_cast<int>(std::floor(at.y));
    // A pixel beyond the border is marked for the one beside it.
    const int column = std::clamp(x, 0, marks.cols - 1);
    const int row = std::clamp(y, 0, marks.rows - 1);
    if (at.z <= farthest.at<float>(row, column) + kSlack) marks.at<unsigned char>(row, column) = 255;
  }
}

}  // namespace

FeatureEdges::FeatureEdges(const Mesh& mesh) {
  const std::vector<CullFace> hidden = cull_faces_of(mesh, surfaces_of(mesh));
  const std::vector<glm::vec3> normals = normals_of(mesh, hidden);
  const std::vector<Side> sides = sorted_sides(mesh);
  for (auto side = sides.begin(); side != sides.end();) {
    const auto end = std::find_if(side, sides.end(), [&](const Side& other) { return !side->joins(other); });
    const Side& other = *(end - 1);
    const bool is_feature = end - side != 2 || !goes_on(mesh, *side, other);
    const bool is_of_closed = end - side == 2 && hidden[side->triangle] != CullFace::none;
    edges_.push_back({{mesh.vertices[side->low_vertex].position_m, mesh.vertices[side->high_vertex].position_m},
                      {normals[side->triangle], normals[other.triangle]},
                      is_feature,
                      is_of_closed});
    side = end;
  }
}

bool FeatureEdges::is_shown(const Edge& edge, const DrawnDepth& view) {
  const glm::vec3 to_eye = glm::vec3(view.eye_m) - edge.ends_m[0];
  const bool faces_a = glm::dot(edge.normals[0], to_eye) > 0;
  const bool faces_b = glm::dot(edge.normals[1], to_eye) > 0;
  if (faces_a != faces_b) return true;
  return edge.is_feature && (faces_a || !edge.is_of_closed || !view.from_outside);
}

cv::Mat FeatureEdges::pixels_touched(const DrawnDepth& view) const {
  ENSURE(view.depth.type() == CV_32FC1 && !view.depth.empty());
  cv::Mat farthest;
  cv::dilate(view.depth, farthest, cv::Mat());
  cv::Mat marks = cv::Mat::zeros(view.depth.size(), CV_8UC1);
  for (const Edge& edge : edges_) {
    if (!is_shown(edge, view)) continue;
    const auto line = clipped_line(view.clip_from_body * glm::dvec4(glm::dvec3(edge.ends_m[0]), 1),
                                   view.clip_from_body * glm::dvec4(glm::dvec3(edge.ends_m[1]), 1));
    if (line) mark_line(in_window((*line)[0], marks.size()), in_window((*line)[1], marks.size()), farthest, marks);
  }
  cv::dilate(marks, marks, cv::Mat());
  return marks;
}

}  // namespace sigs
