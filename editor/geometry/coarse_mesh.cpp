// SPDX-License-Identifier: MIT
#include "editor/geometry/coarse_mesh.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "base/transfer.h"

namespace sigs::editor {
namespace {

constexpr int kMaxCells = 512;  // along the longest side
constexpr float kSolid = 0.5F;

using Corners = std::array<int, 3>;

glm::vec3 linear(const glm::vec3& display) {
  return {linear_of_display(display.x), linear_of_display(display.y), linear_of_display(display.z)};
}
glm::vec3 display(const glm::vec3& linear) {
  return {display_of_linear(linear.x), display_of_linear(linear.y), display_of_linear(linear.z)};
}

// In linear light; the texture is multiplied onto the diffuse colour, as the renderer does.
glm::vec3 mean_color(const Material& material) {
  if (material.texture.empty()) return linear(material.diffuse);
  const cv::Scalar mean = cv::mean(material.texture);
  return linear(material.diffuse) * linear(glm::vec3(mean[0], mean[1], mean[2]) / 255.0F);
}

// The cell of each vertex, cells counted from 0 in the order in which they are met.
struct Clusters {
  std::vector<int> of_vertex;
  int count = 0;
};
Clusters clustered(const Mesh& mesh, float cell_m) {
  Clusters clusters;
  std::unordered_map<std::uint64_t, int> known;
  for (const Vertex& vertex : mesh.vertices) {
    const glm::vec3 steps = glm::max((vertex.position_m - mesh.low_m) / cell_m, 0.0F);
    const auto key = static_cast<std::uint64_t>(steps.x) << 42U | static_cast<std::uint64_t>(steps.y) << 21U |
                     static_cast<std::uint64_t>(steps.z);
    clusters.of_vertex.push_back(known.try_emplace(key, clusters.count).first->second);
    clusters.count = static_cast<int>(known.size());
  }
  return clusters;
}

struct Colors {
  glm::vec3 sum{0, 0, 0};
  float weight = 0;
};

// Faces that are left, each once, smallest corner first.
std::map<Corners, Colors> faces_of(const Mesh& mesh, const Clusters& clusters) {
  std::map<Corners, Colors> faces;
  for (const MeshPart& part : mesh.parts) {
    const Material& material = mesh.materials[part.material];
    if (material.opacity < kSolid) continue;
    const glm::vec3 color = mean_color(material);
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
      std::array<glm::vec3, 3> p{};
      Corners corners{};
      for (std::uint32_t k = 0; k < 3; ++k) {
        p[k] = mesh.vertices[mesh.indices[i + k]].position_m;
        corners[k] = clusters.of_vertex[mesh.indices[i + k]];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
      std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
      const float area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
      Colors& colors = faces[corners];
      colors.sum += color * area;
      colors.weight += area;
    }
  }
  return faces;
}

std::vector<glm::vec3> means(const Mesh& mesh, const Clusters& clusters) {
  std::vector<glm::dvec3> sums(clusters.count, glm::dvec3{0, 0, 0});
  std::vector<int> counts(clusters.count, 0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    sums[clusters.of_vertex[i]] += glm::dvec3(mesh.vertices[i].position_m);
    ++counts[clusters.of_vertex[i]];
  }
  std::vector<glm::vec3> points_m;
  for (std::size_t i = 0; i < sums.size(); ++i) points_m.emplace_back(sums[i] / static_cast<double>(counts[i]));
  return points_m;
}

CoarseMesh with_cells(const Mesh& mesh, float cell_m) {
  const Clusters clusters = clustered(mesh, cell_m);
  CoarseMesh result{.points_m = means(mesh, clusters)};
  for (const auto& [corners, colors] : faces_of(mesh, clusters)) {
    const glm::vec3& a = result.points_m[corners[0]];
    const glm::vec3 across = glm::cross(result.points_m[corners[1]] - a, result.points_m[corners[2]] - a);
    const float doubled_area = glm::length(across);
    if (!(doubled_area > 0) || !(colors.weight > 0)) continue;
    result.faces.push_back({corners, across / doubled_area, display(colors.sum / colors.weight)});
  }
  return result;
}

}  // namespace

CoarseMesh coarse(const Mesh& mesh, int max_faces) {
  const glm::vec3 size = mesh.high_m - mesh.low_m;
  const float max_length_m = std::max({size.x, size.y, size.z});
  if (mesh.indices.empty() || !(max_length_m > 0)) return {};
  CoarseMesh best;
  for (int few = 1, many = kMaxCells; few <= many;) {
    // Small numbers first: fine grids take longest.
    const int cells = many < 2 * few ? (few + many) / 2 : 2 * few;
    CoarseMesh tried = with_cells(mesh, max_length_m / (static_cast<float>(cells) + 0.5F));
    if (static_cast<int>(tried.faces.size()) <= max_faces) {
      best = std::move(tried);
      few = cells + 1;
    } else {
      many = cells - 1;
    }
  }
  return best;
}

}  // namespace sigs::editor
