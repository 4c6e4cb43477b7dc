// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <map>
#include <opencv2/core.hpp>

namespace sigs::editor {

enum class Filter { nearest, smooth };

// Pictures on the graphics card, uploaded when first drawn and dropped when no longer drawn. The window's thread only.
class Textures {
 public:
  Textures() = default;
  ~Textures();
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  // CV_8UC1 (shown grey), CV_8UC3 (BGR) or CV_8UC4 (RGBA, straight). The picture's samples must not change any more.
  [[nodiscard]] ImTextureID of(const cv::Mat& picture, Filter filter);

  // Once a turn, after drawing: what was not drawn for some turns goes.
  void end_turn();

 private:
  struct Entry {
    cv::Mat picture;  // keeps the samples, and so their address, from being used for another one
    unsigned int name = 0;
    Filter filter = Filter::smooth;
    int unused_turns = 0;
  };
  std::map<const unsigned char*, Entry> entries_;
};

}  // namespace sigs::editor
