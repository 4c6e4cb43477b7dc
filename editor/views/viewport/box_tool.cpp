// SPDX-License-Identifier: MIT
#include "editor/views/viewport/box_tool.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

constexpr double kMinLit_px = 3;

// Of the footage, that is seen: the newest image may still be that of another frame than the playhead's.
int seen_frame(const ViewContext& context) {
  return context.shown.image ? context.shown.image->frame : footage_frame(context);
}

// One line below the other, in the upper left of the image.
void draw_lines_of_help(const ImageCanvas& canvas, std::span<const char* const> lines) {
  glm::dvec2 at = canvas.rect.low + static_cast<double>(scaled(12));
  for (const char* const line : lines) {
    at.y += label_size(line).y;
    draw_label(canvas, at, line, color::kText);
  }
}

}  // namespace

void BoxTool::ask_for_real_aircraft(const ViewContext& context, std::optional<std::string> label) {
  if (!context.document.has_file()) {
    context.edits.ask(ShowMessage{"Save the project first (Ctrl + S): boxes are kept in a file beside it"});
    return;
  }
  wanted_ = Wanted{
      .is_real = true, .label = label ? *std::move(label) : real_aircraft_.new_label(), .from_px = {}, .to_px = {}};
}

void BoxTool::follow(const ViewContext& context) {
  if (real_aircraft_.follow(context.document)) {
    wanted_.reset();
    is_worked_in_ = false;
  }
  for (int button = 0; button < 3; ++button)
    if (ImGui::IsMouseClicked(button) && !any_popup_open()) is_worked_in_ = false;
  const ImGuiIO& io = ImGui::GetIO();
  if ((!is_worked_in_ && !is_marking()) || io.WantTextInput || any_popup_open()) return;
  context.needs.own_undo = true;
  if (!io.KeyCtrl || io.KeyAlt) return;
  const bool redoes = pressed(Key::y, true);
  if (!pressed(Key::z, true) && !redoes) return;
  tell(context, redoes || io.KeyShift ? real_aircraft_.redo(context.document, context.edits)
                                      : real_aircraft_.undo(context.document, context.edits));
}

void BoxTool::tell(const ViewContext& context, const Result<void>& changed) {
  is_worked_in_ = true;
  if (!changed) context.edits.ask(ShowMessage{changed.error().text(), true});
}

void BoxTool::press(const ImageCanvas& canvas, const glm::dvec2& mouse) {
  wanted_->from_px = wanted_->to_px = canvas.view.image_of(mouse);
}

void BoxTool::drag(const ViewContext& context, const ImageCanvas& canvas, bool hovered, bool down) {
  context.needs.own_escape = true;
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (pressed(Key::escape)) return wanted_.reset();
  if (!wanted_->from_px) return;
  wanted_->to_px = canvas.view.image_of(dv(ImGui::GetMousePos()));
  if (down) return;
  const glm::dvec2 low = glm::min(*wanted_->from_px, *wanted_->to_px);
  const glm::dvec2 size = glm::abs(*wanted_->to_px - *wanted_->from_px);
  take_box(context, canvas, {low.x, low.y, size.x, size.y});
}

void BoxTool::take_box(const ViewContext& context, const ImageCanvas& canvas, const Box& box) {
  if (!is_marking()) {
    wanted_.reset();
    if (box.width >= kMinLit_px && box.height >= kMinLit_px) context.edits.ask(LightLike{footage_frame(context), box});
    return;
  }
  wanted_->from_px.reset();
  wanted_->to_px.reset();
  const bool is_click = std::max(box.width, box.height) * canvas.view.zoom < static_cast<double>(scaled(3));
  if (is_click || !context.shown.scene) return;
  const FootageShape& footage = context.shown.scene->draft.scene.footage;
  tell(context, real_aircraft_.mark(context.document, context.edits, wanted_->label, seen_frame(context), box,
                                    {footage.size_px, static_cast<int>(footage.times_s.size())}));
}

void BoxTool::draw(const ViewContext& context, const ImageCanvas& canvas) const {
  if (!wanted_) return;
  if (wanted_->is_real) {
    constexpr std::array kLines{"Drag a box around a real aircraft; go to another frame and drag again:",
                                "frames between are filled; Esc ends this"};
    draw_lines_of_help(canvas, kLines);
  } else {
    constexpr std::array kLines{
        "Drag a box around something lit in the footage, such as a real aircraft; Esc ends this"};
    draw_lines_of_help(canvas, kLines);
  }
  context.ui_probe.note(wanted_->is_real ? "viewport/real aircraft box" : "viewport/lit box", canvas.rect);
  if (!wanted_->from_px) return;
  const glm::dvec2 a = canvas.view.screen_of(*wanted_->from_px), b = canvas.view.screen_of(*wanted_->to_px);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  canvas.draw.AddRect(im(glm::min(a, b)), im(glm::max(a, b)), wanted_->is_real ? color::kRealAircraft : color::kAccent,
                      0, 0, scaled(1.5F));
  canvas.draw.PopClipRect();
}

void BoxTool::draw_real_aircraft(const ViewContext& context, const ImageCanvas& canvas, LabelPlacer& labels) const {
  const RealAircraftBoxes& boxes = real_aircraft_.boxes();
  for (const RealAircraftBox& box : boxes_of_frame(boxes, seen_frame(context))) {
    const ScreenRect outer = canvas.on_screen(box.box);
    context.ui_probe.note("viewport/real/" + box.label, outer);
    draw_outline(canvas, outer, color::kRealAircraft, is_filled(boxes, static_cast<std::size_t>(&box - boxes.data())));
    const std::string text = "real " + shortened(box.label, 40);
    const double above = outer.low.y - scaled(4);
    const std::array places{glm::dvec2(outer.low.x, outer.high.y + scaled(4) + label_size(text).y),
                            glm::dvec2(outer.low.x, above), glm::dvec2(outer.low.x, above - label_size(text).y - 1)};
    draw_label(canvas, labels, places, text, color::kRealAircraft, true);
  }
}

void BoxTool::open_menu(const ViewContext& context, const ImageCanvas& canvas, const glm::dvec2& pixel,
                        bool are_shown) {
  menu_box_.reset();
  if (!are_shown) return;
  const double reach = static_cast<double>(scaled(4)) / canvas.view.zoom;  // small ones are not easily hit
  for (const RealAircraftBox& box : boxes_of_frame(real_aircraft_.boxes(), seen_frame(context))) {
    const auto& [x, y, width, height] = box.box;
    const bool is_there =
        pixel.x >= x - reach && pixel.x <= x + width + reach && pixel.y >= y - reach && pixel.y <= y + height + reach;
    if (is_there && (!menu_box_ || width * height < menu_box_->box.width * menu_box_->box.height)) menu_box_ = box;
  }
}

void BoxTool::draw_menu(const ViewContext& context) {
  if (!menu_box_) return;
  const std::string& label = menu_box_->label;
  UiProbe& probe = context.ui_probe;
  ImGui::TextDisabled("Real %s", shortened(label, 40).c_str());
  if (probe.noted(ImGui::MenuItem("Mark it in another frame...", nullptr, false, real_aircraft_.is_track(label)),
                  "viewport/menu/mark it again"))
    ask_for_real_aircraft(context, label);
  if (probe.noted(ImGui::MenuItem("Delete this box"), "viewport/menu/delete box"))
    tell(context, real_aircraft_.remove(context.document, context.edits, *menu_box_));
  if (probe.noted(ImGui::MenuItem("Delete it in all frames"), "viewport/menu/delete real aircraft"))
    tell(context, real_aircraft_.remove_all(context.document, context.edits, label));
  ImGui::Separator();
}

}  // namespace sigs::editor
