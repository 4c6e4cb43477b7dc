// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "render/draw_list.h"
#include "render/feature_edges.h"

namespace sigs {

// Uploads textures with all their mipmaps. Mesa's glGenerateMipmap() compiles shaders of its own for each kind of size,
// in every process anew: a fifth of the processor time that a single frame takes. The shader here is one that Mesa
// keeps in its cache on the disk; it reads the same texels with the same weights. It belongs to the context that is
// current.
class Mipmaps {
 public:
  Mipmaps();
  ~Mipmaps();
  Mipmaps(const Mipmaps&) = delete;
  Mipmaps& operator=(const Mipmaps&) = delete;

  // The name of a 2D texture in sRGB, which is bound. Changes the framebuffer, viewport, program and vertex array that
  // are bound, and switches depth test, scissor, blending, culling and multisampling off.
  //   texels  CV_8UC4, continuous: premultiplied red, green, blue, and opacity
  [[nodiscard]] unsigned int uploaded(const cv::Mat& texels) const;

 private:
  void halve(unsigned int texture, const cv::Size& size, int levels) const;

  unsigned int program_ = 0;  // 0: the driver lacks something; glGenerateMipmap() it is
  unsigned int framebuffer_ = 0;
  unsigned int vertex_array_ = 0;
};

// What was given to OpenGL.
struct PassCounts {
  std::int64_t triangles = 0;
  std::int64_t draw_calls = 0;
};

// Makes the following draw calls leave out one side of triangles.
void leave_out(CullFace side);

// A mesh in the memory of the GPU. It belongs to the context that is current when it is created.
class GpuMesh {
 public:
  // Uploads vertices, materials, textures and the indices of solid triangles. The mesh itself is not needed afterwards.
  explicit GpuMesh(const Mesh& mesh);

  // Whether the mesh is the one that was uploaded. False where another one lies at the same address (a model read again
  // with other axes, for example). Compares all materials and parts, but only some thousand vertices, indices and
  // texels.
  [[nodiscard]] bool is_copy_of(const Mesh& mesh) const;

  // The same number for the same mesh, as far as is_copy_of() compares.
  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_; }

  // Found at the first call. mesh: the one that was uploaded.
  [[nodiscard]] const FeatureEdges& feature_edges(const Mesh& mesh) {
    return feature_edges_ ? *feature_edges_ : feature_edges_.emplace(mesh);
  }

  // Frees the memory of the GPU.
  void release();

  // The transparent triangles from far to near; eye_m in body axes.
  [[nodiscard]] DrawList sorted_for(const glm::dvec3& eye_m) const;

  // Selects what the following calls of draw() take their triangles from: the solid ones, whose runs are returned, or a
  // list from sorted_for().
  const std::vector<Run>& bind_solid() const;
  void bind_sorted(const DrawList& list) const;
  // Draws one run of what was bound last, with the program in use.
  void draw(const Run& run) const;

  // Binds the texture of a run; does nothing for kNoTexture.
  void bind_texture(int texture) const;

  // Number of bytes uploaded since the last call.
  [[nodiscard]] std::int64_t take_bytes_uploaded() { return std::exchange(bytes_uploaded_, 0); }

 private:
  void upload_textures(const Mesh& mesh);

  std::uint64_t fingerprint_;
  std::vector<int> texture_of_material_;
  std::vector<TransparentTriangle> transparent_triangles_;
  std::vector<Run> solid_;
  std::optional<FeatureEdges> feature_edges_;
  std::int64_t bytes_uploaded_ = 0;
  unsigned int vertex_array_ = 0;
  unsigned int vertex_buffer_ = 0;
  unsigned int material_buffer_ = 0;
  unsigned int solid_indices_ = 0;
  unsigned int sorted_indices_ = 0;
  std::vector<unsigned int> textures_;
};

// The uploaded mesh, uploaded at its first use and again where it has changed.
[[nodiscard]] GpuMesh& uploaded_mesh(std::map<const Mesh*, GpuMesh>& meshes, const Mesh& mesh);

}  // namespace sigs
