// SPDX-License-Identifier: MIT
#include "editor/app/layout.h"

#include <algorithm>
#include <utility>

#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

// A panel with its own background; padding 0 for images.
template <class Content>
void panel(const char* id, ImVec2 size, bool padded, ImU32 background, Content content) {
  ImGui::PushStyleColor(ImGuiCol_ChildBg, background);
  const ImGuiWindowFlags padding = padded ? ImGuiWindowFlags_AlwaysUseWindowPadding : ImGuiWindowFlags_None;
  ImGui::BeginChild(id, size, false, ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar | padding);
  content();
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

void move(double& size, double by_px, double minimum, double maximum) {
  size = std::clamp(size + by_px / scaled(1), minimum, std::max(minimum, maximum));
}

constexpr double kMinTimelineHeight = 90;

// Where the text is 15 px high; the images above keep some room.
double highest_timeline(float room_px) {
  return room_px / scaled(1) - 200;
}

}  // namespace

float Layout::timeline_height_px(const Settings& settings, float room_px) {
  return scaled(std::clamp(settings.timeline_height, kMinTimelineHeight,
                           std::max(kMinTimelineHeight, highest_timeline(room_px))));
}

// The tabs and what is in the one that is shown.
void Layout::draw_tabs(const ViewContext& context, OwnBodySession& own_body) {
  if (context.rig != nullptr && context.rig->size() > 1) {
    cameras_.draw(context);
    if (cameras_.shows_all()) {
      shows_own_body_ = false;
      return mosaic_.draw(context, cameras_);
    }
  }
  if (!ImGui::BeginTabBar("image tabs")) return;
  const auto tab = [&](const char* label, const char* place, ImGuiTabItemFlags flags, auto content) {
    const bool open = ImGui::BeginTabItem(label, nullptr, flags);
    context.ui_probe.note_item(place);
    if (!open) return false;
    content();
    ImGui::EndTabItem();
    return true;
  };
  const bool footage_is_wanted = std::exchange(wants_footage_, false);
  tab("Footage", "tab/footage", footage_is_wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None, [&] {
    viewport_.draw(context);
    const glm::dvec2 low(ImGui::GetWindowPos().x, ImGui::GetWindowPos().y);
    first_steps_.draw(context, {low, low + glm::dvec2(ImGui::GetWindowSize().x, ImGui::GetWindowSize().y)});
  });
  if (!tab("Stages", "tab/stages", ImGuiTabItemFlags_None, [&] { stages_.draw(context); })) stages_.forget();
  const bool is_wanted = std::exchange(wants_own_body_, false);
  shows_own_body_ = tab("Own body", "tab/own body", is_wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None,
                        [&] { own_body_.draw(context, own_body); });
  ImGui::EndTabBar();
}

void Layout::draw_images(const ViewContext& context, OwnBodySession& own_body, Settings& settings) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float bar = splitter_thickness();
  // Painting needs the room, and the world has nothing to say to it.
  const bool show_world = settings.show_world && !shows_own_body_;
  const float world = show_world ? static_cast<float>((room.x - bar) * settings.world_share) : 0;
  const float left = show_world ? room.x - bar - world : room.x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  images_at_ = {corner.x + left / 2, corner.y + room.y / 2};
  panel("images", {left, room.y}, false, color::kCanvas, [&] { draw_tabs(context, own_body); });
  if (!show_world) return;
  ImGui::SameLine(0, 0);
  const SplitterMove moved = vertical_splitter("world splitter", room.y);
  settings.world_share = std::clamp(settings.world_share - moved.by_px / std::max(1.0F, room.x), 0.1, 0.9);
  if (moved.reset) settings.world_share = Settings().world_share;
  ImGui::SameLine(0, 0);
  panel("world", {world, room.y}, false, color::kCanvas, [&] { world_.draw(context); });
}

void Layout::draw(const ViewContext& context, OwnBodySession& own_body, Settings& settings) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float bar = splitter_thickness();
  const double max_timeline = highest_timeline(room.y);
  const float timeline = timeline_height_px(settings, room.y);
  // In a small window, or with large text, the images keep the larger part.
  const float max_inspector = std::max(scaled(160), room.x * 0.42F);
  const float inspector = settings.show_inspector ? std::min(scaled(settings.inspector_width), max_inspector) : 0;
  const float left = settings.show_inspector ? room.x - inspector - bar : room.x;
  const auto with_usual_spacing = [&](auto content) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(6)});
    content();
    ImGui::PopStyleVar();
  };

  ImGui::BeginGroup();
  ImGui::BeginChild("upper", {left, room.y - timeline - bar});
  with_usual_spacing([&] { draw_images(context, own_body, settings); });
  ImGui::EndChild();
  const SplitterMove moved = horizontal_splitter("timeline splitter", left);
  move(settings.timeline_height, -moved.by_px, kMinTimelineHeight, max_timeline);
  if (moved.reset) settings.timeline_height = Settings().timeline_height;
  panel("timeline", {left, timeline}, true, color::kPanel,
        [&] { with_usual_spacing([&] { timeline_.draw(context); }); });
  ImGui::EndGroup();

  if (settings.show_inspector) {
    ImGui::SameLine(0, 0);
    const SplitterMove side = vertical_splitter("inspector splitter", room.y);
    if (side.by_px != 0) {
      settings.inspector_width = inspector / scaled(1);
      move(settings.inspector_width, -side.by_px, 200, max_inspector / scaled(1));
    }
    if (side.reset) settings.inspector_width = Settings().inspector_width;
    ImGui::SameLine(0, 0);
    panel("inspector", {inspector, room.y}, true, color::kPanel,
          [&] { with_usual_spacing([&] { inspector_.draw(context); }); });
  }
  ImGui::PopStyleVar();
}

}  // namespace sigs::editor
