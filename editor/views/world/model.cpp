// SPDX-License-Identifier: MIT
#include "editor/views/world/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <queue>

#include "editor/geometry/rulers.h"
#include "project/project.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kFirstPieces = 24;  // an S with its middle on its chord is not taken for straight

struct Piece {
  double first = 0;
  double last = 0;
  glm::dvec3 middle_m{0, 0, 0};
  double off_chord_m = 0;

  [[nodiscard]] double middle() const { return (first + last) / 2; }
  [[nodiscard]] bool operator<(const Piece& other) const { return off_chord_m < other.off_chord_m; }
};

std::vector<double> first_parameters(double first, double last, std::span<const double> through, std::size_t maximum) {
  std::vector<double> at;
  const std::size_t pieces = std::clamp<std::size_t>(kFirstPieces, 1, std::max<std::size_t>(1, maximum / 4));
  for (std::size_t i = 0; i <= pieces; ++i)
    at.push_back(std::lerp(first, last, static_cast<double>(i) / static_cast<double>(pieces)));
  for (const double parameter : through.first(std::min(through.size(), maximum / 2)))
    if (parameter > first && parameter < last) at.push_back(parameter);
  std::ranges::sort(at);
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

Piece piece_between(const std::function<glm::dvec3(double)>& curve, double first, const glm::dvec3& first_m,
                    double last, const glm::dvec3& last_m) {
  Piece piece{.first = first, .last = last};
  piece.middle_m = curve(piece.middle());
  piece.off_chord_m = glm::distance(piece.middle_m, (first_m + last_m) / 2.0);
  return piece;
}

constexpr std::size_t kMaxPoints = 400;   // of a trajectory
constexpr std::size_t kMaxTicks = 300;    // of a trajectory
constexpr double kTickReach_s = 0.05;     // to see where the trajectory leads
constexpr double kToleranceShare = 5e-5;  // of a trajectory's extent: a tenth of a pixel when it fills the screen
constexpr int kBorderSteps = 10;          // a side of the image, for a distorting lens
constexpr int kHalvings = 14;
constexpr double kFlatImageX = 0.3;  // of a ray's length: 72 degrees off the axis

double extent_m(const std::vector<glm::dvec3>& points_m) {
  glm::dvec3 low = points_m.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& point_m : points_m) {
    low = glm::min(low, point_m);
    high = glm::max(high, point_m);
  }
  return glm::distance(low, high);
}

std::vector<WorldTick> ticks_along(const Trajectory& trajectory, double first_s, double last_s, double step_s) {
  std::vector<WorldTick> ticks;
  for (double time_s = std::ceil(first_s / step_s) * step_s; time_s <= last_s && ticks.size() <= kMaxTicks;
       time_s += step_s)
    ticks.push_back({trajectory.position_m(time_s), trajectory.position_m(time_s + kTickReach_s)});
  return ticks;
}

WorldCurve curve_of(const OpenedScene& opened, int intruder, const SceneIntruder& flown) {
  const Scene& scene = opened.draft.scene;
  const auto& waypoints = opened.project->intruders[static_cast<std::size_t>(intruder)].trajectory.waypoints;
  const CountedFrames counted = counted_frames(scene);
  const std::vector<double> knots = waypoint_frames(waypoints, scene);
  double first = counted.first_frame;
  double last = counted.last_frame;
  for (const double knot : knots) {
    first = std::min(first, knot);
    last = std::max(last, knot);
  }
  const auto position = [&](double frame) {
    return flown.trajectory.position_m(time_of_frame_s(counted.footage, frame));
  };
  std::vector<glm::dvec3> rough_m;
  for (int i = 0; i <= 8; ++i) rough_m.push_back(position(std::lerp(first, last, i / 8.0)));
  const double tolerance_m = std::max(1e-3, kToleranceShare * extent_m(rough_m));
  const double first_s = time_of_frame_s(counted.footage, counted.first_frame);
  const double last_s = time_of_frame_s(counted.footage, counted.last_frame);
  const double step_s = std::max(1.0, round_step((last_s - first_s) / double(kMaxTicks)));
  return {.intruder = intruder,
          .samples = sampled_curve(position, first, last, knots, tolerance_m, kMaxPoints),
          .range_first = static_cast<double>(counted.first_frame),
          .range_last = static_cast<double>(counted.last_frame),
          .ticks = ticks_along(flown.trajectory, first_s, last_s, step_s)};
}

double farthest_from_camera_m(const Scene& scene, const WorldCurve& curve) {
  double farthest_m = 0;
  for (std::size_t i = 0; i < curve.samples.at.size(); ++i) {
    const double frame = curve.samples.at[i];
    if (frame < curve.range_first || frame > curve.range_last) continue;
    const double time_s = time_of_frame_s(counted_frames(scene).footage, frame);
    const glm::dvec3 camera_m = camera_at(scene.motion, time_s).translation_m;
    farthest_m = std::max(farthest_m, glm::distance(camera_m, curve.samples.points_m[i]));
  }
  return farthest_m;
}

// Of a pixel, or where the lens has none there, of the outermost on the way to it from the image's middle.
std::optional<glm::dvec3> ray_towards(const Lens& lens, const glm::dvec2& middle, const glm::dvec2& pixel) {
  if (const std::optional<glm::dvec3> ray = lens.ray(pixel)) return ray;
  double visible = 0;
  double not_visible = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double share = (visible + not_visible) / 2;
    (lens.ray(glm::mix(middle, pixel, share)) ? visible : not_visible) = share;
  }
  return lens.ray(glm::mix(middle, pixel, visible));
}

void make_flat_if_ahead(ImageBorder& border) {
  const bool ahead = std::ranges::all_of(border.rays, [](const glm::dvec3& ray) { return ray.x > kFlatImageX; });
  if (!ahead) return;
  for (glm::dvec3& ray : border.rays) ray /= ray.x;
}

std::shared_ptr<const Model> shared_model(const Scene& scene, const Model* model) {
  const auto found =
      std::ranges::find_if(scene.models, [&](const std::shared_ptr<const Model>& held) { return held.get() == model; });
  return found == scene.models.end() ? nullptr : *found;
}

CurveSamples camera_path_of(const Scene& scene) {
  const CountedFrames counted = counted_frames(scene);
  const auto place = [&](double frame) {
    return camera_at(scene.motion, time_of_frame_s(counted.footage, frame)).translation_m;
  };
  std::vector<glm::dvec3> rough_m;
  for (int i = 0; i <= 8; ++i) rough_m.push_back(place(std::lerp(counted.first_frame, counted.last_frame, i / 8.0)));
  const double tolerance_m = std::max(1e-3, kToleranceShare * extent_m(rough_m));
  return sampled_curve(place, counted.first_frame, counted.last_frame, {}, tolerance_m, kMaxPoints);
}

// All sit on the aircraft, which is where the active one says.
std::vector<WorldCamera> rig_cameras(const ViewContext& context, const CameraPose& world_from_active) {
  std::vector<WorldCamera> cameras;
  const std::vector<RigCamera>& rig = context.document.cameras();
  const std::size_t active = context.document.active_camera();
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const CameraPose pose =
        world_from_active * (inverse(body_from_camera(rig[active].mount)) * body_from_camera(rig[i].mount));
    cameras.push_back({rig[i].name, pose, i == active});
  }
  return cameras;
}

}  // namespace

CurveSamples sampled_curve(const std::function<glm::dvec3(double)>& curve, double first, double last,
                           std::span<const double> through, double tolerance_m, std::size_t maximum) {
  if (!(last > first)) return {{first}, {curve(first)}};
  std::map<double, glm::dvec3> points;
  for (const double at : first_parameters(first, last, through, maximum)) points.emplace(at, curve(at));
  std::priority_queue<Piece> pieces;
  for (auto end = std::next(points.begin()); end != points.end(); ++end) {
    const auto begin = std::prev(end);
    pieces.push(piece_between(curve, begin->first, begin->second, end->first, end->second));
  }
  while (points.size() < maximum && !pieces.empty() && pieces.top().off_chord_m > tolerance_m) {
    const Piece piece = pieces.top();
    pieces.pop();
    const double middle = piece.middle();
    if (!(middle > piece.first && middle < piece.last)) continue;  // neighbours among the doubles
    points.emplace(middle, piece.middle_m);
    pieces.push(piece_between(curve, piece.first, points.at(piece.first), middle, piece.middle_m));
    pieces.push(piece_between(curve, middle, piece.middle_m, piece.last, points.at(piece.last)));
  }
  CurveSamples samples;
  for (const auto& [at, point_m] : points) {
    samples.at.push_back(at);
    samples.points_m.push_back(point_m);
  }
  return samples;
}

glm::dvec3 CurveSamples::point_at(double parameter) const {
  const auto after = std::ranges::upper_bound(at, parameter);
  if (after == at.begin()) return points_m.front();
  if (after == at.end()) return points_m.back();
  const auto next = static_cast<std::size_t>(after - at.begin());
  const double share = (parameter - at[next - 1]) / (at[next] - at[next - 1]);
  return glm::mix(points_m[next - 1], points_m[next], share);
}

std::vector<glm::dvec3> stretch(const CurveSamples& samples, double from, double to) {
  if (samples.at.empty()) return {};
  from = std::max(from, samples.at.front());
  to = std::min(to, samples.at.back());
  if (!(from < to)) return {};
  std::vector<glm::dvec3> points_m{samples.point_at(from)};
  for (std::size_t i = 0; i < samples.at.size(); ++i)
    if (samples.at[i] > from && samples.at[i] < to) points_m.push_back(samples.points_m[i]);
  points_m.push_back(samples.point_at(to));
  return points_m;
}

ImageBorder image_border(const Camera& camera) {
  const glm::dvec2 low{-0.5, -0.5};
  const glm::dvec2 high{camera.size_px.width - 0.5, camera.size_px.height - 0.5};
  const std::array<glm::dvec2, 5> corners{low, {high.x, low.y}, high, {low.x, high.y}, low};
  const int steps = camera.lens.is_pinhole() ? 1 : kBorderSteps;
  ImageBorder border;
  for (std::size_t side = 0; side < 4; ++side)
    for (int step = 0; step < steps; ++step) {
      const glm::dvec2 pixel = glm::mix(corners[side], corners[side + 1], static_cast<double>(step) / steps);
      const std::optional<glm::dvec3> ray = ray_towards(camera.lens, (low + high) / 2.0, pixel);
      if (!ray) continue;
      if (step == 0) border.corners.push_back(border.rays.size());
      border.rays.push_back(*ray);
    }
  make_flat_if_ahead(border);
  return border;
}

WorldModel world_model(const OpenedScene& opened) {
  const Scene& scene = opened.draft.scene;
  WorldModel model{
      .revision = opened.revision, .border = image_border(scene.camera), .camera_path = camera_path_of(scene)};
  const std::vector<int>& numbers = opened.draft.intruder_of_project;
  for (std::size_t i = 0; i < numbers.size() && i < opened.project->intruders.size(); ++i) {
    if (numbers[i] < 0) continue;
    const SceneIntruder& flown = scene.intruders[static_cast<std::size_t>(numbers[i])];
    model.curves.push_back(curve_of(opened, static_cast<int>(i), flown));
    model.farthest_m = std::max(model.farthest_m, farthest_from_camera_m(scene, model.curves.back()));
  }
  return model;
}

void RigBorders::follow(const std::vector<PreviewOutput>& rig) {
  borders_.resize(rig.size());
  for (std::size_t i = 0; i < rig.size(); ++i) {
    if (rig[i].scene == borders_[i].scene) continue;
    borders_[i] = {rig[i].scene, rig[i].scene ? image_border(rig[i].scene->draft.scene.camera) : ImageBorder()};
  }
}

WorldMoment world_moment(const ViewContext& context) {
  const double time_s = time_of(context, context.document.playhead());
  WorldMoment moment{.time_s = time_s, .world_from_camera = camera_pose_at(context, time_s)};
  moment.cameras = rig_cameras(context, moment.world_from_camera);
  if (!context.shown.scene) return moment;
  const DraftScene& draft = context.shown.scene->draft;
  const std::size_t count = std::min(draft.intruder_of_project.size(), context.project().intruders.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (draft.intruder_of_project[i] < 0) continue;
    const SceneIntruder& flown = draft.scene.intruders[static_cast<std::size_t>(draft.intruder_of_project[i])];
    moment.bodies.push_back({.intruder = static_cast<int>(i),
                             .world_from_body = flown.trajectory.world_from_body(time_s),
                             .model = shared_model(draft.scene, flown.model)});
  }
  return moment;
}

std::vector<glm::dvec3> points_of_interest(const ViewContext& context, const WorldModel& model) {
  const Document& document = context.document;
  std::vector<glm::dvec3> points_m;
  for (const int frame : {document.first_frame(), document.last_frame()})
    points_m.push_back(camera_pose_at(context, time_of(context, frame)).translation_m);
  for (const glm::dvec3& point_m : model.camera_path.points_m) points_m.push_back(point_m + path_shift_m(context));
  for (const IntruderSettings& intruder : context.project().intruders)
    for (const WaypointSettings& waypoint : intruder.trajectory.waypoints) points_m.push_back(waypoint.position_m);
  if (document.selection().kind == Selected::light && context.project().light.kind == LightKind::point)
    points_m.push_back(context.project().light.position_m);
  for (const WorldCurve& curve : model.curves) {
    const std::vector<glm::dvec3> flown_m = stretch(curve.samples, curve.range_first, curve.range_last);
    points_m.insert(points_m.end(), flown_m.begin(), flown_m.end());
  }
  // A camera that hangs in the air, alone.
  if (std::ranges::all_of(points_m, [&](const glm::dvec3& p) { return p == points_m.front(); }))
    points_m.push_back(points_m.front() + glm::dvec3(100, 0, 0));
  return points_m;
}

}  // namespace sigs::editor
