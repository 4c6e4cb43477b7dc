// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/pose.h"
#include "base/result.h"
#include "camera/virtual_camera.h"
#include "mesh/mesh.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"

namespace sigs {

// How a body looks from the sun: a parallel projection along the light, fitted to the box around the mesh.
struct SunView {
  glm::dmat4 clip_from_body{1.0};
  glm::dmat4 texels_from_body{1.0};  // metres to x and y in the map and depth away from the sun, all in texels
  cv::Size size_texels;              // two texels of margin all around the body
  double depth_texels = 0;           // what the map's depths of 0..1 span
};

// The view of a mesh from the sun.
//   to_sun_in_body  unit vector
//   side_texels     wanted larger side of the map
[[nodiscard]] SunView sun_view_of(const Mesh& mesh, const glm::dvec3& to_sun_in_body, int side_texels);

// Side of the map for a body that is drawn with a camera: a texel is as large as 1.25 drawn pixels at the body's
// middle. In steps, so that it seldom changes from frame to frame; 128 to 2048.
[[nodiscard]] int shadow_map_side(const Mesh& mesh, const Pose<frame::View, frame::Body>& view_from_body,
                                  const VirtualCamera& view);

// Depth of what the sun's light meets first (Williams 1978). It belongs to the context that is current when it is
// created. Glass casts no shadow; of textures that let light through in places, opaque texels do.
class ShadowMap {
 public:
  // Compiles the shaders. Error unavailable as that of Program::create().
  [[nodiscard]] static Result<ShadowMap> create();

  // Draws the map of a body, in place of the one before. Error unavailable where the driver cannot draw to it. Other
  // framebuffers, viewports and programs have to be bound again afterwards.
  [[nodiscard]] Result<PassCounts> draw(const GpuMesh& gpu, const SunView& sun);

  // Makes the map the texture of unit 1, which the shaders read it from.
  void bind() const;

 private:
  ShadowMap(Program solid, Program cutout);
  [[nodiscard]] Result<void> grow(const cv::Size& size);

  Program solid_;
  Program cutout_;
  cv::Size size_{0, 0};
  unsigned int framebuffer_ = 0;
  unsigned int depth_ = 0;
};

}  // namespace sigs
