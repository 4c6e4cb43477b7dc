// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_canvas.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "editor/views/own_body/own_body_images.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"

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

template <class... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), format, numbers...);
  return text.data();
}

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
  if (!ImGui::IsItemActive()) {
    painting.end_stroke();
    return;
  }
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
  const cv::Mat* const footage = context.shown.footage.get();
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
  if (!found || found->confidence.size() != canvas.image_px) {
    draw_label(canvas, {canvas.rect.low.x + scaled(8), canvas.rect.high.y - scaled(8)},
               "Nothing is detected yet. Detect first.", color::kPartly);
    return;
  }
  if (shown_confidence_of_ != found) confidence_ = confidence_image(found->confidence);
  shown_confidence_of_ = found;
  draw_image(canvas.draw, context.textures, confidence_, canvas.view, canvas.rect);
  draw_label(canvas, {canvas.rect.low.x + scaled(8), canvas.rect.high.y - scaled(8)},
             "blue: world    grey: nobody can tell    violet: own body", color::kText);
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
    left = formatted("x %4d  y %4d   mask %3.0f%%", pixel_->x, pixel_->y, mask.at<uchar>(*pixel_) / 2.55);
    const std::shared_ptr<const OwnBody>& found = session.detection().value;
    if (found && found->confidence.size() == mask.size())
      left += formatted("   confidence %3.0f%%", found->confidence.at<ushort>(*pixel_) / 655.35);
  }
  draw.AddText(&mono, mono.FontSize, {low.x + scaled(10), y}, color::kText, left.c_str());
  const std::string right = formatted("%.0f%%   %d x %d", look_.zoom() * 100, mask.cols, mask.rows);
  const float width = mono.CalcTextSizeA(mono.FontSize, 1e6F, 0, right.c_str()).x;
  const float used = mono.CalcTextSizeA(mono.FontSize, 1e6F, 0, left.c_str()).x + scaled(30);
  if (used + width < size.x)
    draw.AddText(&mono, mono.FontSize, {low.x + size.x - width - scaled(10), y}, color::kQuiet, right.c_str());
}

}  // namespace sigs::editor
