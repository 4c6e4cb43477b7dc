// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <utility>

namespace sigs {

struct FrameQuantisers;
class CodedFootage;

// How the samples of an image are stored.
enum class PixelLayout {
  gray,    // plane 0: luma
  yuv420,  // planes Y, Cb, Cr; chroma halved both ways, rounded up
  yuv422,  // chroma halved in x, rounded up
  yuv444,
  rgb,  // planes red, green, blue, full range
};

enum class ColorRange { limited, full };          // luma 16..235 or 0..255, of 10 bits 64..940 or 0..1023
enum class ColorMatrix { bt601, bt709, bt2020 };  // Y'CbCr coefficients; bt2020 is the non-constant-luminance one

// Where the chroma samples lie among the luma samples (H.273, chroma sample location type).
enum class ChromaSite {
  left,      // 4:2:0: on every other column, midway between two rows; 4:2:2: on every other column
  center,    // 4:2:0: midway between two columns and two rows; 4:2:2: midway between two columns
  top_left,  // 4:2:0: on every other column and row; 4:2:2: as left
};

// The meaning of the samples. It is passed from the footage to the output unchanged.
struct ColorInfo {
  ColorRange range = ColorRange::limited;
  ColorMatrix matrix = ColorMatrix::bt709;
  ChromaSite chroma_site = ChromaSite::left;
  int primaries = 2;  // ISO/IEC 23091-2 code points, 2: unspecified
  int transfer = 2;
  bool matrix_stated = false;  // false: the file does not state it; the matrix above is assumed from the image's height
  int unknown_matrix = 2;      // the code point of one that the file states and this program does not know; 2: none
  bool range_stated = false;   // false: the file does not state it; the range above is assumed

  [[nodiscard]] bool operator==(const ColorInfo&) const = default;
};

[[nodiscard]] constexpr int plane_count(PixelLayout layout) {
  return layout == PixelLayout::gray ? 1 : 3;
}

// One image of the footage in its own planes. Unused planes are empty.
//   bit_depth  of the samples, 8 to 16 (usual are 8, 10, 12 and 16). Of 8 bits planes are CV_8UC1; else CV_16UC1 with
//              codes from 0 to 2^bit_depth - 1
struct Frame {
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;
  ColorInfo color;
  std::array<cv::Mat, 3> planes{};
  double time_s = 0;     // presentation time, 0 at the footage's first frame
  bool damaged = false;  // the footage's own frame is damaged; the samples are of an intact one nearby
  // How coarsely the codec has quantised it (video/frame_quantisers.h); null where the source was not asked for it or
  // the stream does not state it. Copies of the frame share it.
  std::shared_ptr<const FrameQuantisers> quantisers{};
  // What encoders have made of the footage's own samples (video/shared_footage.h), so that others need not code again
  // what is unchanged; null where the footage has one reader. Copies of the frame share it.
  std::shared_ptr<CodedFootage> coded{};

  [[nodiscard]] cv::Size size_px() const { return planes[0].size(); }
  [[nodiscard]] int plane_count() const { return sigs::plane_count(layout); }
};

// A deep copy: copies of a cv::Mat share their samples, those of this frame are its own.
[[nodiscard]] Frame cloned(const Frame& frame);

// Part of a frame, with samples of its own. The part lies within the frame, and its corner on a chroma sample (see
// chroma_step()).
[[nodiscard]] Frame part_of(const Frame& frame, const cv::Rect& part);

// A frame whose samples are all 0.
[[nodiscard]] Frame blank_frame(PixelLayout layout, cv::Size size_px, const ColorInfo& color, int bit_depth = 8);

// How many luma samples one chroma sample spans, in x and y: {2, 2} for yuv420, {1, 1} for layouts without subsampling.
[[nodiscard]] cv::Size chroma_step(PixelLayout layout);

// The linear map between code values (planes 0, 1, 2) and R'G'B' in 0..1:
//   rgb = to_rgb * (code - offset), code = from_rgb * rgb + offset
// For gray only luma is used (R' = G' = B'); for rgb the map is a division by the highest code. Equations of H.273,
// section 8.3.
struct CodeToRgb {
  cv::Matx33f to_rgb;
  cv::Matx33f from_rgb;
  cv::Vec3f offset;
};
[[nodiscard]] CodeToRgb code_to_rgb(PixelLayout layout, const ColorInfo& color, int bit_depth = 8);

// A whole image as 8-bit BGR (CV_8UC3, OpenCV's order), chroma interpolated bilinearly from its site, whatever the
// frame's depth. For display, for PNG files and for the classic method; the direct method never converts a whole image.
// The frame must not be empty.
[[nodiscard]] cv::Mat bgr_of(const Frame& frame);

// The same in 16 bits: CV_16UC3, 65535 is white. For frames of more than 8 bits.
[[nodiscard]] cv::Mat bgr16_of(const Frame& frame);

// The reverse: a BGR image of 8 (CV_8UC3) or 16 bits (CV_16UC3) as a frame, chroma averaged at its site
// (shrunk_chroma), codes rounded.
[[nodiscard]] Frame frame_of_bgr(const cv::Mat& bgr, PixelLayout layout, const ColorInfo& color, int bit_depth = 8);

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
