// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

namespace sigs::editor {

// Which parts of the window look different from the update before. ImGui draws everything anew each update; what draws
// in software would spend most of its time on pixels that stay as they are.
class ChangedRegions {
 public:
  // Rectangles (left, top, right, bottom, in ImGui's coordinates) that hold every pixel that may differ from what the
  // call before was given; none: nothing does. At most three, which do not overlap.
  [[nodiscard]] std::vector<ImVec4> of(const ImDrawData& data);

  // The next call finds everything changed.
  void forget() { panels_.clear(); }

 private:
  // What ImGui draws with one image and within one rectangle.
  struct Piece {
    std::uint64_t fingerprint = 0;
    ImVec4 bounds{0, 0, 0, 0};  // of the pixels that it may touch
  };
  // What it draws for one of its windows.
  struct Panel {
    const void* list = nullptr;
    std::vector<Piece> pieces;
  };
  [[nodiscard]] static Piece piece_of(const ImDrawList& list, const ImDrawCmd& command);
  [[nodiscard]] static Panel panel_of(const ImDrawList& list);
  static void add_changes(const Panel& before, const Panel& after, std::vector<ImVec4>& regions);

  std::vector<Panel> panels_;
  ImVec2 size_{0, 0};
};

// The common part; its right edge is left of its left one where there is none.
[[nodiscard]] ImVec4 common_part(const ImVec4& a, const ImVec4& b);

}  // namespace sigs::editor
