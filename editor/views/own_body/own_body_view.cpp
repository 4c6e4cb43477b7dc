// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/views/own_body/own_body_images.h"
#include "editor/views/viewport/image_icons.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/popups.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr double kPanel = 290;  // wide, where the text is 15 px high
constexpr double kRadius = 120;

float readout_height() {
  return std::ceil(font(Font::mono)->FontSize + scaled(9));
}

}  // namespace

ToolbarItem OwnBodyView::look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look) {
  return {.button = {.id = label, .label = label, .tooltip = tooltip, .on = look_ == look},
          .clicked =
              [this, look] {
                look_ = look;
                grid_.show_all();
              },
          .drawn = [&context, label] { context.ui_probe.note_item(std::string("own body/look ") + label); }};
}

void OwnBodyView::draw_radius(const ViewContext& context) {
  auto radius = static_cast<float>(canvas_.radius_px());
  ImGui::SetNextItemWidth(scaled(kRadius));
  if (ImGui::DragFloat("##radius", &radius, std::max(0.05F, radius * 0.01F), static_cast<float>(kMinRadius_px),
                       static_cast<float>(kMaxRadius_px), radius < 10 ? "radius %.1f px" : "radius %.0f px",
                       ImGuiSliderFlags_AlwaysClamp))
    canvas_.set_radius_px(radius);
  context.ui_probe.note_item("own body/radius");
  tooltip_for_item("Radius of the brush in the footage's pixels ([ and ]); its edge is as soft as the setting says");
}

void OwnBodyView::add_brush_items(std::vector<ToolbarItem>& items, const ViewContext& context, MaskPainting& painting) {
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "add",
                              .icon = image_icon::brush,
                              .label = "Add",
                              .tooltip = "Paint what belongs to the own body (B). With Shift: the other brush",
                              .on = !canvas_.erases()},
                   .clicked = [this] { canvas_.set_erases(false); }});
  items.push_back({.button = {.id = "erase",
                              .icon = image_icon::eraser,
                              .label = "Erase",
                              .tooltip = "Paint what does not (E). With Shift: the other brush",
                              .on = canvas_.erases()},
                   .clicked = [this] { canvas_.set_erases(true); }});
  items.push_back({.width = scaled(kRadius), .content = [this, &context] { draw_radius(context); }});
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "undo",
                              .icon = image_icon::undo,
                              .tooltip = "Take the last stroke back (Ctrl + Z)",
                              .enabled = painting.can_undo()},
                   .clicked = [&painting] { painting.undo(); },
                   .drawn = [&context] { context.ui_probe.note_item("own body/undo"); }});
  items.push_back({.button = {.id = "redo",
                              .icon = image_icon::redo,
                              .tooltip = "Bring it back (Ctrl + Y)",
                              .enabled = painting.can_redo()},
                   .clicked = [&painting] { painting.redo(); },
                   .drawn = [&context] { context.ui_probe.note_item("own body/redo"); }});
}

void OwnBodyView::draw_toolbar_of(const ViewContext& context, OwnBodySession& session) {
  std::vector<ToolbarItem> items{
      look_button(context, "Paint", "The mask over the footage", Mode::paint),
      look_button(context, "Mask", "The mask alone: white hides", Mode::mask),
      look_button(context, "Confidence", "How sure the detection is of each pixel", Mode::confidence),
      look_button(context, "Stages", "Every step of the detection", Mode::stages)};
  if (paints() && session.fits()) add_brush_items(items, context, session.painting());
  const bool is_grid = look_ == Mode::stages;
  const ZoomableImage& look = is_grid ? grid_.look() : canvas_.look();
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "fit",
                              .icon = image_icon::fit,
                              .label = "Fit",
                              .tooltip = "The whole image (F or 0)",
                              .on = look.is_fitted()},
                   .clicked = [this, is_grid] { is_grid ? grid_.fit() : canvas_.look().fit(); }});
  items.push_back({.button = {.id = "exact",
                              .label = "1:1",
                              .tooltip = "One pixel of the screen for each of the image (1)",
                              .on = look.zoom() == 1},
                   .clicked = [this, is_grid] {
                     if (is_grid)
                       grid_.zoom_to_exact();
                     else
                       canvas_.look().zoom_to(1, canvas_.look().room_px() / 2.0);
                   }});
  draw_toolbar(items);
}

void OwnBodyView::draw_stages(const ViewContext& context, const OwnBodySession& session, const ScreenRect& rect) {
  const std::shared_ptr<const OwnBody>& found = session.detection().value;
  const std::vector<StageTile> tiles = found ? stage_tiles(*found) : std::vector<StageTile>();
  context.ui_probe.note("own body/stages", rect);
  if (!tiles.empty()) {
    if (grid_.handle_escape()) context.needs.own_escape = true;
    grid_.draw(tiles, found->mask.size(), rect, context.textures);
    return;
  }
  const ImageCanvas canvas{*ImGui::GetWindowDrawList(), rect, {}, {}};
  draw_label(canvas, {rect.low.x + scaled(8), rect.high.y - scaled(8)}, "Nothing is detected yet. Detect first.",
             color::kPartly);
}

void OwnBodyView::draw_image_of(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect) {
  switch (look_) {
    case Mode::paint:
      return canvas_.draw(context, session, rect, CanvasMode::over_footage);
    case Mode::mask:
      return canvas_.draw(context, session, rect, CanvasMode::mask_alone);
    case Mode::confidence:
      return canvas_.draw(context, session, rect, CanvasMode::confidence);
    case Mode::stages:
      return draw_stages(context, session, rect);
  }
}

// As in every program with several panels: undo counts where the last press was. A dialog in between is no other place.
// Where strokes cannot be seen none is taken back, nor anything else.
void OwnBodyView::handle_undo(const ViewContext& context, MaskPainting& painting, const ScreenRect& worked_in) {
  const ImGuiIO& io = ImGui::GetIO();
  if (std::exchange(last_update_, ImGui::GetFrameCount()) != ImGui::GetFrameCount() - 1) is_worked_in_ = false;
  for (int button = 0; button < 3; ++button)
    if (ImGui::IsMouseClicked(button) && !any_popup_open()) is_worked_in_ = worked_in.contains(dv(io.MousePos));
  if (!is_worked_in_) return;
  context.needs.own_undo = true;
  if (!paints() || io.WantTextInput || any_popup_open() || !io.KeyCtrl || io.KeyAlt) return;
  if (pressed(Key::z, true)) io.KeyShift ? painting.redo() : painting.undo();
  if (pressed(Key::y, true)) painting.redo();
}

void OwnBodyView::draw(const ViewContext& context, OwnBodySession& session) {
  ImGui::PushID("own body");
  session.follow(context.document, context.shown.scene.get());
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float panel = std::floor(std::min(scaled(kPanel), room.x * 0.45F));
  const float left = room.x - panel - scaled(1);
  const glm::dvec2 corner = glm::round(dv(ImGui::GetCursorScreenPos()));

  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("image", {left, room.y}, false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  handle_undo(context, session.painting(), {corner, corner + glm::dvec2(left, room.y)});
  draw_toolbar_of(context, session);
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  const glm::dvec2 size(left, std::max(1.0F, room.y - toolbar_height() - readout_height()));
  draw_image_of(context, session, {low, low + glm::max(glm::floor(size), 1.0)});
  ImGui::SetCursorScreenPos(im({low.x, low.y + std::max(1.0, std::floor(size.y))}));
  ImGui::BeginChild("readout");
  if (look_ != Mode::stages) canvas_.draw_readout(session);
  ImGui::EndChild();
  ImGui::EndChild();
  ImGui::PopStyleVar();

  ImGui::SameLine(0, scaled(1));
  ImGui::PushStyleColor(ImGuiCol_ChildBg, color::kPanel);
  ImGui::BeginChild("panel", {panel, room.y}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  if (panel_.draw(context, session)) is_worked_in_ = true;
  ImGui::EndChild();
  ImGui::PopStyleColor();
  ImGui::PopID();
}

}  // namespace sigs::editor
