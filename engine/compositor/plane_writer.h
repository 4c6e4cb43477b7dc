// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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

  // Rewrites the pixels (x, y) of rect that are to change; gives back how many. For each row y of rect, pixels.row(y)
  // gives an object with
  //   bool changes(int x)                          whether the pixel is rewritten
  //   cv::Vec3f over(int x, const cv::Vec3f& rgb)  its colour where rgb was: R'G'B' in 0..1; beyond, the planes clip
  template <class Pixels>
  std::int64_t rewrite(const cv::Rect& rect, const Pixels& pixels) {
    std::int64_t count = 0;
    const int first = rect.y / step_.height;
    for (int block_y = first; block_y * step_.height < rect.br().y; ++block_y) {
      const int begin = std::max(block_y * step_.height, rect.y);
      const int end = std::min((block_y + 1) * step_.height, rect.br().y);
      if (end - begin == 1)
        count += rewrite_row(block_y, begin, rect, std::array{pixels.row(begin)});
      else
        count += rewrite_row(block_y, begin, rect, std::array{pixels.row(begin), pixels.row(begin + 1)});
    }
    return count;
  }

 private:
  // One row of blocks, as far as their pixels lie in rect: a luma row from y on for each of `rows`.
  template <class Row, std::size_t count>
  std::int64_t rewrite_row(int block_y, int y, const cv::Rect& rect, const std::array<Row, count>& rows) {
    std::array<uchar*, count> luma;
    for (std::size_t j = 0; j < count; ++j) luma[j] = frame_.planes[0].ptr<uchar>(y + static_cast<int>(j));
    std::int64_t changed = 0;
    const int first = rect.x / step_.width;
    for (int block_x = first; block_x * step_.width < rect.br().x; ++block_x) {
      const int begin = std::max(block_x * step_.width, rect.x);
      const int end = std::min((block_x + 1) * step_.width, rect.br().x);
      changed += rewrite_block({block_x, block_y}, begin, end, rows, luma);
    }
    return changed;
  }

  template <class Row, std::size_t count>
  int rewrite_block(const cv::Point& block, int begin, int end, const std::array<Row, count>& rows,
                    const std::array<uchar*, count>& luma) {
    const auto is_still = [&](const Row& row) {
      for (int x = begin; x < end; ++x)
        if (row.changes(x)) return false;
      return true;
    };
    if (std::all_of(rows.begin(), rows.end(), is_still)) return 0;
    const cv::Vec3f chroma = chroma_code(block);
    cv::Vec3f moved{0, 0, 0};
    int changed = 0;
    for (std::size_t j = 0; j < count; ++j)
      for (int x = begin; x < end; ++x) {
        if (!rows[j].changes(x)) continue;
        const cv::Vec3f old_code(luma[j][x], chroma[1], chroma[2]);
        const cv::Vec3f code = map_.from_rgb * rows[j].over(x, rgb_of(old_code)) + map_.offset;
        luma[j][x] = clipped(code[0]);
        moved += code - old_code;
        ++changed;
      }
    move_chroma(block, chroma, moved);
    return changed;
  }

  void move_chroma(const cv::Point& block, const cv::Vec3f& chroma, const cv::Vec3f& moved) {
    if (frame_.plane_count() == 1) return;
    const cv::Size size = frame_.size_px();
    const int wide = std::min(step_.width, size.width - block.x * step_.width);
    const int high = std::min(step_.height, size.height - block.y * step_.height);
    const auto share = 1.0F / static_cast<float>(wide * high);
    frame_.planes[1].at<uchar>(block) = clipped(chroma[1] + moved[1] * share);
    frame_.planes[2].at<uchar>(block) = clipped(chroma[2] + moved[2] * share);
  }

  [[nodiscard]] cv::Vec3f rgb_of(const cv::Vec3f& code) const { return map_.to_rgb * (code - map_.offset); }

  [[nodiscard]] cv::Vec3f chroma_code(const cv::Point& block) const {
    if (frame_.plane_count() == 1) return map_.offset;
    return {0, static_cast<float>(frame_.planes[1].at<uchar>(block)),
            static_cast<float>(frame_.planes[2].at<uchar>(block))};
  }

  [[nodiscard]] static uchar clipped(float code) { return static_cast<uchar>(std::clamp(code, 0.0F, 255.0F) + 0.5F); }

  Frame& frame_;
  CodeToRgb map_;
  cv::Size step_;
};

}  // namespace sigs
