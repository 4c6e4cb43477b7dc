// SPDX-License-Identifier: MIT
#include "editor/views/world/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "editor/preview/preview_output.h"
#include "scene/flight.h"
#include "scene/scene_light.h"

namespace sigs::editor {

namespace {

constexpr double kMinBody_px = 30;  // across the model's largest extent
constexpr int kMaxFaces = 300;
constexpr double kOwnColorShare = 0.35;  // of the model's, the rest is the intruder's
constexpr double kSun_px = 6;

struct ScreenFace {
  std::array<ImVec2, 3> corners;
  double depth_m = 0;
  ImU32 color = 0;
};

struct Drawing {
  glm::dmat3 world_from_body{1};
  glm::dvec3 at_m{0, 0, 0};
  double enlarged = 1;
  ImU32 color = 0;
};

ImU32 shaded(ImU32 color, const glm::vec3& own, double brightness) {
  const auto channel = [&](int shift, double own_value) {
    const double value = static_cast<double>((color >> shift) & 0xFFU);
    const double mixed = std::lerp(value, own_value * 255, kOwnColorShare) * brightness;
    return static_cast<ImU32>(std::clamp(mixed, 0.0, 255.0)) << shift;
  };
  return channel(IM_COL32_R_SHIFT, own.r) | channel(IM_COL32_G_SHIFT, own.g) | channel(IM_COL32_B_SHIFT, own.b) |
         IM_COL32_A_MASK;
}

double length_m(const Model& model) {
  const glm::vec3 extent_m = model.mesh.high_m - model.mesh.low_m;
  return std::max({extent_m.x, extent_m.y, extent_m.z, 0.01F});
}

// Bright where a face looks up and at the eye, so that the shape is seen from every side.
double brightness_of(const glm::dvec3& normal, const glm::dvec3& to_eye) {
  const glm::dvec3 lamp = glm::normalize(to_eye + glm::dvec3(0, 0, -1.2));
  return 0.3 + 0.75 * std::max(0.0, glm::dot(normal, lamp));
}

// Points of the mesh in the world and on the screen; none for those out of sight.
struct Corners {
  std::vector<glm::dvec3> in_world_m;
  std::vector<std::optional<glm::dvec2>> on_screen;
};

Corners corners_of(const WorldCanvas& canvas, const CoarseMesh& mesh, const Drawing& drawing) {
  Corners corners;
  for (const glm::vec3& point_m : mesh.points_m) {
    corners.in_world_m.push_back(drawing.at_m + drawing.world_from_body * (glm::dvec3(point_m) * drawing.enlarged));
    corners.on_screen.push_back(canvas.in_sight(corners.in_world_m.back(), 5000));
  }
  return corners;
}

std::optional<ScreenFace> visible_face(const WorldCanvas& canvas, const CoarseMesh::Face& face, const Corners& corners,
                                       const Drawing& drawing) {
  ScreenFace drawn;
  std::array<glm::dvec2, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto point = static_cast<std::size_t>(face.corners[i]);
    if (!corners.on_screen[point]) return std::nullopt;
    at[i] = *corners.on_screen[point];
    drawn.corners[i] = im(at[i]);
    drawn.depth_m += glm::dot(corners.in_world_m[point], canvas.eye().forward());
  }
  const glm::dvec2 a = at[1] - at[0];
  const glm::dvec2 b = at[2] - at[0];
  if (a.x * b.y - a.y * b.x > 0) return std::nullopt;  // from within: clockwise, with y down
  const glm::dvec3 normal = drawing.world_from_body * glm::dvec3(face.normal);
  drawn.color = shaded(drawing.color, face.color, brightness_of(normal, -canvas.eye().forward()));
  return drawn;
}

void draw_faces(WorldCanvas& canvas, const CoarseMesh& mesh, const Drawing& drawing) {
  const Corners corners = corners_of(canvas, mesh, drawing);
  std::vector<ScreenFace> drawn;
  for (const CoarseMesh::Face& face : mesh.faces)
    if (const std::optional<ScreenFace> on_screen = visible_face(canvas, face, corners, drawing))
      drawn.push_back(*on_screen);
  std::ranges::sort(drawn, [](const ScreenFace& a, const ScreenFace& b) { return a.depth_m > b.depth_m; });
  // Soft edges would let what lies behind shine through between neighbours.
  ImDrawList& list = canvas.list();
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const ScreenFace& face : drawn)
    list.AddTriangleFilled(face.corners[0], face.corners[1], face.corners[2], face.color);
  list.Flags = flags;
}

// In the aircraft's level plane, from one angle to another to the right of its nose.
void draw_arc(WorldCanvas& canvas, const Drawing& drawing, double radius_m, double from_deg, double to_deg,
              ImU32 color) {
  constexpr int kPieces = 24;
  std::vector<glm::dvec3> points_m;
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = std::lerp(from_deg, to_deg, double(i) / kPieces) * std::numbers::pi / 180;
    points_m.push_back(drawing.at_m +
                       drawing.world_from_body * (radius_m * glm::dvec3(std::cos(angle), std::sin(angle), 0)));
  }
  canvas.polyline(points_m, color, 2);
}

// From where which position light is seen (14 CFR 25.1387), and the beam of the landing light.
void draw_lights(WorldCanvas& canvas, const LampSettings& lights, const Drawing& drawing, double length_m) {
  constexpr double kSide_deg = 110, kArcRadius = 0.9, kBeam = 3;  // radius and beam in lengths of the aircraft
  const double radius_m = kArcRadius * length_m * drawing.enlarged;
  if (lights.position_cd > 0) {
    draw_arc(canvas, drawing, radius_m, -kSide_deg, 0, IM_COL32(235, 70, 70, 220));
    draw_arc(canvas, drawing, radius_m, 0, kSide_deg, IM_COL32(70, 210, 110, 220));
    draw_arc(canvas, drawing, radius_m, kSide_deg, 360 - kSide_deg, IM_COL32(235, 235, 235, 200));
  }
  if (lights.landing_cd <= 0) return;
  for (const double side : {-0.5, 0.5}) {
    const double angle = side * lights.landing_beam_deg * std::numbers::pi / 180;
    const glm::dvec3 along = drawing.world_from_body * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    canvas.dashes(drawing.at_m, drawing.at_m + along * (kBeam * length_m * drawing.enlarged),
                  IM_COL32(250, 235, 170, 200), 1.5);
  }
}

void draw_body(WorldCanvas& canvas, const WorldContext& world, const WorldBody& body, const CoarseMesh& mesh,
               bool highlighted) {
  const glm::dvec3& at_m = body.world_from_body.translation_m;
  const ImU32 color = intruder_color(body.intruder);
  draw_drop_line(canvas, at_m, color);
  const std::optional<glm::dvec2> at = canvas.in_sight(at_m, 100);
  if (!at) return;
  const double true_px = canvas.eye().pixels_per_metre(at_m, canvas.rect()) * length_m(*body.model);
  const double enlarged = std::max(1.0, scaled(kMinBody_px) / std::max(true_px, 1e-12));
  if (highlighted) canvas.list().AddCircle(im(*at), scaled(kMinBody_px) * 0.72F, color::kAccent, 0, scaled(1.5));
  const Drawing drawing{.world_from_body = glm::mat3_cast(body.world_from_body.rotation),
                        .at_m = at_m,
                        .enlarged = enlarged,
                        .color = color};
  draw_faces(canvas, mesh, drawing);
  const std::vector<IntruderSettings>& intruders = world.context.project().intruders;
  if (const auto which = static_cast<std::size_t>(body.intruder); which < intruders.size())
    draw_lights(canvas, intruders[which].lights, drawing, length_m(*body.model));
  const double distance_m = glm::distance(world.moment.world_from_camera.translation_m, at_m);
  const double aside = scaled(kMinBody_px) * 0.6 + scaled(4);
  const std::string text = distance_text(distance_m);
  if (!canvas.label(*at + glm::dvec2(aside, scaled(12)), text, color))
    canvas.label(*at + glm::dvec2(0, -aside), text, color, WorldCanvas::Side::centre);
}

void draw_sun(ImDrawList& list, const glm::dvec2& at, ImU32 color) {
  const double radius = scaled(kSun_px);
  list.AddCircleFilled(im(at), static_cast<float>(radius), color, 16);
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4;
    const glm::dvec2 along{std::cos(angle), std::sin(angle)};
    list.AddLine(im(at + along * (radius * 1.45)), im(at + along * (radius * 2.0)), color, scaled(1.5));
  }
}

// Which direction on the screen a place lies that is not in sight.
glm::dvec2 direction_to(const OrbitCamera& eye, const glm::dvec3& p_m) {
  const glm::dvec3 from_eye = p_m - eye.eye_m();
  const glm::dvec2 direction{glm::dot(from_eye, eye.right()), -glm::dot(from_eye, eye.up())};
  const double length = glm::length(direction);
  return length > 0 ? direction / length : glm::dvec2(0, -1);
}

bool is_marked_at_edge(const WorldCanvas& canvas, const glm::dvec3& light_m) {
  return !canvas.in_sight(light_m, -static_cast<double>(scaled(12)));
}

void draw_arrow_to_light(WorldCanvas& canvas, const glm::dvec2& at, const glm::dvec3& light_m, const std::string& text,
                         ImU32 color) {
  const glm::dvec2 direction = direction_to(canvas.eye(), light_m);
  const glm::dvec2 across{-direction.y, direction.x};
  const glm::dvec2 tip = at + direction * static_cast<double>(scaled(17));
  const glm::dvec2 neck = tip - direction * static_cast<double>(scaled(6));
  const double half = scaled(4.5);
  canvas.list().AddTriangleFilled(im(tip), im(neck + across * half), im(neck - across * half), color);
  const bool on_right = at.x > (canvas.rect().low.x + canvas.rect().high.x) / 2;
  ImFont* face = font(Font::small);
  const double width = face->CalcTextSizeA(face->FontSize, 1e6F, 0, text.c_str()).x;
  const double aside = on_right ? -scaled(18) - width : scaled(18);
  canvas.label(at + glm::dvec2(aside, std::abs(direction.y) > 0.7 ? 0 : scaled(18)), text, color::kQuiet);
}

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

const CoarseMesh& BodyShapes::of(const std::shared_ptr<const Model>& model) {
  const auto [entry, is_new] = shapes_.try_emplace(model);
  if (is_new) entry->second = coarse(model->mesh, kMaxFaces);
  return entry->second;
}

void BodyShapes::keep_only(const std::vector<WorldBody>& bodies) {
  std::erase_if(shapes_, [&](const auto& entry) {
    return std::ranges::none_of(bodies, [&](const WorldBody& body) { return body.model == entry.first; });
  });
}

void draw_bodies(WorldCanvas& canvas, const WorldContext& world, BodyShapes& shapes, const Selection& hovered) {
  std::vector<const WorldBody*> far_to_near;
  for (const WorldBody& body : world.moment.bodies)
    if (body.model) far_to_near.push_back(&body);
  const glm::dvec3 forward = canvas.eye().forward();
  std::ranges::stable_sort(far_to_near, [&](const WorldBody* a, const WorldBody* b) {
    return glm::dot(a->world_from_body.translation_m - b->world_from_body.translation_m, forward) > 0;
  });
  const Selection& selection = world.context.document.selection();
  for (const WorldBody* body : far_to_near) {
    const auto means = [&](const Selection& s) { return s.kind == Selected::intruder && s.intruder == body->intruder; };
    draw_body(canvas, world, *body, shapes.of(body->model), means(selection) || means(hovered));
  }
  shapes.keep_only(world.moment.bodies);
}

glm::dvec3 shown_light_m(const WorldContext& world) {
  constexpr double kAway_m = 1e7;
  const LightSettings& light = world.context.project().light;
  if (light.kind == LightKind::point) return light.position_m;
  const OpenedScene* const opened = world.context.shown.scene.get();
  const glm::dvec3 to_sun =
      opened != nullptr ? sunlight_at(opened->draft.scene, world.moment.time_s).to_sun : glm::dvec3(0, 0, -1);
  return world.moment.world_from_camera.translation_m + kAway_m * to_sun;
}

glm::dvec2 light_mark(const WorldCanvas& canvas, const glm::dvec3& light_m) {
  if (!is_marked_at_edge(canvas, light_m)) return *canvas.in_sight(light_m);
  const glm::dvec2 middle = (canvas.rect().low + canvas.rect().high) / 2.0;
  const glm::dvec2 room = glm::max(canvas.rect().size() / 2.0 - static_cast<double>(scaled(22)), 1.0);
  const glm::dvec2 direction = direction_to(canvas.eye(), light_m);
  const double reach =
      std::min(room.x / std::max(std::abs(direction.x), 1e-9), room.y / std::max(std::abs(direction.y), 1e-9));
  return middle + direction * reach;
}

void draw_light(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered) {
  if (world.context.project().footage.spectrum == Spectrum::thermal) return;  // nothing is lit
  const glm::dvec3 light_m = shown_light_m(world);
  const bool is_sun = world.context.project().light.kind == LightKind::sun;
  const bool is_selected = world.context.document.selection().kind == Selected::light;
  const bool highlighted = is_selected || hovered.kind == Selected::light;
  const ImU32 color = highlighted ? color::kAccent : color::kLight;
  const glm::dvec2 at = light_mark(canvas, light_m);
  if (is_marked_at_edge(canvas, light_m)) {
    const double distance_m = glm::distance(light_m, world.moment.world_from_camera.translation_m);
    const std::string text = "light " + distance_text(distance_m) + (is_selected ? "  (F: in sight)" : "");
    draw_arrow_to_light(canvas, at, light_m, is_sun ? "sun" : text, color);
  } else if (!is_sun) {
    draw_drop_line(canvas, light_m, color);
  }
  draw_sun(canvas.list(), at, color);
}

void draw_volumes(WorldCanvas& canvas, const WorldContext& world) {
  for (const WellClearVolume& volume : shown_volumes(world.context.project())) draw_volume(canvas, world, volume);
}

}  // namespace sigs::editor
