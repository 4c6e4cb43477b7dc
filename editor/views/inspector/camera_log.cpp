// SPDX-License-Identifier: MIT
#include "editor/views/inspector/camera_log.h"

#include <fmt/format.h>
#include <imgui.h>

#include "base/pose.h"
#include "editor/preview/ego_motion_job.h"
#include "editor/views/inspector/job_progress.h"
#include "editor/views/shown_camera.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

std::string covered_text(const std::vector<PlatformAttitude>& turns) {
  return fmt::format("{} attitudes, {:.2f} to {:.2f} s of the footage", turns.size(), turns.front().time_s,
                     turns.back().time_s);
}

RowOptions look_of_camera(const ViewContext& context, const Field& field) {
  RowOptions look;
  const Scene* const scene = shown_scene(context);
  const bool has_path = scene != nullptr && scene->motion.path;
  if (field.key == "camera.position_m" && !glm::any(movable_axes(context))) look.off_because = kWhyCameraIsFixed;
  if (field.key == "camera.speed_mps" && has_path) look.off_because = "The log says how the camera moves.";
  return look;
}

void draw_estimate(const ViewContext& context) {
  const EgoMotionState* const state = context.ego_motion;
  if (state == nullptr) return;
  ImGui::Spacing();
  if (state->is_running()) {
    if (draw_job_progress(*state)) context.edits.ask(StopCameraMotion{});
    context.ui_probe.note_item("inspector/stop camera motion");
    return;
  }
  if (ImGui::Button("Estimate camera motion")) context.edits.ask(EstimateCameraMotion{});
  context.ui_probe.note_item("inspector/estimate camera motion");
  tooltip_for_item(
      "Finds how the camera turns from the footage itself, in the background, and writes it as a log beside the "
      "project. With a log that has rates of turn, both are used together.");
  if (state->value)
    for (const Warning& warning : state->value->warnings) note(warning.what, true);
}

}  // namespace

std::vector<std::string> lines_of_motion(const CameraMotion& motion, double time_s) {
  std::vector<std::string> lines;
  if (!motion.source.position.empty()) lines.push_back("Position by " + motion.source.position);
  if (!motion.source.attitude.empty()) lines.push_back("Attitude by " + motion.source.attitude);
  if (!motion.attitudes.empty()) lines.push_back(covered_text(motion.attitudes));
  if (const auto sd_rad = attitude_sd_at(motion.deviations, time_s))
    lines.push_back(fmt::format("Standard deviation here {:.2g}\u00b0, {:.2g}\u00b0, {:.2g}\u00b0 about its axes",
                                deg_of_rad(sd_rad->x), deg_of_rad(sd_rad->y), deg_of_rad(sd_rad->z)));
  if (motion.readout_s > 0) lines.push_back(fmt::format("Rolling shutter: {:.2f} ms", motion.readout_s * 1000));
  return lines;
}

std::string place_text(const Scene& scene) {
  if (!scene.earth) return "";
  const GeodeticPosition& origin = scene.earth->origin();
  return fmt::format("World's origin at {:.7f}\u00b0, {:.7f}\u00b0, {:.1f} m\nworld X heads {:.1f}\u00b0 from north",
                     origin.latitude_deg, origin.longitude_deg, origin.height_m,
                     deg_of_rad(scene.earth->heading_rad()));
}

void draw_camera(const ViewContext& context, FieldRows& rows) {
  for (const Field& field : rows.sheet().fields())
    if (field.key.starts_with("camera.") && !field.key.starts_with("camera.track.") &&
        field.key != "camera.readout_s" && field.key != "camera.exposure_s")
      rows.row(field.key, look_of_camera(context, field));
  if (is_turned_by_file(context)) return;
  ImGui::Spacing();
  if (!knows_horizon(context.project().camera))
    note("Horizon: not set. Labels call the intruders' side of it unknown.");
  if (ImGui::Button("Horizon...")) context.edits.ask(ShowHorizon{});
  context.ui_probe.note_item("inspector/horizon");
  tooltip_for_item("Shows the horizon's line over the footage, to be dragged onto the footage's own");
}

void draw_camera_log(const ViewContext& context, FieldRows& rows) {
  const bool has_log = !context.project().camera.track.file.empty();
  const auto look_of = [&](const Field& field) {
    RowOptions look;
    if (field.key != "camera.track.file" && !has_log) look.off_because = "Counts with a log alone.";
    return look;
  };
  rows.rows("camera.track.", look_of);
  rows.row("camera.readout_s");
  rows.row("camera.exposure_s");
  const double time_s = time_of(context, context.document.playhead());
  if (const Scene* const scene = shown_scene(context))
    for (const std::string& line : lines_of_motion(scene->motion, time_s)) note(line);
  draw_estimate(context);
}

void draw_place_on_earth(const ViewContext& context, FieldRows& rows) {
  rows.rows("geo.");
  const Scene* const scene = shown_scene(context);
  if (scene == nullptr) return;
  const std::string text = place_text(*scene);
  note(text.empty() ? "Not known: neither stated nor in a log." : text);
}

}  // namespace sigs::editor
