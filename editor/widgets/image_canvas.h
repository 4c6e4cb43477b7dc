// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/image_view.h"

namespace sigs::editor {

// An image as it lies on the screen while it is drawn on.
struct ImageCanvas {
  ImDrawList& draw;
  ScreenRect rect;  // nothing is drawn beyond it
  ImageView view;
  cv::Size image_px;

  // The first and the one after the last screen pixel that the image covers, within the rect or not.
  [[nodiscard]] ScreenRect image_on_screen() const;
  // The pixel at a place of the screen; none beside the image.
  [[nodiscard]] std::optional<cv::Point> pixel_at(const glm::dvec2& screen) const;
};

// A small text on a dark plate, kept within the rect; `at` is its lower left corner.
void draw_label(const ImageCanvas& canvas, const glm::dvec2& at, const std::string& text, ImU32 color);

// Such texts, none over another.
class ImageLabels {
 public:
  // Nothing may cover this.
  void keep_free(const ScreenRect& taken) { taken_.push_back(taken); }
  // At the first of the places, as above, where it covers nothing; without any at the first of all, or not at all.
  void draw(const ImageCanvas& canvas, std::span<const glm::dvec2> places, const std::string& text, ImU32 color,
            bool in_any_case);

 private:
  std::vector<ScreenRect> taken_;
};
// How large the plate of a text is.
[[nodiscard]] glm::dvec2 label_size(const std::string& text);

// The outline of a rect of the screen, just outside it; dashes where asked for. Its corners may lie anywhere.
void draw_outline(const ImageCanvas& canvas, const ScreenRect& outlined, ImU32 color, bool dashed);

// Lines between the pixels, once these are large enough to tell from each other.
void draw_pixel_grid(const ImageCanvas& canvas);

// Red, green and blue of each pixel in it, once there is room; of those around the mouse where there are very many.
void draw_pixel_values(const ImageCanvas& canvas, const cv::Mat& image, const glm::dvec2& mouse);

// Around one pixel: a square where pixels are large, else a cross beside it.
void draw_pixel_mark(const ImageCanvas& canvas, const cv::Point& pixel);

// "120  84  33", or "120" for one channel; red first.
[[nodiscard]] std::string pixel_text(const cv::Mat& image, const cv::Point& pixel);

}  // namespace sigs::editor
