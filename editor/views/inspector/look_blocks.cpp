// SPDX-License-Identifier: MIT
#include "editor/views/inspector/inspector_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "base/pose.h"
#include "editor/preview/jobs.h"
#include "scene/scene_at.h"
#include "scene/scene_light.h"

namespace sigs::editor {

namespace {

constexpr std::string_view kFirstOfColor = ", red";
constexpr std::size_t kParts = 3;  // red, green, blue, which follow each other

// Three digits, without an exponent.
// Never with an exponent for a large one.
std::string digits_text(double value, int digits) {
  return std::abs(value) < std::pow(10, digits) ? fmt::format("{:.{}g}", value, digits) : fmt::format("{:.0f}", value);
}

std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit == "deg") return number + "\u00b0";
  return unit.empty() ? number : number + " " + unit;
}

FoundLine line_of(const AppearanceQuantity& quantity) {
  const Estimate& estimate = quantity.estimate;
  const std::string name = capitalised(quantity.name);
  if (estimate.is_known)
    return {name, with_unit(digits_text(estimate.value, 3) + " \u00b1 " + digits_text(estimate.sd, 2), quantity.unit),
            "", quantity.how};
  const bool is_clear = quantity.setting == "appearance.haze.visibility_m";  // of which there is no number
  const std::string taken = is_clear ? "clear air" : with_unit(digits_text(estimate.value, 3), quantity.unit);
  return {name, "not known; " + taken, estimate.why};
}

FoundLine line_of_color(const AppearanceQuantity* parts) {
  const Estimate &red = parts[0].estimate, &green = parts[1].estimate, &blue = parts[2].estimate;
  const std::string name = capitalised(parts[0].name.substr(0, parts[0].name.size() - kFirstOfColor.size()));
  const std::string color = fmt::format("{:.2f} {:.2f} {:.2f}", red.value, green.value, blue.value);
  if (!red.is_known) return {name, "not known; " + color, red.why};
  return {name, fmt::format("{} \u00b1 {:.1g}", color, std::max({red.sd, green.sd, blue.sd})), ""};
}

void draw_cell(const std::string& text, bool is_quiet) {
  ImGui::TableNextColumn();
  draw_text(text, is_quiet ? color::kQuiet : ImGui::GetColorU32(ImGuiCol_Text));
}

void draw_line(const FoundLine& line) {
  ImGui::TableNextRow();
  draw_cell(line.name, true);
  draw_cell(line.value, !line.why.empty());
  tooltip_for_item(line.why.empty() ? line.how.c_str() : line.why.c_str());
}

void draw_found(const ViewContext& context, const Appearance& appearance) {
  ImGui::BeginGroup();
  ImGui::PushFont(font(Font::small));
  if (ImGui::BeginTable("found", 2)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    for (const FoundLine& line : found_lines(appearance)) draw_line(line);
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::EndGroup();
  context.ui_probe.note_item("inspector/found in the footage");
}

RowOptions look_of(const Field& field, const Project& project) {
  const CompositingSettings& compositing = project.compositing;
  const HazeSettings& haze = project.appearance.haze;
  RowOptions look;
  look.is_hidden = field.key.starts_with("appearance.thermal.") && project.footage.spectrum != Spectrum::thermal;
  if (compositing.method != MethodChoice::direct) look.off_because = "Counts for the direct method alone.";
  if (field.key != "appearance.haze.airlight_color") return look;
  look.is_color = true;
  if (haze.airlight != AirlightChoice::color) look.off_because = "Counts where the airlight is a colour.";
  return look;
}

}  // namespace

std::vector<FoundLine> found_lines(const Appearance& appearance) {
  const std::vector<AppearanceQuantity> quantities = quantities_of(appearance);
  std::vector<FoundLine> lines;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const bool is_color = quantities[i].name.ends_with(kFirstOfColor) && i + kParts <= quantities.size();
    lines.push_back(is_color ? line_of_color(&quantities[i]) : line_of(quantities[i]));
    if (is_color) i += kParts - 1;
  }
  return lines;
}

void AppearanceBlock::draw_match(const ViewContext& context, const AppearanceState& state) {
  if (draw_if_running(context, state, StopMatchingFootage{}, "inspector/stop matching footage")) return;
  if (context.ui_probe.noted(
          ImGui::Button("Match the footage"), "inspector/match the footage",
          "Finds blur, noise, compression, haze and light in the footage, in the background, and sets them."))
    context.edits.ask(MatchFootage{});
  if (state.value && state.value != shown_) ImGui::SetScrollHereY(0);
  shown_ = state.value;
  if (!state.value) return;
  draw_found(context, *state.value);
  ImGui::Separator();
}

void AppearanceBlock::draw(const ViewContext& context, FieldRows& rows) {
  if (context.appearance != nullptr) draw_match(context, *context.appearance);
  ImGui::Spacing();
  const Project& project = context.project();
  rows.rows("appearance.", [&](const Field& field) { return look_of(field, project); });
}

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

constexpr std::array<const char*, 5> kPointKeys{"light.kind", "light.position_m", "light.color", "light.ambient",
                                                "light.white_cdpm2"};
constexpr std::array<const char*, 3> kSunKeys{"light.kind", "light.sun.azimuth_deg", "light.sun.elevation_deg"};
constexpr std::array<const char*, 6> kSunColorKeys{"light.color",         "light.sky_color", "light.ground_color",
                                                   "light.ground_shadow", "light.exposure",  "light.white_cdpm2"};

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

// The camera in the playhead's frame.
struct Viewpoint {
  glm::dvec3 camera_m{0, 0, 0};   // in the world
  double camera_bearing_rad = 0;  // from world X to the right
};

Viewpoint viewpoint_of(const ViewContext& context) {
  const CameraPose camera = camera_pose_at(context, time_of(context, context.document.playhead()));
  return {camera.translation_m, attitude_of(camera.rotation).yaw_rad};
}

// Buttons that put the light behind, above or beside the camera: the sun's direction, or a point light at the
// distance that it has.
void draw_presets(const ViewContext& context) {
  const Viewpoint viewpoint = viewpoint_of(context);
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

// The button with which something lit is boxed in the footage; what is found while it is looked at.
void draw_lit_like(const ViewContext& context) {
  if (context.light != nullptr && draw_if_running(context, *context.light, StopLightLike{}, "inspector/stop lit like"))
    return;
  if (context.ui_probe.noted(ImGui::Button("Lit like..."), "inspector/lit like",
                             "Draw a box around a real aircraft in the footage, or another thing that the sun lights: "
                             "the exposure is set so that the intruder is as bright as it."))
    context.edits.ask(ShowLightLike{});
}

}  // namespace

void LightBlock::draw_direction(const ViewContext& context, FieldRows& rows) {
  const Viewpoint viewpoint = viewpoint_of(context);
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

void LightBlock::draw(const ViewContext& context, FieldRows& rows) {
  if (context.project().footage.spectrum == Spectrum::thermal)
    return note(
        "The footage is thermal: what flies in it is shown by its heat (in the block of the intruder), not lit.");
  draw_lit_like(context);
  if (context.project().light.kind == LightKind::sun) {
    for (const char* const key : kSunKeys) rows.row(key, look_of_light(key));
    note_sun(context);
    note("As seen from the camera");
    draw_presets(context);
    ImGui::Spacing();
    for (const char* const key : kSunColorKeys) rows.row(key, look_of_light(key));
    return;
  }
  for (const char* const key : kPointKeys) rows.row(key, look_of_light(key));
  ImGui::Spacing();
  note("As seen from the camera");
  draw_direction(context, rows);
  draw_presets(context);
}

}  // namespace sigs::editor
