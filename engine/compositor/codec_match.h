// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "project/project.h"
#include "video/frame.h"
#include "video/frame_quantisers.h"

namespace sigs {

// The image around the intruders goes once through the compression that the footage has been through, so that their
// edges ring and their finest detail is lost as those of a real aircraft in this footage (compositor/recompression.h).

// The quantisers that a frame's patches are coded with; nothing where the codec keeps every sample.
//   stated     those of the frame, null where its stream states none; then kDefaultQp or kDefaultJpegQuality_percent
//   quantiser  replaces the stated ones: QP of H.264, JPEG's quality in percent, MPEG-4's quantiser (MPEG-2's scale
//              halved) by the codec that is matched. Beyond the codec's range: the end of the range
[[nodiscard]] std::optional<FrameQuantisers> matched_quantisers(CodecMatchChoice codec, std::optional<double> quantiser,
                                                                const FrameQuantisers* stated);

// The codec match of one frame. It is made before anything is composited, as it keeps the footage around the intruders:
// that is what their difference is coded against.
class CodecMatch {
 public:
  //   reaches     where the frame may be rewritten; what is rewritten beside them is not coded
  //   earlier_px  of each reach: where what is in it was in images before, compositor/recompression.h; or empty: the
  //               image is coded as the first one. Of reaches whose macroblocks overlap the largest one's counts
  CodecMatch(const Frame& footage, std::span<const cv::Rect> reaches, FrameQuantisers quantisers,
             std::span<const std::vector<cv::Point2d>> earlier_px = {});

  // Codes what was composited in the macroblocks of the reaches (and of where it was in images before) and in those
  // around them. Without images before, only samples in macroblocks
  // (JPEG, MPEG: blocks of 8x8) in which the frame differs from the footage change, and for H.264 those up to two
  // samples beside. Where the own body hides everything (own_body is 1) samples are those of the footage again,
  // although a camera's codec would let an intruder's edge ring there: no label says that an own body was rewritten.
  // A chroma sample is part of the own body where all pixels are that it belongs to.
  //   mask      CV_8UC1 of the frame's size, or empty: then nothing was composited and nothing is done. At least 1
  //             afterwards at all pixels of samples that are not those of the footage
  //   own_body  CV_32FC1 of the frame's size, or empty
  // Gives back how many luma samples went through the codec.
  std::int64_t apply(Frame& frame, cv::Mat& mask, const cv::Mat& own_body) const;

 private:
  // A rectangle of whole macroblocks, in macroblocks from quantisers_.origin_px on, with the footage in it. Samples
  // beyond the image repeat those at its edge.
  struct Patch {
    cv::Rect blocks;
    Frame footage;
    std::vector<cv::Point2d> earlier_px;
  };

  [[nodiscard]] cv::Rect blocks_around(const cv::Rect& reach) const;
  [[nodiscard]] cv::Rect rect_of(const cv::Rect& blocks, int plane) const;
  [[nodiscard]] Frame cut_out(const Frame& frame, const cv::Rect& blocks) const;
  void put_back(Frame& frame, cv::Mat& mask, const Patch& patch, const Frame& coded, const cv::Mat& own_body) const;

  FrameQuantisers quantisers_;
  PixelLayout layout_ = PixelLayout::yuv420;
  cv::Size size_px_;
  std::vector<Patch> patches_;
};

}  // namespace sigs
