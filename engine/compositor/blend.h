// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "base/image.h"
#include "compositor/float_patch.h"
#include "project/project.h"
#include "video/chroma.h"
#include "video/frame.h"

namespace sigs {

// The halved chroma of a part of a frame while pixels in it are rewritten, row by row. Chroma is read between its
// samples at their site, and what a pixel changes goes to the samples that average it there (video/chroma.h). Until
// write() the frame's chroma stays as it is, so the order of the pixels does not matter.
//
// A sample C whose pixels, with weights w and opacities a, read u before and have the chroma p after, becomes
//   sum(w p) + (1 - sum(w a)) (C - sum(w u))
// The second term is the detail that reading between samples loses; it goes with the background. So C keeps its bits
// where no covered pixel has weight in it, and opaque pixels leave nothing of it.
class SubsampledChroma {
 public:
  // part: of the frame's pixels, those that may be rewritten
  SubsampledChroma(const Frame& frame, const cv::Rect& part);

  // To be called before the pixels of row y are read and added: columns begin to end - 1.
  void start_row(int y, int begin, int end);

  // Both chroma codes at a pixel of the row.
  [[nodiscard]] float cb_at(int x) const { return between(read_cb_, x); }
  [[nodiscard]] float cr_at(int x) const { return between(read_cr_, x); }

  // A covered pixel of the row: how much its chroma codes change, and its opacity.
  void add(int x, float cb_change, float cr_change, float opacity) {
    const cv::Vec3f change(cb_change, cr_change, opacity);
    const ChromaShare& share = column_shares_[static_cast<size_t>(x)];
    cv::Vec3f* const at = &row_sums_[static_cast<size_t>(share.first - window_.x)];
    at[0] += share.in_first * change;
    at[1] += share.in_next * change;
  }

  // After the last pixel of the row.
  void finish_row();

  // The samples as they have become, for planes 1 and 2 and each row of them:
  //   out(plane, y, x, code, opacity)  code: not rounded; opacity: sum(w a)
  // Samples in which no covered pixel has weight are left out. The frame's own samples may be overwritten meanwhile.
  template <class Out>
  void write(const Out& out) const;

 private:
  [[nodiscard]] float between(const std::vector<float>& samples, int x) const {
    const ChromaTap& tap = column_taps_[static_cast<size_t>(x)];
    const float first = samples[static_cast<size_t>(tap.first - read_from_)];
    return first + tap.share * (samples[static_cast<size_t>(tap.second - read_from_)] - first);
  }
  template <class Sample>
  void read_row(const cv::Mat& plane, int count, std::vector<float>& samples) const;
  void add_row_sums(int chroma_row, float weight);

  // What reading between samples and averaging again makes of a sample, along one axis: weights of the one before, of
  // itself and of the one after.
  using Averaging = std::array<float, 3>;
  [[nodiscard]] static std::vector<Averaging> averaging(const std::vector<ChromaTap>& taps,
                                                        const std::vector<ChromaShare>& shares, int count);
  // A copy of the window's samples and of one more on each side, as floats; the plane's edges repeated.
  [[nodiscard]] static cv::Mat with_border(const cv::Mat& plane, const cv::Rect& window);

  const Frame& frame_;
  std::vector<ChromaTap> column_taps_;
  std::vector<ChromaTap> row_taps_;
  std::vector<ChromaShare> column_shares_;
  std::vector<ChromaShare> row_shares_;
  cv::Rect window_;                  // of the chroma samples that any pixel of the part has weight in
  cv::Mat sums_;                     // CV_32FC3 over the window: w (p - u) for both codes, w a
  std::vector<cv::Vec3f> row_sums_;  // of one row of pixels, over the window's columns and one more
  int row_ = 0;
  int read_from_ = 0;  // the chroma column that read_cb_ and read_cr_ begin with
  std::vector<float> read_cb_;
  std::vector<float> read_cr_;
};

template <class Out>
void SubsampledChroma::write(const Out& out) const {
  const std::vector<Averaging> across = averaging(column_taps_, column_shares_, frame_.planes[1].cols);
  const std::vector<Averaging> down = averaging(row_taps_, row_shares_, frame_.planes[1].rows);
  std::vector<float> mixed(static_cast<size_t>(window_.width) + 2);  // of three rows, by their weights
  for (int channel = 0; channel < 2; ++channel) {
    const cv::Mat before = with_border(frame_.planes[static_cast<size_t>(channel) + 1], window_);
    for (int y = 0; y < window_.height; ++y) {
      const float* const above = before.ptr<float>(y);
      const float* const here = before.ptr<float>(y + 1);
      const float* const below = before.ptr<float>(y + 2);
      const Averaging& row_weights = down[static_cast<size_t>(window_.y + y)];
      for (size_t i = 0; i < mixed.size(); ++i)
        mixed[i] = row_weights[0] * above[i] + row_weights[1] * here[i] + row_weights[2] * below[i];
      const cv::Vec3f* const sums = sums_.ptr<cv::Vec3f>(y);
      for (int x = 0; x < window_.width; ++x) {
        if (!(sums[x][2] > 0)) continue;
        const Averaging& weights = across[static_cast<size_t>(window_.x + x)];
        const float* const near = &mixed[static_cast<size_t>(x)];
        const float averaged = weights[0] * near[0] + weights[1] * near[1] + weights[2] * near[2];
        const float code = here[x + 1];
        out(channel + 1, window_.y + y, window_.x + x, code + sums[x][channel] + sums[x][2] * (averaged - code),
            sums[x][2]);
      }
    }
  }
}

// The layer's part inside bounds. Shares its samples with the layer.
[[nodiscard]] Layer clipped(const Layer& layer, const cv::Rect& bounds);

// The layer's coverage over another rectangle, 0 beyond its own: CV_32FC1.
[[nodiscard]] cv::Mat coverage_over(const cv::Rect& target, const Layer& layer);

// The layer without what the own body occludes: times (1 - mask).
//   own_body  CV_32FC1 of the whole image, 0..1, or empty: the layer unchanged. The layer lies within the image's rows;
//             columns beyond its sides are those of the other side (part_round)
[[nodiscard]] Layer occluded_by_body(const Layer& layer, const cv::Mat& own_body);

// The layer times (1 - mask), for any mask over the layer's own rectangle: CV_32FC1 of its size, 0..1.
[[nodiscard]] Layer occluded_by(const Layer& layer, const cv::Mat& mask);

// Composites the layer over the frame, in the frame's own planes. Only samples that the layer covers are converted and
// rewritten; every other sample keeps its bits. A luma sample is covered where the opacity of its pixel is above 0, a
// chroma sample where that of any pixel is that it averages at its site (video/chroma.h): for 4:2:0 at the left, three
// columns by two rows. The background's chroma is read between its samples, as it was before.
// Code values are converted to light and back by the footage's transfer function and primaries (video/color_space.h).
// The layer lies within the image. Gives back how many pixels were rewritten.
std::int64_t blend_over(Frame& frame, const Layer& layer, BlendChoice space);

// The same into a copy of the samples around the layer, not rounded (compositor/float_patch.h), for stages that work on
// what the layer changes; of heat not clipped either. The frame stays as it is.
//   margin_px  of the copy beyond the layer, on each side
//   own_body   as for patch_of()
[[nodiscard]] FloatPatch blended_patch(const Frame& frame, const Layer& layer, BlendChoice space, int margin_px,
                                       const cv::Mat& own_body);

// Puts pixels of an 8-bit BGR image into the frame's own planes, in the part of it that rect names. Gives back how
// many were rewritten.
//   bgr     of rect's size
//   weight  CV_32FC1 of rect's size: 0 leaves the pixel's samples as they are, 1 replaces them, between mixes
std::int64_t replace_pixels(Frame& frame, const cv::Rect& rect, const cv::Mat& bgr, const cv::Mat& weight);

// The same over the whole image.
std::int64_t replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight);

}  // namespace sigs
