// SPDX-License-Identifier: MIT
#include "editor/views/viewport/cameras_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "editor/document/field_edits.h"
#include "editor/document/project_edits.h"
#include "editor/views/viewport/overlays.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

namespace {

constexpr double kGap_px = 6;  // between images, where text is 15 px high

glm::dvec2 size_of(const PreviewOutput& shown) {
  const cv::Size size = shown.image && !shown.image->bgr.empty() ? shown.image->bgr.size()
                        : shown.scene                            ? shown.scene->draft.scene.footage.size_px
                                                                 : cv::Size(4, 3);
  return {std::max(1, size.width), std::max(1, size.height)};
}

// How large images of these shapes get in so many columns, as the least factor.
double zoom_in_columns(const std::vector<glm::dvec2>& sizes_px, const glm::dvec2& cell_px) {
  double zoom = 1e9;
  for (const glm::dvec2& size : sizes_px) zoom = std::min({zoom, cell_px.x / size.x, cell_px.y / size.y});
  return zoom;
}

// Where images lie side by side, in as many columns as leave each the most room; by index. Places that share a row are
// equally high. Sizes are in pixels of the images; rect is on the screen.
std::vector<ScreenRect> mosaic_places(const std::vector<glm::dvec2>& sizes_px, const ScreenRect& rect, double gap_px) {
  const std::size_t count = sizes_px.size();
  std::size_t best = 1;
  double best_zoom = -1;
  glm::dvec2 cell{1, 1};
  for (std::size_t columns = 1; columns <= count; ++columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    const glm::dvec2 grid(static_cast<double>(columns), static_cast<double>(rows));
    const glm::dvec2 room = glm::max((rect.size() - (grid - 1.0) * gap_px) / grid, 1.0);
    const double zoom = zoom_in_columns(sizes_px, room);
    if (zoom <= best_zoom) continue;
    best = columns;
    best_zoom = zoom;
    cell = room;
  }
  std::vector<ScreenRect> places;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 at(static_cast<double>(i % best), static_cast<double>(i / best));
    const glm::dvec2 low = glm::floor(rect.low + at * (cell + gap_px));
    places.push_back({low, glm::floor(low + cell)});
  }
  return places;
}

void draw_name(const ImageCanvas& canvas, const std::string& name, const std::string& why_still, bool is_active) {
  const double line = label_size("A").y;
  const glm::dvec2 at =
      glm::max(canvas.rect.low, canvas.image_on_screen().low) + glm::dvec2(scaled(8), scaled(8) + line);
  draw_label(canvas, at, name, is_active ? color::kAccent : color::kText);
  if (!why_still.empty()) draw_label(canvas, at + glm::dvec2(0, line + scaled(4)), why_still, color::kPartly);
}

}  // namespace

void CameraTabs::draw(const ViewContext& context) {
  const std::vector<RigCamera>& cameras = context.document.cameras();
  if (const std::size_t active = context.document.active_camera(); active != active_) {
    active_ = active;
    shows_all_ = false;
  }
  const std::size_t wanted = shows_all_ ? cameras.size() : active_;
  if (wanted != in_front_) updates_to_select_ = 2;
  in_front_ = wanted;
  if (!ImGui::BeginTabBar("cameras", ImGuiTabBarFlags_FittingPolicyScroll)) return;
  std::size_t open = wanted;
  for (std::size_t i = 0; i <= cameras.size(); ++i) {
    const bool is_all = i == cameras.size();
    const std::string label =
        is_all ? "All###all cameras" : fmt::format("{}###camera {}", shortened(cameras[i].name, 40), i);
    const bool selects = updates_to_select_ > 0 && i == wanted;
    if (ImGui::BeginTabItem(label.c_str(), nullptr, selects ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None)) {
      open = i;
      ImGui::EndTabItem();
    }
    context.ui_probe.note_item(is_all ? "camera/All" : "camera/" + cameras[i].name,
                               is_all ? "All cameras side by side (A)" : "");
  }
  ImGui::EndTabBar();
  if (updates_to_select_ > 0) {
    --updates_to_select_;
  } else if (open != wanted) {
    shows_all_ = open == cameras.size();
    in_front_ = open;
    if (shows_all_) return;
    active_ = open;
    context.edits.activate_camera(open);
  }
}

void Mosaic::handle_mouse(const ViewContext& context, std::size_t camera, const ToolContext* tool, CameraTabs& tabs) {
  if (ImGui::IsItemActivated()) {
    held_ = camera;
    opens_tab_ = tool == nullptr || waypoint_at(*tool) == nullptr;
    if (tool != nullptr) tool_.press(*tool);
  }
  if (camera != held_) return;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (tool_.is_active() && tool != nullptr) tool_.drag(*tool);
    if (tool_.has_moved()) opens_tab_ = false;
    return;
  }
  tool_.release(context);
  if (!ImGui::IsItemDeactivated() || !ImGui::IsItemHovered() || !opens_tab_) return;
  tabs.show_all(false);
  context.edits.activate_camera(camera);
}

void Mosaic::draw_cell(const ViewContext& whole, std::size_t camera, const ScreenRect& rect, CameraTabs& tabs) {
  const ViewContext context = seen_from(whole, camera);
  const PreviewOutput& shown = context.shown;
  const std::string& name = context.document.cameras()[camera].name;
  const std::string place = "mosaic/" + name;
  const glm::dvec2 size = size_of(shown);
  const ImageCanvas canvas{*ImGui::GetWindowDrawList(), rect, fitted(size, rect),
                           cv::Size(static_cast<int>(size.x), static_cast<int>(size.y))};
  const std::optional<FootageCamera> eye = footage_camera_at(context, frame_of_overlays(context));
  const std::vector<WaypointMark> none;
  const std::vector<WaypointMark>& marks = eye ? cells_[camera].marks.of(context, *eye) : none;
  std::optional<ToolContext> tool;
  if (eye) tool.emplace(ToolContext{context, canvas, *eye, marks, dv(ImGui::GetMousePos())});
  handle_mouse(context, camera, tool ? &*tool : nullptr, tabs);

  const ScreenRect image = canvas.image_on_screen();
  canvas.draw.PushClipRect(im(rect.low), im(rect.high), true);
  if (shown.image && !shown.image->bgr.empty())
    draw_image(canvas.draw, context.textures, shown.image->bgr, canvas.view, rect);
  else
    canvas.draw.AddRectFilled(im(image.low), im(image.high), IM_COL32(58, 60, 66, 255));
  LabelPlacer labels;
  keep_waypoints_free(canvas, context, marks, labels);
  if (eye) cells_[camera].path.draw(canvas, context, *eye);
  if (shown.image) draw_boxes(canvas, context, *shown.image, labels);
  if (eye) draw_waypoints(canvas, context, marks, *eye, labels, place);
  if (tool && camera == held_) tool_.draw(*tool);
  draw_name(canvas, name, not_filming_text(shown, context.document.playhead()),
            camera == context.document.active_camera());
  if (ImGui::IsItemHovered()) canvas.draw.AddRect(im(image.low), im(image.high), color::kAccent, 0, 0, scaled(2));
  canvas.draw.PopClipRect();
  context.ui_probe.note(place, image);
}

void Mosaic::draw(const ViewContext& context, CameraTabs& tabs) {
  context.needs.all_cameras = true;
  const glm::dvec2 low = glm::round(dv(ImGui::GetCursorScreenPos()));
  const ScreenRect rect{low, low + glm::max(glm::floor(dv(ImGui::GetContentRegionAvail())), 1.0)};
  context.ui_probe.note("mosaic", rect);
  const std::size_t count = std::min(context.rig->size(), context.document.cameras().size());
  std::vector<glm::dvec2> sizes_px;
  for (std::size_t i = 0; i < count; ++i) sizes_px.push_back(size_of((*context.rig)[i]));
  const std::vector<ScreenRect> places = mosaic_places(sizes_px, rect, scaled(kGap_px));
  cells_.resize(count);
  tool_.select_again(context);
  for (std::size_t i = 0; i < count; ++i) {
    ImGui::SetCursorScreenPos(im(places[i].low));
    ImGui::PushID(static_cast<int>(i));
    ImGui::InvisibleButton("camera", im(glm::max(places[i].size(), 1.0)));
    draw_cell(context, i, places[i], tabs);
    ImGui::PopID();
  }
}

void ask_add_camera(const ViewContext& context) {
  Edits& edits = context.edits;
  edits.ask(AskForFile{.title = "Add a camera: choose its video",
                       .extensions = extensions_for("footage.video"),
                       .start = context.project().file.parent_path() / "",
                       .chosen = [&edits](const std::filesystem::path& video) {
                         edits.change_whole("add camera", [video](Project& whole) { add_camera(whole, video); });
                         edits.activate_camera(std::numeric_limits<std::size_t>::max());  // the last one
                       }});
}

void ask_remove_camera(const ViewContext& context) {
  context.edits.change_whole(
      "remove camera", [camera = context.document.active_camera()](Project& whole) { remove_camera(whole, camera); });
}

std::string not_filming_text(const PreviewOutput& shown, int playhead) {
  if (!shown.scene || !shown.scene->draft.scene.timeline) return "";
  const CountedFrames filmed = filmed_frames(shown.scene->draft.scene);
  if (playhead >= filmed.first_frame && playhead <= filmed.last_frame) return "";
  const std::optional<RigView>& view = shown.scene->project->rig_view;
  return fmt::format("{} films from frame {} to {} only", view ? view->name : std::string("It"), filmed.first_frame,
                     filmed.last_frame);
}

}  // namespace sigs::editor
