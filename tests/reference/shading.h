// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
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
  double ambient = 0;           // 0..1
  bool is_sun = false;          // then lamp_m and ambient have no meaning, and color is that of the sun
  glm::dvec3 to_sun{0, 0, -1};  // unit vector
  glm::dvec3 up{0, 0, -1};      // unit vector, to the zenith
  glm::dvec3 sky{0, 0, 0};
  glm::dvec3 ground{0, 0, 0};
  double time_s = 0;         // of the middle of the time in which turning blades are seen
  double blades_seen_s = 0;  // that time
};

// A place on the body's surface.
struct SurfacePoint {
  glm::dvec3 p_m;
  glm::dvec3 normal;     // as modelled; any length
  bool is_front = true;  // the triangle's corners run counter-clockwise as the ray sees them
  glm::dvec2 uv;         // OBJ's
  int material = 0;
  glm::dvec3 facet{0, 0, 0};  // unit normal of the triangle, towards where the ray comes from
  bool is_in_shadow = false;  // of the body itself, in the sun
};

// The shading model of assets/shaders/intruder.frag, in doubles: Lambert and Blinn-Phong in linear light; in the sun
// the radiance of a surface by its reflectance (BRDF), which docs/formulas.md describes. Images are
// read by bilinear interpolation of premultiplied linear light at full size; many rays a pixel do the rest.
class Shader {
 public:
  Shader(const Mesh& mesh, const Lighting& lighting);

  // Red, green, blue, opacity: premultiplied, linear. All 0 where light passes as if nothing were there.
  [[nodiscard]] glm::dvec4 shade(const SurfacePoint& point) const;

  // Whether the sun's light is stopped by this place of the surface: not by glass, nor where an image is mostly clear.
  [[nodiscard]] bool stops_sun(int material, const glm::dvec2& uv) const;

 private:
  struct ShadedMaterial {
    glm::dvec3 diffuse;
    glm::dvec3 specular;
    double shininess;
    double opacity;
    cv::Mat texture;  // CV_32FC4, premultiplied, linear; empty: white
    std::optional<Rotor> rotor;
  };

  [[nodiscard]] glm::dvec4 shade(const SurfacePoint& point, const ShadedMaterial& paint) const;
  [[nodiscard]] glm::dvec4 in_sun(const SurfacePoint& point, const ShadedMaterial& paint,
                                  const glm::dvec4& texture) const;

  Lighting lighting_;
  std::vector<ShadedMaterial> materials_;
};

}  // namespace sigs::truth
