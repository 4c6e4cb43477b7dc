// SPDX-License-Identifier: MIT
#include "editor/widgets/texture_order.h"

#include <algorithm>

namespace sigs::editor {

namespace {

constexpr long kTurnsKept = 30;

}  // namespace

void TextureOrder::use(TextureKey key, std::size_t bytes) {
  Use& use = uses_[key];
  bytes_ += bytes - use.bytes;
  use = {.bytes = bytes, .turn = turn_};
}

std::vector<TextureKey> TextureOrder::end_turn(std::size_t most_bytes) {
  std::vector<TextureKey> gone;
  while (!uses_.empty()) {
    const auto oldest = std::min_element(uses_.begin(), uses_.end(),
                                         [](const auto& a, const auto& b) { return a.second.turn < b.second.turn; });
    const long unused_turns = turn_ - oldest->second.turn;
    if (unused_turns == 0 || (unused_turns < kTurnsKept && bytes_ <= most_bytes)) break;
    bytes_ -= oldest->second.bytes;
    gone.push_back(oldest->first);
    uses_.erase(oldest);
  }
  ++turn_;
  return gone;
}

}  // namespace sigs::editor
