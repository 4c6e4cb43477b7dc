// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace sigs {

// The pixel convention of the whole program, which is OpenCV's: the centre of the first pixel is (0, 0), x runs right,
// y runs down. Pixel (i, j) covers the square [i - 0.5, i + 0.5) x [j - 0.5, j + 0.5). Integer rectangles (cv::Rect)
// name the first covered column and row and the number of covered columns and rows.

// A rectangle in continuous pixel coordinates. It is given by its edges: pixel (i, j) is {i - 0.5, j - 0.5, 1, 1}.
struct Box {
  double x = 0;  // left edge, px
  double y = 0;  // upper edge, px
  double width = 0;
  double height = 0;

  [[nodiscard]] bool operator==(const Box&) const = default;
};

// Of images that are each a part of a larger one: the larger one's size, and the part's upper left pixel in it.
struct ImagePart {
  cv::Size whole_px;
  cv::Point corner_px;
};

// Boxes in the frames of a video that have any.
using BoxesByFrame = std::map<int, std::vector<Box>>;

// As bounds: a rectangle larger than anything that is measured in pixels.
inline const cv::Rect kUnboundedRect{-1'000'000, -1'000'000, 2'000'000, 2'000'000};

// Smallest rectangle of whole pixels that touches all of the box, grown by margin_px and clipped to bounds.
[[nodiscard]] cv::Rect pixels_touched(const Box& box, int margin_px, const cv::Rect& bounds);

// The rectangle with by_px more on each of its four sides.
[[nodiscard]] inline cv::Rect grown(const cv::Rect& rect, int by_px) {
  return {rect.x - by_px, rect.y - by_px, rect.width + 2 * by_px, rect.height + 2 * by_px};
}

// The samples of a rectangle of an image. Columns beyond the image are those that follow on its other side, as those of
// a 360 degree image do; rows lie within it. Shares the image's samples where all columns lie within it.
[[nodiscard]] cv::Mat part_round(const cv::Mat& image, const cv::Rect& rect);

// The column modulo the width: 0 .. width - 1, for any column.
[[nodiscard]] inline int column_round(int column, int width) {
  const int rest = column % width;
  return rest < 0 ? rest + width : rest;
}

// What one intruder adds to an image, in linear light, over a small rectangle of that image.
//   rect      position of the layer in the image; empty: nothing is rendered
//   color     CV_32FC4: red, green, blue, opacity; premultiplied (red <= opacity for a surface no brighter than white)
//   coverage  CV_32FC1: share of the pixel that the silhouette covers, 0..1. The truth is measured in it: the lens
//             warps it and the own body occludes it, but blur does not change it, and glass covers although it lets
//             light through.
struct Layer {
  cv::Rect rect;
  cv::Mat color;
  cv::Mat coverage;

  // Whether nothing is rendered.
  [[nodiscard]] bool empty() const { return rect.empty(); }
};

// Width and height in pixels as the header of a PNG, JPEG, BMP, TIFF, WebP or PNM file states them, read without
// decoding: a file of some hundred kilobytes can contain a billion pixels. None for other files and incomplete headers.
[[nodiscard]] std::optional<cv::Size> image_size_px(const std::filesystem::path& path);

}  // namespace sigs
