// SPDX-License-Identifier: MIT
#include "editor/views/models/model_gallery.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/widgets/icons.h"
#include "editor/widgets/screen_vec.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kOwnModel = "OBJ file...";
constexpr int kImageWidth_px = 220;
constexpr int kImageHeight_px = 132;
constexpr float kImageShape = float(kImageHeight_px) / kImageWidth_px;
constexpr ImU32 kSky = IM_COL32(104, 118, 138, 255);  // dark and white models stand out alike
constexpr double kTileWidth = 92;                     // at least

}  // namespace

ModelGallery::ModelGallery(const fs::path& samples, std::function<void()> wake)
    : samples_(sample_models_in(samples)),
      images_({kImageWidth_px, kImageHeight_px}, std::move(wake), model_thumbnail) {}

bool ModelGallery::draw_tile(const ViewContext& context, const std::string& name, const fs::path& file, bool is_chosen,
                             float width) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float image_height = width * kImageShape;
  const float text_height = font(Font::small)->FontSize + scaled(6);
  const bool is_pressed = ImGui::InvisibleButton(name.c_str(), {width, image_height + text_height});
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{place.x + width, place.y + image_height + text_height};
  const ImVec2 image_end{end.x, place.y + image_height};
  const float rounding = scaled(4);
  list.AddRectFilled(place, end, is_chosen || is_hovered ? IM_COL32(58, 64, 76, 255) : IM_COL32(46, 50, 58, 255),
                     rounding);
  list.AddRectFilled(place, image_end, kSky, rounding, ImDrawFlags_RoundCornersTop);
  const auto image = file.empty() ? nullptr : images_.of(file);
  if (image && !image->empty()) {
    list.AddImage(context.textures.of(*image, Filter::smooth), place, image_end);
    context.ui_probe.note("gallery image/" + name, {dv(place), dv(image_end)});
  } else {
    draw_icon(list, file.empty() ? Icon::folder : Icon::aircraft, {(place.x + end.x) / 2, (place.y + image_end.y) / 2},
              scaled(20), faded(color::kText, 0.7));
  }
  if (is_chosen || is_hovered)
    list.AddRect(place, end, is_chosen ? color::kAccent : faded(color::kAccent, 0.5), rounding, 0, scaled(1.5));
  ImGui::PushFont(font(Font::small));
  const std::string shown = elided(name, width - scaled(6));
  const float text = ImGui::CalcTextSize(shown.c_str()).x;
  list.AddText({place.x + (width - text) / 2, image_end.y + scaled(1)}, is_chosen ? color::kText : color::kQuiet,
               shown.c_str());
  ImGui::PopFont();
  tooltip_for_item(file.empty() ? "A model of yours, as Wavefront OBJ" : shown == name ? "" : name.c_str());
  return is_pressed;
}

std::optional<ModelGallery::Pressed> ModelGallery::draw(const ViewContext& context, const std::string& place,
                                                        std::optional<std::size_t> chosen, const fs::path& own) {
  const float gap = scaled(6);
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((room + gap) / (scaled(kTileWidth) + gap)));
  const float width = (room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  std::optional<Pressed> pressed;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  for (std::size_t i = 0; i <= samples_.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, gap);
    const std::optional<std::size_t> one = i < samples_.size() ? std::optional(i) : std::nullopt;
    std::error_code code;
    const fs::path own_file = fs::is_regular_file(own, code) ? own : fs::path();
    const std::string name = one ? samples_[i].name : kOwnModel;
    const bool is_pressed =
        draw_tile(context, name, one ? samples_[i].file : own_file, chosen == one, std::floor(width));
    const bool is_twice = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (is_pressed || is_twice) pressed = Pressed{.sample = one, .twice = is_twice};
    context.ui_probe.note_item(place + "/" + name);
  }
  ImGui::PopStyleVar();
  return pressed;
}

}  // namespace sigs::editor
