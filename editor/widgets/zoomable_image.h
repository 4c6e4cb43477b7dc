// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string>

#include "base/image.h"
#include "editor/geometry/image_view.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

// Zoom and pan of an image within an area of the screen. The image is fitted into the area until the user zooms or
// pans. Positions are in screen pixels from the area's upper left corner, so that several areas of one size can share
// the same zoom and pan.
class ZoomableImage {
 public:
  // To be called first in each update, with the sizes of image and area in pixels. A fitted image follows the size of
  // the area; any other keeps the image point in the middle of the area.
  void lay_out(const cv::Size& image_px, const glm::dvec2& room_px);

  // How the image lies on the screen in an area whose upper left corner lies at room_corner. A corner on whole pixels
  // keeps the image exact.
  [[nodiscard]] ImageView view(const glm::dvec2& room_corner) const;
  [[nodiscard]] double zoom() const { return view_.zoom; }
  [[nodiscard]] bool is_fitted() const { return fitted_; }
  [[nodiscard]] const glm::dvec2& room_px() const { return room_px_; }

  void fit();
  void zoom_by(double factor, const glm::dvec2& at);
  void zoom_to(double zoom, const glm::dvec2& at);
  // A part of the image in the middle, with about as much around it as it is large.
  void show(const Box& part);

  // A pan is given as the sum of the mouse's moves since begin_pan, because the origin is rounded to whole pixels.
  void begin_pan();
  void pan(const glm::dvec2& by_px_since_begin);

 private:
  [[nodiscard]] ScreenRect room() const { return {{0, 0}, room_px_}; }

  ImageView view_;
  ImageView before_pan_;
  glm::dvec2 image_px_{0, 0};
  glm::dvec2 room_px_{0, 0};
  bool fitted_ = true;
};

// Applies the mouse wheel and the keys 1, F and 0 while the mouse is over the area. True: the zoom has changed.
bool handle_zoom_input(ZoomableImage& look, const glm::dvec2& room_corner);

// How many times smaller an image is drawn from when it is looked at from afar: showing every third pixel would lose
// small things. 1 at zoom 1/2 and above.
[[nodiscard]] int divisor_at(double zoom);

// The part of an image that lies within a rect: pixel by pixel from zoom 1 on, smooth below.
void draw_image(ImDrawList& draw, Textures& textures, const ShownImage& image, const ImageView& view,
                const ScreenRect& rect);

// The same of a patched image: the ground's texture stays when the patch is another one. On the screen the patch ends
// where it equals the ground, so that no seam is seen at any zoom.
void draw_image(ImDrawList& draw, Textures& textures, const PatchedImage& image, const ImageView& view,
                const ScreenRect& rect);

// The image's pixels that show in a rect.
[[nodiscard]] cv::Rect pixels_in_sight(const ImageView& view, const cv::Size& image_px, const ScreenRect& rect);

// An image as it lies on the screen while it is drawn on.
struct ImageCanvas {
  ImDrawList& draw;
  ScreenRect rect;  // nothing is drawn beyond it
  ImageView view;
  cv::Size image_px;

  // The first and the one after the last screen pixel that the image covers, within the rect or not.
  [[nodiscard]] ScreenRect image_on_screen() const;
  // Where a box of the image lies.
  [[nodiscard]] ScreenRect on_screen(const Box& box) const {
    return {view.screen_of({box.x, box.y}), view.screen_of({box.x + box.width, box.y + box.height})};
  }
  // The pixel at a place of the screen; none beside the image.
  [[nodiscard]] std::optional<cv::Point> pixel_at(const glm::dvec2& screen) const;
};

// A small text on a dark plate, kept within the rect; `at` is its lower left corner.
void draw_label(const ImageCanvas& canvas, const glm::dvec2& at, const std::string& text, ImU32 color);

// The same at the first of the places where it overlaps no other label; where there is none, at the first place with
// in_any_case, else not at all.
void draw_label(const ImageCanvas& canvas, LabelPlacer& labels, std::span<const glm::dvec2> places,
                const std::string& text, ImU32 color, bool in_any_case);
// In the lower left corner of the rect.
void draw_corner_label(const ImageCanvas& canvas, const std::string& text, ImU32 color);
// How large the plate of a text is.
[[nodiscard]] glm::dvec2 label_size(const std::string& text);

// The outline of a rect of the screen, just outside it; dashes where asked for. Its corners may lie anywhere.
void draw_outline(const ImageCanvas& canvas, const ScreenRect& outlined, ImU32 color, bool dashed);

// Lines between the pixels, once these are large enough to tell from each other.
void draw_pixel_grid(const ImageCanvas& canvas);

// Red, green and blue of each pixel in it, once there is room; of those around the mouse where there are very many.
void draw_pixel_values(const ImageCanvas& canvas, const PatchedImage& image, const glm::dvec2& mouse);

// Around one pixel: a square where pixels are large, else a cross beside it.
void draw_pixel_mark(const ImageCanvas& canvas, const cv::Point& pixel);

// "120  84  33", or "120" for one channel; red first.
[[nodiscard]] std::string pixel_text(const PatchedImage& image, const cv::Point& pixel);

}  // namespace sigs::editor
