// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

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

constexpr double kMaxListRows = 6;        // of the list, before it scrolls
constexpr double kMaxPreviewWidth = 300;  // where the text is 15 px high
constexpr double kTurnAPixel_rad = 0.01;  // a drag across the preview is about half a turn

std::string key_of(int intruder) {
  return fmt::format("intruders[{}]", intruder);
}

bool has_problem(const ProblemsByField& problems, int intruder) {
  const std::string key = key_of(intruder);
  const auto found = problems.lower_bound(key);
  return found != problems.end() && found->first.starts_with(key);
}

std::string decimetres(double metres) {
  return number_text(std::round(metres * 10) / 10);
}

void draw_buttons(const ViewContext& context, std::optional<int> intruder) {
  ButtonFlow flow;
  if (context.ui_probe.noted(flow.button("Add", "Another intruder, 300 m ahead of the camera and crossing"),
                             "inspector/add intruder"))
    add_intruder(context);
  if (context.ui_probe.noted(flow.button("Duplicate", "A copy of this one, 30 m to its right", intruder.has_value()),
                             "inspector/duplicate intruder"))
    duplicate_intruder(context, *intruder);
  if (context.ui_probe.noted(flow.button("Delete", "Takes this intruder out of the project", intruder.has_value()),
                             "inspector/delete intruder"))
    delete_intruder(context, *intruder);
}

RowOptions look_of(const Field& field, const IntruderSettings& intruder) {
  RowOptions look;
  if (field.key.ends_with(".forward") || field.key.ends_with(".up")) look.names = {"+x", "-x", "+y", "-y", "+z", "-z"};
  if (field.key.ends_with(".scale") && intruder.model.length_m > 0)
    look.off_because = "The length says how large it is.";
  return look;
}

// In the middle of what is left of a frame.
void draw_centred(ImVec2 low, ImVec2 size, const std::string& text) {
  const std::string shown = elided(text, size.x - scaled(12));
  const ImVec2 extent = ImGui::CalcTextSize(shown.c_str());
  ImGui::GetWindowDrawList()->AddText({low.x + (size.x - extent.x) / 2, low.y + (size.y - extent.y) / 2}, color::kQuiet,
                                      shown.c_str());
}

// However it is spelt: a project that was saved elsewhere names the same file by another way.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code code;
  return std::filesystem::absolute(a, code).lexically_normal() == std::filesystem::absolute(b, code).lexically_normal();
}

// From the model's middle along an axis of it, with a word at the tip.
void draw_axis(ImDrawList& list, ImVec2 low, ImVec2 size, const glm::dvec3& axis_in_body, double turn_rad, ImU32 color,
               const char* word) {
  const cv::Size size_px(static_cast<int>(size.x), static_cast<int>(size.y));
  const glm::dvec2 begin = turntable_point_px({0, 0, 0}, turn_rad, size_px);
  const glm::dvec2 end = turntable_point_px(axis_in_body, turn_rad, size_px);
  const ImVec2 from{low.x + static_cast<float>(begin.x), low.y + static_cast<float>(begin.y)};
  const ImVec2 tip{low.x + static_cast<float>(end.x), low.y + static_cast<float>(end.y)};
  list.AddLine(from, tip, color, scaled(1.5));
  const double length = glm::length(end - begin);
  if (length > 1) {
    const glm::dvec2 along = (end - begin) / length * static_cast<double>(scaled(8));
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) * 0.45;
    const auto at = [&](const glm::dvec2& p) {
      return ImVec2{low.x + static_cast<float>(p.x), low.y + static_cast<float>(p.y)};
    };
    list.AddTriangleFilled(at(end + along * 0.4), at(end - along * 0.6 + across), at(end - along * 0.6 - across),
                           color);
  }
  const ImVec2 extent = ImGui::CalcTextSize(word);
  const float x = tip.x >= from.x ? tip.x + scaled(6) : tip.x - scaled(6) - extent.x;
  list.AddText({std::clamp(x, low.x + scaled(2), low.x + size.x - extent.x - scaled(2)),
                std::clamp(tip.y - extent.y / 2, low.y, low.y + size.y - extent.y)},
               color, word);
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
    rows.row(field.key, field.key == "footage.last_frame" ? last : RowOptions());
    if (field.key == "footage.calibration" && scene != nullptr && !rows.problems().contains(field.key))
      note(lens_text(scene->draft.scene.camera));
  }
}

void ModelBlock::draw_list(const ViewContext& context, const FieldRows& rows) {
  const std::vector<IntruderSettings>& intruders = context.project().intruders;
  const std::optional<int> chosen = current_intruder(context);
  const auto count = static_cast<int>(intruders.size());
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("intruders", {0, line * static_cast<float>(std::min<double>(count, kMaxListRows))});
  ImGuiListClipper clipper;
  clipper.Begin(count, line);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      ImGui::PushID(i);
      if (context.ui_probe.noted(ImGui::Selectable("##intruder", chosen == i), "inspector/" + key_of(i)))
        context.edits.select({Selected::intruder, i, 0});
      const ImVec2 low = ImGui::GetItemRectMin();
      const ImVec2 high = ImGui::GetItemRectMax();
      ImDrawList& list = *ImGui::GetWindowDrawList();
      const float middle = (low.y + high.y) / 2;
      list.AddCircleFilled({low.x + scaled(10), middle}, scaled(4), intruder_color(i), 12);
      const bool is_wrong = has_problem(rows.problems(), i);
      const std::string& name = intruders[static_cast<std::size_t>(i)].name;
      const std::string shown = elided(name.empty() ? "(no name)" : name, high.x - low.x - scaled(is_wrong ? 44 : 24));
      list.AddText({low.x + scaled(20), middle - ImGui::GetFontSize() / 2}, color::kText, shown.c_str());
      if (is_wrong) draw_icon(list, Icon::warning, {high.x - scaled(12), middle}, ImGui::GetFontSize(), color::kBad);
      ImGui::PopID();
    }
  ImGui::EndChild();
}

void ModelBlock::draw_preview(const ViewContext& context, int intruder) {
  const float width = std::min(ImGui::GetContentRegionAvail().x, scaled(kMaxPreviewWidth));
  const ImVec2 size{std::floor(width), std::floor(width * 0.6F)};
  ImGui::InvisibleButton("preview", size);
  context.ui_probe.note_item("inspector/model preview");
  const ModelImage* const model = context.shown.model.get();
  const std::string& file = context.project().intruders[static_cast<std::size_t>(intruder)].model.file;
  const bool is_of_this = model != nullptr && is_same_file(model->file, resolved(context.project(), file));
  const bool has_failed = is_of_this && !model->problem.empty();
  // The line of its size is there before the size is known, and while the image is out of sight: nothing below moves.
  const auto leave_line = [&] {
    if (!file.empty() && !has_failed) note(" ");
  };
  if (!ImGui::IsItemVisible()) return leave_line();
  if (ImGui::IsItemActive())
    turn_rad_ = std::remainder(turn_rad_ - kTurnAPixel_rad * static_cast<double>(ImGui::GetIO().MouseDelta.x),
                               2 * std::numbers::pi);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  context.needs.turntable = PreviewRequest::Turntable{
      .intruder = intruder, .turn_rad = turn_rad_, .size_px = {static_cast<int>(size.x), static_cast<int>(size.y)}};
  tooltip_for_item(
      "Drag to turn. Does the model's nose point along the arrow, its top upwards? If not, change the axes below.");

  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, color::kCanvas, scaled(4));
  if (!is_of_this || model->rgba.empty()) {
    draw_centred(low, size, file.empty() ? "no model" : has_failed ? "no image" : "...");
    return leave_line();
  }
  list.AddImage(context.textures.of(model->rgba, Filter::smooth), low, high);
  context.ui_probe.note_item("inspector/model image");
  draw_axis(list, low, size, {1, 0, 0}, turn_rad_, color::kAccent, "nose");
  draw_axis(list, low, size, {0, 0, -1}, turn_rad_, color::kText, "top");
  note(fmt::format("{} m long, {} m span, {} m high", decimetres(model->size_m.x), decimetres(model->size_m.y),
                   decimetres(model->size_m.z)));
}

void ModelBlock::draw(const ViewContext& context, FieldRows& rows) {
  const std::optional<int> intruder = current_intruder(context);
  if (intruder)
    draw_list(context, rows);
  else
    note("No intruder yet. Add one, or drop a Wavefront OBJ file onto the window.");
  draw_buttons(context, intruder);
  if (!intruder) return;
  ImGui::Spacing();
  const std::string key = key_of(*intruder);
  const IntruderSettings& settings = context.project().intruders[static_cast<std::size_t>(*intruder)];
  rows.row(key + ".name");
  rows.row(key + ".model.file");
  if (context.ui_probe.noted(ImGui::Button("Change model..."), "inspector/change model",
                             "Shows the models that come with the program, and takes one of yours"))
    context.edits.ask(ShowModels{*intruder});
  draw_preview(context, *intruder);
  for (const Field& field : rows.sheet().fields())
    if (field.key.starts_with(key + ".model.") && field.key != key + ".model.file")
      rows.row(field.key, look_of(field, settings));
  rows.rows(key + ".contrail.", [&](const Field& field) {
    RowOptions look;
    if (settings.contrail.strands == 0 && !field.key.ends_with("strands")) look.off_because = "It has no contrail.";
    return look;
  });
  if (context.project().footage.spectrum == Spectrum::thermal) return rows.rows(key + ".heat.");
  if (context.ui_probe.noted(ImGui::Button(settings.lights.is_dark() ? "Lights on" : "Lights off"), "inspector/lights",
                             "Position lights, strobes and beacons as aircraft of this category have them; seen at "
                             "dusk and by night. White is, in the block Light, says how dark it is."))
    context.edits.change(settings.lights.is_dark() ? "lights on" : "lights off", [=](Project& project) {
      IntruderSettings& changed = project.intruders[static_cast<std::size_t>(*intruder)];
      changed.lights = changed.lights.is_dark() ? usual_lights(changed.category) : LampSettings{};
    });
  if (!settings.lights.is_dark()) rows.rows(key + ".lights.");
}

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
  if (context.ui_probe.noted(
          ImGui::Button("Estimate camera motion"), "inspector/estimate camera motion",
          "Finds how the camera turns from the footage itself, in the background, and writes it as a log beside the "
          "project. With a log that has rates of turn, both are used together."))
    context.edits.ask(EstimateCameraMotion{});
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
