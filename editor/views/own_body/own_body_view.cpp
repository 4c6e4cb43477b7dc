// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"
#include "editor/views/viewport/viewport_view.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

// The middle of the screen's pixel that the mouse is on.
glm::dvec2 mouse_on_screen() {
  return glm::floor(dv(ImGui::GetMousePos())) + 0.5;
}

// A plus or a minus, dark around light: seen on sky and ground alike.
void draw_sign(ImDrawList& draw, const glm::dvec2& at, bool minus, ImU32 color) {
  const double arm = scaled(3.5);
  for (const auto& [ink, width] : {std::pair(IM_COL32(0, 0, 0, 170), scaled(3)), std::pair(color, scaled(1.3))}) {
    draw.AddLine(im(at - glm::dvec2(arm, 0)), im(at + glm::dvec2(arm, 0)), ink, width);
    if (!minus) draw.AddLine(im(at - glm::dvec2(0, arm)), im(at + glm::dvec2(0, arm)), ink, width);
  }
}

constexpr double kPanel = 290;  // wide, where the text is 15 px high
constexpr double kRadius = 120;
constexpr const char* kNothingDetected = "Nothing is detected yet. Detect first.";

}  // namespace

Brush OwnBodyCanvas::brush(const ViewContext& context) const {
  return {.radius_px = radius_px_,
          .edge_px = context.project().own_body.soft_edge_px,
          .erases = erases_ != ImGui::GetIO().KeyShift};
}

void OwnBodyCanvas::handle_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!hovered_ || io.WantTextInput || io.KeyCtrl || io.KeyAlt) return;
  if (pressed(Key::b)) erases_ = false;
  if (pressed(Key::e)) erases_ = true;
  if (pressed(Key::left_bracket, true)) radius_px_ = stepped_radius_px(radius_px_, -1);
  if (pressed(Key::right_bracket, true)) radius_px_ = stepped_radius_px(radius_px_, 1);
}

void OwnBodyCanvas::handle_mouse(const ViewContext& context, OwnBodySession& session, const ImageCanvas& canvas,
                                 bool paints) {
  MaskPainting& painting = session.painting();
  const glm::dvec2 place = canvas.view.image_of(mouse_on_screen());
  if (ImGui::IsItemActivated()) {
    pans_ = !paints || ImGui::IsMouseClicked(ImGuiMouseButton_Middle);
    if (pans_)
      look_.begin_pan();
    else
      painting.begin_stroke(brush(context), place);
  }
  if (!ImGui::IsItemActive()) return painting.end_stroke();
  const auto button = ImGui::IsMouseDown(ImGuiMouseButton_Middle) ? ImGuiMouseButton_Middle : ImGuiMouseButton_Left;
  if (pans_) look_.pan(dv(ImGui::GetMouseDragDelta(button, 0)));
  if (pressed(Key::escape)) painting.take_back_stroke();
  painting.extend_stroke(place);
}

void OwnBodyCanvas::draw(const ViewContext& context, OwnBodySession& session, const ScreenRect& rect, CanvasMode look) {
  const cv::Size size = session.painting().empty() ? session.footage_px() : session.painting().mask().size();
  look_.lay_out(size, rect.size());
  ImGui::SetCursorScreenPos(im(rect.low));
  ImGui::InvisibleButton("own body canvas", im(glm::max(rect.size(), 1.0)),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  hovered_ = ImGui::IsItemHovered();
  context.ui_probe.note_item("own body/canvas");
  const bool paints = look != CanvasMode::confidence && session.fits();
  if (hovered_ && !session.painting().is_stroking()) handle_zoom_input(look_, rect.low);
  handle_keys();
  const ImageCanvas before{*ImGui::GetWindowDrawList(), rect, look_.view(rect.low), size};
  handle_mouse(context, session, before, paints);
  const ImageCanvas canvas{before.draw, rect, look_.view(rect.low), size};
  pixel_ = hovered_ ? canvas.pixel_at(dv(ImGui::GetMousePos())) : std::nullopt;
  context.ui_probe.note("own body/image", canvas.image_on_screen());
  draw_layers(context, session, canvas, look);
  if (paints && (hovered_ || session.painting().is_stroking())) draw_brush(context, canvas);
}

void OwnBodyCanvas::draw_layers(const ViewContext& context, const OwnBodySession& session, const ImageCanvas& canvas,
                                CanvasMode look) {
  const bool footage_alone = hovered_ && !ImGui::GetIO().WantTextInput && held(Key::backslash);
  const ShownImage* const footage = context.shown.footage.get();
  context.needs.footage = true;
  canvas.draw.AddRectFilled(im(canvas.rect.low), im(canvas.rect.high), color::kCanvas);
  if (footage != nullptr && session.fits())
    draw_image(canvas.draw, context.textures, *footage, canvas.view, canvas.rect);
  if (!footage_alone && look == CanvasMode::confidence) draw_confidence(context, session, canvas);
  if (!footage_alone && look != CanvasMode::confidence && !session.painting().empty())
    tiles_.draw(canvas, context.textures, session.painting().mask(),
                look == CanvasMode::mask_alone ? MaskStyle::alone : MaskStyle::tint);
  draw_pixel_grid(canvas);
}

void OwnBodyCanvas::draw_confidence(const ViewContext& context, const OwnBodySession& session,
                                    const ImageCanvas& canvas) {
  const std::shared_ptr<const OwnBody>& found = session.detection().value;
  if (!found || found->confidence.size() != canvas.image_px)
    return draw_corner_label(canvas, kNothingDetected, color::kPartly);
  if (shown_confidence_of_ != found) confidence_ = confidence_image(found->confidence);
  shown_confidence_of_ = found;
  draw_image(canvas.draw, context.textures, confidence_, canvas.view, canvas.rect);
  draw_corner_label(canvas, "blue: world    grey: nobody can tell    violet: own body", color::kText);
}

void OwnBodyCanvas::draw_brush(const ViewContext& context, const ImageCanvas& canvas) const {
  const Brush now = brush(context);
  const glm::dvec2 at = mouse_on_screen();
  const auto radius = static_cast<float>(std::max(1.0, now.radius_px * canvas.view.zoom));
  const ImU32 ink = now.erases ? color::kText : faded(color::kOwnBody, 1);
  ImGui::SetMouseCursor(ImGuiMouseCursor_None);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  canvas.draw.AddCircle(im(at), radius, IM_COL32(0, 0, 0, 170), 0, scaled(3));
  canvas.draw.AddCircle(im(at), radius, ink, 0, scaled(1.3));
  const bool has_room = radius > scaled(9);
  draw_sign(canvas.draw, has_room ? at : at + glm::dvec2(radius + scaled(7), radius + scaled(7)), now.erases, ink);
  canvas.draw.PopClipRect();
}

void OwnBodyCanvas::draw_readout(const OwnBodySession& session) const {
  const ImFont& mono = *font(Font::mono);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(low, {low.x + size.x, low.y + size.y}, color::kPanel);
  const float y = std::round(low.y + (size.y - mono.FontSize) / 2);
  const cv::Mat& mask = session.painting().mask();
  std::string left;
  if (pixel_ && cv::Rect({0, 0}, mask.size()).contains(*pixel_)) {
    left = fmt::format("x {:4}  y {:4}   mask {:3.0f}%", pixel_->x, pixel_->y, mask.at<uchar>(*pixel_) / 2.55);
    const std::shared_ptr<const OwnBody>& found = session.detection().value;
    if (found && found->confidence.size() == mask.size())
      left += fmt::format("   confidence {:3.0f}%", found->confidence.at<ushort>(*pixel_) / 655.35);
  }
  draw.AddText(&mono, mono.FontSize, {low.x + scaled(10), y}, color::kText, left.c_str());
  const std::string right = fmt::format("{:.0f}%   {}", look_.zoom() * 100, image_size_text(mask.size(), " x "));
  const float width = mono.CalcTextSizeA(mono.FontSize, 1e6F, 0, right.c_str()).x;
  const float used = mono.CalcTextSizeA(mono.FontSize, 1e6F, 0, left.c_str()).x + scaled(30);
  if (used + width < size.x)
    draw.AddText(&mono, mono.FontSize, {low.x + size.x - width - scaled(10), y}, color::kQuiet, right.c_str());
}

ToolbarItem OwnBodyView::look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look) {
  ToolbarItem item =
      choice_item({.id = label, .label = label, .tooltip = tooltip}, look_, look, [this] { grid_.show_all(); });
  item.drawn = [&context, label] { context.ui_probe.note_item(std::string("own body/look ") + label); };
  return item;
}

void OwnBodyView::draw_radius(const ViewContext& context) {
  auto radius = static_cast<float>(canvas_.radius_px());
  ImGui::SetNextItemWidth(scaled(kRadius));
  if (context.ui_probe.noted(
          ImGui::DragFloat("##radius", &radius, std::max(0.05F, radius * 0.01F), static_cast<float>(kMinRadius_px),
                           static_cast<float>(kMaxRadius_px), radius < 10 ? "radius %.1f px" : "radius %.0f px",
                           ImGuiSliderFlags_AlwaysClamp),
          "own body/radius",
          "Radius of the brush in the footage's pixels ([ and ]); its edge is as soft as the setting says"))
    canvas_.set_radius_px(radius);
}

void OwnBodyView::add_brush_items(std::vector<ToolbarItem>& items, const ViewContext& context, MaskPainting& painting) {
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "add",
                              .icon = Icon::brush,
                              .label = "Add",
                              .tooltip = "Paint what belongs to the own body (B). With Shift: the other brush",
                              .on = !canvas_.erases()},
                   .clicked = [this] { canvas_.set_erases(false); }});
  items.push_back({.button = {.id = "erase",
                              .icon = Icon::eraser,
                              .label = "Erase",
                              .tooltip = "Paint what does not (E). With Shift: the other brush",
                              .on = canvas_.erases()},
                   .clicked = [this] { canvas_.set_erases(true); }});
  items.push_back({.width = scaled(kRadius), .content = [this, &context] { draw_radius(context); }});
  items.push_back({.is_gap = true});
  items.push_back({.button = {.id = "undo",
                              .icon = Icon::undo,
                              .tooltip = "Take the last stroke back (Ctrl + Z)",
                              .enabled = painting.can_undo()},
                   .clicked = [&painting] { painting.undo(); },
                   .drawn = [&context] { context.ui_probe.note_item("own body/undo"); }});
  items.push_back({.button = {.id = "redo",
                              .icon = Icon::redo,
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
  const auto to_exact = [this, is_grid] {
    if (is_grid)
      grid_.zoom_to_exact();
    else
      canvas_.look().zoom_to(1, canvas_.look().room_px() / 2.0);
  };
  add_zoom_items(items, {.is_fitted = look.is_fitted(),
                         .zoom = look.zoom(),
                         .fit = [this, is_grid] { is_grid ? grid_.fit() : canvas_.look().fit(); },
                         .to_exact = to_exact});
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
  draw_corner_label({*ImGui::GetWindowDrawList(), rect, {}, {}}, kNothingDetected, color::kPartly);
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
