// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs::editor {

// Images as they are kept to be shown. A 4K frame takes longer to convert to BGR than to composite, so a frame of
// footage keeps its own planes, and what is looked at is converted: a part of it, or all of it made smaller.
// Pixel (x, y) is column x of row y, from 0.

// The part of bgr_of(frame), without converting the rest. The part lies within the frame.
[[nodiscard]] cv::Mat bgr_of_part(const Frame& frame, const cv::Rect& part);

// A part with the pixels around it that its chroma depends on, as far as the image has them; begins with a chroma
// sample.
[[nodiscard]] cv::Rect with_chroma_reach(const cv::Rect& part, const cv::Size& image_px);
// The chroma samples that belong to these pixels, which begin with one.
//   step  chroma_step()
[[nodiscard]] cv::Rect in_chroma(const cv::Rect& pixels, const cv::Size& step);

// A copy that is so many times smaller each way: pixel (i, j) is the mean of the block of divisor x divisor pixels that
// begins at (divisor * i, divisor * j), of those that there are at the right and lower edge. The image itself, not
// copied, where divisor < 2.
[[nodiscard]] cv::Mat reduced_copy(const cv::Mat& image, int divisor);
// Its size: rounded up.
[[nodiscard]] cv::Size reduced_size(const cv::Size& image_px, int divisor);

// One image, whose samples never change; copies share them. For any thread.
class ShownImage {
 public:
  ShownImage() = default;
  // CV_8UC1 (grey), CV_8UC3 (BGR) or CV_8UC4 (RGBA, straight).
  ShownImage(cv::Mat pixels);  // NOLINT(google-explicit-constructor): an image is one that can be shown
  explicit ShownImage(std::shared_ptr<const Frame> frame);
  // A part of a frame that is larger, so that chroma at the part's edges is what it is in the whole. The frame's first
  // pixel is one of the image with even coordinates.
  ShownImage(std::shared_ptr<const Frame> frame, const cv::Rect& part);

  [[nodiscard]] bool empty() const { return size_.empty(); }
  [[nodiscard]] cv::Size size() const { return size_; }
  [[nodiscard]] bool is_grey() const { return !frame_ && pixels_.channels() == 1; }

  // Where the samples lie: what the image is known by, as long as a copy of it is kept.
  [[nodiscard]] const unsigned char* samples() const { return frame_ ? frame_->planes[0].data : pixels_.data; }
  [[nodiscard]] std::size_t bytes() const;

  // Its pixels, as it was given; a frame's are those of bgr_of(). The part lies within the image.
  [[nodiscard]] cv::Mat part(const cv::Rect& part) const;
  [[nodiscard]] cv::Mat whole() const { return part({{0, 0}, size_}); }

  // reduced_copy() of the part. A frame's planes are made smaller before they are converted, so that pixels may differ
  // by three codes, and where colours change abruptly, by what chroma that belongs to two blocks brings. Of images of one
  // footage the same blocks give the same pixels.
  [[nodiscard]] cv::Mat reduced(const cv::Rect& part, int divisor) const;

 private:
  cv::Mat pixels_;  // empty where there is a frame
  std::shared_ptr<const Frame> frame_;
  cv::Point at_;  // the frame's pixel that is the image's first
  cv::Size size_;
};

// An image that differs from another one in a part only, as a composited frame does from its footage. Images of one
// footage frame share the large one, so that each more costs its part alone: in time, in memory and on the graphics
// card.
struct PatchedImage {
  ShownImage ground;  // Empty: there is no image.
  // Lies over the ground, as a whole within it, with its first pixel at patch_at; grey where that is. Empty: the
  // ground is the image. What of it is within kPatchMargin_px of an edge of it equals the ground, but for edges that
  // are the ground's too.
  ShownImage patch;
  cv::Point patch_at;

  [[nodiscard]] bool empty() const { return ground.empty(); }
  [[nodiscard]] cv::Size size() const { return ground.size(); }
  [[nodiscard]] cv::Rect patch_rect() const { return {patch_at, patch.size()}; }

  // What is seen in a part, which has to lie within the image. Without a patch there it may be the ground's own.
  [[nodiscard]] cv::Mat part(const cv::Rect& part) const;
  [[nodiscard]] cv::Mat whole() const { return part({{0, 0}, size()}); }
  // One pixel; grey of one channel.
  [[nodiscard]] cv::Vec3b bgr_at(const cv::Point& pixel) const;
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
