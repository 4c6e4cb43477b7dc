// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/pose.h"
#include "base/text.h"
#include "editor/document/project_edits.h"
#include "editor/views/results/results_view.h"
#include "editor/views/viewport/cameras_view.h"
#include "scene/opened_project.h"

namespace sigs::editor {

namespace {

constexpr int kUpdatesToWait = 20;  // until a row that is wanted must have been drawn

// The block of what is selected in another view; "": none in particular.
const char* block_of(Selected kind) {
  switch (kind) {
    case Selected::footage:
      return "Inputs";
    case Selected::camera:
      return "Camera";
    case Selected::light:
      return "Light";
    case Selected::waypoint:
      return "Trajectory";
    default:
      return "";
  }
}

void draw_own_body(const ViewContext& context, FieldRows& rows) {
  const bool is_paper = context.project().own_body.method == OwnBodyMethod::paper;
  rows.rows("own_body.", [&](const Field& field) {
    RowOptions look;
    if (field.key.starts_with("own_body.paper.") && !is_paper) look.off_because = "Counts for the paper method alone.";
    if (field.key.starts_with("own_body.stable.") && is_paper) look.off_because = "Counts for the stable method alone.";
    return look;
  });
  ImGui::Spacing();
  if (context.ui_probe.noted(ImGui::Button("Detect and paint..."), "inspector/own body",
                             "Finds the aircraft that carries the camera in its footage"))
    context.edits.ask(ShowOwnBody{});
  note("What else hides intruders: trees and hills, as a mask of one frame.");
  rows.rows("footage.occluder_");
  note("Clouds in the footage, found in each frame. How far they are is yours to say.");
  rows.rows("footage.cloud_", [&](const Field& field) {
    const bool is_depth = field.key == "footage.cloud_depth_m";
    RowOptions look =
        off_where(is_depth && !context.project().footage.cloud_distance_m, "Counts where clouds hide intruders.");
    look.suggested = 2000;
    return look;
  });
}

void draw_compositing(const ViewContext& context, FieldRows& rows) {
  const bool is_direct = context.project().compositing.method == MethodChoice::direct;
  rows.rows("compositing.", [&](const Field& field) {
    return off_where(field.key == "compositing.blend" && !is_direct, "Counts for the direct method alone.");
  });
}

void draw_export(const ViewContext& context, FieldRows& rows) {
  const bool has_crf = max_crf(context.project().output.codec) > 0;
  rows.rows("export.", [&](const Field& field) {
    RowOptions look;
    if (field.key == "export.video.crf" && !has_crf) look.off_because = "Counts for h264, hevc and av1 alone.";
    if (field.key == "export.labels") look.names = {"xml"};
    if (field.key == "export.encounter") look.names.assign(kWellClearNames.begin(), kWellClearNames.end());
    return look;
  });
  ImGui::Spacing();
  if (context.ui_probe.noted(ImGui::Button("Export..."), "inspector/export",
                             "Writes video, masks and labels (Ctrl + E)"))
    context.edits.ask(ShowExport{});
}

// How many problems a block holds, at the right end of its header.
void draw_badge(int count) {
  if (count == 0) return;
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  const std::string text = std::to_string(count);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float right = high.x - scaled(10);
  const float middle = (low.y + high.y) / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({right - size.x, middle - size.y / 2}, color::kBad, text.c_str());
  draw_icon(list, Icon::warning, {right - size.x - scaled(12), middle}, ImGui::GetFontSize(), color::kBad);
}

// What its clock makes of the footage: "films from 0.370 to 6.637 s of the first camera's time".
std::string filming_text(const Scene& scene) {
  const FootageShape& footage = scene.footage;
  if (footage.times_s.empty()) return "";
  return fmt::format("Its footage is from {:.3f} to {:.3f} s of the first camera's time.", footage.times_s.front(),
                     footage.times_s.back());
}

void draw_buttons(const ViewContext& context) {
  const std::size_t camera = context.document.active_camera();
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("Add camera...", "Another camera of the same aircraft, by its video"),
                             "inspector/add camera"))
    ask_add_camera(context);
  const bool is_first = camera == 0;
  const char* const tooltip = is_first ? "The first camera stays: waypoints count its frames, and the clock is its"
                                       : "Takes this camera out of the project; its files stay";
  if (context.ui_probe.noted(flow.button("Remove", tooltip, !is_first), "inspector/remove camera"))
    ask_remove_camera(context);
}

}  // namespace

void InspectorView::follow_selection(const ViewContext& context) {
  const Selection& selection = context.document.selection();
  // What was selected right here must not move away under the mouse.
  const bool is_elsewhere =
      !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows | ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  if (is_elsewhere && selection.kind != followed_.kind && *block_of(selection.kind) != '\0') {
    block_to_open_ = block_of(selection.kind);
    updates_to_open_ = 1;
  }
  followed_ = selection;
}

void InspectorView::follow_matching(const ViewContext& context) {
  const bool is_matching = context.appearance != nullptr && context.appearance->is_running();
  const bool is_elsewhere = !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (is_matching && !was_matching_ && is_elsewhere) {
    block_to_open_ = "Appearance";
    updates_to_open_ = 1;
  }
  was_matching_ = is_matching;
}

void InspectorView::go_to_problem(const ViewContext& context, const std::string& key) {
  filter_.clear();
  block_to_open_ = editor::block_of(key);
  // A key without a row of its own is shown by its block.
  const bool has_row = memory_.sheet->find(key) != nullptr;
  updates_to_open_ = has_row ? kUpdatesToWait : 2;
  memory_.wanted_key = key;
  memory_.wanted_updates = has_row ? kUpdatesToWait : 0;
  if (!key.starts_with("intruders[")) return;
  const auto number_after = [&](const char* name) {
    return static_cast<int>(std::strtol(key.c_str() + key.find(name) + std::string(name).size(), nullptr, 10));
  };
  const int intruder = number_after("intruders[");
  if (key.find("waypoints[") != std::string::npos)
    context.edits.select({Selected::waypoint, intruder, number_after("waypoints[")});
  else
    context.edits.select({Selected::intruder, intruder, 0});
}

void InspectorView::draw_depth(const ViewContext& context) const {
  const auto choice = [&](const char* label, const char* name, bool all, const char* tooltip) {
    const bool is_on = context.settings.all_settings == all;
    ImGui::PushStyleColor(ImGuiCol_Button, is_on ? color::kAccentSoft : IM_COL32(0, 0, 0, 0));
    if (ImGui::Button(label)) context.edits.ask(ShowAllSettings{all});
    ImGui::PopStyleColor();
    context.ui_probe.note_item(name, tooltip);
  };
  ImGui::SameLine(0, scaled(6));
  choice("Common", "inspector/common", false,
         "The settings that most projects need, and those that are wrong or guessed. The filter finds all.");
  ImGui::SameLine(0, scaled(2));
  choice("All", "inspector/all", true, "Every setting of the project file");
}

void InspectorView::draw_top(const ViewContext& context, FieldRows& rows) {
  for (const Field& field : memory_.sheet->fields())
    if (editor::block_of(field.key).empty()) rows.row(field.key);
  const float depth = ImGui::CalcTextSize("CommonAll").x + 4 * ImGui::GetStyle().FramePadding.x + scaled(8);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - depth -
                          (filter_.empty() ? 0 : icon_button_width() + scaled(2)));
  text_input("##filter", filter_, "Filter settings");
  context.ui_probe.note_item("inspector/filter");
  if (!filter_.empty()) {
    ImGui::SameLine(0, scaled(2));
    if (icon_button("clear filter", Icon::cross, "End filtering")) filter_.clear();
  }
  draw_depth(context);
  if (const std::optional<std::string> key = problems_.draw(context)) go_to_problem(context, *key);
}

void InspectorView::block(const ViewContext& context, const char* title, bool opens_first, const FieldRows& rows,
                          const std::function<void()>& content) {
  const bool is_wanted = updates_to_open_ > 0 && block_to_open_ == title;
  if (is_wanted)
    ImGui::SetNextItemOpen(true);
  else
    ImGui::SetNextItemOpen(opens_first, ImGuiCond_FirstUseEver);
  ImGui::PushFont(font(Font::bold));
  const bool is_open = ImGui::CollapsingHeader(title);
  ImGui::PopFont();
  context.ui_probe.note_item(std::string("inspector/") + title);
  if (is_wanted && memory_.wanted_updates == 0) ImGui::SetScrollHereY(0);
  draw_badge(problems_.count_in(title));
  if (!is_open) return;
  ImGui::PushID(title);
  const int left_out_before = rows.left_out();
  content();
  if (const int more = rows.left_out() - left_out_before; more > 0) {
    ImGui::PushFont(font(Font::small));
    ImGui::PushStyleColor(ImGuiCol_Text, color::kQuiet);
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0, 0, 0, 0));
    if (ImGui::Button(fmt::format("{} more", count_text(more, "setting")).c_str()))
      context.edits.ask(ShowAllSettings{true});
    ImGui::PopStyleColor(2);
    ImGui::PopFont();
    context.ui_probe.note_item(fmt::format("inspector/{}/more", title));
  }
  ImGui::PopID();
  ImGui::Spacing();
}

void InspectorView::draw_blocks(const ViewContext& context, FieldRows& rows) {
  if (context.scored != nullptr) block(context, "Tracker results", true, rows, [&] { draw_results_panel(context); });
  block(context, "Inputs", true, rows, [&] { draw_inputs(context, rows); });
  if (!context.document.cameras().empty()) block(context, kMountBlock, true, rows, [&] { mount_.draw(context, rows); });
  block(context, "Own body", false, rows, [&] { draw_own_body(context, rows); });
  block(context, "Camera", true, rows, [&] { draw_camera(context, rows); });
  block(context, kCameraLogBlock, false, rows, [&] { draw_camera_log(context, rows); });
  block(context, kPlaceBlock, false, rows, [&] { draw_place_on_earth(context, rows); });
  block(context, "Light", false, rows, [&] { light_.draw(context, rows); });
  block(context, "Intruders", true, rows, [&] { model_.draw(context, rows); });
  block(context, "Trajectory", true, rows, [&] { trajectory_.draw(context, rows); });
  block(context, "Encounter", false, rows, [&] { encounter_.draw(context, rows); });
  block(context, "Compositing", false, rows, [&] { draw_compositing(context, rows); });
  block(context, "Appearance", false, rows, [&] { appearance_.draw(context, rows); });
  block(context, "Export", false, rows, [&] { draw_export(context, rows); });
  const bool has_arrived = !memory_.wanted_key.empty() && memory_.wanted_updates == 0;
  if (has_arrived) memory_.wanted_key.clear();
  updates_to_open_ = has_arrived && updates_to_open_ > 2 ? 0 : std::max(0, updates_to_open_ - 1);
}

void InspectorView::draw_found(const ViewContext& context, FieldRows& rows) const {
  std::string heading;
  bool has_any = false;
  for (const Field& field : memory_.sheet->fields()) {
    const std::string name = editor::block_of(field.key);
    if (name.empty() || !matches(field, filter_)) continue;
    const bool is_of_intruder = name == "Intruders" || name == "Trajectory";
    // By the intruder's name: "airliner, scale" without the field's own.
    const std::string whole = place_of(context.project(), field.key);
    const std::string place = is_of_intruder ? whole.substr(0, whole.rfind(", ")) : name;
    if (place != heading) note(place);
    heading = place;
    rows.row(field.key);
    has_any = true;
  }
  if (!has_any) note("No setting is called so.");
}

void InspectorView::draw(const ViewContext& context) {
  memory_.refresh(context);
  problems_.refresh(context);
  if (std::optional<std::string> lost = loss_of_view_.found(context))
    context.edits.ask(ShowMessage{*std::move(lost), true});
  follow_selection(context);
  follow_matching(context);
  FieldRows rows(context, problems_.by_field(), memory_);
  if (!context.settings.all_settings && filter_.empty()) rows.leave_out_uncommon();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {scaled(8), scaled(4)});
  draw_top(context, rows);
  ImGui::BeginChild("settings");
  if (filter_.empty())
    draw_blocks(context, rows);
  else
    draw_found(context, rows);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  rows.finish();
}

void MountBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::size_t camera = context.document.active_camera();
  const std::string& name = context.document.cameras()[camera].name;
  if (!is_typing_) typed_ = name;
  ImGui::SetNextItemWidth(rows.begin_row("Name"));
  text_input("##camera name", typed_);
  context.ui_probe.note_item("inspector/camera name", "What results, labels and the tabs call it");
  const bool is_done = ImGui::IsItemDeactivatedAfterEdit();
  is_typing_ = ImGui::IsItemActive();
  if (is_done && typed_ != name) {
    if (const std::string reason = why_not_called(context.document.whole(), camera, typed_); !reason.empty())
      context.edits.ask(ShowMessage{reason, true});
    else
      context.edits.change_whole("rename camera",
                                 [camera, typed = typed_](Project& whole) { whole.cameras.at(camera).name = typed; });
  }
  rows.rows("mount.");
  rows.rows("clock.", [&](const Field&) { return off_where(camera == 0, "The first camera's clock is that of all."); });
  const Scene* const scene = shown_scene(context);
  if (scene != nullptr && camera > 0) note(filming_text(*scene));
  ImGui::Spacing();
  draw_buttons(context);
}

}  // namespace sigs::editor
