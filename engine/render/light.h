// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>

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

  [[nodiscard]] bool operator==(const SunView&) const = default;
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

  // Draws the map of a body, in place of the one before; nothing where that is the same map. Error unavailable where
  // the driver cannot draw to it. Other framebuffers, viewports and programs have to be bound again afterwards.
  [[nodiscard]] Result<PassCounts> draw(const GpuMesh& gpu, const SunView& sun);

  // Makes the map the texture of unit 1, which the shaders read it from.
  void bind() const;

 private:
  ShadowMap(Program solid, Program cutout);
  [[nodiscard]] Result<void> grow(const cv::Size& size);

  Program solid_;
  Program cutout_;
  // What the map is of. A body that keeps its attitude in the sun has the same one in every frame.
  struct Drawn {
    std::uint64_t fingerprint = 0;
    SunView sun;
  };
  std::optional<Drawn> drawn_;
  cv::Size size_{0, 0};
  unsigned int framebuffer_ = 0;
  unsigned int depth_ = 0;
};

// What lights a body: an omnidirectional point light (paper section 3.1.2) with ambient light; or the sun with the
// light of sky and ground. Colours are linear; 1: a white surface that the light falls on squarely becomes white.
struct Light {
  enum class Kind { point, sun };

  glm::dvec3 p_in_camera{0, 0, 0};  // of the point light: metres, camera frame
  glm::dvec3 color{1, 1, 1};        // of the point light or of the sun
  double ambient = 0.35;            // of the point light, 0..1: share that comes from everywhere

  Kind kind = Kind::point;
  glm::dvec3 to_sun{0, 0, -1};       // direction, camera frame; of any length but 0
  glm::dvec3 up{0, 0, -1};           // direction of the world's zenith, camera frame; of any length but 0
  glm::dvec3 sky_color{0, 0, 0};     // what the whole sky gives a surface that looks up
  glm::dvec3 ground_color{0, 0, 0};  // what the ground gives a surface that looks down
  double exposure = 1;               // factor of sun, sky and ground
};

// Sets the uniforms of a program for a body; the program is in use afterwards. The second for programs with SUN, which
// need the map of the body's shadows bound too.
void set_point_light(const Program& program, const Light& light, const Pose<frame::View, frame::Body>& view_from_body,
                     const Pose<frame::View, frame::Camera>& view_from_camera);
void set_sun_light(const Program& program, const Light& light, const Pose<frame::View, frame::Body>& view_from_body,
                   const Pose<frame::View, frame::Camera>& view_from_camera, const SunView& sun);

// Unit vector towards the sun in the body's axes.
[[nodiscard]] glm::dvec3 to_sun_in_body(const Light& light, const Pose<frame::Camera, frame::Body>& camera_from_body);

}  // namespace sigs
