// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
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

  [[nodiscard]] const std::vector<SeeThrough>& see_through() const { return see_through_; }
  [[nodiscard]] const std::vector<Run>& solid_runs() const { return solid_runs_; }

  // Makes the following calls of draw() take their triangles from the solid list, or from a list of this moment.
  void bind_solid() const;
  void bind_sorted(const DrawList& list) const;
  void draw(const Run& run) const;

  // Binds a material's picture; plain white where it has none.
  void bind_picture(int material) const;

 private:
  void upload_pictures(const Mesh& mesh);

  std::uint64_t fingerprint_;
  std::vector<Run> solid_runs_;
  std::vector<SeeThrough> see_through_;
  unsigned int vertex_array_ = 0;
  unsigned int vertex_buffer_ = 0;
  unsigned int solid_indices_ = 0;
  unsigned int sorted_indices_ = 0;
  std::vector<unsigned int> pictures_;                              // by material
  std::map<const unsigned char*, unsigned int> picture_of_pixels_;  // each picture once; null: white
};

}  // namespace sigs
