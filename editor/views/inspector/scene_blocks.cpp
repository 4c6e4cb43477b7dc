// SPDX-License-Identifier: MIT

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string_view>

#include "base/pose.h"
#include "base/text.h"
#include "editor/document/field_edits.h"
#include "editor/preview/thumbnails.h"
#include "editor/views/inspector/scene_blocks.h"

#include <fmt/format.h>

#include "editor/views/shown_camera.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"

namespace sigs::editor {

namespace {

constexpr double kMinDistance_m = 1;
constexpr double kMaxDistance_m = 1e7;
constexpr double kUsualDistance_m = 4000;  // where the light was at the camera itself

struct Preset {
  const char* label;
  const char* tooltip;
  double bearing_deg;
  double elevation_deg;
};
constexpr std::array<Preset, 4> kPresets{{
    {"Behind", "30 degrees high in the camera's back: what it sees is lit from the front", 180, 30},
    {"Overhead", "Straight above the camera", 0, 90},
    {"Left", "30 degrees high to the left", -90, 30},
    {"Right", "30 degrees high to the right", 90, 30},
}};

double wrapped_deg(double angle_deg) {
  return angle_deg - 360 * std::ceil((angle_deg - 180) / 360);
}

void put_light(const ViewContext& context, const LightDirection& direction, const glm::dvec3& camera_m,
               const std::string& gesture) {
  // Centimetres are enough for a light, and keep numbers short.
  const glm::dvec3 position_m = glm::round(position_of(direction, camera_m) * 100.0) / 100.0;
  context.edits.change(
      "move light", [=](Project& project) { put_value(project, "light.position_m", position_m); }, gesture);
}

// Its azimuth is from world X, as bearings are here; tenths of a degree are enough.
void put_sun(const ViewContext& context, double bearing_deg, double elevation_deg) {
  const double azimuth_deg = std::round(10 * wrapped_deg(bearing_deg)) / 10;
  context.edits.change("turn sun", [=](Project& project) {
    project.light.sun = {.azimuth_deg = azimuth_deg, .elevation_deg = elevation_deg};
  });
}

bool slider(FieldRows& rows, const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags) {
  const float width = rows.begin_row(label);
  ImGui::SetNextItemWidth(width);
  ImGui::PushID(label);
  const bool moved = ImGui::SliderScalar("##slider", ImGuiDataType_Double, &value, &low, &high, format,
                                         flags | ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopID();
  return moved;
}

}  // namespace

LightBlock::Viewpoint LightBlock::viewpoint_of(const ViewContext& context) {
  const CameraPose camera = camera_pose_at(context, time_of(context, context.document.playhead()));
  return {camera.translation_m, attitude_of(camera.rotation).yaw_rad};
}

void LightBlock::draw_direction(const ViewContext& context, FieldRows& rows, const Viewpoint& viewpoint) {
  LightDirection light = dragged_.value_or(direction_of(context.project().light.position_m, viewpoint.camera_m));
  double bearing_deg = wrapped_deg(deg_of_rad(light.bearing_rad - viewpoint.camera_bearing_rad));
  double elevation_deg = deg_of_rad(light.elevation_rad);
  bool is_held = false;
  bool has_moved = false;
  const auto one = [&](const char* label, double& value, double low, double high, const char* format,
                       ImGuiSliderFlags flags, const char* tooltip) {
    has_moved |= slider(rows, label, value, low, high, format, flags);
    context.ui_probe.note_item(std::string("inspector/light ") + label);
    is_held |= ImGui::IsItemActive();
    if (ImGui::IsItemDeactivated()) context.edits.end_gesture();
    tooltip_for_item(tooltip);
  };
  one("Bearing", bearing_deg, -180, 180, "%.0f°", 0,
      "From the camera's heading, in the playhead's frame; to the right is positive. Ctrl+click to type.");
  one("Elevation", elevation_deg, -90, 90, "%.0f°", 0, "Above the horizon. Ctrl+click to type.");
  one("Distance", light.distance_m, kMinDistance_m, kMaxDistance_m, light.distance_m < 100 ? "%.1f m" : "%.0f m",
      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat,
      "From the camera. A light far away shines from one direction on everything.");
  if (has_moved) {
    light.bearing_rad = rad_of_deg(bearing_deg) + viewpoint.camera_bearing_rad;
    light.elevation_rad = rad_of_deg(elevation_deg);
    put_light(context, light, viewpoint.camera_m, "light direction");
  }
  dragged_ = is_held ? std::optional(light) : std::nullopt;
}

void LightBlock::draw_presets(const ViewContext& context, const Viewpoint& viewpoint) const {
  const double now_m = direction_of(context.project().light.position_m, viewpoint.camera_m).distance_m;
  const bool is_sun = context.project().light.kind == LightKind::sun;
  ButtonFlow flow;
  for (const Preset& preset : kPresets) {
    const bool is_pressed = flow.button(preset.label, preset.tooltip);
    if (is_pressed && is_sun)
      put_sun(context, deg_of_rad(viewpoint.camera_bearing_rad) + preset.bearing_deg, preset.elevation_deg);
    else if (is_pressed)
      put_light(context,
                {.bearing_rad = viewpoint.camera_bearing_rad + rad_of_deg(preset.bearing_deg),
                 .elevation_rad = rad_of_deg(preset.elevation_deg),
                 .distance_m = now_m >= kMinDistance_m ? now_m : kUsualDistance_m},
                viewpoint.camera_m, "");
    context.ui_probe.note_item(std::string("inspector/light preset ") + preset.label);
  }
}

namespace {

constexpr std::array<const char*, 4> kPointKeys{"light.kind", "light.position_m", "light.color", "light.ambient"};
constexpr std::array<const char*, 3> kSunKeys{"light.kind", "light.sun.azimuth_deg", "light.sun.elevation_deg"};
constexpr std::array<const char*, 4> kSunColorKeys{"light.color", "light.sky_color", "light.ground_color",
                                                   "light.exposure"};

RowOptions look_of_light(std::string_view key) {
  RowOptions look;
  look.is_color = key.ends_with("color");
  return look;
}

// Where the sun stands in the playhead's frame, wherever that comes from.
void note_sun(const ViewContext& context) {
  const OpenedScene* const opened = context.shown.scene.get();
  if (opened == nullptr || opened->draft.scene.light.kind != LightKind::sun) return;
  const Sunlight sun = sunlight_at(opened->draft.scene, time_of(context, context.document.playhead()));
  const double bearing_deg = deg_of_rad(std::atan2(sun.to_sun.y, sun.to_sun.x));
  const double elevation_deg = deg_of_rad(std::asin(std::clamp(-sun.to_sun.z, -1.0, 1.0)));
  note(fmt::format("In the playhead's frame the sun stands {:.1f} deg from world X to the right, {:.1f} deg high{}",
                   bearing_deg, elevation_deg, sun.visible_share > 0 ? "." : ": it has set."));
}

}  // namespace

void LightBlock::draw(const ViewContext& context, FieldRows& rows) {
  if (context.project().light.kind == LightKind::sun) {
    for (const char* const key : kSunKeys) rows.row(key, look_of_light(key));
    note_sun(context);
    note("As seen from the camera");
    draw_presets(context, viewpoint_of(context));
    ImGui::Spacing();
    for (const char* const key : kSunColorKeys) rows.row(key, look_of_light(key));
    return;
  }
  for (const char* const key : kPointKeys) rows.row(key, look_of_light(key));
  ImGui::Spacing();
  note("As seen from the camera");
  const Viewpoint viewpoint = viewpoint_of(context);
  draw_direction(context, rows, viewpoint);
  draw_presets(context, viewpoint);
}

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

}  // namespace

void draw_inputs(const ViewContext& context, FieldRows& rows) {
  const OpenedScene* const scene = context.shown.scene.get();
  rows.row("footage.video");
  if (scene != nullptr && scene->footage) draw_video(*scene->footage, rows);
  RowOptions last;
  last.suggested = scene != nullptr ? double(scene->draft.scene.footage.times_s.size()) - 1 : 0;
  for (const Field& field : rows.sheet().fields()) {
    if (!field.key.starts_with("footage.") || field.key == "footage.video") continue;
    if (field.key.starts_with("footage.occluder_")) continue;  // with the own body
    rows.row(field.key, field.key == "footage.last_frame" ? last : RowOptions());
    if (field.key == "footage.calibration" && scene != nullptr && !rows.problems().contains(field.key))
      note(lens_text(scene->draft.scene.camera));
  }
}

namespace {

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
  if (flow.button("Add", "Another intruder, 300 m ahead of the camera and crossing")) add_intruder(context);
  context.ui_probe.note_item("inspector/add intruder");
  if (flow.button("Duplicate", "A copy of this one, 30 m to its right", intruder.has_value()))
    duplicate_intruder(context, *intruder);
  context.ui_probe.note_item("inspector/duplicate intruder");
  if (flow.button("Delete", "Takes this intruder out of the project", intruder.has_value()))
    delete_intruder(context, *intruder);
  context.ui_probe.note_item("inspector/delete intruder");
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
      if (ImGui::Selectable("##intruder", chosen == i)) context.edits.select({Selected::intruder, i, 0});
      context.ui_probe.note_item("inspector/" + key_of(i));
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
  if (!ImGui::IsItemVisible()) return;
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
  const ModelImage* const model = context.shown.model.get();
  const std::string& file = context.project().intruders[static_cast<std::size_t>(intruder)].model.file;
  const bool is_of_this = model != nullptr && is_same_file(model->file, resolved(context.project(), file));
  if (!is_of_this || model->rgba.empty()) {
    draw_centred(low, size, file.empty() ? "no model" : is_of_this && !model->problem.empty() ? "no image" : "...");
    return;
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
  if (ImGui::Button("Change model...")) context.edits.ask(ShowModels{*intruder});
  context.ui_probe.note_item("inspector/change model");
  tooltip_for_item("Shows the models that come with the program, and takes one of yours");
  draw_preview(context, *intruder);
  for (const Field& field : rows.sheet().fields())
    if (field.key.starts_with(key + ".model.") && field.key != key + ".model.file")
      rows.row(field.key, look_of(field, settings));
}

}  // namespace sigs::editor
