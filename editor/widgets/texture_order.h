// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <map>
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

}  // namespace sigs::editor
