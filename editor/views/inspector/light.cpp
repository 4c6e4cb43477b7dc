// SPDX-License-Identifier: MIT
#include "editor/views/inspector/light.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/pose.h"
#include "editor/document/field_texts.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kMinDistance_m = 1;
constexpr double kMaxDistance_m = 1e7;
constexpr double kUsualDistance_m = 4000;  // where the light has with_preset at the camera itself

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

void put_light(const ViewContext& context, const LightDirection& direction, const glm::dvec3& camera_m,
               const std::string& gesture) {
  // Centimetres are enough for a light, and keep numbers short.
  const glm::dvec3 position_m = glm::round(position_of(direction, camera_m) * 100.0) / 100.0;
  context.edits.change(
      "move light", [=](Project& project) { put_value(project, "light.position_m", position_m); }, gesture);
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

double wrapped_deg(double angle_deg) {
  return angle_deg - 360 * std::ceil((angle_deg - 180) / 360);
}

}  // namespace

LightBlock::Viewpoint LightBlock::viewpoint_of(const ViewContext& context) {
  const CameraSettings& camera = context.project().camera;
  const double time_s =
      context.shown.scene ? time_of_frame_s(context.shown.scene->draft.scene.footage, context.document.playhead()) : 0;
  return {camera.position_m + glm::dvec3(camera.speed_mps * time_s, 0, 0), rad_of_deg(camera.yaw_deg)};
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
  ButtonFlow flow;
  for (const Preset& preset : kPresets) {
    if (flow.button(preset.label, preset.tooltip))
      put_light(context,
                {.bearing_rad = viewpoint.camera_bearing_rad + rad_of_deg(preset.bearing_deg),
                 .elevation_rad = rad_of_deg(preset.elevation_deg),
                 .distance_m = now_m >= kMinDistance_m ? now_m : kUsualDistance_m},
                viewpoint.camera_m, "");
    context.ui_probe.note_item(std::string("inspector/light preset ") + preset.label);
  }
}

void LightBlock::draw(const ViewContext& context, FieldRows& rows) {
  rows.rows("light.", [](const Field& field) {
    RowOptions look;
    look.is_color = field.key == "light.color";
    return look;
  });
  ImGui::Spacing();
  note("As viewpoint from the camera");
  const Viewpoint viewpoint = viewpoint_of(context);
  draw_direction(context, rows, viewpoint);
  draw_presets(context, viewpoint);
}

}  // namespace sigs::editor
