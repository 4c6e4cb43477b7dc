// SPDX-License-Identifier: MIT
#include "editor/widgets/textures.h"

#include <doctest/doctest.h>

#include <array>

using namespace sigs::editor;

namespace {

const std::array<unsigned char, 1000> kSamples{};

TextureKey key(std::size_t i, int divisor = 1) {
  return {&kSamples[i], divisor};
}

}  // namespace

TEST_CASE("textures of footage that plays stay below their limit") {
  TextureOrder order;
  for (std::size_t frame = 0; frame < kSamples.size(); ++frame) {
    order.use(key(frame), 100);
    (void)order.end_update(500);
    CHECK(order.bytes() <= 500);
    CHECK(order.bytes() == 100 * std::min<std::size_t>(frame + 1, 5));
  }
}

TEST_CASE("a drawn texture is never evicted and the one drawn last is evicted last") {
  TextureOrder order;
  for (std::size_t i = 0; i < 4; ++i) {
    order.use(key(i), 100);
    CHECK(order.end_update(400).empty());
  }
  order.use(key(0), 100);
  CHECK(order.end_update(250) == std::vector<TextureKey>{key(1), key(2)});
  order.use(key(7), 300);
  CHECK(order.end_update(0) == std::vector<TextureKey>{key(3), key(0)});
  CHECK(order.bytes() == 300);
  CHECK(order.end_update(0) == std::vector<TextureKey>{key(7)});
  CHECK(order.bytes() == 0);
}

TEST_CASE("an image and its smaller copy are two textures and a texture drawn twice in an update counts once") {
  TextureOrder order;
  order.use(key(1), 100);
  order.use(key(1), 100);
  order.use(key(1, 3), 11);
  CHECK(order.bytes() == 111);
}

TEST_CASE("a texture no longer drawn is evicted after a while, even below the limit") {
  TextureOrder order;
  order.use(key(1), 100);
  for (int turn = 0; turn < 30; ++turn) CHECK(order.end_update(1000).empty());
  CHECK(order.end_update(1000).size() == 1);
}
