// SPDX-License-Identifier: MIT
#include "editor/widgets/texture_order.h"

#include <algorithm>

namespace sigs::editor {

namespace {

constexpr long kUpdatesKept = 30;

}  // namespace

void TextureOrder::use(TextureKey key, std::size_t bytes) {
  Use& use = uses_[key];
  bytes_ += bytes - use.bytes;
  use = {.bytes = bytes, .update = update_};
}

std::vector<TextureKey> TextureOrder::end_update(std::size_t max_bytes) {
  std::vector<TextureKey> gone;
  while (!uses_.empty()) {
    const auto oldest = std::min_element(
        uses_.begin(), uses_.end(), [](const auto& a, const auto& b) { return a.second.update < b.second.update; });
    const long unused_updates = update_ - oldest->second.update;
    if (unused_updates == 0 || (unused_updates < kUpdatesKept && bytes_ <= max_bytes)) break;
    bytes_ -= oldest->second.bytes;
    gone.push_back(oldest->first);
    uses_.erase(oldest);
  }
  ++update_;
  return gone;
}

}  // namespace sigs::editor
