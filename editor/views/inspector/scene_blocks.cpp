// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pose.h"
#include "base/text.h"
#include "editor/preview/jobs.h"
#include "editor/preview/thumbnails.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/waypoint_actions.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

std::string video_text(const VideoInfo& video) {
  const double rate_hz = video.frame_rate_den > 0 ? double(video.frame_rate_num) / video.frame_rate_den : 0;
  const double length_s = video.times_s.empty() ? 0 : video.times_s.back() + (rate_hz > 0 ? 1 / rate_hz : 0);
  std::string text = fmt::format(
      "{}, {}{}, {}\n{}, {}", image_size_text(video.size_px, " x "), video.variable_frame_rate ? "about " : "",
      number_text(std::round(rate_hz * 1000) / 1000, "frames/s"), video.codec, count_text(video.frame_count(), "frame"),
      number_text(std::round(length_s * 100) / 100, "s"));
  if (!video.conversion.empty()) text += fmt::format("\n{}: {}", video.pixel_format, video.conversion);
  return text;
}

void draw_video(const Footage& footage, const FieldRows& rows) {
  if (footage.video) {
    note(video_text(*footage.video));
    for (const Warning& warning : footage.video->warnings) note(warning.text(), true);
  } else if (!rows.problems().contains("footage.video")) {
    note("Grey frames replace the footage.", true);
  }
}

std::string lens_text(const Camera& camera) {
  const LensParameters& lens = camera.lens.parameters();
  const char* const kind = is_fisheye(lens.model) ? " (fisheye)" : "";
  const std::string distortion =
      camera.lens.is_pinhole() ? "no distortion" : fmt::format("{} coefficients", lens.coefficients.size());
  const double valid_deg = std::min(180.0, deg_of_rad(camera.lens.valid_angle_rad()));
  return fmt::format("{}, {}{}, {}\nfocal length {} x {} px\nvalid to {} from the axis",
                     image_size_text(camera.size_px, " x "), name_of(lens.model), kind, distortion,
                     number_text(std::round(lens.fx * 10) / 10), number_text(std::round(lens.fy * 10) / 10),
                     number_text(std::round(valid_deg * 10) / 10, "deg"));
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
  if (draw_if_running(context, *state, StopCameraMotion{}, "inspector/stop camera motion")) return;
  if (context.ui_probe.noted(
          ImGui::Button("Estimate camera motion"), "inspector/estimate camera motion",
          "Finds how the camera turns from the footage itself, in the background, and writes it as a log beside the "
          "project. With a log that has rates of turn, both are used together."))
    context.edits.ask(EstimateCameraMotion{});
  if (state->value)
    for (const Warning& warning : state->value->warnings) note(warning.what, true);
}

}  // namespace

void draw_inputs(const ViewContext& context, FieldRows& rows) {
  const OpenedScene* const scene = context.shown.scene.get();
  rows.row("footage.video");
  if (scene != nullptr && scene->footage) draw_video(*scene->footage, rows);
  RowOptions last;
  last.suggested = scene != nullptr ? double(scene->draft.scene.footage.times_s.size()) - 1 : 0;
  for (const Field& field : rows.sheet().fields()) {
    if (!field.key.starts_with("footage.") || field.key == "footage.video") continue;
    if (field.key.starts_with("footage.occluder_") || field.key.starts_with("footage.cloud_"))
      continue;  // with the own body
    RowOptions options = field.key == "footage.last_frame" ? last : RowOptions();
    options.is_hidden = field.key == "footage.palette" && context.project().footage.spectrum != Spectrum::thermal;
    rows.row(field.key, options);
    if (field.key == "footage.calibration" && scene != nullptr && !rows.problems().contains(field.key))
      note(lens_text(scene->draft.scene.camera));
  }
}

std::vector<std::string> lines_of_motion(const CameraMotion& motion, double time_s) {
  std::vector<std::string> lines;
  if (!motion.source.position.empty()) lines.push_back("Position by " + motion.source.position);
  if (!motion.source.attitude.empty()) lines.push_back("Attitude by " + motion.source.attitude);
  if (!motion.attitudes.empty())
    lines.push_back(fmt::format("{} attitudes, {:.2f} to {:.2f} s of the footage", motion.attitudes.size(),
                                motion.attitudes.front().time_s, motion.attitudes.back().time_s));
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
  if (context.project().rig_view) note("Of the aircraft that carries the cameras.");
  for (const Field& field : rows.sheet().fields())
    if (field.key.starts_with("camera.") && !field.key.starts_with("camera.track.") &&
        field.key != "camera.readout_s" && field.key != "camera.exposure_s")
      rows.row(field.key, look_of_camera(context, field));
  if (is_turned_by_file(context)) return;
  ImGui::Spacing();
  if (!knows_horizon(context.project().camera))
    note("Horizon: not set. Labels call the intruders' side of it unknown.");
  if (context.ui_probe.noted(ImGui::Button("Horizon..."), "inspector/horizon",
                             "Shows the horizon's line over the footage, to be dragged onto the footage's own"))
    context.edits.ask(ShowHorizon{});
}

void draw_camera_log(const ViewContext& context, FieldRows& rows) {
  const bool has_log = !context.project().camera.track.file.empty();
  rows.rows("camera.track.", [&](const Field& field) {
    return off_where(field.key != "camera.track.file" && !has_log, "Counts with a log alone.");
  });
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
