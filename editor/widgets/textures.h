// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <compare>
#include <cstddef>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

namespace sigs::editor {

// An image by the address of its samples, so many times smaller.
struct TextureKey {
  const unsigned char* samples = nullptr;
  int divisor = 1;

  [[nodiscard]] auto operator<=>(const TextureKey&) const = default;
};

// Which textures are kept, and which goes first: what was not drawn for longest. What was drawn in this update never
// goes. Knows nothing of OpenGL.
class TextureOrder {
 public:
  void use(TextureKey key, std::size_t bytes);

  // Names those that must go: what was not drawn for 30 updates and, while all hold more than that, what was not drawn
  // in this one.
  [[nodiscard]] std::vector<TextureKey> end_update(std::size_t max_bytes);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Use {
    std::size_t bytes = 0;
    long update = 0;  // that it was drawn in last
  };
  std::map<TextureKey, Use> uses_;
  std::size_t bytes_ = 0;
  long update_ = 0;
};

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
