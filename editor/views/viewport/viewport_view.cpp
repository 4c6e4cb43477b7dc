// SPDX-License-Identifier: MIT
#include "editor/views/viewport/viewport_view.h"

#include <imgui.h>

#include <cmath>

#include "editor/views/results/result_boxes.h"
#include "editor/views/viewport/readout.h"
#include "editor/views/viewport/toolbar.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

// Of what is shown, else of what will be; nothing until a scene is open.
cv::Size picture_size(const Studio& studio) {
  if (studio.shown.picture && !studio.shown.picture->bgr.empty()) return studio.shown.picture->bgr.size();
  return studio.shown.scene ? studio.shown.scene->draft.scene.footage.size_px : cv::Size();
}

// Overlays lie on what is seen: while it plays that may be a frame behind.
int frame_of_overlays(const Studio& studio) {
  return studio.playing && studio.shown.picture ? studio.shown.picture->frame : studio.document.playhead();
}

}  // namespace

void ViewportView::draw(const Studio& studio) {
  ImGui::PushID("viewport");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  tool_.select_again(studio);
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const glm::dvec2 room(all.x, std::max(1.0F, all.y - toolbar_height() - readout_height()));
  draw_viewport_toolbar({overlays_, wipe_, look_});
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  draw_canvas(studio, {low, low + glm::max(glm::floor(room), 1.0)});
  ImGui::SetCursorScreenPos(im({low.x, low.y + std::max(1.0, std::floor(room.y))}));
  // In a panel of its own: when the mouse moves, its text alone is drawn anew.
  ImGui::BeginChild("readout");
  draw_readout(studio, {.pixel = pixel_, .of_footage = over_footage_, .zoom = look_.zoom()});
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopID();
}

void ViewportView::draw_canvas(const Studio& studio, const ScreenRect& rect) {
  const cv::Size size = picture_size(studio);
  look_.lay_out(size, rect.size());
  banner_.take_mouse(rect, problems_of(studio, studio.shown.picture.get()));
  ImGui::SetCursorScreenPos(im(rect.low));
  ImGui::InvisibleButton(
      "footage", im(rect.size()),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  hovered_ = ImGui::IsItemHovered();
  const bool pressed_here = ImGui::IsItemActivated();
  if (hovered_ && take_zoom_input(look_, rect.low)) grip_ = grip_ == Grip::ground ? Grip::nothing : grip_;
  footage_alone_ = hovered_ && !ImGui::GetIO().WantTextInput && held(Key::backslash);

  const PictureCanvas canvas{*ImGui::GetWindowDrawList(), rect, look_.view(rect.low), size};
  studio.places.note("viewport", rect);
  studio.places.note("viewport/picture", canvas.picture_on_screen());
  const std::optional<FootageEye> eye = eye_at(studio, frame_of_overlays(studio));
  const std::vector<WaypointMark> none;
  const std::vector<WaypointMark>& marks = eye && overlays_.waypoints ? marks_.of(studio, *eye) : none;
  std::optional<ToolTurn> turn;
  if (eye) turn.emplace(ToolTurn{studio, canvas, *eye, marks, dv(ImGui::GetMousePos())});
  const ToolTurn* const tools = turn ? &*turn : nullptr;
  if (pressed_here) take_press(canvas, tools);
  take_mouse(studio, canvas, tools);
  draw_menu(studio, canvas, tools);

  pixel_ = hovered_ ? canvas.pixel_at(dv(ImGui::GetMousePos())) : std::nullopt;
  over_footage_ = footage_alone_ || wipe_.is_left_of_line(canvas, dv(ImGui::GetMousePos()));
  draw_picture_layers(studio, canvas);
  draw_overlays(studio, canvas, tools, marks);
  if (tools != nullptr) tool_.draw(*tools);
  wipe_.draw_line(canvas, grip_ == Grip::line || (hovered_ && wipe_.is_at(canvas, dv(ImGui::GetMousePos()))));
  banner_.draw(canvas.draw);
}

void ViewportView::draw_picture_layers(const Studio& studio, const PictureCanvas& canvas) {
  const Picture* const picture = studio.shown.picture.get();
  const ScreenRect whole = canvas.picture_on_screen();
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  if (picture == nullptr || picture->bgr.empty())
    canvas.draw.AddRectFilled(im(whole.low), im(whole.high), IM_COL32(58, 60, 66, 255));
  else
    draw_picture(canvas.draw, studio.textures, picture->bgr, canvas.view, canvas.rect);
  if (canvas.picture_px.empty() || (picture == nullptr && studio.shown.busy)) draw_opening(canvas.rect, studio);
  wipe_.draw_footage(canvas, studio, footage_alone_);
  canvas.draw.PopClipRect();
}

void ViewportView::draw_opening(const ScreenRect& rect, const Studio& studio) const {
  const char* const text = studio.shown.scene ? "Making the picture..." : "Opening the project...";
  const glm::dvec2 at = glm::floor((rect.low + rect.high - dv(ImGui::CalcTextSize(text))) / 2.0);
  ImGui::GetWindowDrawList()->AddText(im(at), color::kQuiet, text);
}

void ViewportView::draw_overlays(const Studio& studio, const PictureCanvas& canvas, const ToolTurn* turn,
                                 std::span<const WaypointMark> marks) {
  const FootageEye* const eye = turn != nullptr ? &turn->eye : nullptr;
  if (overlays_.own_body && studio.shown.scene)
    own_body_.draw(canvas, studio.textures, studio.shown.scene->draft.scene.own_body);
  draw_pixel_grid(canvas);
  const Picture* const picture = studio.shown.picture.get();
  const cv::Mat* const values = footage_alone_       ? studio.shown.footage.get()
                                : picture != nullptr ? &picture->bgr
                                                     : nullptr;
  if (values != nullptr) draw_pixel_values(canvas, *values, dv(ImGui::GetMousePos()));
  draw_picture_grid(canvas, overlays_.grid);
  if (footage_alone_) return;
  PictureLabels labels;
  keep_waypoints_free(canvas, studio, marks, labels);
  if (overlays_.horizon && turn != nullptr)
    horizon_.draw(*turn, grip_ == Grip::horizon || (hovered_ && horizon_.part_at(*turn)), labels);
  if (overlays_.path && eye != nullptr) path_.draw(canvas, studio, *eye);
  if (overlays_.box && picture != nullptr) {
    draw_boxes(canvas, studio, *picture, labels);
    draw_result_boxes(canvas, studio, picture->frame);
    draw_result_legend(canvas, studio, picture->frame);
  }
  if (eye != nullptr) draw_waypoints(canvas, studio, marks, *eye, labels);
}

}  // namespace sigs::editor
