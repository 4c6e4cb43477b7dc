// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "render/draw_list.h"

namespace sigs {

// A mesh in the memory of the current context, which owns all of it.
class GpuMesh {
 public:
  explicit GpuMesh(const Mesh& mesh);

  // False where the mesh at the same address is another one than that which was uploaded (a model read again with other
  // axes, say). Looks at every material and part, but only at some thousand vertices, indices and texels.
  [[nodiscard]] bool is_copy_of(const Mesh& mesh) const;

  // Returns what was uploaded to the driver.
  void release();

  // What is seen through, far to near as the eye (body axes) sees it.
  [[nodiscard]] DrawList sorted_for(const glm::dvec3& eye_m) const;

  // Makes the following calls of draw() take their triangles from the solid ones, whose runs it returns; or from a list
  // of this moment.
  const std::vector<Run>& bind_solid() const;
  void bind_sorted(const DrawList& list) const;
  void draw(const Run& run) const;

  // Binds the texture of a run; nothing where it has none.
  void bind_texture(int texture) const;

  // Since the last time it was asked.
  [[nodiscard]] std::int64_t take_bytes_uploaded() { return std::exchange(bytes_uploaded_, 0); }

 private:
  void upload_textures(const Mesh& mesh);

  std::uint64_t fingerprint_;
  std::vector<int> texture_of_material_;
  std::vector<TransparentTriangle> transparent_triangles_;
  std::vector<Run> solid_;
  std::int64_t bytes_uploaded_ = 0;
  unsigned int vertex_array_ = 0;
  unsigned int vertex_buffer_ = 0;
  unsigned int material_buffer_ = 0;
  unsigned int solid_indices_ = 0;
  unsigned int sorted_indices_ = 0;
  std::vector<unsigned int> textures_;
};

}  // namespace sigs
