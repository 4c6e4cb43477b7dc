// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstddef>
#include <map>
#include <opencv2/core.hpp>

#include "editor/widgets/texture_order.h"

namespace sigs::editor {

enum class Filter { nearest, smooth };

// Images on the graphics card, uploaded when first drawn and dropped when no longer drawn. The window's thread only.
class Textures {
 public:
  Textures() = default;
  ~Textures();
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  // CV_8UC1 (shown grey), CV_8UC3 (BGR) or CV_8UC4 (RGBA, straight). The image's samples must not change any more.
  // divisor  a copy so many times smaller each way, averaged
  [[nodiscard]] ImTextureID of(const cv::Mat& image, Filter filter, int divisor = 1);

  // Once per update, after drawing: what was not drawn for some updates goes, and sooner where all hold more than that.
  void end_update(std::size_t max_bytes);

  // On the graphics card, and the images they were made of: these are kept with them.
  [[nodiscard]] std::size_t bytes() const { return order_.bytes(); }

 private:
  struct Entry {
    cv::Mat image;  // keeps the samples, and so their address, from being used for another one
    unsigned int name = 0;
    Filter filter = Filter::smooth;
  };
  TextureOrder order_;
  std::map<TextureKey, Entry> entries_;
};

// A copy that is so many times smaller each way, of at least one pixel; the image itself at 1.
[[nodiscard]] cv::Mat reduced_copy(const cv::Mat& image, int divisor);

}  // namespace sigs::editor
