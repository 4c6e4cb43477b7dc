// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <utility>

#include "video/frame.h"

namespace sigs {

// How many bits the samples of a frame have, 8 to 16, and what follows from that.

// The highest code value: 255 for 8 bits, 1023 for 10.
[[nodiscard]] constexpr int max_code(int bit_depth) {
  return (1 << bit_depth) - 1;
}

// How many codes of this depth one step of 8 bits is, in limited range: 1 for 8 bits, 4 for 10 (H.273, equations 20 to
// 25).
[[nodiscard]] constexpr int codes_per_8_bit_step(int bit_depth) {
  return 1 << (bit_depth - 8);
}

// OpenCV's type of a plane: CV_8UC1 for 8 bits, else CV_16UC1.
[[nodiscard]] constexpr int plane_type(int bit_depth) {
  return bit_depth > 8 ? CV_16UC1 : CV_8UC1;
}

// Calls work with a sample (0) of the type that planes of this depth have, uchar or ushort, and gives back its result:
//   with_sample_type(frame.bit_depth, [&](auto sample) { using Sample = decltype(sample); ... });
template <class Work>
decltype(auto) with_sample_type(int bit_depth, Work&& work) {
  if (bit_depth > 8) return std::forward<Work>(work)(ushort{0});
  return std::forward<Work>(work)(uchar{0});
}

// The sample at a place of a plane.
[[nodiscard]] inline int sample_at(const cv::Mat& plane, int y, int x) {
  return plane.depth() == CV_8U ? int{plane.at<uchar>(y, x)} : int{plane.at<ushort>(y, x)};
}

// The frame with another depth, each sample rounded to the nearest code of the same meaning. Limited range: codes times
// a power of two. Full range and RGB: 0 to the highest code, chroma about its own middle. A frame that has the depth
// already is returned with its samples shared. For what reads 8 bits (measurements of the footage, trackers), and for
// codecs that do not have the footage's depth.
[[nodiscard]] Frame with_bit_depth(const Frame& frame, int bit_depth);

}  // namespace sigs
