// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace sigs::truth {

// Whether it is opaque: nothing behind its surface is visible.
[[nodiscard]] bool lets_no_light_through(const Material& material);

// Lights in body coordinates, metres.
struct Lighting {
  glm::dvec3 lamp_m;
  glm::dvec3 eye_m;
  glm::dvec3 color;
  double ambient = 0;  // 0..1
};

// A place on the body's surface.
struct SurfacePoint {
  glm::dvec3 p_m;
  glm::dvec3 normal;     // as modelled; any length
  bool is_front = true;  // the triangle's corners run counter-clockwise as the ray sees them
  glm::dvec2 uv;         // OBJ's
  int material = 0;
};

// The shading model of assets/shaders/intruder.frag, in doubles: Lambert and Blinn-Phong in linear light. Images are
// read by bilinear interpolation of premultiplied linear light at full size; many rays a pixel do the rest.
class Shader {
 public:
  Shader(const Mesh& mesh, const Lighting& lighting);

  // Red, green, blue, opacity: premultiplied, linear. All 0 where light passes as if nothing were there.
  [[nodiscard]] glm::dvec4 shade(const SurfacePoint& point) const;

 private:
  struct ShadedMaterial {
    glm::dvec3 diffuse;
    glm::dvec3 specular;
    double shininess;
    double opacity;
    cv::Mat texture;  // CV_32FC4, premultiplied, linear; empty: white
  };

  Lighting lighting_;
  std::vector<ShadedMaterial> materials_;
};

}  // namespace sigs::truth
