// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

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

}  // namespace sigs
