// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace sigs::editor {

// A large image that differs from another one in a part only, as a composited frame does from its footage. Images of
// one footage frame share the large one, so that each more costs its part alone: in time, in memory and on the graphics
// card. Pixel (x, y) is column x of row y, from 0.
struct PatchedImage {
  // CV_8UC3 (BGR) or CV_8UC1; never changed. Empty: there is no image.
  cv::Mat ground;
  // Lies over the ground, as a whole within it, with its first pixel at patch_at; of the ground's type. Empty: the
  // ground is the image. What of it is within kPatchMargin_px of an edge of it equals the ground, but for edges that
  // are the ground's too.
  cv::Mat patch;
  cv::Point patch_at;

  [[nodiscard]] bool empty() const { return ground.empty(); }
  [[nodiscard]] cv::Size size() const { return ground.size(); }
  [[nodiscard]] cv::Rect patch_rect() const { return {patch_at, patch.size()}; }

  // One pixel, which has to lie within the image; grey of one channel.
  [[nodiscard]] cv::Vec3b bgr_at(const cv::Point& pixel) const;

  // All of it in one piece: a copy, or the ground itself where there is no patch.
  [[nodiscard]] cv::Mat whole() const;
};

// Wide enough that a patch can be averaged and smoothed together with the ground around it, down to a sixteenth of its
// size each way (drawn_patch).
inline constexpr int kPatchMargin_px = 32;

// How a patch is drawn from a copy `divisor` times smaller each way, so that it looks as if the whole image had been
// reduced: its pixels are averages of the same blocks. Both are pixels of the image, and empty where there is no patch.
struct DrawnPatch {
  // What is reduced: whole blocks of the image, counted from its first pixel; at the image's own edges the rest.
  cv::Rect reduced;
  // What is drawn of it: one block less on each side but at the image's edges, as smoothing looks one block further.
  cv::Rect drawn;
};

// divisor: at least 1. Of one above kPatchMargin_px / 2 blocks with parts of the intruder may be left out, where they
// are narrower than a pixel or two of the screen.
[[nodiscard]] DrawnPatch drawn_patch(const PatchedImage& image, int divisor);

}  // namespace sigs::editor
