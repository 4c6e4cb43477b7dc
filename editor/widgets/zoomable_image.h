// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/image.h"
#include "editor/geometry/image_view.h"
#include "editor/widgets/screen_vec.h"
#include "editor/widgets/textures.h"

namespace sigs::editor {

// How an image is looked at within a room on the screen: fitted until the person zooms or pans. Positions are counted
// from the room's upper left corner, so that several rooms of one size can share one look.
class ZoomableImage {
 public:
  // Before anything else, each update. A fitted image follows the room; any other keeps what is in the room's middle.
  void lay_out(const cv::Size& image_px, const glm::dvec2& room_px);

  // For a room whose corner lies there; whole pixels keep the image exact.
  [[nodiscard]] ImageView view(const glm::dvec2& room_corner) const;
  [[nodiscard]] double zoom() const { return view_.zoom; }
  [[nodiscard]] bool is_fitted() const { return fitted_; }
  [[nodiscard]] const glm::dvec2& room_px() const { return room_px_; }

  void fit();
  void zoom_by(double factor, const glm::dvec2& at);
  void zoom_to(double zoom, const glm::dvec2& at);
  // A part of the image in the middle, with about as much around it as it is large.
  void show(const Box& part);

  // Panning is told by the sum of the moves since it began.
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

// The mouse wheel and the keys 1, F and 0 over a room; true where one of them did something.
bool handle_zoom_input(ZoomableImage& look, const glm::dvec2& room_corner);

// How many times smaller an image is drawn from when it is looked at from afar: showing every third pixel would lose
// small things. 1 at zoom 1/2 and above.
[[nodiscard]] int divisor_at(double zoom);

// The part of an image that lies within a rect: pixel by pixel from zoom 1 on, smooth below.
void draw_image(ImDrawList& draw, Textures& textures, const cv::Mat& image, const ImageView& view,
                const ScreenRect& rect);

// The image's pixels that show in a rect.
[[nodiscard]] cv::Rect pixels_in_sight(const ImageView& view, const cv::Size& image_px, const ScreenRect& rect);

}  // namespace sigs::editor
