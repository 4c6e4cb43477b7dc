// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>

#include "base/pose.h"
#include "editor/document/rig_edits.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/viewport/cameras_view.h"

namespace sigs::editor {

namespace {

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
  rows.rows("clock.", [&](const Field&) {
    RowOptions look;
    if (camera == 0) look.off_because = "The first camera's clock is that of all.";
    return look;
  });
  const Scene* const scene = shown_scene(context);
  if (scene != nullptr && camera > 0) note(filming_text(*scene));
  ImGui::Spacing();
  draw_buttons(context);
}

}  // namespace sigs::editor
