// SPDX-License-Identifier: MIT
#include "first_project/planning_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "base/text.h"
#include "scene/flight.h"
#include "scene/scene_at.h"
#include "scene/scene_parts.h"
#include "spline/trajectory.h"

namespace sigs {

namespace {

constexpr double kGravity_mps2 = 9.80665;
constexpr double kBank_rad = rad_of_deg(35);
constexpr double kMinSize_px = 20, kMaxSize_px = 60, kSizeShare = 0.03;  // of the image's width
constexpr double kMinVisible_px = 2;                                     // what is smaller does not count as in view
constexpr double kEnough = 0.95;                                         // of the frames
constexpr double kGood = 0.75;  // from here on, no flight that is nearest at the end is tried
constexpr double kTurning_rad = rad_of_deg(10);
constexpr double kSteep_rad = rad_of_deg(60);  // from here on an azimuth says little of what is in view
constexpr double kGround_m = 30;               // the least height of a flight
constexpr double kWholeFrames = 20;
constexpr int kSamples = 25;  // frames at which a flight is judged
constexpr int kTurnWaypoints = 5;
constexpr int kSizeSteps = 4;

// The shape of a flight, in a horizontal plane: along the line of sight and to the right of it.
struct FlightShape {
  double speed_mps = 0;
  double turn_rad = 0;      // on each side of the middle, away from the camera; 0: straight
  double approach_rad = 0;  // 0: across the line of sight, pi/2: along it
};

// Along the line of sight and to the right of it, metres.
struct PlanePoint {
  double along_m = 0;
  double right_m = 0;
};

// Times of the range, and where the camera is and looks then.
struct CameraView {
  double middle_s = 0;
  double half_s = 0;
  glm::dvec3 start_m{0}, velocity_mps{0};  // at the middle: the straight flight that comes nearest to the camera's
  double azimuth_rad = 0;                  // of the line of sight at the middle
  double turn_radps = 0;
  double elevation_rad = 0;  // of the line of sight
};

double range_s(const Scene& scene) {
  return time_of_frame_s(scene.footage, scene.last_frame) - time_of_frame_s(scene.footage, scene.first_frame);
}

double azimuth_of(const glm::dvec3& direction) {
  return std::atan2(direction.y, direction.x);
}
double elevation_of(const glm::dvec3& direction) {
  return std::atan2(-direction.z, std::hypot(direction.x, direction.y));
}

// The direction, in camera axes, in which the intruder is to be at the middle of the range.
glm::dvec3 aim(const Scene& scene, double middle_s) {
  const cv::Size size = scene.footage.size_px;
  const glm::dquat attitude = camera_at(scene.motion, middle_s).rotation;
  const auto ray_at = [&](double share) {
    return scene.camera.lens.ray({(size.width - 1) / 2.0, share * (size.height - 1)});
  };
  constexpr double kUsualShare = 0.36;   // of the image's height, from above
  constexpr double kUpwardShare = 0.45;  // of a camera that looks up at what flies
  constexpr double kUpward_rad = rad_of_deg(5);
  if (scene.horizon_is_known && elevation_of(attitude * glm::dvec3(1, 0, 0)) > kUpward_rad)
    return ray_at(kUpwardShare).value_or(glm::dvec3(1, 0, 0));
  const std::optional<glm::dvec3> usual = ray_at(kUsualShare);
  std::optional<glm::dvec3> best;
  const std::optional<glm::dvec3> top = ray_at(0.1), bottom = ray_at(0.9);
  if (scene.horizon_is_known && top && bottom) {
    const double wanted_rad = 0.14 * angle_between(*top, *bottom);
    double min_rad = rad_of_deg(2) + wanted_rad / 4;
    for (int row = 10; row <= 75; ++row) {
      const std::optional<glm::dvec3> ray = ray_at(row / 100.0);
      if (!ray) continue;
      const double off_rad = std::abs(elevation_of(attitude * *ray) - wanted_rad);
      if (off_rad < min_rad) best = ray, min_rad = off_rad;
    }
  }
  if (best) return *best;
  return usual ? *usual : glm::dvec3(1, 0, 0);
}

CameraView view_of(const Scene& scene) {
  CameraView view;
  const double first_s = time_of_frame_s(scene.footage, scene.first_frame);
  view.half_s = range_s(scene) / 2;
  view.middle_s = first_s + view.half_s;
  const glm::dvec3 ray = aim(scene, view.middle_s);
  const auto direction_at = [&](double time_s) { return camera_at(scene.motion, time_s).rotation * ray; };
  view.azimuth_rad = azimuth_of(direction_at(view.middle_s));
  view.elevation_rad = elevation_of(direction_at(view.middle_s));
  view.start_m = camera_at(scene.motion, view.middle_s).translation_m;
  if (view.half_s < 1e-6) return view;
  const glm::dvec3 last_m = camera_at(scene.motion, first_s + 2 * view.half_s).translation_m;
  view.velocity_mps = (last_m - camera_at(scene.motion, first_s).translation_m) / (2 * view.half_s);
  // Turns of less than a half turn between samples are followed.
  double turned_rad = 0;
  double before_rad = azimuth_of(direction_at(first_s));
  for (int i = 1; i <= kSamples; ++i) {
    const double azimuth_rad = azimuth_of(direction_at(first_s + 2 * view.half_s * i / kSamples));
    turned_rad += std::remainder(azimuth_rad - before_rad, 2 * std::numbers::pi);
    before_rad = azimuth_rad;
  }
  if (std::abs(turned_rad) > kTurning_rad && std::abs(view.elevation_rad) < kSteep_rad)
    view.turn_radps = turned_rad / (2 * view.half_s);
  return view;
}

// Where the flight is `time_s` after the middle of the range, for its nearest distance from the camera.
PlanePoint point_at(const FlightShape& shape, double nearest_m, double half_s, double time_s) {
  const double way_m = shape.speed_mps * time_s;
  if (shape.turn_rad == 0) {
    const double ahead_m = nearest_m + shape.speed_mps * half_s * std::sin(shape.approach_rad);
    return {ahead_m - way_m * std::sin(shape.approach_rad), way_m * std::cos(shape.approach_rad)};
  }
  const double radius_m = shape.speed_mps * shape.speed_mps / (kGravity_mps2 * std::tan(kBank_rad));
  const double turned_rad = std::min(std::abs(way_m) / radius_m, shape.turn_rad);
  const double straight_m = std::abs(way_m) - radius_m * turned_rad;
  const double right_m = radius_m * std::sin(turned_rad) + straight_m * std::cos(turned_rad);
  return {nearest_m + radius_m * (1 - std::cos(turned_rad)) + straight_m * std::sin(turned_rad),
          std::copysign(right_m, way_m)};
}

glm::dvec3 world_point(const CameraView& view, const FlightShape& shape, double nearest_m, double time_s) {
  const PlanePoint point = point_at(shape, nearest_m, view.half_s, time_s);
  const double azimuth_rad = view.azimuth_rad + view.turn_radps * time_s;
  const glm::dvec3 ahead(std::cos(azimuth_rad), std::sin(azimuth_rad), 0);
  const glm::dvec3 right(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0);
  // Level flight at the height at which the line of sight is where the intruder is nearest; of a steep line of sight
  // the nearest distance is along it.
  constexpr double kShallow_rad = rad_of_deg(12);
  const bool is_shallow = std::abs(view.elevation_rad) < kShallow_rad;
  const double across_m = is_shallow ? nearest_m : nearest_m * std::cos(view.elevation_rad);
  const double down_m = across_m * -std::tan(view.elevation_rad);
  glm::dvec3 place = view.start_m + view.velocity_mps * time_s + (point.along_m - nearest_m + across_m) * ahead +
                     point.right_m * right;
  place.z = view.start_m.z + down_m + (is_shallow ? 0 : view.velocity_mps.z * time_s);
  return place;
}

std::vector<WaypointSettings> waypoints_of(const Scene& scene, const CameraView& view, const FlightShape& shape,
                                           double nearest_m) {
  const bool is_moment = view.half_s < 1e-6;
  const bool is_straight = shape.turn_rad == 0 && view.turn_radps == 0;
  const int count = is_straight ? 2 : kTurnWaypoints;
  std::vector<WaypointSettings> waypoints;
  for (int i = 0; i < count; ++i) {
    const double share = double(i) / (count - 1);
    const double span = is_moment ? 1 : scene.last_frame - scene.first_frame;
    // Whole frames can be gone to; where there are few, hundredths keep the waypoints apart.
    const double parts = span >= kWholeFrames ? 1 : 100;
    const double frame = std::round((scene.first_frame + share * span) * parts) / parts;
    const double time_s = time_of_frame_s(scene.footage, frame) - view.middle_s;
    glm::dvec3 place = world_point(view, shape, nearest_m, time_s);
    for (int k = 0; k < 3; ++k) place[k] = std::round(place[k] * 100) / 100;
    waypoints.push_back({.frame = frame, .position_m = place});
  }
  return waypoints;
}

// A flight that was tried.
struct Trial {
  FlightShape shape;
  std::vector<WaypointSettings> waypoints;
  double visible_share = -1;
  double largest_px = 0;
  bool is_flyable = false;
};

double wanted_size_px(const Scene& scene) {
  return std::clamp(kSizeShare * scene.footage.size_px.width, kMinSize_px * 1.15, kMaxSize_px * 0.9);
}

// Speed of aircraft of this length.
double usual_speed_mps(double length_m) {
  if (length_m < 3) return 15;
  if (length_m < 6) return 30;
  return length_m < 20 ? 50 : 90;
}

class FlightSearch {
 public:
  FlightSearch(Scene scene, const std::shared_ptr<const Model>& model)
      : scene_(std::move(scene)), model_(model), view_(view_of(scene_)) {
    const Result<Trajectory> any = Trajectory::make({TimedWaypoint{}}, {});
    add_intruder(scene_, "intruder", model_, *any);
  }

  Trial best() {
    const glm::vec3 size = model_->mesh.high_m - model_->mesh.low_m;
    const double speed_mps = usual_speed_mps(double(size.x));
    Trial best;
    for (const FlightShape& shape : shapes(speed_mps)) {
      if (shape.approach_rad > 0 && best.is_flyable && best.visible_share >= kGood) break;
      Trial trial = tried(shape);
      const double gain = trial.visible_share - best.visible_share;
      if ((trial.is_flyable && !best.is_flyable && gain > -0.3) || (trial.is_flyable == best.is_flyable && gain > 0.02))
        best = std::move(trial);
      if (best.visible_share >= kEnough && best.is_flyable) break;
    }
    if (std::abs(view_.elevation_rad) >= kSteep_rad && best.visible_share < kGood)
      return slow_crossing(speed_mps, best);
    return best;
  }

  // Below or above the camera an aircraft leaves the image within seconds, but for one that flies nearly as the camera
  // does.
  Trial slow_crossing(double speed_mps, Trial best) {
    for (const double factor : {0.5, 0.25, 0.1, 0.05, 0.02, 0.01}) {
      Trial trial = tried({.speed_mps = factor * speed_mps});
      if (trial.is_flyable && trial.visible_share > best.visible_share) best = std::move(trial);
      if (best.visible_share >= kGood) break;
    }
    return best;
  }

  // With the waypoints of a trial.
  Visibility visibility(const Trial& trial) {
    set(trial.waypoints);
    constexpr int kFrames = 200;
    return estimated_visibilities(scene_, kFrames).front();
  }

 private:
  // From the simplest to the most contrived.
  static std::vector<FlightShape> shapes(double speed_mps) {
    std::vector<FlightShape> shapes;
    for (const double factor : {1.0, 0.8}) shapes.push_back({.speed_mps = factor * speed_mps});
    for (const double turn_deg : {20, 40, 60, 75})
      for (const double factor : {1.0, 0.8, 0.65})
        shapes.push_back({.speed_mps = factor * speed_mps, .turn_rad = rad_of_deg(turn_deg)});
    for (const double approach_deg : {60, 75, 83, 88})
      for (const double factor : {1.0, 0.8})
        shapes.push_back({.speed_mps = factor * speed_mps, .approach_rad = rad_of_deg(approach_deg)});
    return shapes;
  }

  void set(const std::vector<WaypointSettings>& waypoints) {
    const std::vector<TimedWaypoint> timed = timed_waypoints(waypoints, scene_);
    if (Result<Trajectory> trajectory = Trajectory::make(timed, {})) scene_.intruders.front().trajectory = *trajectory;
  }

  // The shape at the distance at which the intruder becomes as large as wanted.
  Trial tried(const FlightShape& shape) {
    Trial trial{.shape = shape};
    const double wanted_px = wanted_size_px(scene_);
    const double radius_m = std::max(double(model_->mesh.radius_m), 0.01);
    double nearest_m = 2 * radius_m / std::max(1e-6, wanted_px / pixels_per_radian());
    for (int i = 0; i < kSizeSteps; ++i) {
      nearest_m = std::clamp(nearest_m, 2.5 * radius_m, 1e6);
      trial.waypoints = waypoints_of(scene_, view_, shape, nearest_m);
      set(trial.waypoints);
      judge(trial);
      if (trial.largest_px <= 0) break;
      nearest_m *= trial.largest_px / wanted_px;
    }
    trial.is_flyable = view_.half_s < 1e-6 || !exceeds_limits();
    return trial;
  }

  [[nodiscard]] double pixels_per_radian() const {
    const double there = scene_.camera.lens.pixels_per_radian(aim(scene_, view_.middle_s));
    return there > 0 ? there : scene_.camera.lens.pinhole().parameters().fx;
  }

  void judge(Trial& trial) const {
    const VisibilityEstimator estimator(scene_);
    const int length = scene_.last_frame - scene_.first_frame;
    const int samples = std::min(kSamples, length + 1);
    int visible = 0;
    trial.largest_px = 0;
    for (int i = 0; i < samples; ++i) {
      const int frame = scene_.first_frame + (samples > 1 ? static_cast<int>(1LL * length * i / (samples - 1)) : 0);
      const VisibilityEstimate estimate = estimator.at(0, frame);
      if (estimate.visibility_state != VisibilityState::in_view || estimate.size_px < kMinVisible_px) continue;
      ++visible;
      trial.largest_px = std::max(trial.largest_px, estimate.size_px);
    }
    trial.visible_share = double(visible) / samples;
  }

  // Of speed, climb and load. What is below the ground is put right by raising the camera.
  [[nodiscard]] bool exceeds_limits() const {
    const std::vector<FlightFlag> flags = flight_flags(scene_, 0);
    return std::any_of(flags.begin(), flags.end(),
                       [](const FlightFlag& flag) { return flag.fault != FlightFault::underground; });
  }

  Scene scene_;
  std::shared_ptr<const Model> model_;
  CameraView view_;
};

std::string shape_text(const FlightShape& shape) {
  const std::string speed = fmt::format("at {} m/s", number_text(shape.speed_mps, shape.speed_mps < 3 ? 1 : 0));
  if (shape.turn_rad > 0)
    return fmt::format("comes in {}, turns away in the middle of the frames used and leaves", speed);
  if (shape.approach_rad > 0) return fmt::format("comes towards the camera {}", speed);
  return fmt::format("crosses from left to right {} against the camera, nearest in the middle of the frames used",
                     speed);
}

}  // namespace

FirstFlight first_flight(Scene scene, const std::shared_ptr<const Model>& model) {
  FlightSearch search(std::move(scene), model);
  const Trial trial = search.best();
  FirstFlight flight{.waypoints = trial.waypoints, .visibility = search.visibility(trial)};
  double lowest_z_m = -INFINITY;
  for (const WaypointSettings& waypoint : flight.waypoints) lowest_z_m = std::max(lowest_z_m, waypoint.position_m.z);
  flight.raise_m = std::max(0.0, std::ceil(lowest_z_m + kGround_m));
  for (WaypointSettings& waypoint : flight.waypoints) waypoint.position_m.z -= flight.raise_m;
  flight.note = {.field = "intruders[0].trajectory",
                 .text = fmt::format("{}; {}", shape_text(trial.shape), text_of(flight.visibility)),
                 .is_guess = true};
  return flight;
}

}  // namespace sigs
