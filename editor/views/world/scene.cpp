// SPDX-License-Identifier: MIT
#include "editor/views/world/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/geometry/rulers.h"
#include "editor/views/waypoint_actions.h"

namespace sigs::editor {

namespace {

constexpr double kEdgeOn_rad = 0.03;
constexpr double kLabelledReach = 1.5;  // times the eye's distance: beyond, the lines are too close to each other
constexpr ImU32 kLine = IM_COL32(255, 255, 255, 15);
constexpr ImU32 kBoldLine = IM_COL32(255, 255, 255, 34);

bool is_edge_on(const OrbitCamera& eye) {
  return std::abs(eye.elevation_rad) < kEdgeOn_rad;
}

std::string text_of(const GridLine& line) {
  return (line.is_of_x ? "X " : "Y ") + round_distance_text(line.at_m);
}

void draw_label(WorldCanvas& canvas, const GridLine& line, double text_px) {
  const double from_target_m = std::abs(line.at_m - canvas.eye().target_m[line.is_of_x ? 0 : 1]);
  if (from_target_m > kLabelledReach * canvas.eye().distance_m) return;
  const auto ends = canvas.within_rect(line.ends_m[0], line.ends_m[1]);
  if (!ends) return;
  const auto [a, b] = *ends;
  // Lines of one x end below, those of one y at the left, whichever direction they run.
  const bool a_is_it = line.is_of_x == (std::abs(canvas.eye().right().y) > 0.7) ? a.x < b.x : a.y > b.y;
  const glm::dvec2 at = a_is_it ? a : b;
  const glm::dvec2 inwards = glm::normalize((a_is_it ? b : a) - at + glm::dvec2(1e-9));
  const ImU32 color = faded(line.is_of_x ? color::kAxisX : color::kAxisY, 0.9);
  canvas.label(at + inwards * (2.2 * text_px), text_of(line), color, WorldCanvas::Side::centre);
}

// Level with the ground it is one line, with the metres along it.
void draw_edge_on(WorldCanvas& canvas, const GroundGrid& grid, double text_px) {
  const bool along_x = std::abs(canvas.eye().right().x) > 0.7;
  for (const GridLine& line : grid.lines) {
    if (line.is_of_x != along_x) continue;
    const glm::dvec3 foot_m = (line.ends_m[0] + line.ends_m[1]) / 2.0;
    const std::optional<glm::dvec2> foot = canvas.in_sight(foot_m);
    if (!foot) continue;
    const bool marked = std::llround(line.at_m / grid.step_m) % 5 == 0;
    const glm::dvec2 down{0, text_px * (marked ? 0.6 : 0.35)};
    canvas.list().AddLine(im(*foot), im(*foot + down), faded(color::kQuiet, 0.6));
    if (marked)
      canvas.label(*foot + glm::dvec2(0, text_px * 1.3), text_of(line),
                   faded(along_x ? color::kAxisX : color::kAxisY, 0.75), WorldCanvas::Side::centre);
  }
  const auto across = std::ranges::find_if(grid.lines, [&](const GridLine& line) { return line.is_of_x != along_x; });
  if (across != grid.lines.end()) canvas.line(across->ends_m[0], across->ends_m[1], faded(color::kQuiet, 0.6));
}

constexpr double kCamera_px = 13;      // of the little camera, along its axis
constexpr double kCameraAxes_px = 24;  // of its axes
constexpr double kTick_px = 3.5;       // half a mark across a trajectory
constexpr double kMinTickGap_px = 7;
constexpr ImU32 kCameraColor = IM_COL32(214, 222, 235, 255);

bool is_current(const ViewContext& context, int intruder) {
  return current_intruder(context) == intruder;
}

// The image's edge at a depth, in the world.
std::vector<glm::dvec3> border_at(const ImageBorder& border, double depth_m, const CameraPose& world_from_camera) {
  std::vector<glm::dvec3> points_m;
  for (const glm::dvec3& ray : border.rays) points_m.push_back(world_from_camera * (ray * depth_m));
  if (!points_m.empty()) points_m.push_back(points_m.front());
  return points_m;
}

void draw_field_of_view(WorldCanvas& canvas, const ImageBorder& border, double depth_m, const CameraPose& pose,
                        bool highlighted) {
  const std::vector<glm::dvec3> edge_m = border_at(border, depth_m, pose);
  for (const std::size_t corner : border.corners)
    canvas.line(pose.translation_m, edge_m[corner], faded(kCameraColor, highlighted ? 0.4 : 0.14));
  canvas.polyline(edge_m, faded(kCameraColor, highlighted ? 0.5 : 0.2), 1);
}

// The other cameras of a rig, and the names of all. They are near each other: at its far end a field of view is told
// from the others.
void draw_rig(WorldCanvas& canvas, const WorldContext& world) {
  const std::vector<WorldCamera>& cameras = world.moment.cameras;
  if (world.borders == nullptr || cameras.size() < 2) return;
  const double depth_m = view_depth_m(world.model);
  for (std::size_t i = 0; i < std::min(cameras.size(), world.borders->size()); ++i) {
    const WorldCamera& camera = cameras[i];
    if (!camera.is_active) draw_field_of_view(canvas, world.borders->of(i), depth_m, camera.world_from_camera, false);
    const ImU32 shade = camera.is_active ? color::kAccent : kCameraColor;
    std::vector<glm::dvec3> places{{1, 0, 0}};  // the middle, else at the edge
    const std::vector<glm::dvec3>& rays = world.borders->of(i).rays;
    places.insert(places.end(), rays.begin(), rays.end());
    for (const glm::dvec3& ray : places) {
      const std::optional<glm::dvec2> at = canvas.in_sight(camera.world_from_camera * (ray * depth_m));
      if (!at || !canvas.label(*at, camera.name, shade, WorldCanvas::Side::centre)) continue;
      world.context.ui_probe.note("world/camera/" + camera.name, {*at - 4.0, *at + 4.0});
      break;
    }
  }
}

// A small pyramid open to where the camera looks, and a mark on its upper side.
void draw_camera_icon(WorldCanvas& canvas, const CameraPose& pose, ImU32 color) {
  const double length_m = scaled(kCamera_px) / canvas.eye().pixels_per_metre(pose.translation_m, canvas.rect());
  const auto at = [&](double x, double y, double z) { return pose * (glm::dvec3(x, y, z) * length_m); };
  const std::array<glm::dvec3, 5> frame{at(1, -0.7, -0.5), at(1, 0.7, -0.5), at(1, 0.7, 0.5), at(1, -0.7, 0.5),
                                        at(1, -0.7, -0.5)};
  for (std::size_t i = 0; i < 4; ++i) canvas.line(pose.translation_m, frame[i], color, 1.4);
  canvas.polyline(frame, color, 1.4);
  const std::array<glm::dvec3, 3> up{at(1, -0.35, -0.6), at(1, 0, -0.95), at(1, 0.35, -0.6)};
  canvas.polyline(up, color, 1.4);
}

// Forward, right and down of the camera, in the colours of the world's X, Y and Z.
void draw_camera_axes(WorldCanvas& canvas, const CameraPose& pose) {
  const double length_m = scaled(kCameraAxes_px) / canvas.eye().pixels_per_metre(pose.translation_m, canvas.rect());
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 tip{0, 0, 0};
    tip[axis] = length_m;
    canvas.line(pose.translation_m, pose * tip, color::kAxes[static_cast<std::size_t>(axis)], 1.4);
  }
}

// As the scene's log has it, or straight on by the settings.
void draw_camera_path(WorldCanvas& canvas, const WorldContext& world) {
  const ViewContext& context = world.context;
  const ImU32 shade = faded(kCameraColor, 0.55);
  if (context.shown.scene && context.shown.scene->draft.scene.motion.path) {
    std::vector<glm::dvec3> points_m = world.model.camera_path.points_m;
    for (glm::dvec3& point_m : points_m) point_m += path_shift_m(context);
    canvas.polyline(points_m, shade, 1.6);
    return;
  }
  const auto place = [&](int frame) { return camera_pose_at(context, time_of(context, frame)).translation_m; };
  canvas.line(place(context.document.first_frame()), place(context.document.last_frame()), shade, 1.6);
}

void draw_ticks(WorldCanvas& canvas, const WorldCurve& curve, ImU32 color) {
  std::optional<glm::dvec2> last;
  for (const WorldTick& tick : curve.ticks) {
    const std::optional<glm::dvec2> at = canvas.in_sight(tick.at_m);
    const std::optional<glm::dvec2> next = canvas.eye().screen_of(tick.next_m, canvas.rect());
    if (!at || !next) continue;
    const double length = glm::distance(*at, *next);
    if (length < 1e-6 || (last && glm::distance(*last, *at) < scaled(kMinTickGap_px))) continue;
    const glm::dvec2 along = (*next - *at) / length;
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) * static_cast<double>(scaled(kTick_px));
    canvas.list().AddLine(im(*at - across), im(*at + across), color, scaled(1.2));
    last = at;
  }
}

// Wider than the curve, to be seen beside one of any colour.
void draw_flagged(WorldCanvas& canvas, const WorldCurve& curve, const Survey* survey) {
  if (survey == nullptr) return;
  for (const FlightFlag& flag : survey->flags)
    canvas.polyline(stretch(curve.samples, flag.first_frame - 0.5, flag.last_frame + 0.5), faded(color::kBad, 0.75), 7);
}

// Waypoints off the curve pull at it: the lines between them say how.
void draw_control_lines(WorldCanvas& canvas, const TrajectoryPlan& plan, ImU32 color) {
  if (plan.spline != SplineKind::approximating) return;
  for (std::size_t i = 1; i < plan.waypoints.size() && i < 100; ++i)
    canvas.line(plan.waypoints[i - 1].position_m, plan.waypoints[i].position_m, faded(color, 0.25));
}

constexpr double kMinStep_px = 1.5;  // what lies nearer to the point before adds nothing to a polyline

bool holds(const ScreenRect& outer, const ScreenRect& inner) {
  return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace

void draw_ground(WorldCanvas& canvas) {
  const GroundGrid grid = ground_grid(canvas.eye(), canvas.rect());
  const double text_px = font(Font::small)->FontSize;
  if (is_edge_on(canvas.eye())) return draw_edge_on(canvas, grid, text_px);
  for (const GridLine& line : grid.lines)
    if (const auto ends = canvas.within_rect(line.ends_m[0], line.ends_m[1]))
      canvas.list().AddLine(im((*ends)[0]), im((*ends)[1]), line.bold ? kBoldLine : kLine);
}

void draw_ground_labels(WorldCanvas& canvas) {
  if (is_edge_on(canvas.eye())) return;
  const GroundGrid grid = ground_grid(canvas.eye(), canvas.rect());
  const double text_px = font(Font::small)->FontSize;
  for (const bool bold : {true, false})
    for (const GridLine& line : grid.lines)
      if (line.bold == bold && std::llround(line.at_m / grid.step_m) % 5 == 0) draw_label(canvas, line, text_px);
}

void draw_axes(WorldCanvas& canvas) {
  const double reach = scaled(24);
  const ScreenRect& rect = canvas.rect();
  const glm::dvec2 origin{rect.low.x + reach * 1.6, rect.high.y - reach * 1.6};
  const OrbitCamera& eye = canvas.eye();
  std::array<std::size_t, 3> order{0, 1, 2};  // far to near
  const auto depth = [&](std::size_t axis) { return eye.forward()[static_cast<int>(axis)]; };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return depth(a) > depth(b); });
  ImFont* face = font(Font::small);
  for (const std::size_t axis : order) {
    const auto i = static_cast<int>(axis);
    const glm::dvec2 direction{eye.right()[i], -eye.up()[i]};
    const glm::dvec2 tip = origin + direction * reach;
    canvas.list().AddLine(im(origin), im(tip), color::kAxes[axis], scaled(1.8));
    const char name[2] = {static_cast<char>('X' + i), 0};
    const ImVec2 size = face->CalcTextSizeA(face->FontSize, 1e6F, 0, name);
    const double length = glm::length(direction);
    if (length < 0.25) continue;  // the axis points at the eye
    const glm::dvec2 middle = tip + direction / length * (0.7 * face->FontSize);
    canvas.list().AddText(face, face->FontSize, im(middle - glm::dvec2(size.x, size.y) / 2.0), color::kAxes[axis],
                          name);
  }
  canvas.keep_free({origin - reach * 1.5, origin + reach * 1.5});
}

double view_depth_m(const WorldModel& model) {
  // A curved edge bulges around the camera and would hide what is within.
  const bool is_curved = std::ranges::any_of(model.border.rays, [](const glm::dvec3& ray) { return ray.x < 0.999; });
  return model.farthest_m > 0 ? std::clamp(model.farthest_m * (is_curved ? 0.35 : 1.05), 20.0, 5000.0) : 200;
}

void draw_drop_line(WorldCanvas& canvas, const glm::dvec3& from_m, ImU32 color) {
  const glm::dvec3 foot_m{from_m.x, from_m.y, 0};
  canvas.line(from_m, foot_m, faded(color, 0.35));
  if (const std::optional<glm::dvec2> foot = canvas.in_sight(foot_m))
    canvas.list().AddCircleFilled(im(*foot), scaled(2), faded(color, 0.6));
}

void draw_camera(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered) {
  const Document& document = world.context.document;
  draw_camera_path(canvas, world);
  const CameraPose& pose = world.moment.world_from_camera;
  const bool highlighted = document.selection().kind == Selected::camera || hovered.kind == Selected::camera;
  draw_field_of_view(canvas, world.model.border, view_depth_m(world.model), pose, highlighted);
  draw_rig(canvas, world);
  draw_drop_line(canvas, pose.translation_m, kCameraColor);
  draw_camera_axes(canvas, pose);
  draw_camera_icon(canvas, pose, highlighted ? color::kAccent : kCameraColor);
}

void draw_trajectories(WorldCanvas& canvas, const WorldContext& world) {
  const Project& project = world.context.project();
  for (const WorldCurve& curve : world.model.curves) {
    const auto index = static_cast<std::size_t>(curve.intruder);
    if (index >= project.intruders.size()) continue;
    const bool current = is_current(world.context, curve.intruder);
    const ImU32 color = faded(intruder_color(curve.intruder), current ? 1 : 0.6);
    draw_control_lines(canvas, project.intruders[index].trajectory, color);
    draw_flagged(canvas, curve, survey_of(world.context, curve.intruder).get());
    canvas.polyline(stretch(curve.samples, -1e300, curve.range_first), faded(color, 0.3), 1.2);
    canvas.polyline(stretch(curve.samples, curve.range_last, 1e300), faded(color, 0.3), 1.2);
    canvas.polyline(stretch(curve.samples, curve.range_first, curve.range_last), color, current ? 2.2 : 1.6);
    draw_ticks(canvas, curve, faded(color, current ? 0.8 : 0.45));
  }
}

void draw_waypoints(WorldCanvas& canvas, const WorldContext& world, const Selection& hovered) {
  const ViewContext& context = world.context;
  const Selection& selection = context.document.selection();
  for (int i = 0; i < static_cast<int>(context.project().intruders.size()); ++i) {
    const auto& waypoints = context.project().intruders[static_cast<std::size_t>(i)].trajectory.waypoints;
    const std::vector<double> frames = frames_of_waypoints(context, i);
    const bool current = is_current(context, i);
    Thinning thinning(scaled(3));
    for (int w = 0; w < static_cast<int>(waypoints.size()); ++w) {
      const glm::dvec3& at_m = waypoints[static_cast<std::size_t>(w)].position_m;
      const Selection self{Selected::waypoint, i, w};
      if (selection == self) draw_drop_line(canvas, at_m, color::kAccent);
      const std::optional<glm::dvec2> at = canvas.in_sight(at_m, 8);
      if (!at) continue;
      const bool highlighted = selection == self || hovered == self;
      if (thinning.leaves_out(*at) && !highlighted) continue;
      const float radius = scaled(highlighted ? 5 : current ? 4 : 3);
      context.ui_probe.note(fmt::format("world/waypoint/{}/{}", i, w),
                            {*at - glm::dvec2(radius), *at + glm::dvec2(radius)});
      canvas.list().AddCircleFilled(im(*at), radius + scaled(1.5), IM_COL32(0, 0, 0, 150), 12);
      canvas.list().AddCircleFilled(im(*at), radius,
                                    highlighted ? color::kAccent
                                    : current   ? color::kWaypoint
                                                : intruder_color(i),
                                    12);
      if (!current && !highlighted) continue;
      canvas.label_beside(*at, scaled(9), frame_text(frames[static_cast<std::size_t>(w)]),
                          highlighted ? color::kAccent : color::kText);
    }
  }
}

void draw_closest_approaches(WorldCanvas& canvas, const WorldContext& world) {
  for (const WorldCurve& curve : world.model.curves) {
    const std::shared_ptr<const Survey> survey = survey_of(world.context, curve.intruder);
    if (survey == nullptr || !(survey->closest.distance_m > 0)) continue;
    const ClosestApproach& closest = survey->closest;
    const glm::dvec3 camera_m = camera_pose_at(world.context, closest.time_s).translation_m;
    const std::optional<glm::dvec3> body_m = position_of(world.context, curve.intruder, closest.frame);
    if (!body_m) continue;
    const bool current = is_current(world.context, curve.intruder);
    const ImU32 color = faded(color::kPartly, current ? 0.95 : 0.5);
    canvas.dashes(camera_m, *body_m, color, 1.3);
    // While something is dragged the lines are ahead of the survey: the label says what is drawn.
    const double distance_m = glm::distance(camera_m, *body_m);
    const std::optional<glm::dvec2> middle = canvas.in_sight((camera_m + *body_m) / 2.0);
    if (middle && current) canvas.label_beside(*middle, scaled(8), "closest " + distance_text(distance_m), color);
  }
}

std::optional<glm::dvec2> WorldCanvas::in_sight(const glm::dvec3& p_in_world, double margin_px) const {
  const std::optional<glm::dvec2> at = eye_.screen_of(p_in_world, rect_);
  if (!at || !ScreenRect{rect_.low - margin_px, rect_.high + margin_px}.contains(*at)) return std::nullopt;
  return at;
}

std::optional<std::array<glm::dvec2, 2>> WorldCanvas::within_rect(const glm::dvec3& a_m, const glm::dvec3& b_m) const {
  const auto line = screen_line(eye_, rect_, a_m, b_m);
  return line ? line_within(*line, rect_) : std::nullopt;
}

void WorldCanvas::line(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width) {
  if (const auto ends = screen_line(eye_, rect_, a_m, b_m))
    list_.AddLine(im((*ends)[0]), im((*ends)[1]), color, scaled(width));
}

void WorldCanvas::dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, ImU32 color, double width) {
  constexpr int kMaxDashes = 200;
  const auto ends = screen_line(eye_, rect_, a_m, b_m);
  if (!ends) return;
  const double length = glm::distance((*ends)[0], (*ends)[1]);
  const double period = std::max<double>(scaled(9), length / kMaxDashes);
  for (double along = 0; along < length; along += period) {
    const glm::dvec2 from = glm::mix((*ends)[0], (*ends)[1], along / length);
    const glm::dvec2 to = glm::mix((*ends)[0], (*ends)[1], std::min(1.0, (along + period * 0.55) / length));
    list_.AddLine(im(from), im(to), color, scaled(width));
  }
}

// Cut lines begin a stroke of their own, the rest goes as one.
void WorldCanvas::polyline(std::span<const glm::dvec3> points_m, ImU32 color, double width) {
  std::vector<ImVec2> stroke;
  glm::dvec2 last{0, 0};
  const auto finish = [&] {
    if (stroke.size() > 1)
      list_.AddPolyline(stroke.data(), static_cast<int>(stroke.size()), color, ImDrawFlags_None, scaled(width));
    stroke.clear();
  };
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const auto ends = screen_line(eye_, rect_, points_m[i - 1], points_m[i]);
    if (!ends) {
      finish();
      continue;
    }
    if (!stroke.empty() && glm::distance(last, (*ends)[0]) > kMinStep_px) finish();
    if (stroke.empty()) stroke.push_back(im(last = (*ends)[0]));
    const bool is_end = i + 1 == points_m.size();
    if (is_end || glm::distance(last, (*ends)[1]) >= kMinStep_px) stroke.push_back(im(last = (*ends)[1]));
  }
  finish();
}

bool WorldCanvas::put(const glm::dvec2& low, const std::string& text, ImU32 color, Font which) {
  ImFont* face = font(which);
  const ScreenRect place{low, low + text_size(text, which)};
  if (!holds(rect_, place) || !labels_.place({&place, 1})) return false;
  const ImVec2 corner{std::round(static_cast<float>(place.low.x)), std::round(static_cast<float>(place.low.y))};
  list_.AddText(face, face->FontSize, {corner.x + 1, corner.y + 1}, IM_COL32(0, 0, 0, 160), text.c_str());
  list_.AddText(face, face->FontSize, corner, color, text.c_str());
  return true;
}

bool WorldCanvas::label(const glm::dvec2& at, const std::string& text, ImU32 color, Side side, Font which) {
  const glm::dvec2 size = text_size(text, which);
  return put(at - size * glm::dvec2(side == Side::right ? 0 : 0.5, 0.5), text, color, which);
}

bool WorldCanvas::label_beside(const glm::dvec2& at, double gap_px, const std::string& text, ImU32 color) {
  const glm::dvec2 size = text_size(text, Font::small);
  const glm::dvec2 slanted = glm::dvec2(gap_px, 0.25 * gap_px);
  const glm::dvec2 half = size / 2.0;
  for (const glm::dvec2 side : {glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, -1), glm::dvec2(-1, 1)})
    if (put(at + side * (half + slanted) - half, text, color, Font::small)) return true;
  for (const glm::dvec2 side : {glm::dvec2(0, -1), glm::dvec2(0, 1), glm::dvec2(1, 0), glm::dvec2(-1, 0)})
    if (put(at + side * (half + gap_px) - half, text, color, Font::small)) return true;
  return false;
}

}  // namespace sigs::editor
