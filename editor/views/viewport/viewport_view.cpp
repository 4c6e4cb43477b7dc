// SPDX-License-Identifier: MIT
#include "editor/views/viewport/viewport_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/views/results/results_view.h"
#include "editor/views/viewport/cameras_view.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

// Of what is shown, else of what will be; nothing until a scene is open.
cv::Size image_size(const ViewContext& context) {
  if (context.shown.image && !context.shown.image->bgr.empty()) return context.shown.image->bgr.size();
  return context.shown.scene ? context.shown.scene->draft.scene.footage.size_px : cv::Size();
}

// Overlays lie on what is seen: while it plays that may be a frame behind.
}  // namespace

void ViewportView::draw(const ViewContext& context) {
  ImGui::PushID("viewport");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  tool_.select_again(context);
  boxes_.follow(context);
  if (boxes_.is_marking()) overlays_.real_aircraft = true;
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const glm::dvec2 room(all.x, std::max(1.0F, all.y - toolbar_height() - readout_height()));
  draw_toolbar_row();
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  draw_canvas(context, {low, low + glm::max(glm::floor(room), 1.0)});
  ImGui::SetCursorScreenPos(im({low.x, low.y + std::max(1.0, std::floor(room.y))}));
  // In a panel of its own: when the mouse moves, its text alone is drawn anew.
  ImGui::BeginChild("readout");
  draw_readout(context, {.pixel = pixel_, .of_footage = over_footage_, .zoom = look_.zoom()});
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopID();
}

void ViewportView::draw_canvas(const ViewContext& context, const ScreenRect& rect) {
  const cv::Size size = image_size(context);
  look_.lay_out(size, rect.size());
  banner_.handle_mouse(rect, problems_of(context, context.shown.image.get()));
  ImGui::SetCursorScreenPos(im(rect.low));
  ImGui::InvisibleButton(
      "footage", im(rect.size()),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  hovered_ = ImGui::IsItemHovered();
  const bool pressed_here = ImGui::IsItemActivated();
  if (hovered_ && handle_zoom_input(look_, rect.low)) grip_ = grip_ == Grip::ground ? Grip::nothing : grip_;
  footage_alone_ = hovered_ && !ImGui::GetIO().WantTextInput && held(Key::backslash);

  const ImageCanvas canvas{*ImGui::GetWindowDrawList(), rect, look_.view(rect.low), size};
  context.ui_probe.note("viewport", rect);
  context.ui_probe.note("viewport/image", canvas.image_on_screen());
  const std::optional<FootageCamera> eye = footage_camera_at(context, frame_of_overlays(context));
  const std::vector<WaypointMark> none;
  const std::vector<WaypointMark>& marks = eye && overlays_.waypoints ? marks_.of(context, *eye) : none;
  std::optional<ToolContext> tool;
  if (eye) tool.emplace(ToolContext{context, canvas, *eye, marks, dv(ImGui::GetMousePos())});
  const ToolContext* const tools = tool ? &*tool : nullptr;
  if (pressed_here) handle_press(canvas, tools);
  handle_mouse(context, canvas, tools);
  draw_menu(context, canvas, tools);

  pixel_ = hovered_ ? canvas.pixel_at(dv(ImGui::GetMousePos())) : std::nullopt;
  over_footage_ = footage_alone_ || wipe_.is_left_of_line(canvas, dv(ImGui::GetMousePos()));
  draw_image_layers(context, canvas);
  draw_overlays(context, canvas, tools, marks);
  if (tools != nullptr) tool_.draw(*tools);
  boxes_.draw(context, canvas);
  wipe_.draw_line(canvas, grip_ == Grip::line || (hovered_ && wipe_.is_at(canvas, dv(ImGui::GetMousePos()))));
  banner_.draw(canvas.draw);
}

void ViewportView::draw_image_layers(const ViewContext& context, const ImageCanvas& canvas) {
  const PreviewImage* const image = context.shown.image.get();
  const ScreenRect whole = canvas.image_on_screen();
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  if (image == nullptr || image->bgr.empty())
    canvas.draw.AddRectFilled(im(whole.low), im(whole.high), IM_COL32(58, 60, 66, 255));
  else
    draw_image(canvas.draw, context.textures, image->bgr, canvas.view, canvas.rect);
  if (canvas.image_px.empty() || (image == nullptr && context.shown.busy)) draw_opening(canvas.rect, context);
  wipe_.draw_footage(canvas, context, footage_alone_);
  draw_brighter(canvas.draw, im(whole.low), im(whole.high), overlays_.doublings);
  canvas.draw.PopClipRect();
}

void ViewportView::draw_opening(const ScreenRect& rect, const ViewContext& context) const {
  const char* const text = context.shown.scene ? "Making the image..." : "Opening the project...";
  const glm::dvec2 at = glm::floor((rect.low + rect.high - dv(ImGui::CalcTextSize(text))) / 2.0);
  ImGui::GetWindowDrawList()->AddText(im(at), color::kQuiet, text);
}

void ViewportView::draw_overlays(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool,
                                 std::span<const WaypointMark> marks) {
  const FootageCamera* const eye = tool != nullptr ? &tool->eye : nullptr;
  if (overlays_.own_body && context.shown.scene)
    own_body_.draw(canvas, context.textures, context.shown.scene->draft.scene.own_body);
  if (overlays_.own_body) clouds_.draw(canvas, context.textures, clouds_of_frame(context));
  draw_pixel_grid(canvas);
  const PreviewImage* const image = context.shown.image.get();
  draw_pixel_values(canvas, watched_image(context, footage_alone_), dv(ImGui::GetMousePos()));
  draw_image_grid(canvas, overlays_.grid);
  if (footage_alone_) return;
  if (const std::string text = not_filming_text(context.shown, context.document.playhead()); !text.empty())
    draw_label(canvas, glm::dvec2(canvas.rect.low.x, canvas.rect.high.y) + glm::dvec2(scaled(12), -scaled(12)), text,
               color::kPartly);
  LabelPlacer labels;
  keep_waypoints_free(canvas, context, marks, labels);
  if (overlays_.horizon && tool != nullptr)
    horizon_.draw(*tool, grip_ == Grip::horizon || (hovered_ && horizon_.part_at(*tool)), labels);
  if (overlays_.path && eye != nullptr) path_.draw(canvas, context, *eye);
  if (overlays_.box && image != nullptr) {
    draw_boxes(canvas, context, *image, labels);
    if (context.document.active_camera() == 0) {  // of whose footage results are
      draw_result_boxes(canvas, context, image->frame);
      draw_result_legend(canvas, context, image->frame);
    }
  }
  if (overlays_.real_aircraft) boxes_.draw_real_aircraft(context, canvas, labels);
  if (eye != nullptr) draw_waypoints(canvas, context, marks, *eye, labels, "viewport");
}

void ViewportView::handle_press(const ImageCanvas& canvas, const ToolContext* tool) {
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  grip_mouse_ = mouse;
  grip_ = Grip::nothing;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
    grip_ = Grip::ground;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    const bool on_waypoint = tool != nullptr && waypoint_at(*tool) != nullptr;
    if (boxes_.is_wanted()) {
      grip_ = Grip::box;
      boxes_.press(canvas, mouse);
    } else if (!on_waypoint && wipe_.is_at(canvas, mouse))
      grip_ = Grip::line;
    else
      grip_ = grip_of_press(tool);
  }
  if (grip_ == Grip::ground) look_.begin_pan();
}

// Waypoints lie over the horizon, which lies over intruders' boxes.
ViewportView::Grip ViewportView::grip_of_press(const ToolContext* tool) {
  if (tool == nullptr) return Grip::ground;
  const bool on_waypoint = waypoint_at(*tool) != nullptr;
  if (overlays_.horizon && !on_waypoint && horizon_.press(*tool)) return Grip::horizon;
  return tool_.press(*tool) ? Grip::waypoint : Grip::ground;
}

void ViewportView::handle_mouse(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  const bool down = ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  const bool on_line = grip_ == Grip::line || (grip_ == Grip::nothing && hovered_ && wipe_.is_at(canvas, mouse));
  if (on_line) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const bool may_hold = grip_ == Grip::horizon || (grip_ == Grip::nothing && hovered_ && overlays_.horizon);
  if (may_hold && !on_line && tool != nullptr && horizon_.part_at(*tool))
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (hovered_ && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) handle_double_click(context, canvas, tool);
  if (tool_.is_active() && tool != nullptr && down) tool_.drag(*tool);
  if (horizon_.is_active() && tool != nullptr && down) horizon_.drag(*tool);
  if (grip_ == Grip::line) wipe_.drag_to(canvas, mouse);
  if (boxes_.is_wanted()) boxes_.drag(context, canvas, hovered_, down);
  const bool drags = glm::distance(mouse, grip_mouse_) >= scaled(3) || !look_.is_fitted();
  if (grip_ == Grip::ground && down && drags && mouse != grip_mouse_) look_.pan(mouse - grip_mouse_);
  if (down) return;
  tool_.release(context);
  horizon_.release(context);
  grip_ = Grip::nothing;
}

void ViewportView::handle_double_click(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  if (boxes_.is_wanted() || grip_ == Grip::line || grip_ == Grip::horizon ||
      (tool != nullptr && waypoint_at(*tool) != nullptr))
    return;
  const glm::dvec2 mouse = dv(ImGui::GetMousePos());
  if (tool == nullptr || !overlays_.waypoints || !current_intruder(context) || !canvas.pixel_at(mouse))
    return look_.fit();
  tool_.release(context);
  add_waypoint_at(*tool, canvas.view.image_of(mouse));
}

void ViewportView::draw_waypoint_menu(const ViewContext& context) {
  const WaypointMark& mark = *menu_waypoint_;
  ImGui::TextDisabled("Waypoint %d, frame %.4g", mark.waypoint + 1, mark.frame);
  ImGui::Separator();
  if (ImGui::MenuItem("Go to its frame")) go_to_moment(context, mark.frame);
  if (ImGui::MenuItem("Duplicate", "Ctrl+D")) duplicate_selected(context);
  if (ImGui::MenuItem("Delete", "Del")) delete_selected(context);
}

void ViewportView::draw_menu(const ViewContext& context, const ImageCanvas& canvas, const ToolContext* tool) {
  if (hovered_ && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) {
    menu_waypoint_.reset();
    menu_intruder_.reset();
    if (tool != nullptr) {
      if (const WaypointMark* mark = waypoint_at(*tool)) {
        menu_waypoint_ = *mark;
        context.edits.select({Selected::waypoint, mark->intruder, mark->waypoint});
      }
      menu_intruder_ = intruder_at(*tool);
    }
    menu_pixel_ = canvas.view.image_of(dv(ImGui::GetMousePos()));
    boxes_.open_menu(context, canvas, menu_pixel_, overlays_.real_aircraft);
    ImGui::OpenPopup("image menu");
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(6)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {scaled(10), scaled(8)});
  if (ImGui::BeginPopup("image menu")) {
    if (menu_waypoint_)
      draw_waypoint_menu(context);
    else
      draw_image_menu(context, tool);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

void ViewportView::draw_image_menu(const ViewContext& context, const ToolContext* tool) {
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  boxes_.draw_menu(context);
  if (menu_intruder_ && static_cast<std::size_t>(*menu_intruder_) < intruders.size()) {
    const std::string text = "Select " + shortened(intruders[static_cast<std::size_t>(*menu_intruder_)].name, 60);
    if (ImGui::MenuItem(text.c_str())) context.edits.select({Selected::intruder, *menu_intruder_, 0});
    ImGui::Separator();
  }
  const bool can_add = tool != nullptr && current_intruder(context).has_value();
  if (ImGui::MenuItem("Add waypoint here", "double click", false, can_add)) add_waypoint_at(*tool, menu_pixel_);
  if (intruders.empty() && ImGui::MenuItem("Add intruder")) add_intruder(context);
  ImGui::Separator();
  if (context.ui_probe.noted(ImGui::MenuItem("Lit like something here..."), "viewport/menu/lit like"))
    ask_for_lit_box();
  if (context.ui_probe.noted(ImGui::MenuItem("Mark a real aircraft here..."), "viewport/menu/mark real aircraft"))
    boxes_.ask_for_real_aircraft(context);
  if (ImGui::MenuItem("Wipe against the footage", nullptr, wipe_.is_on())) wipe_.toggle();
  if (ImGui::MenuItem("Fit", "F")) look_.fit();
}

namespace {

constexpr double kHandleHeight = 0.8;  // of the rect, from above

// Triangles to both sides on a plate: can be dragged.
void draw_handle(ImDrawList& draw, const glm::dvec2& middle, ImU32 color) {
  const double r = scaled(11);
  draw.AddCircleFilled(im(middle), static_cast<float>(r), IM_COL32(16, 18, 22, 220));
  draw.AddCircle(im(middle), static_cast<float>(r), color, 0, scaled(1.4));
  for (const double side : {-1.0, 1.0})
    draw.AddTriangleFilled(im(middle + side * glm::dvec2(0.65 * r, 0)),
                           im(middle + side * glm::dvec2(0.2 * r, 0.38 * r)),
                           im(middle + side * glm::dvec2(0.2 * r, -0.38 * r)), color);
}

ImageGrid next(ImageGrid grid) {
  if (grid == ImageGrid::none) return ImageGrid::thirds;
  return grid == ImageGrid::thirds ? ImageGrid::eighths : ImageGrid::none;
}

constexpr std::array<const char*, OverlayChoice::kMaxDoublings + 1> kGains{"Gain", "Gain x2", "Gain x4", "Gain x8",
                                                                           "Gain x16"};

const char* label_of(ImageGrid grid) {
  if (grid == ImageGrid::none) return "Grid";
  return grid == ImageGrid::thirds ? "Grid 3 x 3" : "Grid 8 x 6";
}

}  // namespace

double ViewportWipe::line_x(const ImageCanvas& canvas) const {
  return std::round(canvas.rect.low.x + share_ * canvas.rect.size().x);
}

bool ViewportWipe::is_at(const ImageCanvas& canvas, const glm::dvec2& mouse) const {
  return on_ && std::abs(mouse.x - line_x(canvas)) <= scaled(7);
}

bool ViewportWipe::is_left_of_line(const ImageCanvas& canvas, const glm::dvec2& mouse) const {
  return on_ && mouse.x < line_x(canvas);
}

void ViewportWipe::drag_to(const ImageCanvas& canvas, const glm::dvec2& mouse) {
  share_ = std::clamp((mouse.x - canvas.rect.low.x) / std::max(1.0, canvas.rect.size().x), 0.02, 0.98);
}

void ViewportWipe::draw_footage(const ImageCanvas& canvas, const ViewContext& context, bool everywhere) {
  if (!on_ && !everywhere) return;
  context.needs.footage = true;
  if (!context.shown.footage) return;
  ScreenRect left = canvas.rect;
  if (!everywhere) left.high.x = line_x(canvas);
  draw_image(canvas.draw, context.textures, *context.shown.footage, canvas.view, left);
}

void ViewportWipe::draw_line(const ImageCanvas& canvas, bool highlighted) const {
  if (!on_) return;
  const double x = line_x(canvas);
  const ImU32 color = highlighted ? color::kAccent : IM_COL32(255, 255, 255, 220);
  canvas.draw.AddRectFilled(im({x - 1, canvas.rect.low.y}), im({x + 1, canvas.rect.high.y}), color);
  // Below the middle, where intruders are looked for.
  draw_handle(canvas.draw, {x, std::round(std::lerp(canvas.rect.low.y, canvas.rect.high.y, kHandleHeight))}, color);
  const double bottom = canvas.rect.high.y - scaled(6);
  const double width = ImGui::CalcTextSize("footage").x;
  if (x - canvas.rect.low.x > width + scaled(20))
    draw_label(canvas, {x - width - scaled(10), bottom}, "footage", color::kText);
  if (canvas.rect.high.x - x > width + scaled(40))
    draw_label(canvas, {x + scaled(8), bottom}, "composite", color::kText);
}

void ViewportView::draw_toolbar_row() {
  std::vector<ToolbarItem> items{
      toggle_item(
          {"box", Icon::box, "Box",
           "Boxes of the truth: what is visible solid, the whole silhouette dashed; and those of trackers, where "
           "results are loaded"},
          overlays_.box),
      toggle_item({"path", Icon::path, "Path", "The path of each intruder, as seen from here through the lens"},
                  overlays_.path),
      toggle_item(
          {"waypoints", Icon::waypoints, "Waypoints",
           "Waypoints with their frames. Drag: move at constant distance; with Shift or Alt: nearer and farther. "
           "Double click on the image: add one"},
          overlays_.waypoints),
      toggle_item(
          {"horizon", Icon::horizon, "Horizon",
           "Where the world is level. Drag the line onto the footage's own horizon: its middle up and down, its "
           "ends to tilt it. Numbers: headings against true north where it is known, else against world X; the "
           "circle with wings: where the camera flies to"},
          overlays_.horizon),
      toggle_item({"own body", Icon::own_body, "Own body",
                   "What hides intruders: the mask of the aircraft that carries the camera, and clouds where the "
                   "project says how far they are"},
                  overlays_.own_body),
      toggle_item(
          {"real aircraft", Icon::aircraft, "Real aircraft",
           "Boxes of aircraft that the footage itself shows: solid where they were drawn, dashed where they are "
           "filled in between. The right button marks and deletes them"},
          overlays_.real_aircraft),
      {.button = {.id = "grid",
                  .icon = Icon::grid,
                  .label = label_of(overlays_.grid),
                  .tooltip = "Lines across the image: thirds, 8 x 6, none",
                  .on = overlays_.grid != ImageGrid::none},
       .clicked = [this] { overlays_.grid = next(overlays_.grid); }},
      {.button = {.id = "gain",
                  .label = kGains[static_cast<std::size_t>(overlays_.doublings)],
                  .tooltip =
                      "Shows dark footage brighter: twice, 4, 8 and 16 times. For the eye alone: nothing that is "
                      "exported changes",
                  .on = overlays_.doublings > 0},
       .clicked = [this] { overlays_.doublings = (overlays_.doublings + 1) % (OverlayChoice::kMaxDoublings + 1); }},
      {.is_gap = true},
      {.button = {.id = "wipe",
                  .icon = Icon::wipe,
                  .label = "Wipe",
                  .tooltip = "Untouched footage left of a line that can be dragged. Hold \\: footage alone",
                  .on = wipe_.is_on()},
       .clicked = [this] { wipe_.toggle(); }},
      {.is_gap = true},
  };
  add_zoom_items(items, {.is_fitted = look_.is_fitted(),
                         .zoom = look_.zoom(),
                         .fit = [this] { look_.fit(); },
                         .to_exact = [this] { look_.zoom_to(1, look_.room_px() / 2.0); }});
  draw_toolbar(items);
}

}  // namespace sigs::editor
