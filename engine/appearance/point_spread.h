// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "appearance/edge_fit.h"
#include "appearance/estimate.h"
#include "appearance/panel.h"
#include "video/frame.h"

namespace sigs {

// What is taken where the footage does not tell: the widths of real aircraft's edges in 112 clips were those of a sigma
// of 0.45 px in all of them, at every range. Chroma is spread over 0.9 of its samples before
// the codec, which spreads it further: so inserted aircraft are like the real ones in the tuning clips of
// bench/realism.
inline constexpr double kDefaultPointSpread_px = 0.45;
inline constexpr double kDefaultChromaBlur_px = 0.9;
// Of JPEG images, which no other compression has gone before: a sensor sees red and blue in every second row and
// column; read between linearly, these spread with a standard deviation of 2 px / sqrt(6), which is 0.4 samples of
// 4:2:0.
inline constexpr double kDefaultJpegChromaBlur_px = 0.4;
inline constexpr double kDefaultSharpening = 0.4;
inline constexpr double kDefaultSharpening_px = 0.8;

struct PointSpreadFound {
  Estimate sigma_px;  // settings appearance.psf_sigma_px, .sharpening, .sharpening_px, .chroma_blur_px
  Estimate sharpening;
  Estimate sharpening_px;
  Estimate chroma_blur_px;  // samples of the chroma planes
  int edges_found = 0;
  int edges_used = 0;  // the sharpest, on which the shape was fitted
  std::vector<Panel> panels;
};

// The sharpness of footage, of its luma and chroma, by straight edges in its frames.
//
// Edges in nature are seldom perfect, and none is sharper than the camera shows it. So each edge gets its own sigma,
// and the sharp end of these counts: their 10 % quantile, raised by what the error of a single edge lowers it. The
// edges that agree with that are fitted together, which gives sigma and sharpening.
class PointSpread {
 public:
  // Frames of one clip in order, all of the same layout and colours.
  //   own_body  CV_8UC1 of the frame's size, above 127: hidden, and no edge there counts; empty: nothing is
  void add(const Frame& frame, const cv::Mat& own_body = {});
  [[nodiscard]] PointSpreadFound finish() const;

 private:
  struct Edge {
    EdgeLine line;
    int times_seen = 1;  // at the same place
    EdgeSample luma;
    std::vector<EdgeSample> chroma;  // of the planes that show the edge
  };
  struct SharpEnd;
  [[nodiscard]] bool is_seen_again(const EdgeLine& line);
  [[nodiscard]] std::vector<const Edge*> counted_edges() const;
  [[nodiscard]] SharpEnd sharp_end() const;
  void find_luma(PointSpreadFound& found, const SharpEnd& end) const;
  void find_chroma(PointSpreadFound& found, const SharpEnd& end) const;
  [[nodiscard]] static bool is_one_direction(const SharpEnd& end);
  [[nodiscard]] std::string why_not(const SharpEnd& end) const;

  std::vector<Edge> edges_;
  int frames_ = 0;
  int jpeg_frames_ = 0;  // whose stream says that they are JPEG images
  PixelLayout layout_ = PixelLayout::gray;
};

}  // namespace sigs
