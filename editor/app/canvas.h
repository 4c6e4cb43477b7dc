// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include "editor/app/changed_regions.h"

namespace sigs::editor {

// The window's image, kept from update to update; what changed is drawn into it, then it is copied to the window.
class Canvas {
 public:
  Canvas() = default;
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Draws what differs from the update before. False: nothing does, and the window was left as it is.
  bool draw(ImDrawData& data, int width_px, int height_px);

  // Everything is drawn anew the next time (other fonts, a window that was hidden).
  void forget() { changed_.forget(); }

 private:
  void make(int width_px, int height_px);
  void draw_region(ImDrawData& data, const ImVec4& region) const;

  ChangedRegions changed_;
  unsigned int framebuffer_ = 0;
  unsigned int color_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace sigs::editor
