// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include "base/image.h"
#include "editor/geometry/picture_view.h"
#include "editor/widgets/screen_vec.h"
#include "editor/widgets/textures.h"

namespace sigs::editor {

// How a picture is looked at within a room on the screen: fitted until the person zooms or pans. Places are counted
// from the room's upper left corner, so that several rooms of one size can share one look.
class ZoomablePicture {
 public:
  // Before anything else, each turn. A fitted picture follows the room; any other keeps what is in the room's middle.
  void lay_out(const cv::Size& picture_px, const glm::dvec2& room_px);

  // For a room whose corner lies there; whole pixels keep the picture exact.
  [[nodiscard]] PictureView view(const glm::dvec2& room_corner) const;
  [[nodiscard]] double zoom() const { return view_.zoom; }
  [[nodiscard]] bool is_fitted() const { return fitted_; }
  [[nodiscard]] const glm::dvec2& room_px() const { return room_px_; }

  void fit();
  void zoom_by(double factor, const glm::dvec2& at);
  void zoom_to(double zoom, const glm::dvec2& at);
  // A part of the picture in the middle, with about as much around it as it is large.
  void show(const Box& part);

  // Panning is told by the sum of the moves since it began.
  void begin_pan();
  void pan(const glm::dvec2& by_px_since_begin);

 private:
  [[nodiscard]] ScreenRect room() const { return {{0, 0}, room_px_}; }

  PictureView view_;
  PictureView before_pan_;
  glm::dvec2 picture_px_{0, 0};
  glm::dvec2 room_px_{0, 0};
  bool fitted_ = true;
};

// The mouse wheel and the keys 1, F and 0 over a room; true where one of them did something.
bool take_zoom_input(ZoomablePicture& look, const glm::dvec2& room_corner);

// How many times smaller a picture is drawn from when it is looked at from afar: showing every third pixel would lose
// small things. 1 at zoom 1/2 and above.
[[nodiscard]] int divisor_at(double zoom);

// The part of a picture that lies within a rect: pixel by pixel from zoom 1 on, smooth below.
void draw_picture(ImDrawList& draw, Textures& textures, const cv::Mat& picture, const PictureView& view,
                  const ScreenRect& rect);

// The picture's pixels that show in a rect.
[[nodiscard]] cv::Rect pixels_in_sight(const PictureView& view, const cv::Size& picture_px, const ScreenRect& rect);

}  // namespace sigs::editor
