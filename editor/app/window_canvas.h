// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>
#include <optional>

#include "editor/app/changed_regions.h"

namespace sigs::editor {

// The image of the window, kept in a framebuffer from update to update, upside down as windows have it: so a driver
// that draws in software copies it by rows, not by drawing it. Changed regions are drawn into it, then it is copied to
// the window. Needs a current OpenGL context in every call, the destructor included.
class Canvas {
 public:
  Canvas() = default;
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Draws the regions that differ from the update before and copies all to the window's back buffer; the caller swaps.
  // Leaves the data upside down.
  // Size in pixels of the framebuffer; another one than before has everything drawn. False: nothing differs, or the
  // size is 0, and the window was not touched.
  //   first  as for ChangedRegions: what changes elsewhere may be drawn by a later call
  bool draw(ImDrawData& data, int width_px, int height_px, const std::optional<ImVec2>& first = std::nullopt);

  // Has the next call draw everything (after other fonts, or when the window was hidden).
  void forget() { changed_.forget(); }

 private:
  // Makes the framebuffer anew in this size.
  void make(int width_px, int height_px);
  // Both are upside down.
  void draw_region(ImDrawData& data, const ImVec4& region) const;

  ChangedRegions changed_;
  // OpenGL's names of the framebuffer and its texture; 0: not made yet.
  unsigned int framebuffer_ = 0;
  unsigned int color_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace sigs::editor
