// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>

#include "base/layer.h"
#include "base/pose.h"
#include "base/result.h"
#include "camera/pinhole_view.h"
#include "mesh/mesh.h"

namespace sigs {

// An omnidirectional point light (paper section 3.1.2) and the light that comes from everywhere.
struct Light {
  glm::dvec3 p_in_camera{0, 0, 0};  // metres, camera frame
  glm::dvec3 color{1, 1, 1};        // linear; 1: a white surface facing the light becomes white
  double ambient = 0.35;            // 0..1: share of the light that comes from everywhere
};

// What a renderer has done since it was made.
struct RenderCounts {
  std::int64_t pixels_drawn = 0;     // of the views
  std::int64_t triangles_drawn = 0;  // given to OpenGL, once for each piece of a large view
  std::int64_t bytes_uploaded = 0;   // vertices, triangles and textures; what a view says about itself is left out
  std::int64_t draw_calls = 0;
};

// Draws meshes off screen with OpenGL through EGL. One renderer lives on one thread: the one that made it.
class Renderer {
 public:
  // Makes a context on EGL's surfaceless platform, else on the first EGL device that works.
  // Error unavailable where there is none; it says what was tried.
  //   samples_per_pixel  1 (no multisampling), 2, 4 or 8, as far as the driver can
  [[nodiscard]] static Result<Renderer> create(int samples_per_pixel = 4);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // "surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"
  [[nodiscard]] const std::string& description() const;

  // Largest side of a view that draw() can make, px.
  [[nodiscard]] int max_size_px() const;

  [[nodiscard]] const RenderCounts& counts() const;

  // The mesh as the view sees it, covering the whole view (layer.rect = {0, 0, size}): premultiplied, linear light,
  // several samples a pixel. Solid parts first, then glass from far to near. The mesh is uploaded at its first use and
  // kept for as long as the renderer lives, by the address of the mesh: keep meshes alive and where they are. A mesh
  // that has changed is uploaded again, as far as a look at some thousand of its vertices and texels tells. Depth and
  // position are relative to the camera, so nothing shakes far from the world's origin. Everything given must be
  // finite. A view of no size gives an empty layer. Errors: bad_data where the view is larger than max_size_px();
  // unavailable where the driver fails.
  [[nodiscard]] Result<Layer> draw(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                                   const Light& light, const VirtualCamera& view);

  // Gives back what was uploaded of a mesh. Nothing happens where it was never drawn.
  void forget(const Mesh& mesh);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sigs
