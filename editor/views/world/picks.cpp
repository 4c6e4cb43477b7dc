// SPDX-License-Identifier: MIT
#include "editor/views/world/world_view.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "editor/geometry/image_view.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kPickReach_px = 9;
constexpr double kBodyReach_px = 16;
constexpr double kCurveReach_px = 6;
constexpr double kMaxCoordinate_m = 1e6;  // of a new waypoint from the camera
constexpr double kMinSlope = 0.12;        // below, the view looks along level ground

double depth_m(const WorldCanvas& canvas, const glm::dvec3& at_m) {
  return glm::dot(at_m - canvas.eye().eye_m(), canvas.eye().forward());
}

// What can be picked, and where the screen shows it.
struct Offers {
  std::vector<Selection> what;
  std::vector<PickPoint> points;

  void add(const Selection& offered, const WorldCanvas& canvas, const glm::dvec3& at_m) {
    what.push_back(offered);
    points.push_back({canvas.in_sight(at_m, 20), depth_m(canvas, at_m)});
  }
  [[nodiscard]] std::optional<Selection> at(const glm::dvec2& mouse, double reach_px) const {
    const std::optional<std::size_t> found = nearest_point(points, mouse, reach_px);
    return found ? std::optional(what[*found]) : std::nullopt;
  }
};

// Those of the intruder that is worked on come first.
Offers waypoints_offered(const WorldCanvas& canvas, const ViewContext& context, bool of_current) {
  Offers offers;
  const std::optional<int> current = current_intruder(context);
  for (int i = 0; i < static_cast<int>(context.project().intruders.size()); ++i) {
    if ((i == current) != of_current) continue;
    const auto& waypoints = context.project().intruders[static_cast<std::size_t>(i)].trajectory.waypoints;
    for (int w = 0; w < static_cast<int>(waypoints.size()); ++w)
      offers.add({Selected::waypoint, i, w}, canvas, waypoints[static_cast<std::size_t>(w)].position_m);
  }
  return offers;
}

Offers things_offered(const WorldCanvas& canvas, const WorldContext& world) {
  Offers offers;
  for (const WorldBody& body : world.moment.bodies)
    offers.add({Selected::intruder, body.intruder, 0}, canvas, body.world_from_body.translation_m);
  offers.add({Selected::camera, 0, 0}, canvas, world.moment.world_from_camera.translation_m);
  if (world.context.project().footage.spectrum == Spectrum::visible) {
    offers.what.push_back({Selected::light, 0, 0});
    offers.points.push_back({light_mark(canvas, shown_light_m(world)), 1e9});
  }
  return offers;
}

struct CurvePlace {
  WorldPick pick;
  double distance_px = 0;
};

std::optional<CurvePlace> place_on(const WorldCurve& curve, const WorldCanvas& canvas, const glm::dvec2& mouse) {
  const CurveSamples& samples = curve.samples;
  std::vector<std::optional<glm::dvec2>> on_screen;
  for (const glm::dvec3& point_m : samples.points_m) on_screen.push_back(canvas.in_sight(point_m, 1e5));
  const std::optional<PlaceOnLine> place = nearest_place(on_screen, mouse, scaled(kCurveReach_px));
  if (!place) return std::nullopt;
  const std::size_t i = place->segment;
  const bool parallel = canvas.eye().projection == Projection::parallel;
  const double share = parallel ? place->share
                                : share_in_world(place->share, depth_m(canvas, samples.points_m[i]),
                                                 depth_m(canvas, samples.points_m[i + 1]));
  const double frame = std::lerp(samples.at[i], samples.at[i + 1], share);
  return CurvePlace{{{Selected::nothing, curve.intruder, 0}, frame}, place->distance_px};
}

WorldPick curve_at(const WorldCanvas& canvas, const WorldContext& world, const glm::dvec2& mouse) {
  CurvePlace nearest{.distance_px = 1e9};
  for (const WorldCurve& curve : world.model.curves) {
    if (static_cast<std::size_t>(curve.intruder) >= world.context.project().intruders.size()) continue;
    const std::optional<CurvePlace> place = place_on(curve, canvas, mouse);
    if (place && place->distance_px < nearest.distance_px) nearest = *place;
  }
  return nearest.pick;
}

}  // namespace

WorldPick pick_at(const WorldCanvas& canvas, const WorldContext& world, const glm::dvec2& mouse) {
  for (const bool of_current : {true, false})
    if (const auto found = waypoints_offered(canvas, world.context, of_current).at(mouse, scaled(kPickReach_px)))
      return {*found, {}};
  if (const auto found = things_offered(canvas, world).at(mouse, scaled(kBodyReach_px))) return {*found, {}};
  return curve_at(canvas, world, mouse);
}

std::optional<Movable> movable(const WorldContext& world, const Selection& what) {
  const Project& project = world.context.project();
  if (what.kind == Selected::light && project.light.kind == LightKind::point)
    return Movable{what, "Light", project.light.position_m};
  if (what.kind == Selected::camera && glm::any(movable_axes(world.context)))
    return Movable{what, "Camera", world.moment.world_from_camera.translation_m};
  if (what.kind != Selected::waypoint) return std::nullopt;
  const WaypointSettings* const waypoint = waypoint_of(project, what.intruder, what.waypoint);
  if (waypoint == nullptr) return std::nullopt;
  const long frame = std::lround(frame_of_waypoint(world.context, what.intruder, what.waypoint));
  return Movable{what, fmt::format("Waypoint at frame {}", frame), waypoint->position_m};
}

std::string gesture_of(const Selection& moved) {
  if (moved.kind == Selected::waypoint) return gesture_of_waypoint(moved.intruder, moved.waypoint);
  return moved.kind == Selected::light ? "move light" : "move camera";
}

void move_to(const WorldContext& world, const Movable& moved, const glm::dvec3& to_m) {
  Edits& edits = world.context.edits;
  if (moved.what.kind == Selected::waypoint)
    world.context.edits.move_waypoint(moved.what.intruder, moved.what.waypoint, to_m, gesture_of(moved.what));
  if (moved.what.kind == Selected::light)
    edits.change(
        "move light", [=](Project& project) { project.light.position_m = to_m; }, gesture_of(moved.what));
  if (moved.what.kind != Selected::camera) return;
  // The project holds where it starts: all of its way moves along.
  const glm::dvec3 way_m = to_m - world.moment.world_from_camera.translation_m;
  const glm::dvec3 start_m =
      world.context.project().camera.position_m + glm::mix(glm::dvec3(0), way_m, movable_axes(world.context));
  edits.change(
      "move camera", [=](Project& project) { project.camera.position_m = start_m; }, gesture_of(moved.what));
}

std::optional<glm::dvec3> place_for_waypoint(const WorldCanvas& canvas, const WorldContext& world,
                                             const glm::dvec2& mouse) {
  const ViewContext& context = world.context;
  const std::optional<int> intruder = current_intruder(context);
  if (!intruder) return std::nullopt;
  const glm::dvec3 camera_m = world.moment.world_from_camera.translation_m;
  const glm::dvec3 through_m = position_of(context, *intruder, context.document.playhead()).value_or(camera_m);
  const Ray ray = canvas.eye().ray_at(mouse, canvas.rect());
  const bool level = std::abs(ray.direction.z) >= kMinSlope;
  const glm::dvec3 forward = canvas.eye().forward();
  const glm::dvec3 normal = level ? glm::dvec3(0, 0, 1) : glm::normalize(glm::dvec3(forward.x, forward.y, 0));
  const double slope = glm::dot(ray.direction, normal);
  const double along_m = glm::dot(through_m - ray.origin_m, normal) / slope;
  const bool before = canvas.eye().projection == Projection::parallel || along_m > 0;
  const glm::dvec3 place_m = ray.origin_m + ray.direction * along_m;
  if (!std::isfinite(along_m) || !before || glm::distance(place_m, camera_m) > kMaxCoordinate_m) return std::nullopt;
  return place_m;
}

}  // namespace sigs::editor
