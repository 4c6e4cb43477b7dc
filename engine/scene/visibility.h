// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sigs {

// In how many frames an intruder is visible, and how large it is there. Counted from the truth of an export
// or estimated without drawing (outlook.h).
struct Visibility {
  int frames = 0;          // of the footage
  int frames_checked = 0;  // of these; the numbers below count them alone
  int visible = 0;         // some of it lies in the image, not all of that behind the own body
  int behind_camera = 0;   // all of it
  int occluded = 0;        // in the image, behind the own body
  double smallest_px = 0;  // longer side of the whole silhouette where it is visible, the image's edge left aside
  double largest_px = 0;
  bool is_estimate = false;

  // One more frame in which it is visible. size_px <= 0: not known.
  void count_visible(double size_px);
};

// "visible in 112 of 200 frames, 8 to 61 px"; "visible in about 112 of 200 frames, ..." of an estimate; "visible in
// about 11 of 20 frames looked at (of 5000), ..."; "never visible in 200 frames".
[[nodiscard]] std::string text_of(const Visibility& visibility);

}  // namespace sigs
