// SPDX-License-Identifier: MIT
#include "editor/widgets/zoomable_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "editor/widgets/keys.h"

namespace sigs::editor {

namespace {

constexpr double kZoomPerNotch = 1.25;
constexpr std::size_t kReducedKept = 24;

}  // namespace

void ZoomablePicture::lay_out(const cv::Size& picture_px, const glm::dvec2& room_px) {
  const glm::dvec2 size(picture_px.width, picture_px.height);
  if (fitted_ || size != picture_px_) {
    picture_px_ = size;
    room_px_ = room_px;
    fit();
    return;
  }
  if (room_px == room_px_) return;
  const glm::dvec2 by = (room_px - room_px_) / 2.0;
  room_px_ = room_px;
  view_ = panned(view_, by, picture_px_, room());
}

PictureView ZoomablePicture::view(const glm::dvec2& room_corner) const {
  return {view_.zoom, view_.origin_on_screen + room_corner};
}

void ZoomablePicture::fit() {
  view_ = fitted(picture_px_, room());
  fitted_ = true;
}

void ZoomablePicture::zoom_by(double factor, const glm::dvec2& at) {
  view_ = panned(zoomed(view_, factor, at), {0, 0}, picture_px_, room());
  fitted_ = false;
}

void ZoomablePicture::zoom_to(double zoom, const glm::dvec2& at) {
  zoom_by(zoom / view_.zoom, at);
}

void ZoomablePicture::show(const Box& part) {
  const glm::dvec2 size = glm::max(glm::dvec2(part.width, part.height), 4.0);
  const double zoom = std::clamp(std::min(room_px_.x / size.x, room_px_.y / size.y) / 2, kLeastZoom, kMostZoom);
  zoom_to(zoom >= 1 ? std::floor(zoom) : zoom, room_px_ / 2.0);
  const glm::dvec2 middle = view_.screen_of({part.x + part.width / 2, part.y + part.height / 2});
  view_ = panned(view_, room_px_ / 2.0 - middle, picture_px_, room());
}

void ZoomablePicture::begin_pan() {
  before_pan_ = view_;
}

void ZoomablePicture::pan(const glm::dvec2& by_px_since_begin) {
  view_ = panned(before_pan_, by_px_since_begin, picture_px_, room());
  fitted_ = false;
}

bool take_zoom_input(ZoomablePicture& look, const glm::dvec2& room_corner) {
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

cv::Mat ReducedPictures::of(const cv::Mat& picture, double zoom) {
  const int divisor = static_cast<int>(std::floor(1 / zoom + 1e-9));
  if (divisor < 2) return picture;
  const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.picture.data == picture.data && entry.divisor == divisor;
  });
  if (known != entries_.end()) return known->reduced;
  Entry entry{.picture = picture, .divisor = divisor};
  const cv::Size size(std::max(1, picture.cols / divisor), std::max(1, picture.rows / divisor));
  cv::resize(picture, entry.reduced, size, 0, 0, cv::INTER_AREA);
  entries_.push_front(entry);
  if (entries_.size() > kReducedKept) entries_.pop_back();
  return entry.reduced;
}

cv::Rect pixels_in_sight(const PictureView& view, const cv::Size& picture_px, const ScreenRect& rect) {
  const glm::dvec2 most(picture_px.width, picture_px.height);
  const glm::dvec2 low = glm::clamp(glm::floor(view.picture_of(rect.low) + 0.5), glm::dvec2(0), most);
  const glm::dvec2 high = glm::clamp(glm::ceil(view.picture_of(rect.high) + 0.5), low, most);
  return {cv::Point(static_cast<int>(low.x), static_cast<int>(low.y)),
          cv::Point(static_cast<int>(high.x), static_cast<int>(high.y))};
}

void draw_picture(ImDrawList& draw, Textures& textures, ReducedPictures& reduced, const cv::Mat& picture,
                  const PictureView& view, const ScreenRect& rect) {
  if (picture.empty()) return;
  // The part in sight alone: a quad of 80,000 screen pixels has no exact texture coordinates.
  const cv::Rect part = pixels_in_sight(view, picture.size(), rect);
  if (part.empty()) return;
  const glm::dvec2 size(picture.cols, picture.rows);
  const glm::dvec2 low(part.x, part.y);
  const glm::dvec2 high(part.x + part.width, part.y + part.height);
  const Filter filter = view.zoom >= 1 ? Filter::nearest : Filter::smooth;
  draw.PushClipRect(im(rect.low), im(rect.high), true);
  draw.AddImage(textures.of(reduced.of(picture, view.zoom), filter), im(view.screen_of(low - 0.5)),
                im(view.screen_of(high - 0.5)), im(low / size), im(high / size));
  draw.PopClipRect();
}

}  // namespace sigs::editor
