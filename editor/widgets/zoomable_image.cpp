// SPDX-License-Identifier: MIT
#include "editor/widgets/zoomable_image.h"

#include <algorithm>
#include <cmath>

#include "editor/widgets/keys.h"

namespace sigs::editor {

namespace {

constexpr double kZoomPerNotch = 1.25;

}  // namespace

void ZoomableImage::lay_out(const cv::Size& image_px, const glm::dvec2& room_px) {
  const glm::dvec2 size(image_px.width, image_px.height);
  if (fitted_ || size != image_px_) {
    image_px_ = size;
    room_px_ = room_px;
    fit();
    return;
  }
  if (room_px == room_px_) return;
  const glm::dvec2 by = (room_px - room_px_) / 2.0;
  room_px_ = room_px;
  view_ = panned(view_, by, image_px_, room());
}

ImageView ZoomableImage::view(const glm::dvec2& room_corner) const {
  return {view_.zoom, view_.origin_on_screen + room_corner};
}

void ZoomableImage::fit() {
  view_ = fitted(image_px_, room());
  fitted_ = true;
}

void ZoomableImage::zoom_by(double factor, const glm::dvec2& at) {
  view_ = panned(zoomed(view_, factor, at), {0, 0}, image_px_, room());
  fitted_ = false;
}

void ZoomableImage::zoom_to(double zoom, const glm::dvec2& at) {
  zoom_by(zoom / view_.zoom, at);
}

void ZoomableImage::show(const Box& part) {
  const glm::dvec2 size = glm::max(glm::dvec2(part.width, part.height), 4.0);
  const double zoom = std::clamp(std::min(room_px_.x / size.x, room_px_.y / size.y) / 2, kMinZoom, kMaxZoom);
  zoom_to(zoom >= 1 ? std::floor(zoom) : zoom, room_px_ / 2.0);
  const glm::dvec2 middle = view_.screen_of({part.x + part.width / 2, part.y + part.height / 2});
  view_ = panned(view_, room_px_ / 2.0 - middle, image_px_, room());
}

void ZoomableImage::begin_pan() {
  before_pan_ = view_;
}

void ZoomableImage::pan(const glm::dvec2& by_px_since_begin) {
  view_ = panned(before_pan_, by_px_since_begin, image_px_, room());
  fitted_ = false;
}

bool handle_zoom_input(ZoomableImage& look, const glm::dvec2& room_corner) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 at = glm::floor(dv(io.MousePos) - room_corner);
  if (io.MouseWheel != 0) {
    look.zoom_by(std::pow(kZoomPerNotch, io.MouseWheel), at);
    return true;
  }
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt) return false;
  if (pressed(Key::digit1)) {
    look.zoom_to(1, at);
    return true;
  }
  if (!pressed(Key::f) && !pressed(Key::digit0)) return false;
  look.fit();
  return true;
}

int divisor_at(double zoom) {
  return std::max(1, static_cast<int>(std::floor(1 / zoom + 1e-9)));
}

cv::Rect pixels_in_sight(const ImageView& view, const cv::Size& image_px, const ScreenRect& rect) {
  const glm::dvec2 maximum(image_px.width, image_px.height);
  const glm::dvec2 low = glm::clamp(glm::floor(view.image_of(rect.low) + 0.5), glm::dvec2(0), maximum);
  const glm::dvec2 high = glm::clamp(glm::ceil(view.image_of(rect.high) + 0.5), low, maximum);
  return {cv::Point(static_cast<int>(low.x), static_cast<int>(low.y)),
          cv::Point(static_cast<int>(high.x), static_cast<int>(high.y))};
}

void draw_image(ImDrawList& draw, Textures& textures, const cv::Mat& image, const ImageView& view,
                const ScreenRect& rect) {
  if (image.empty()) return;
  // The part in sight alone: a quad of 80,000 screen pixels has no exact texture coordinates.
  const cv::Rect part = pixels_in_sight(view, image.size(), rect);
  if (part.empty()) return;
  const glm::dvec2 size(image.cols, image.rows);
  const glm::dvec2 low(part.x, part.y);
  const glm::dvec2 high(part.x + part.width, part.y + part.height);
  const Filter filter = view.zoom >= 1 ? Filter::nearest : Filter::smooth;
  draw.PushClipRect(im(rect.low), im(rect.high), true);
  draw.AddImage(textures.of(image, filter, divisor_at(view.zoom)), im(view.screen_of(low - 0.5)),
                im(view.screen_of(high - 0.5)), im(low / size), im(high / size));
  draw.PopClipRect();
}

}  // namespace sigs::editor
