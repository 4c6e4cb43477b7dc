// SPDX-License-Identifier: MIT
#include "scene/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/pose.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"
#include "telemetry/gpmf.h"
#include "telemetry/track.h"

namespace sigs {

namespace {

constexpr int kMaxLookFrames = 200;
constexpr double kKilometre_m = 1000;
constexpr double kTooNear_m = 20;   // all waypoints of a flight in metres are hardly this near to the origin
constexpr double kStandsOut = 1.3;  // how much higher than long and wide a model is that stands on its tail
constexpr double kStabilised_rad = rad_of_deg(0.5);

ModelAxes file_axes_of(const ModelSettings& model) {
  return {.forward = model.forward, .up = model.up, .scale = model.scale, .length_m = model.length_m};
}

// "set forward to -z and up to +y", or only one of them.
std::string axes_to_set(const ModelSettings& model, const std::string& forward, const std::string& up) {
  const std::string set_forward = model.forward == forward ? "" : "forward to " + forward;
  const std::string set_up = model.up == up ? "" : "up to " + up;
  return "set " + set_forward + (set_forward.empty() || set_up.empty() ? "" : " and ") + set_up;
}

std::optional<Problem> axes_mistake(const ModelSettings& settings, const Model& model, const std::string& key) {
  const ModelShape& shape = model.shape;
  const glm::dvec3 size(model.mesh.high_m - model.mesh.low_m);
  const auto problem = [&](const std::string& what) {
    return Problem{key + (settings.forward == file_axis(shape.nose, file_axes_of(settings)) ? ".up" : ".forward"),
                   fmt::format("{}: by its shape, {}; if the model is meant so, leave it", what,
                               axes_to_set(settings, file_axis(shape.nose, file_axes_of(settings)),
                                           file_axis(shape.top, file_axes_of(settings))))};
  };
  if (shape.wings_are_sure && shape.nose_is_sure) {
    if (shape.nose.z != 0) return problem("the aircraft flies belly or back first, its nose up or down");
    if (shape.nose.y != 0) return problem("the aircraft flies sideways");
    if (shape.nose.x < 0) return problem("the aircraft flies tail first");
    if (shape.top.y != 0) return problem("the aircraft flies on its side");
    if (shape.top_is_sure && shape.top.z > 0) return problem("the aircraft flies upside down");
  } else if (size.z > kStandsOut * std::max(size.x, size.y)) {
    return Problem{key + ".up", fmt::format("makes the model {:.3g} m high, but {:.3g} m long and {:.3g} m wide; is "
                                            "another axis of the file its up?",
                                            size.z, size.x, size.y)};
  }
  return std::nullopt;
}

std::optional<Problem> frames_mistake(const TrajectoryPlan& plan, const Scene& scene, const std::string& key) {
  const Timeline used = scene.timeline.value_or(Timeline{scene.footage, scene.first_frame, scene.last_frame});
  const int last = static_cast<int>(used.footage.times_s.size()) - 1;
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    const std::optional<double>& frame = plan.waypoints[i].frame;
    const bool all_before = i + 1 == plan.waypoints.size() && frame && *frame < used.first_frame && i > 0;
    // A flight may well begin before and end after the frames used; what begins after them is a slip.
    const bool begins_after = i == 0 && frame && *frame > used.last_frame;
    if (!all_before && !begins_after) continue;
    return Problem{
        fmt::format("{}.waypoints[{}].frame", key, i),
        fmt::format("{:.10g} is {} the frames used, {} to {} (the footage has {} frames): the intruder flies "
                    "straight on from there; set frames within them",
                    *frame, begins_after ? "after" : "before", used.first_frame, used.last_frame, last + 1)};
  }
  return std::nullopt;
}

// Whether a point of the world is in the image at some frame of its waypoint.
bool is_in_image(const Scene& scene, const glm::dvec3& p_in_world, double time_s) {
  const glm::dvec3 p_in_camera = inverse(camera_at(scene.motion, time_s)) * p_in_world;
  if (glm::length(p_in_camera) < 1) return false;
  const std::optional<glm::dvec2> pixel = scene.camera.lens.pixel(p_in_camera);
  const cv::Size size = scene.footage.size_px;
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x <= size.width - 1 && pixel->y <= size.height - 1;
}

// How many of the waypoints are in the image when each is changed so.
template <class Change>
std::size_t waypoints_in_image(const std::vector<TimedWaypoint>& waypoints, const Scene& scene, const Change& change) {
  return static_cast<std::size_t>(std::count_if(waypoints.begin(), waypoints.end(), [&](const TimedWaypoint& waypoint) {
    return is_in_image(scene, change(waypoint.position_m), waypoint.time_s);
  }));
}

std::optional<Problem> positions_mistake(const Project& project, std::size_t intruder, const Scene& scene,
                                         const std::string& key) {
  const IntruderSettings& settings = project.intruders[intruder];
  const std::vector<TimedWaypoint> waypoints = timed_waypoints(settings.trajectory.waypoints, scene);
  const auto all = [&](const auto& test) { return std::all_of(waypoints.begin(), waypoints.end(), test); };
  const auto in_image = [&](const auto& change) { return waypoints_in_image(waypoints, scene, change); };
  if (in_image([](const glm::dvec3& p) { return p; }) > 0) return std::nullopt;
  if (all([](const TimedWaypoint& w) { return w.position_m.z > 0; }) &&
      2 * in_image([](const glm::dvec3& p) { return glm::dvec3(p.x, p.y, -p.z); }) >= waypoints.size())
    return Problem{
        key + ".waypoints",
        fmt::format("\"{}\" is below the ground and out of view; z points down, so heights are negative: with "
                    "the sign of all z changed it would be in view",
                    settings.name)};
  if (all([](const TimedWaypoint& w) { return glm::length(w.position_m) < kTooNear_m; }) &&
      2 * in_image([](const glm::dvec3& p) { return p * kKilometre_m; }) >= waypoints.size())
    return Problem{
        key + ".waypoints",
        fmt::format("\"{}\" stays within {:.3g} m of the world's origin and is out of view; positions are in "
                    "metres: if these are kilometres, multiply them by 1000",
                    settings.name, kTooNear_m)};
  return std::nullopt;
}

// Angles of a direction against the image's middle: to the right and up.
struct Bearing {
  double right_rad = 0;
  double up_rad = 0;
};
Bearing bearing_of(const glm::dvec3& direction) {
  return {std::atan2(direction.y, direction.x), std::atan2(-direction.z, std::hypot(direction.x, direction.y))};
}

// The edges of the image, as angles; those of a place on an edge that has no ray count as the edge of the lens' field.
struct ImageEdges {
  double left_rad, right_rad, up_rad, down_rad;

  explicit ImageEdges(const Camera& camera) {
    const double x = camera.size_px.width - 1, y = camera.size_px.height - 1;
    const double field_rad = camera.lens.valid_angle_rad();
    const auto at = [&](double px, double py) { return camera.lens.ray({px, py}); };
    const auto left = at(0, y / 2), right = at(x, y / 2), top = at(x / 2, 0), bottom = at(x / 2, y);
    left_rad = left ? bearing_of(*left).right_rad : -field_rad;
    right_rad = right ? bearing_of(*right).right_rad : field_rad;
    up_rad = top ? bearing_of(*top).up_rad : field_rad;
    down_rad = bottom ? bearing_of(*bottom).up_rad : -field_rad;
    if (camera.lens.period_px() > 0) {  // 360 degrees: nothing is beside the image
      left_rad = rad_of_deg(-180);
      right_rad = rad_of_deg(180);
    }
  }
};

// How far outside the image, and on which side.
struct Outside {
  double angle_rad = 0;
  const char* side = "";
};

Outside outside_of(const Bearing& bearing, const ImageEdges& edges) {
  Outside most;
  const auto consider = [&](double angle_rad, const char* side) {
    if (angle_rad > most.angle_rad) most = {angle_rad, side};
  };
  consider(edges.left_rad - bearing.right_rad, "left of it");
  consider(bearing.right_rad - edges.right_rad, "right of it");
  consider(bearing.up_rad - edges.up_rad, "above it");
  consider(edges.down_rad - bearing.up_rad, "below it");
  return most;
}

}  // namespace

std::vector<Problem> lint(const Project& project, std::size_t intruder, const Scene& scene,
                          std::size_t scene_intruder) {
  std::vector<Problem> mistakes;
  const auto add = [&](std::optional<Problem> mistake) {
    if (mistake) mistakes.push_back(*std::move(mistake));
  };
  const std::string key = key_of_intruder(intruder);
  const SceneIntruder& placed = scene.intruders[scene_intruder];
  const IntruderSettings& settings = project.intruders[intruder];
  if (placed.model != nullptr && !placed.is_distractor && !placed.model->mesh.indices.empty())
    add(axes_mistake(settings.model, *placed.model, key + ".model"));
  add(frames_mistake(settings.trajectory, scene, key + ".trajectory"));
  add(positions_mistake(project, intruder, scene, key + ".trajectory"));
  return mistakes;
}

std::string where_out_of_view(const Scene& scene, std::size_t intruder) {
  const Camera camera = compositing_camera(scene);
  const ImageEdges edges(camera);
  const int length = scene.last_frame - scene.first_frame;
  const int frames = std::min(kMaxLookFrames, length + 1);
  std::optional<Outside> nearest;
  int nearest_frame = 0;
  for (int i = 0; i < frames; ++i) {
    const int frame = scene.first_frame + (frames > 1 ? static_cast<int>(1LL * length * i / (frames - 1)) : 0);
    const glm::dvec3 place = camera_from_body_at(scene, intruder, time_of_frame_s(scene.footage, frame)).translation_m;
    if (place.x <= 0 && edges.right_rad < rad_of_deg(90) && !camera.lens.pixel(place)) continue;
    const Outside outside = outside_of(bearing_of(place), edges);
    if (nearest && nearest->angle_rad <= outside.angle_rad) continue;
    nearest = outside;
    nearest_frame = frame;
  }
  if (!nearest) return "it is behind the camera all the time";
  if (nearest->angle_rad <= 0) return {};
  return fmt::format("at frame {} it is nearest to the image, {:.0f} degrees {}", nearest_frame,
                     std::max(1.0, deg_of_rad(nearest->angle_rad)), nearest->side);
}

std::vector<Problem> footage_mistakes(const std::filesystem::path& video, const std::filesystem::path& log) {
  std::vector<Problem> mistakes;
  // Attitudes found in the images, and CORI * IORI, are those of the images.
  if (!log.empty())
    if (const Result<Track> followed = read_track(log); followed && followed->attitude_is_whole) return mistakes;
  const auto add = [&](const std::string& why) {
    mistakes.push_back({"footage.video", why + ": the images turn differently from the camera, so an intruder that "
                                               "follows a calibration or a log is not locked to them; record without "
                                               "stabilisation, or find the motion with `sigs ego-motion --into`, or "
                                               "name the video as camera.track.file if it has CORI and IORI"});
  };
  const std::optional<GoproHeader> header = read_gopro_header(video);
  if (header && header->is_stabilised) {
    add("was stabilised by the camera" + (header->stabilisation.empty() ? "" : " (" + header->stabilisation + ")"));
    return mistakes;
  }
  const Result<Track> track = read_track(video);
  if (!track) return mistakes;
  double most_rad = 0;
  for (const glm::dquat& turn : track->camera_from_image.values)
    most_rad = std::max(most_rad, 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w)));
  if (most_rad > kStabilised_rad)
    add(fmt::format("was stabilised by the camera, which turned the images by up to {:.1f} degrees",
                    deg_of_rad(most_rad)));
  return mistakes;
}

}  // namespace sigs
