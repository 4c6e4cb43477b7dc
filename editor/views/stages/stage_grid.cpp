// SPDX-License-Identifier: MIT
#include "editor/views/stages/stages_view.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "base/text.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kDifferencesKept = 1;

struct Words {
  const char* stage;
  const char* label;
  const char* tooltip;
};

constexpr std::array kWords{
    Words{"input1", "Input 1", "The footage"},
    Words{"clouds", "Clouds", "Opacity of the clouds that are found in the footage"},
    Words{"input2", "Input 2", "The intruder before pure green, as a camera without distortion sees it"},
    Words{"a", "A: undistorted", "Input 1 without the lens' distortion"},
    Words{"b", "B: keyed", "Input 2 keyed into A"},
    Words{"c", "C: distorted", "B through the lens"},
    Words{"d", "D: blurred", "C blurred as the lens does at the intruder's distance"},
    Words{"f", "F: key, distorted and blurred",
          "Input 2 distorted and blurred the same way: where it is not green, D is taken"},
    Words{"keyed", "Keyed",
          "What the key gives, before the own body hides any of it: classic takes D where F is not green"},
    Words{"shadow", "Shadow", "The footage with the intruder's shadow on the ground"},
    Words{"layer", "Layer", "The intruder alone in its virtual view, before it is warped"},
    Words{"warped", "Warped", "The layer through the lens"},
    Words{"hazed", "Hazed", "With the footage's black and saturation, behind haze"},
    Words{"motion_blurred", "Motion blur", "Blurred by its motion while the shutter is open"},
    Words{"blurred", "Blurred", "Blurred as the lens does at the intruder's distance"},
    Words{"occluded", "Occluded", "Without what own body, occluder and clouds hide"},
    Words{"sharpened", "Sharpened", "The frame with the intruder, sharpened as the footage's camera does"},
    Words{"chroma_blur", "Chroma blur", "Its colours spread over the chroma planes as the footage's are"},
    Words{"grain", "Grain", "With noise of the footage's kind"},
    Words{"uncoded", "Before the codec", "The frame before the footage's compression is applied around the intruder"},
    Words{"mask", "Mask", "Opacity with which intruders are composited"},
    Words{"output", "Output", "The finished frame, as it is exported"},
};

StageTile tile_of(const std::string& stage, const cv::Mat& image) {
  const auto words = std::ranges::find_if(kWords, [&](const Words& known) { return stage == known.stage; });
  if (words == kWords.end()) return {stage, "", image};
  return {words->label, words->tooltip, image};
}

double head_px() {
  return std::ceil(font(Font::small)->FontSize + scaled(8));
}

double gap_px() {
  return std::round(scaled(4));
}

}  // namespace

StageName stage_name(const std::string& name) {
  int number = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (code != std::errc() || end == name.data() + name.size() || *end != '_' || number < 0) return {std::nullopt, name};
  return {number, std::string(end + 1, name.data() + name.size())};
}

std::vector<int> intruders_of(const std::vector<Stage>& stages) {
  std::set<int> numbers;
  for (const Stage& stage : stages)
    if (const std::optional<int> intruder = stage_name(stage.name).intruder) numbers.insert(*intruder);
  return {numbers.begin(), numbers.end()};
}

std::vector<StageTile> stage_tiles(const std::vector<Stage>& stages, std::optional<int> intruder) {
  std::vector<StageTile> tiles;
  for (const Stage& stage : stages) {
    const StageName name = stage_name(stage.name);
    if (stage.image.empty() || (name.intruder && name.intruder != intruder)) continue;
    tiles.push_back(tile_of(name.stage, stage.image));
  }
  return tiles;
}

cv::Mat difference(const cv::Mat& a, const cv::Mat& b, double gain) {
  if (a.empty() || a.size() != b.size() || a.type() != b.type()) return {};
  cv::Mat apart;
  cv::absdiff(a, b, apart);
  cv::Mat shown;
  apart.convertTo(shown, -1, gain);
  return shown;
}

cv::Mat Differences::of(const cv::Mat& a, const cv::Mat& b, double gain) {
  const auto known = std::ranges::find_if(made_, [&](const CachedDifference& made) {
    return made.a.data == a.data && made.b.data == b.data && made.gain == gain;
  });
  if (known != made_.end()) return known->image;
  if (made_.size() >= kDifferencesKept) made_.erase(made_.begin());
  made_.push_back({a, b, gain, difference(a, b, gain)});
  return made_.back().image;
}

GridShape grid_shape(int count, const glm::dvec2& image_px, const glm::dvec2& room_px, double label_px) {
  GridShape best;
  double best_zoom = -1;
  for (int columns = 1; columns <= std::max(1, count); ++columns) {
    const int rows = (std::max(1, count) + columns - 1) / columns;
    const glm::dvec2 tile(room_px.x / columns, room_px.y / rows - label_px);
    const glm::dvec2 zooms = tile / glm::max(image_px, 1.0);
    const double zoom = std::min(zooms.x, zooms.y);
    if (zoom <= best_zoom) continue;
    best_zoom = zoom;
    best = {columns, rows};
  }
  return best;
}

void StageGrid::zoom_to_exact() {
  look_.zoom_to(1, look_.room_px() / 2.0);
}

bool StageGrid::handle_escape() {
  if (large_.empty() || ImGui::GetIO().WantTextInput || any_popup_open() || !pressed(Key::escape)) return false;
  show_all();
  return true;
}

void StageGrid::draw(std::span<const StageTile> tiles, const cv::Size& frame_px, const ScreenRect& rect,
                     Textures& textures) {
  const auto large = std::ranges::find(tiles, large_, &StageTile::label);
  if (large != tiles.end()) tiles = tiles.subspan(static_cast<std::size_t>(large - tiles.begin()), 1);
  const glm::dvec2 size(frame_px.width, frame_px.height);
  const GridShape shape = grid_shape(static_cast<int>(tiles.size()), size, rect.size(), head_px() + gap_px());
  const glm::dvec2 cell = glm::floor((rect.size() + gap_px()) / glm::dvec2(shape.columns, shape.rows));
  look_.lay_out(frame_px, glm::max(cell - gap_px() - glm::dvec2(0, head_px()), 1.0));
  next_pixel_.reset();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto column = static_cast<int>(i) % shape.columns;
    const auto row = static_cast<int>(i) / shape.columns;
    const glm::dvec2 low = rect.low + cell * glm::dvec2(column, row);
    draw_tile(tiles[i], frame_px, {low, low + glm::max(cell - gap_px(), 1.0)}, textures);
  }
  pixel_ = next_pixel_;
}

void StageGrid::draw_tile(const StageTile& tile, const cv::Size& frame_px, const ScreenRect& rect, Textures& textures) {
  const bool linked = tile.image.size() == frame_px;
  const ScreenRect room{{rect.low.x, rect.low.y + head_px()}, rect.high};
  if (room.size().x < 2 || room.size().y < 2) return;
  ImGui::PushID(tile.label.c_str());
  ImGui::SetCursorScreenPos(im(rect.low));
  ImGui::InvisibleButton("head", im({rect.size().x, head_px()}));
  if (ImGui::IsItemClicked()) large_ = large_.empty() ? tile.label : std::string();
  const std::string about = tile.tooltip.empty() || tile.tooltip == tile.label ? "" : "\n" + tile.tooltip;
  tooltip_for_item((tile.label + about + (large_.empty() ? "\nClick: larger" : "\nClick or Esc: all")).c_str());
  ImGui::SetCursorScreenPos(im(room.low));
  ImGui::InvisibleButton("image", im(room.size()),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  handle_mouse(tile, linked, room);
  draw_image_of(tile, linked, room, textures);
  draw_head(tile, linked, rect);
  ImGui::PopID();
}

void StageGrid::handle_mouse(const StageTile& tile, bool linked, const ScreenRect& room) {
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  const bool hovered = ImGui::IsItemHovered();
  if (hovered && linked) {
    handle_zoom_input(look_, room.low);
    const ImageCanvas canvas{*ImGui::GetWindowDrawList(), room, look_.view(room.low), tile.image.size()};
    next_pixel_ = canvas.pixel_at(mouse);
  }
  if (ImGui::IsItemActivated()) {
    pressed_ = tile.label;
    panned_ = false;
    look_.begin_pan();
  }
  if (pressed_ != tile.label) return;
  const ImGuiMouseButton button =
      ImGui::IsMouseDown(ImGuiMouseButton_Middle) ? ImGuiMouseButton_Middle : ImGuiMouseButton_Left;
  const glm::dvec2 by = dv(ImGui::GetMouseDragDelta(button, panned_ ? 0 : scaled(3)));
  if (ImGui::IsItemActive() && by != glm::dvec2(0, 0)) {
    panned_ = true;
    if (linked) look_.pan(by);
  }
  if (ImGui::IsItemActive()) return;
  const bool clicked = hovered && !panned_ && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  if (clicked) large_ = large_.empty() ? tile.label : std::string();
  pressed_.clear();
}

void StageGrid::draw_image_of(const StageTile& tile, bool linked, const ScreenRect& room, Textures& textures) {
  const glm::dvec2 size(tile.image.cols, tile.image.rows);
  const ImageCanvas canvas{*ImGui::GetWindowDrawList(), room, linked ? look_.view(room.low) : fitted(size, room),
                           tile.image.size()};
  canvas.draw.AddRectFilled(im(room.low), im(room.high), IM_COL32(12, 13, 15, 255));
  draw_image(canvas.draw, textures, tile.image, canvas.view, room);
  if (!linked) return;
  draw_pixel_grid(canvas);
  if (pixel_) {
    draw_pixel_values(canvas, {.ground = tile.image}, canvas.view.screen_of(glm::dvec2(pixel_->x, pixel_->y)));
    draw_pixel_mark(canvas, *pixel_);
  }
}

void StageGrid::draw_head(const StageTile& tile, bool linked, const ScreenRect& rect) const {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(im(rect.low), im({rect.high.x, rect.low.y + head_px()}), color::kPanel);
  const float y = static_cast<float>(std::floor(rect.low.y + (head_px() - font(Font::small)->FontSize) / 2));
  double room = rect.size().x - 2 * scaled(6);
  std::string value;
  if (linked && pixel_)
    value = (tile.image.channels() == 1 ? "value " : "RGB ") + pixel_text({.ground = tile.image}, *pixel_);
  if (!linked) value = image_size_text(tile.image.size(), " x ");
  ImGui::PushFont(font(Font::small));
  const float label_width = ImGui::CalcTextSize(tile.label.c_str()).x;
  ImGui::PopFont();
  ImGui::PushFont(font(Font::mono));
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  // The value is beside the pixel's mark too; the label is nowhere else.
  if (!value.empty() && value_width + scaled(8) + label_width <= room) {
    draw.AddText({static_cast<float>(rect.high.x) - scaled(6) - value_width, y},
                 linked ? color::kAccent : color::kQuiet, value.c_str());
    room -= value_width + scaled(8);
  }
  ImGui::PopFont();
  ImGui::PushFont(font(Font::small));
  draw.AddText({static_cast<float>(rect.low.x) + scaled(6), y}, color::kText,
               elided(tile.label, static_cast<float>(room)).c_str());
  ImGui::PopFont();
}

}  // namespace sigs::editor
