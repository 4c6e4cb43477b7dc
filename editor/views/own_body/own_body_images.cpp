// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/ensure.h"
#include "base/text.h"
#include "editor/document/mask_painting.h"

namespace sigs::editor {

namespace {

// Blue, green, red.
const cv::Vec3d kWorld(170, 110, 40);
const cv::Vec3d kUnknown(70, 70, 70);
const cv::Vec3d kBody(230, 110, 225);

cv::Vec3b color_of_confidence(double confidence) {
  const double side = 2 * confidence - 1;
  return cv::Vec3b(kUnknown + std::abs(side) * ((side < 0 ? kWorld : kBody) - kUnknown));
}

constexpr int kTile_px = 512;

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

cv::Mat confidence_image(const cv::Mat& confidence) {
  ENSURE(confidence.empty() || confidence.type() == CV_16UC1);
  static const std::vector<cv::Vec3b> kColors = [] {
    std::vector<cv::Vec3b> colors(256);
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = color_of_confidence(static_cast<double>(i) / 255);
    return colors;
  }();
  cv::Mat image(confidence.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      // 65535 is 255 times 257.
      const auto index = static_cast<std::size_t>((confidence.at<ushort>(y, x) + 128) / 257);
      image.at<cv::Vec3b>(y, x) = kColors[index];
    }
  return image;
}

std::vector<StageTile> stage_tiles(const OwnBody& found) {
  std::vector<StageTile> tiles;
  for (const DetectionStage& stage : found.stages)
    if (!stage.image.empty())
      tiles.push_back({fmt::format("{}  {}", tiles.size() + 1, stage.title), stage.name, stage.image});
  return tiles;
}

std::string share_text(double share) {
  return fmt::format("{:.{}g} % of the image", share * 100, share < 0.1 ? 2 : 3);
}

std::string result_text(const OwnBody& found) {
  const std::string frames = count_text(found.frames_used, "frame") + (found.converged ? ", converged early" : "");
  return (found.share > 0 ? "Found in " : "No own body in ") + frames;
}

std::vector<std::string> cautions_about(const OwnBody& found, double seconds) {
  std::vector<std::string> cautions;
  for (const Warning& warning : found.warnings) cautions.push_back(warning.text());
  if (found.share > kLargeShare)
    cautions.push_back(share_text(found.share) + ", more than half, is masked: is that the aircraft, or the world?");
  if (seconds < kEnoughFootage_s)
    cautions.push_back(
        fmt::format("Only {:.2g} s of footage were looked through: what hardly moved meanwhile may be taken "
                    "for own body. Look closely.",
                    seconds));
  return cautions;
}

std::string progress_text(const DetectionState& state) {
  if (state.is_stopping) return "stopping...";
  if (state.total <= 0) return "opening the footage...";
  std::string text = fmt::format("{} of {}", state.done, count_text(state.total, "frame"));
  if (state.left_s) text += fmt::format(", {} left", clock_text(*state.left_s));
  return text;
}

cv::Mat tinted(const cv::Mat& mask, double opacity) {
  const ImVec4 tone = ImGui::ColorConvertU32ToFloat4(color::kOwnBody);
  cv::Mat alpha;
  mask.convertTo(alpha, CV_8U, mask.depth() == CV_8U ? opacity : 255 * opacity);
  cv::Mat tint(mask.size(), CV_8UC4, 255 * cv::Scalar(tone.x, tone.y, tone.z));
  cv::insertChannel(alpha, tint, 3);
  return tint;
}

void MaskTiles::refresh(Tile& tile, const cv::Mat& mask, int divisor, MaskStyle look) {
  if (tile.divisor == divisor && tile.look == look && is_same_mask(tile.mask, mask)) return;
  tile.mask = mask.clone();
  tile.divisor = divisor;
  tile.look = look;
  const cv::Mat small = reduced(mask, divisor);
  tile.shown = look == MaskStyle::alone ? small : tinted(small);
}

void MaskTiles::draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& mask, MaskStyle look) {
  if (mask.size() != size_px_) tiles_.clear();
  size_px_ = mask.size();
  const int divisor = divisor_at(canvas.view.zoom);
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
