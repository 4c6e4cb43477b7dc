// SPDX-License-Identifier: MIT
#include "editor/views/world/volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "editor/preview/encounter_survey.h"
#include "editor/widgets/texts.h"
#include "scene/encounter_tracks.h"

namespace sigs::editor {

namespace {

constexpr int kPoints = 96;  // of a circle
constexpr int kUprights = 12;

bool is_lost_to_any(const WorldContext& world, const WellClearVolume& volume) {
  if (!world.context.shown.scene) return false;
  const Scene& scene = world.context.shown.scene->draft.scene;
  const AircraftState own = encounter_track_of_camera(scene).at(world.moment.time_s);
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const AircraftState intruder = encounter_track_of_intruder(scene, i).at(world.moment.time_s);
    if (has_lost_well_clear(relative_state(own, intruder), volume)) return true;
  }
  return false;
}

glm::dvec3 on_circle(const glm::dvec3& center_m, double radius_m, int point, int points) {
  const double angle = 2 * std::numbers::pi * point / points;
  return center_m + radius_m * glm::dvec3(std::cos(angle), std::sin(angle), 0);
}

void draw_circle(WorldCanvas& canvas, const glm::dvec3& center_m, double radius_m, ImU32 shade, double width) {
  std::vector<glm::dvec3> points_m;
  for (int i = 0; i <= kPoints; ++i) points_m.push_back(on_circle(center_m, radius_m, i, kPoints));
  canvas.polyline(points_m, shade, width);
}

// At the first place of the upper edge, from the camera's right on, that has room.
void draw_label(WorldCanvas& canvas, const glm::dvec3& center_m, double radius_m, const std::string& text,
                ImU32 shade) {
  for (int i = 0; i < kPoints; i += 4)
    if (const std::optional<glm::dvec2> at =
            canvas.in_sight(on_circle(center_m, radius_m, (kPoints / 4 + i) % kPoints, kPoints), -scaled(12)))
      if (canvas.label_beside(*at, scaled(9), text, shade)) return;
}

void draw_volume(WorldCanvas& canvas, const WorldContext& world, const WellClearVolume& volume) {
  const bool is_lost = is_lost_to_any(world, volume);
  const ImU32 shade = is_lost ? color::kBad : color::kGood;
  const double radius_m = std::max(volume.dmod_m, volume.hmd_m);
  const glm::dvec3 up_m{0, 0, -volume.zthr_m};
  const glm::dvec3& center_m = world.moment.world_from_camera.translation_m;
  for (const glm::dvec3& level_m : {center_m + up_m, center_m - up_m})
    draw_circle(canvas, level_m, radius_m, faded(shade, is_lost ? 0.85 : 0.6), is_lost ? 1.8 : 1.3);
  draw_circle(canvas, center_m, radius_m, faded(shade, 0.22), 1);
  for (int i = 0; i < kUprights; ++i) {
    const glm::dvec3 foot_m = on_circle(center_m, radius_m, i, kUprights);
    canvas.line(foot_m - up_m, foot_m + up_m, faded(shade, 0.28), 1);
  }
  draw_label(canvas, center_m + up_m, radius_m,
             fmt::format("{}  {}, \u00b1{}{}", volume.name, distance_text(radius_m), distance_text(volume.zthr_m),
                         is_lost ? ", lost" : ""),
             shade);
}

}  // namespace

void draw_volumes(WorldCanvas& canvas, const WorldContext& world) {
  for (const WellClearVolume& volume : shown_volumes(world.context.project())) draw_volume(canvas, world, volume);
}

}  // namespace sigs::editor
