// SPDX-License-Identifier: MIT
#include "editor/widgets/zoomable_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "editor/widgets/keys.h"
#include "editor/widgets/texts.h"

namespace sigs::editor {

namespace {

constexpr double kZoomPerNotch = 1.25;

constexpr int kTile_px = 512;

// Around what is in sight, so that a view that moves needs another part seldom: with one pixel more, which smoothing
// reads.
cv::Rect in_tiles(const cv::Rect& sight, const cv::Size& image_px) {
  const auto tile_at = [](int at) { return std::max(0, at) / kTile_px * kTile_px; };
  const cv::Point low(tile_at(sight.x - 1), tile_at(sight.y - 1));
  const cv::Point high(tile_at(sight.br().x) + kTile_px, tile_at(sight.br().y) + kTile_px);
  return cv::Rect(low, high) & cv::Rect({0, 0}, image_px);
}

// A part of an image that is brought to the graphics card, and what of it is drawn.
struct DrawnPart {
  cv::Rect texture;
  cv::Rect drawn;
};

// The image's first pixel is the view's pixel `at`. Blocks of a reduced copy begin at the texture's first pixel, and
// the last ones may extend beyond it.
void draw_part(ImDrawList& draw, Textures& textures, const ShownImage& image, const cv::Point& at,
               const DrawnPart& part, const ImageView& view) {
  const int divisor = divisor_at(view.zoom);
  const cv::Size reduced = reduced_size(part.texture.size(), divisor);
  const glm::dvec2 texture_px(divisor * reduced.width, divisor * reduced.height);
  const glm::dvec2 corner(at.x + part.texture.x, at.y + part.texture.y);
  const glm::dvec2 low(at.x + part.drawn.x, at.y + part.drawn.y);
  const glm::dvec2 high = low + glm::dvec2(part.drawn.width, part.drawn.height);
  const Filter filter = view.zoom >= 1 ? Filter::nearest : Filter::smooth;
  draw.AddImage(textures.of(image, part.texture, filter, divisor), im(view.screen_of(low - 0.5)),
                im(view.screen_of(high - 0.5)), im((low - corner) / texture_px), im((high - corner) / texture_px));
}

constexpr std::size_t kMaxLabel = 120;  // bytes
constexpr double kGridFromZoom = 8;
constexpr double kMinValueText_px = 9;
constexpr int kMaxValues = 320;        // pixels; each takes nine characters
constexpr int kValuesAroundMouse = 5;  // pixels to every side

ImU32 readable_on(const cv::Vec3b& bgr) {
  const int luma = (bgr[0] * 11 + bgr[1] * 59 + bgr[2] * 30) / 100;
  return luma > 128 ? IM_COL32(0, 0, 0, 230) : IM_COL32(255, 255, 255, 230);
}

// One side of an outline, upright or level.
void draw_side(ImDrawList& draw, glm::dvec2 low, glm::dvec2 high, ImU32 color, bool dashed) {
  const bool level = high.x - low.x >= high.y - low.y;
  const double length = level ? high.x - low.x : high.y - low.y;
  const double dash = scaled(5);
  for (double at = 0; at < length; at += dashed ? 2 * dash : length) {
    const double end = dashed ? std::min(at + dash, length) : length;
    const glm::dvec2 from = level ? glm::dvec2(low.x + at, low.y) : glm::dvec2(low.x, low.y + at);
    const glm::dvec2 to = level ? glm::dvec2(low.x + end, high.y) : glm::dvec2(high.x, low.y + end);
    draw.AddRectFilled(im(from), im(to), color);
  }
}

// pixel: CV_8UC3 or CV_8UC1, one pixel
void draw_value(const ImageCanvas& canvas, const cv::Mat& pixel, int x, int y, float text_px) {
  const int lines = pixel.channels() == 3 ? 3 : 1;
  const cv::Vec3b bgr = lines == 3 ? pixel.at<cv::Vec3b>(0, 0) : cv::Vec3b::all(pixel.at<uchar>(0, 0));
  const glm::dvec2 middle = canvas.view.screen_of({x, y});
  char text[8];
  for (int line = 0; line < lines; ++line) {
    const int length = std::snprintf(text, sizeof text, "%d", bgr[2 - line]);
    const double width = text_px * 0.6 * length;  // DejaVu Sans Mono's advance
    const glm::dvec2 at(middle.x - width / 2, middle.y + (line - lines / 2.0) * text_px);
    canvas.draw.AddText(font(Font::mono), text_px, im(glm::floor(at)), readable_on(bgr), text);
  }
}

glm::dvec2 plate_margin() {
  return {scaled(5), scaled(2)};
}

ScreenRect plate_at(const ImageCanvas& canvas, const glm::dvec2& at, const std::string& text) {
  const glm::dvec2 plate = label_size(text);
  const glm::dvec2 maximum = glm::max(canvas.rect.low, canvas.rect.high - plate);
  const glm::dvec2 low = glm::floor(glm::clamp(glm::dvec2(at.x, at.y - plate.y), canvas.rect.low, maximum));
  return {low, low + plate};
}

void draw_plate(const ImageCanvas& canvas, const ScreenRect& plate, const std::string& text, ImU32 color) {
  ImFont* const small = font(Font::small);
  canvas.draw.AddRectFilled(im(plate.low), im(plate.high), IM_COL32(12, 13, 16, 190), scaled(3));
  canvas.draw.AddText(small, small->FontSize, im(plate.low + plate_margin()), color,
                      shortened(text, kMaxLabel).c_str());
}

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

void draw_image(ImDrawList& draw, Textures& textures, const ShownImage& image, const ImageView& view,
                const ScreenRect& rect) {
  draw_image(draw, textures, PatchedImage{.ground = image, .patch = {}, .patch_at = {}}, view, rect);
}

void draw_image(ImDrawList& draw, Textures& textures, const PatchedImage& image, const ImageView& view,
                const ScreenRect& rect) {
  if (image.empty()) return;
  // The part in sight alone: a quad of 80,000 screen pixels has no exact texture coordinates.
  const cv::Rect sight = pixels_in_sight(view, image.size(), rect);
  if (sight.empty()) return;
  const int divisor = divisor_at(view.zoom);
  const cv::Rect whole({0, 0}, image.size());
  draw.PushClipRect(im(rect.low), im(rect.high), true);
  draw_part(draw, textures, image.ground, {0, 0}, {divisor > 1 ? whole : in_tiles(sight, image.size()), sight}, view);
  const DrawnPatch patch = drawn_patch(image, divisor);
  if (const cv::Rect part = patch.drawn & sight; !part.empty())
    draw_part(draw, textures, image.patch, image.patch_at, {patch.reduced - image.patch_at, part - image.patch_at},
              view);
  draw.PopClipRect();
}

ScreenRect ImageCanvas::image_on_screen() const {
  return {view.screen_of({-0.5, -0.5}), view.screen_of({image_px.width - 0.5, image_px.height - 0.5})};
}

std::optional<cv::Point> ImageCanvas::pixel_at(const glm::dvec2& screen) const {
  const glm::dvec2 p = glm::floor(view.image_of(screen) + 0.5);
  if (!(p.x >= 0 && p.y >= 0 && p.x < image_px.width && p.y < image_px.height)) return std::nullopt;
  return cv::Point(static_cast<int>(p.x), static_cast<int>(p.y));
}

glm::dvec2 label_size(const std::string& text) {
  ImFont* const small = font(Font::small);
  return dv(small->CalcTextSizeA(small->FontSize, 1e6F, 0, shortened(text, kMaxLabel).c_str())) + 2.0 * plate_margin();
}

void draw_label(const ImageCanvas& canvas, const glm::dvec2& at, const std::string& text, ImU32 color) {
  draw_plate(canvas, plate_at(canvas, at, text), text, color);
}

void draw_corner_label(const ImageCanvas& canvas, const std::string& text, ImU32 color) {
  draw_label(canvas, {canvas.rect.low.x + scaled(8), canvas.rect.high.y - scaled(8)}, text, color);
}

void draw_label(const ImageCanvas& canvas, LabelPlacer& labels, std::span<const glm::dvec2> places,
                const std::string& text, ImU32 color, bool in_any_case) {
  std::vector<ScreenRect> plates;
  for (const glm::dvec2& at : places) plates.push_back(plate_at(canvas, at, text));
  if (const auto plate = labels.place(plates, in_any_case)) draw_plate(canvas, *plate, text, color);
}

void draw_outline(const ImageCanvas& canvas, const ScreenRect& outlined, ImU32 color, bool dashed) {
  const double thick = std::max(1.0F, std::round(scaled(1)));
  const glm::dvec2 minimum = canvas.rect.low - 2 * thick;
  const glm::dvec2 maximum = canvas.rect.high + 2 * thick;
  const glm::dvec2 low = glm::clamp(glm::floor(outlined.low) - thick, minimum, maximum);
  const glm::dvec2 high = glm::clamp(glm::ceil(outlined.high) + thick, minimum, maximum);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  draw_side(canvas.draw, low, {high.x, low.y + thick}, color, dashed);
  draw_side(canvas.draw, {low.x, high.y - thick}, high, color, dashed);
  draw_side(canvas.draw, low, {low.x + thick, high.y}, color, dashed);
  draw_side(canvas.draw, {high.x - thick, low.y}, high, color, dashed);
  canvas.draw.PopClipRect();
}

void draw_pixel_grid(const ImageCanvas& canvas) {
  if (canvas.view.zoom < kGridFromZoom) return;
  const cv::Rect sight = pixels_in_sight(canvas.view, canvas.image_px, canvas.rect);
  const glm::dvec2 low = canvas.view.screen_of(glm::dvec2(sight.x, sight.y) - 0.5);
  const glm::dvec2 high = canvas.view.screen_of(glm::dvec2(sight.x + sight.width, sight.y + sight.height) - 0.5);
  const ImU32 color = IM_COL32(128, 128, 128, canvas.view.zoom < 16 ? 26 : 60);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (int i = 0; i <= sight.width; ++i) {
    const double x = std::round(low.x + i * canvas.view.zoom);
    canvas.draw.AddRectFilled(im({x, low.y}), im({x + 1, high.y}), color);
  }
  for (int j = 0; j <= sight.height; ++j) {
    const double y = std::round(low.y + j * canvas.view.zoom);
    canvas.draw.AddRectFilled(im({low.x, y}), im({high.x, y + 1}), color);
  }
  canvas.draw.PopClipRect();
}

void draw_pixel_values(const ImageCanvas& canvas, const PatchedImage& image, const glm::dvec2& mouse) {
  const double text_px = std::min(canvas.view.zoom / 3.4, static_cast<double>(font(Font::mono)->FontSize));
  if (image.empty() || text_px < kMinValueText_px) return;
  cv::Rect shown = pixels_in_sight(canvas.view, image.size(), canvas.rect);
  if (shown.area() > kMaxValues) {
    const std::optional<cv::Point> pixel = canvas.pixel_at(mouse);
    if (!pixel || !canvas.rect.contains(mouse)) return;
    const int side = 2 * kValuesAroundMouse + 1;
    shown &= cv::Rect(pixel->x - kValuesAroundMouse, pixel->y - kValuesAroundMouse, side, side);
  }
  if (shown.empty()) return;
  const cv::Mat pixels = image.part(shown);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x)
      draw_value(canvas, pixels({x, y, 1, 1}), shown.x + x, shown.y + y, static_cast<float>(text_px));
  canvas.draw.PopClipRect();
}

void draw_pixel_mark(const ImageCanvas& canvas, const cv::Point& pixel) {
  const glm::dvec2 low = canvas.view.screen_of(glm::dvec2(pixel.x, pixel.y) - 0.5);
  const ScreenRect square{low, low + canvas.view.zoom};
  if (canvas.view.zoom >= 4) return draw_outline(canvas, square, color::kAccent, false);
  const glm::dvec2 middle = glm::floor((square.low + square.high) / 2.0);
  const double gap = scaled(4);
  const double arm = scaled(7);
  // Dark below light: to be seen before sky and ground.
  const auto draw_arms = [&](double thick, ImU32 color) {
    for (const double side : {-1.0, 1.0}) {
      const double from = std::min(side * gap, side * (gap + arm));
      const double to = from + arm;
      canvas.draw.AddRectFilled(im(middle + glm::dvec2(from, -thick)), im(middle + glm::dvec2(to, 1 + thick)), color);
      canvas.draw.AddRectFilled(im(middle + glm::dvec2(-thick, from)), im(middle + glm::dvec2(1 + thick, to)), color);
    }
  };
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  draw_arms(1, IM_COL32(0, 0, 0, 150));
  draw_arms(0, color::kAccent);
  canvas.draw.PopClipRect();
}

std::string pixel_text(const PatchedImage& image, const cv::Point& pixel) {
  if (!cv::Rect({0, 0}, image.size()).contains(pixel)) return {};
  const cv::Vec3b bgr = image.bgr_at(pixel);
  if (image.ground.is_grey()) return fmt::format("{:3}", bgr[0]);
  return fmt::format("{:3} {:3} {:3}", bgr[2], bgr[1], bgr[0]);
}

}  // namespace sigs::editor
