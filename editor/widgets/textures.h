// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "editor/geometry/shown_image.h"

namespace sigs::editor {

// What a texture is known by: the address of an image's samples, how many times smaller it is, and which part of the
// image. Valid as long as the image is kept, which Textures does.
struct TextureKey {
  const unsigned char* samples = nullptr;
  int divisor = 1;
  std::array<int, 4> part{};  // x, y, width, height

  [[nodiscard]] auto operator<=>(const TextureKey&) const = default;
};

// Which textures are kept, and which goes first: what was not drawn for longest. What was drawn in this update never
// goes. Knows nothing of OpenGL, so that it can be tested without it.
class TextureOrder {
 public:
  // The texture is drawn in this update; it counts that many bytes from now on.
  void use(TextureKey key, std::size_t bytes);

  // Ends the update and names those that must go; they are removed already. They are what was not drawn for 30 updates
  // and, while all hold more than max_bytes, what was not drawn in this one, oldest first.
  [[nodiscard]] std::vector<TextureKey> end_update(std::size_t max_bytes);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Use {
    std::size_t bytes = 0;
    long update = 0;  // in which it was drawn last
  };
  std::map<TextureKey, Use> uses_;
  std::size_t bytes_ = 0;
  long update_ = 0;
};

// How a texture is enlarged: with sharp pixels, or smoothly.
enum class Filter { nearest, smooth };

// Images on the graphics card, uploaded when first drawn and dropped when no longer drawn. The window's thread only,
// with its OpenGL context current, in the destructor too.
class Textures {
 public:
  Textures() = default;
  ~Textures();
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  // The texture of an image, valid until the end of this update. The image is not empty, is known by the address of its
  // samples, and is kept with its texture.
  [[nodiscard]] ImTextureID of(const ShownImage& image, Filter filter) {
    return of(image, {{0, 0}, image.size()}, filter, 1);
  }
  // That of a part of it (not empty, within the image).
  //   divisor  a copy so many times smaller each way, averaged; 1: the image itself
  [[nodiscard]] ImTextureID of(const ShownImage& image, const cv::Rect& part, Filter filter, int divisor);

  // Once per update, after drawing: what was not drawn for 30 updates goes, and sooner where all hold more than
  // max_bytes.
  void end_update(std::size_t max_bytes);

  // Of the textures and of the images they were made of, which are kept with them.
  [[nodiscard]] std::size_t bytes() const { return order_.bytes(); }

 private:
  struct Entry {
    ShownImage image;  // keeps the samples, and so their address, from being used for another one
    // OpenGL's.
    unsigned int name = 0;
    Filter filter = Filter::smooth;
  };
  TextureOrder order_;
  std::map<TextureKey, Entry> entries_;
};

// What was drawn there so far becomes twice as bright, so many times; what is drawn later does not.
void draw_brighter(ImDrawList& draw, const ImVec2& low, const ImVec2& high, int doublings);

}  // namespace sigs::editor
