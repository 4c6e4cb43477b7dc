// SPDX-License-Identifier: MIT
#include "editor/views/inspector/light.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "editor/document/field_texts.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kLeastDistance_m = 1;
constexpr double kMostDistance_m = 1e7;
constexpr double kUsualDistance_m = 4000;  // where the light has stood at the camera itself

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

void put_light(const Studio& studio, const LightDirection& direction, const glm::dvec3& camera_m,
               const std::string& gesture) {
  // Centimetres are enough for a light, and keep numbers short.
  const glm::dvec3 position_m = glm::round(position_of(direction, camera_m) * 100.0) / 100.0;
  studio.edits.change(
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

LightBlock::Seen LightBlock::seen_from(const Studio& studio) {
  const CameraSettings& camera = studio.project().camera;
  const double time_s =
      studio.shown.scene ? time_of_frame_s(studio.shown.scene->draft.scene.footage, studio.document.playhead()) : 0;
  return {camera.position_m + glm::dvec3(camera.speed_mps * time_s, 0, 0), rad_of_deg(camera.yaw_deg)};
}

void LightBlock::draw_direction(const Studio& studio, FieldRows& rows, const Seen& seen) {
  LightDirection light = dragged_.value_or(direction_of(studio.project().light.position_m, seen.camera_m));
  double bearing_deg = wrapped_deg(deg_of_rad(light.bearing_rad - seen.camera_bearing_rad));
  double elevation_deg = deg_of_rad(light.elevation_rad);
  bool is_held = false;
  bool has_moved = false;
  const auto one = [&](const char* label, double& value, double low, double high, const char* format,
                       ImGuiSliderFlags flags, const char* tooltip) {
    has_moved |= slider(rows, label, value, low, high, format, flags);
    studio.places.note_item(std::string("inspector/light ") + label);
    is_held |= ImGui::IsItemActive();
    if (ImGui::IsItemDeactivated()) studio.edits.end_gesture();
    tooltip_for_item(tooltip);
  };
  one("Bearing", bearing_deg, -180, 180, "%.0f°", 0,
      "From the camera's heading, in the playhead's frame; to the right is positive. Ctrl+click to type.");
  one("Elevation", elevation_deg, -90, 90, "%.0f°", 0, "Above the horizon. Ctrl+click to type.");
  one("Distance", light.distance_m, kLeastDistance_m, kMostDistance_m, light.distance_m < 100 ? "%.1f m" : "%.0f m",
      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat,
      "From the camera. A light far away shines from one direction on everything.");
  if (has_moved) {
    light.bearing_rad = rad_of_deg(bearing_deg) + seen.camera_bearing_rad;
    light.elevation_rad = rad_of_deg(elevation_deg);
    put_light(studio, light, seen.camera_m, "light direction");
  }
  dragged_ = is_held ? std::optional(light) : std::nullopt;
}

void LightBlock::draw_presets(const Studio& studio, const Seen& seen) const {
  const double now_m = direction_of(studio.project().light.position_m, seen.camera_m).distance_m;
  ButtonFlow flow;
  for (const Preset& preset : kPresets) {
    if (flow.button(preset.label, preset.tooltip))
      put_light(studio,
                {.bearing_rad = seen.camera_bearing_rad + rad_of_deg(preset.bearing_deg),
                 .elevation_rad = rad_of_deg(preset.elevation_deg),
                 .distance_m = now_m >= kLeastDistance_m ? now_m : kUsualDistance_m},
                seen.camera_m, "");
    studio.places.note_item(std::string("inspector/light preset ") + preset.label);
  }
}

void LightBlock::draw(const Studio& studio, FieldRows& rows) {
  rows.rows("light.", [](const Field& field) {
    RowLook look;
    look.is_color = field.key == "light.color";
    return look;
  });
  ImGui::Spacing();
  note("As seen from the camera");
  const Seen seen = seen_from(studio);
  draw_direction(studio, rows, seen);
  draw_presets(studio, seen);
}

}  // namespace sigs::editor
