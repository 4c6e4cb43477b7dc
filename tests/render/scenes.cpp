// SPDX-License-Identifier: MIT
#include "render/scenes.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>

namespace sigs::test {

Renderer& renderer() {
  static Renderer shared = [] {
    Result<Renderer> made = Renderer::create();
    if (!made) FAIL(made.error().text());
    return std::move(*made);
  }();
  return shared;
}

Material paint(const glm::vec3& diffuse, float opacity) {
  return {.name = "paint", .diffuse = diffuse, .opacity = opacity};
}

void add_quad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v, int material) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
  for (const glm::vec2 uv : {glm::vec2{0, 0}, glm::vec2{1, 0}, glm::vec2{1, 1}, glm::vec2{0, 1}})
    mesh.vertices.push_back({corner + edge_u * uv.x + edge_v * uv.y, normal, uv});
  mesh.parts.push_back({material, static_cast<std::uint32_t>(mesh.indices.size()), 6});
  for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + index);
}

Mesh measured(Mesh mesh) {
  mesh.low_m = mesh.high_m = mesh.vertices.front().position_m;
  for (const Vertex& vertex : mesh.vertices) {
    mesh.low_m = glm::min(mesh.low_m, vertex.position_m);
    mesh.high_m = glm::max(mesh.high_m, vertex.position_m);
    mesh.radius_m = std::max(mesh.radius_m, glm::length(vertex.position_m));
  }
  return mesh;
}

Mesh facing_quad(const glm::dvec2& low_m, const glm::dvec2& high_m, const Material& material, float x_m) {
  Mesh mesh;
  mesh.materials = {material};
  // From the lower left corner as seen by the camera (z down): u to the right, v up.
  add_quad(mesh, {x_m, low_m.x, high_m.y}, {0, high_m.x - low_m.x, 0}, {0, 0, low_m.y - high_m.y}, 0);
  return measured(std::move(mesh));
}

Mesh box(const glm::vec3& half_m, const Material& material) {
  Mesh mesh;
  mesh.materials = {material};
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0F, 1.0F}) {
      glm::vec3 u{0, 0, 0};
      glm::vec3 v{0, 0, 0};
      glm::vec3 out{0, 0, 0};
      out[axis] = sign * half_m[axis];
      u[(axis + 1) % 3] = 2 * half_m[(axis + 1) % 3];
      v[(axis + 2) % 3] = 2 * half_m[(axis + 2) % 3];
      if (sign < 0) std::swap(u, v);
      add_quad(mesh, out - (u + v) * 0.5F, u, v, 0);
    }
  return measured(std::move(mesh));
}

VirtualCamera view_of(const cv::Size& size_px, double focal_px) {
  VirtualCamera view;
  view.focal_px = focal_px;
  view.center_px = {(size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0};
  view.size_px = size_px;
  return view;
}

Pose<frame::Camera, frame::Body> at(const glm::dvec3& p_in_camera) {
  return {{1, 0, 0, 0}, p_in_camera};
}

Light ambient_only(double ambient) {
  return {.color = glm::dvec3(1), .ambient = ambient};
}

Layer drawn(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body, const Light& light,
            const VirtualCamera& view) {
  static std::deque<Mesh> kept;  // the renderer knows meshes by their address
  Result<Layer> layer = renderer().draw(kept.emplace_back(mesh), camera_from_body, light, view);
  if (!layer) FAIL(layer.error().text());
  return std::move(*layer);
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && a.isContinuous() && b.isContinuous() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

bool is_valid(const Layer& layer) {
  for (int y = 0; y < layer.color.rows; ++y)
    for (int x = 0; x < layer.color.cols; ++x) {
      const auto color = layer.color.at<cv::Vec4f>(y, x);
      const float coverage = layer.coverage.at<float>(y, x);
      for (int i = 0; i < 4; ++i)
        if (!std::isfinite(color[i]) || color[i] < 0) return false;
      if (color[3] == 0 && (color[0] > 0 || color[1] > 0 || color[2] > 0)) return false;
      // Blending of glass rounds in the last of 24 bits.
      if (!(coverage >= 0 && coverage <= 1 && color[3] <= coverage + 1e-6F)) return false;
    }
  return true;
}

}  // namespace sigs::test
