// SPDX-License-Identifier: MIT
#include "editor/views/own_body/mask_tiles.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "editor/widgets/screen_vec.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

namespace {

constexpr int kTile_px = 512;
constexpr double kTint = 0.5;  // how much of the footage the mask covers where it is white

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (!std::equal(a.ptr<uchar>(y), a.ptr<uchar>(y) + a.cols, b.ptr<uchar>(y))) return false;
  return true;
}

cv::Mat reduced(const cv::Mat& mask, int divisor) {
  if (divisor < 2) return mask.clone();
  cv::Mat small;
  const cv::Size size(std::max(1, mask.cols / divisor), std::max(1, mask.rows / divisor));
  cv::resize(mask, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

// The part in sight alone, as draw_image has it.
void draw_tile(const ImageCanvas& canvas, Textures& textures, const cv::Rect& place, const cv::Mat& shown) {
  const cv::Rect part = pixels_in_sight(canvas.view, canvas.image_px, canvas.rect) & place;
  if (part.empty()) return;
  const glm::dvec2 low(part.x, part.y);
  const glm::dvec2 high(part.x + part.width, part.y + part.height);
  const glm::dvec2 corner(place.x, place.y);
  const glm::dvec2 size(place.width, place.height);
  canvas.draw.AddImage(textures.of(shown, canvas.view.zoom >= 1 ? Filter::nearest : Filter::smooth),
                       im(canvas.view.screen_of(low - 0.5)), im(canvas.view.screen_of(high - 0.5)),
                       im((low - corner) / size), im((high - corner) / size));
}

}  // namespace

cv::Mat tinted(const cv::Mat& mask) {
  const ImVec4 tone = ImGui::ColorConvertU32ToFloat4(color::kOwnBody);
  const auto part = [](float value) { return cv::saturate_cast<uchar>(255.0F * value); };
  cv::Mat tint(mask.size(), CV_8UC4);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      tint.at<cv::Vec4b>(y, x) = {part(tone.x), part(tone.y), part(tone.z),
                                  cv::saturate_cast<uchar>(kTint * mask.at<uchar>(y, x))};
  return tint;
}

void MaskTiles::refresh(Tile& tile, const cv::Mat& mask, int divisor, MaskStyle look) {
  if (tile.divisor == divisor && tile.look == look && is_same(tile.mask, mask)) return;
  tile.mask = mask.clone();
  tile.divisor = divisor;
  tile.look = look;
  const cv::Mat small = reduced(mask, divisor);
  tile.shown = look == MaskStyle::alone ? small : tinted(small);
}

void MaskTiles::draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& mask, MaskStyle look) {
  if (mask.size() != size_px_) tiles_.clear();
  size_px_ = mask.size();
  const int divisor = std::max(1, static_cast<int>(std::floor(1 / canvas.view.zoom + 1e-9)));
  const cv::Rect in_sight = pixels_in_sight(canvas.view, mask.size(), canvas.rect);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (int y = 0; y < mask.rows; y += kTile_px)
    for (int x = 0; x < mask.cols; x += kTile_px) {
      const cv::Rect place = cv::Rect(x, y, kTile_px, kTile_px) & cv::Rect({0, 0}, mask.size());
      if ((place & in_sight).empty()) continue;
      Tile& tile = tiles_[{y, x}];
      refresh(tile, mask(place), divisor, look);
      draw_tile(canvas, textures, place, tile.shown);
    }
  canvas.draw.PopClipRect();
}

}  // namespace sigs::editor
