// SPDX-License-Identifier: MIT
#include "render/opacity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace sigs {
namespace {

// How many texels of any rectangle are not opaque, by summed areas (Crow 1984).
class TransparentTexels {
 public:
  explicit TransparentTexels(const cv::Mat& texture) : size_(texture.size()) {
    cv::Mat opacity;
    cv::extractChannel(texture, opacity, 3);
    const cv::Mat is_transparent = (opacity < 255) / 255;
    cv::integral(is_transparent, sums_, CV_32S);
  }

  [[nodiscard]] bool any_under(const std::array<glm::vec2, 3>& uvs) const {
    if (sums_.at<int>(size_.height, size_.width) == 0) return false;
    const auto [left, right] = span({uvs[0].x, uvs[1].x, uvs[2].x}, size_.width);
    const auto [top, bottom] = span({1 - uvs[0].y, 1 - uvs[1].y, 1 - uvs[2].y}, size_.height);
    return sums_.at<int>(bottom, right) - sums_.at<int>(top, right) - sums_.at<int>(bottom, left) +
               sums_.at<int>(top, left) >
           0;
  }

 private:
  // First texel and one past the last that coordinates reach, with a neighbour for linear filtering. All of them where
  // the coordinates run over the edge and the texture repeats.
  static std::pair<int, int> span(const std::array<float, 3>& coordinates, int count) {
    const auto [least, most] = std::minmax_element(coordinates.begin(), coordinates.end());
    const double tile = std::floor(double{*least});
    const double low = *least - tile;
    const double high = *most - tile;
    if (!(high <= 1)) return {0, count};
    return {std::max(0, static_cast<int>(low * count) - 1), std::min(count, static_cast<int>(high * count) + 2)};
  }

  cv::Size size_;
  cv::Mat sums_;
};

using Shelf = std::map<const unsigned char*, TransparentTexels>;

Surface surface_of(const Mesh& mesh, const Material& material, std::uint32_t first, Shelf& shelf) {
  if (!(material.opacity >= kSolidOpacity)) return Surface::glass;
  if (material.texture.empty()) return Surface::solid;
  const TransparentTexels& texels = shelf.try_emplace(material.texture.data, material.texture).first->second;
  const auto uv = [&](std::uint32_t corner) { return mesh.vertices[mesh.indices[first + corner]].uv; };
  return texels.any_under({uv(0), uv(1), uv(2)}) ? Surface::cutout : Surface::solid;
}

}  // namespace

std::vector<Surface> surfaces_of(const Mesh& mesh) {
  Shelf shelf;
  std::vector<Surface> surfaces;
  surfaces.reserve(mesh.indices.size() / 3);
  for (const MeshPart& part : mesh.parts)
    for (std::uint32_t i = 0; i + 2 < part.index_count; i += 3)
      surfaces.push_back(surface_of(mesh, mesh.materials[part.material], part.first_index + i, shelf));
  return surfaces;
}

}  // namespace sigs
