// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sigs {

// What composing one frame took, counted where it is done. The same on every machine, unlike seconds.
struct OpCounts {
  std::int64_t lens_evaluations = 0;  // directions to pixels and pixels to directions through the lens' own formulas
  std::int64_t pixels_drawn = 0;      // of the views given to OpenGL
  std::int64_t triangles_drawn = 0;
  std::int64_t bytes_uploaded = 0;    // meshes and textures
  std::int64_t pixels_warped = 0;     // of layers sampled through the lens
  std::int64_t pixels_blurred = 0;    // of layers; for the classic method of the whole images as well
  std::int64_t pixels_blended = 0;    // rewritten in the image
  std::int64_t pixels_converted = 0;  // of whole images between code values and BGR

  [[nodiscard]] bool operator==(const OpCounts&) const = default;

  OpCounts& operator+=(const OpCounts& more) {
    lens_evaluations += more.lens_evaluations;
    pixels_drawn += more.pixels_drawn;
    triangles_drawn += more.triangles_drawn;
    bytes_uploaded += more.bytes_uploaded;
    pixels_warped += more.pixels_warped;
    pixels_blurred += more.pixels_blurred;
    pixels_blended += more.pixels_blended;
    pixels_converted += more.pixels_converted;
    return *this;
  }
};

}  // namespace sigs
