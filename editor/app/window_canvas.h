// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sigs::editor {

// Finds the parts of the window that look different from the update before. ImGui issues all draw commands in each
// update; with OpenGL in software most of the time would be spent on pixels that do not change. Triangles are compared
// by digests of their vertices, so a texture whose content changes has to be another texture (Textures sees to that).
class ChangedRegions {
 public:
  // Rectangles (left, top, right, bottom, in ImGui's coordinates) that together contain every pixel that may differ
  // from the data of the call before; none: nothing differs. At most three, which do not overlap.
  //   first  places in those coordinates, or none. Changes of the panels that lie elsewhere then wait, unless they
  //          touch a rectangle that is returned: a later call returns them, at the latest one without places.
  [[nodiscard]] std::vector<ImVec4> of(const ImDrawData& data, std::span<const ImVec2> first = {});

  // The next call returns the whole window.
  void forget() { panels_.clear(); }

 private:
  struct Triangle {
    std::uint64_t fingerprint = 0;  // of its vertices
    ImVec4 bounds{0, 0, 0, 0};      // of the pixels that it may touch
  };
  // One draw command: one texture, one clip rectangle.
  struct Piece {
    std::uint64_t surface = 0;      // digest of both
    std::uint64_t fingerprint = 0;  // of all of it
    std::vector<Triangle> triangles;
  };
  // The draw commands of one ImGui window.
  struct Panel {
    const void* list = nullptr;  // address of ImGui's draw list; only compared
    std::vector<Piece> pieces;
  };
  // What ImGui draws, as far as it is compared.
  [[nodiscard]] static Piece piece_of(const ImDrawList& list, const ImDrawCmd& command);
  [[nodiscard]] static Panel panel_of(const ImDrawList& list);
  // Adds where the triangles lie that only one of both has. All of them, where those of both are in another order.
  static void add_changes(const Piece& before, const Piece& after, std::vector<ImVec4>& regions);
  // Where a panel differs; none where it does not.
  [[nodiscard]] static std::vector<ImVec4> changed(const Panel& before, const Panel& after);
  [[nodiscard]] static bool lies_at(const Panel& panel, std::span<const ImVec2> places);
  // Those of all panels, as of() returns them. What waits is put back into `panels` as it was drawn last.
  [[nodiscard]] std::vector<ImVec4> changes(std::vector<Panel>& panels, std::span<const ImVec2> first);

  // Of the call before, and the window's size then. Empty: the next call returns the whole window.
  std::vector<Panel> panels_;
  ImVec2 size_{0, 0};
};

// Intersection of two rectangles; where they have none, its right edge lies left of its left one, or its bottom above
// its top.
[[nodiscard]] ImVec4 common_part(const ImVec4& a, const ImVec4& b);

// The image of the window. Where OpenGL draws on the processor, regions that changed are drawn into the window's back
// buffer, which keeps the rest, and only they are shown; a graphics card draws all of it. Needs the window's OpenGL
// context in every call.
class Canvas {
 public:
  // Draws and shows what differs from the update before.
  // Another size than before has everything drawn. Returns whether the caller has to swap buffers: not where nothing
  // differs, the size is 0, or what was drawn is shown already. What cannot be shown, as the window has got another
  // size meanwhile, the next call draws again.
  //   first  as for ChangedRegions: what changes elsewhere may be drawn by a later call
  bool draw(ImDrawData& data, std::span<const ImVec2> first = {});

  // Has the next call draw everything (after other fonts, or when the window was hidden).
  void forget() { changed_.forget(); }

 private:
  ChangedRegions changed_;
  std::optional<bool> shows_parts_;  // none: not known yet
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace sigs::editor
