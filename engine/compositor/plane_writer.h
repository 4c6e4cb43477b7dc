// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "video/frame.h"

namespace sigs {

// Reads and rewrites single pixels of a frame as R'G'B'. A picture with halved chroma is rewritten block by block: the
// luma of each pixel is set, and the block's chroma sample moves by the mean of what its pixels' chroma moves by, so a
// pixel that is not set pulls it nowhere.
class PixelBlocks {
 public:
  explicit PixelBlocks(Frame& frame)
      : frame_(frame), map_(code_to_rgb(frame.layout, frame.color)), step_(chroma_step(frame.layout)) {}

  // Visits every block that meets rect, and in it every pixel (x, y) of rect for which changed(x, y) holds.
  // new_rgb(x, y, old_rgb) gives the pixel's colour as R'G'B' in 0..1; values beyond are clipped by the planes.
  template <class Changed, class NewRgb>
  void rewrite(const cv::Rect& rect, const Changed& changed, const NewRgb& new_rgb) {
    const int first_row = rect.y / step_.height;
    const int first_column = rect.x / step_.width;
    for (int row = first_row; row * step_.height < rect.y + rect.height; ++row)
      for (int column = first_column; column * step_.width < rect.x + rect.width; ++column)
        rewrite_block(row, column, rect, changed, new_rgb);
  }

 private:
  template <class Changed, class NewRgb>
  void rewrite_block(int row, int column, const cv::Rect& rect, const Changed& changed, const NewRgb& new_rgb) {
    const cv::Rect block =
        cv::Rect({column * step_.width, row * step_.height}, step_) & cv::Rect({0, 0}, frame_.size_px());
    const cv::Rect inside = block & rect;
    cv::Vec3f moved{0, 0, 0};
    bool any = false;
    const cv::Vec3f chroma = chroma_code(row, column);
    for (int y = inside.y; y < inside.y + inside.height; ++y)
      for (int x = inside.x; x < inside.x + inside.width; ++x) {
        if (!changed(x, y)) continue;
        const cv::Vec3f old_code(frame_.planes[0].at<uchar>(y, x), chroma[1], chroma[2]);
        const cv::Vec3f code = map_.from_rgb * new_rgb(x, y, rgb_of(old_code)) + map_.offset;
        frame_.planes[0].at<uchar>(y, x) = clipped(code[0]);
        moved += code - old_code;
        any = true;
      }
    if (!any || frame_.plane_count() == 1) return;
    const auto share = 1.0F / static_cast<float>(block.area());
    frame_.planes[1].at<uchar>(row, column) = clipped(chroma[1] + moved[1] * share);
    frame_.planes[2].at<uchar>(row, column) = clipped(chroma[2] + moved[2] * share);
  }

  [[nodiscard]] cv::Vec3f rgb_of(const cv::Vec3f& code) const { return map_.to_rgb * (code - map_.offset); }

  [[nodiscard]] cv::Vec3f chroma_code(int row, int column) const {
    if (frame_.plane_count() == 1) return map_.offset;
    return {0, static_cast<float>(frame_.planes[1].at<uchar>(row, column)),
            static_cast<float>(frame_.planes[2].at<uchar>(row, column))};
  }

  [[nodiscard]] static uchar clipped(float code) {
    return static_cast<uchar>(std::lround(std::clamp(code, 0.0F, 255.0F)));
  }

  Frame& frame_;
  CodeToRgb map_;
  cv::Size step_;
};

}  // namespace sigs
