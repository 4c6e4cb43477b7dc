// SPDX-License-Identifier: MIT
#include "scene/visibility.h"

#include <algorithm>
#include <cstdio>

namespace sigs {

namespace {

std::string pixels_text(double size_px) {
  char text[32];
  std::snprintf(text, sizeof text, size_px < 9.95 ? "%.1f" : "%.0f", size_px);
  const std::string shown = text;
  return shown.ends_with(".0") ? shown.substr(0, shown.size() - 2) : shown;
}

std::string frames_text(const Visibility& visibility) {
  const std::string frames_checked =
      std::to_string(visibility.frames_checked) + (visibility.frames_checked == 1 ? " frame" : " frames");
  if (visibility.frames_checked >= visibility.frames) return frames_checked;
  return frames_checked + " looked at (of " + std::to_string(visibility.frames) + ")";
}

std::string size_text(const Visibility& visibility) {
  if (visibility.largest_px <= 0) return "";
  const std::string low = pixels_text(visibility.smallest_px);
  const std::string high = pixels_text(visibility.largest_px);
  return ", " + (low == high ? low : low + " to " + high) + " px";
}

}  // namespace

void Visibility::count_visible(double size_px) {
  ++visible;
  if (size_px <= 0) return;
  smallest_px = largest_px > 0 ? std::min(smallest_px, size_px) : size_px;
  largest_px = std::max(largest_px, size_px);
}

std::string text_of(const Visibility& visibility) {
  if (visibility.visible == 0) return "never visible in " + frames_text(visibility);
  return std::string("visible in ") + (visibility.is_estimate ? "about " : "") + std::to_string(visibility.visible) +
         " of " + frames_text(visibility) + size_text(visibility);
}

}  // namespace sigs
