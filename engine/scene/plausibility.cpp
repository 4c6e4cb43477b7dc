// SPDX-License-Identifier: MIT
#include "scene/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "scene/scene_at.h"
#include "scene/scene_parts.h"
#include "scene/visibility.h"
#include "spline/trajectory.h"

namespace sigs {

namespace {

constexpr double kOccludesAll = 0.95;       // share of the image: beyond it, the mask is likely inverted
constexpr int kSamplesOfAll = 200'000;      // of all trajectories together
constexpr int kMaxSamples = 6000;           // of each trajectory
constexpr int kMinSamples = 8;              // of each trajectory
constexpr double kLongestAeroplane_m = 90;  // An-225: 84 m
constexpr double kUnits_m[] = {1e-3, 1e-2, 0.0254, 0.3048};  // common units of models that are not in metres
constexpr const char* kUnitNames[] = {"millimetres", "centimetres", "inches", "feet"};
constexpr double kUsualLength_m[] = {1, 100};  // of most intruders

// Three significant digits, from 1000 to 1e7 a whole number.
std::string short_text(double number) {
  const bool is_whole = std::abs(number) >= 1000 && std::abs(number) < 1e7;
  return is_whole ? fmt::format("{}", std::llround(number)) : fmt::format("{:.3g}", number);
}

std::string length_text(double length_m) {
  return length_m >= 1000 ? short_text(length_m / 1000) + " km" : short_text(length_m) + " m";
}

std::string nearest_frame_text(double frame) {
  return fmt::format("frame {}", std::lround(frame));
}

// What a mask hides. Most hide a part, which a few rows tell; only else all of them are counted.
struct MaskCover {
  double share = 0;  // of the image that is hidden wholly; 0 where it is at most kOccludesAll
  bool hides_any = false;
};

MaskCover cover_of(const cv::Mat& mask) {
  constexpr int kApart = 16;  // rows
  const auto total = static_cast<double>(mask.total());
  MaskCover cover;
  double shown = 0;  // samples
  for (int first = 0; first < kApart; ++first)
    for (int y = first; y < mask.rows; y += kApart) {
      int shown_of_row = 0, hides_of_row = 0;
      for (const float opacity : std::span(mask.ptr<float>(y), static_cast<std::size_t>(mask.cols))) {
        shown_of_row += opacity >= kOccludingOpacity ? 0 : 1;
        hides_of_row += opacity != 0 ? 1 : 0;
      }
      shown += shown_of_row;
      cover.hides_any = cover.hides_any || hides_of_row > 0;
      if (cover.hides_any && shown >= (1 - kOccludesAll) * total) return cover;
    }
  const double share = 1 - shown / total;
  if (share > kOccludesAll) cover.share = share;
  return cover;
}

//   hider  what is white in it
void check_mask(const cv::Mat& mask, const std::string& field, const std::string& hider, std::vector<Problem>& issues) {
  if (mask.empty()) return;
  const MaskCover cover = cover_of(mask);
  const auto add = [&](std::string what) { issues.push_back({field, std::move(what)}); };
  if (cover.share > 0)
    add(fmt::format(
        "is white in {} % of the image and hides every intruder there; white is {}, black is what lies behind it",
        short_text(100 * cover.share), hider));
  else if (!cover.hides_any)
    add("is black all over and hides nothing; it can be left out");
}

// "in millimetres (scale 0.001: 2.9 m)", for each unit in which the model would be an aircraft.
std::string likely_units(const ModelSettings& model, double length_m) {
  std::string units;
  for (std::size_t i = 0; i < std::size(kUnits_m); ++i) {
    const double other_m = length_m / model.scale * kUnits_m[i];
    if (other_m < kUsualLength_m[0] || other_m > kUsualLength_m[1]) continue;
    units += fmt::format("{}in {} (scale {}: {} long)", units.empty() ? "" : " or ", kUnitNames[i],
                         short_text(kUnits_m[i]), length_text(other_m));
  }
  return units;
}

void check_model(const ModelSettings& settings, const Model& model, const std::string& key,
                 std::vector<Problem>& issues) {
  const glm::vec3 size_m = model.mesh.high_m - model.mesh.low_m;
  const double largest_m = std::max({size_m.x, size_m.y, size_m.z});
  const bool may_be_feet = settings.scale == 1 && settings.length_m == 0 && size_m.x > kLongestAeroplane_m;
  if (largest_m >= kMinAircraft_m && largest_m <= kMaxAircraft_m && !may_be_feet) return;
  const std::string what =
      fmt::format("makes the model {} long and {} wide", length_text(size_m.x), length_text(size_m.y));
  if (settings.length_m > 0) return issues.push_back({key + ".length_m", what});
  const std::string units = likely_units(settings, size_m.x);
  issues.push_back({key + ".scale", what + (units.empty() ? "; set it, or length_m, to what the model measures"
                                                          : fmt::format("; is the file {}?", units))});
}

// Of the first frame.
double camera_height_m(const Scene& scene) {
  return -camera_at(scene.motion, time_of_frame_s(scene.footage, scene.first_frame)).translation_m.z;
}

struct Extremes {
  double fastest_mps = 0;
  double fastest_frame = 0;
  double lowest_z_m = -INFINITY;
  double lowest_frame = 0;
};

Extremes extremes_of(const Scene& scene, const SceneIntruder& intruder, int samples) {
  Extremes extremes;
  const int last = scene.last_frame - scene.first_frame;
  const int steps = std::clamp(samples - 1, 1, std::max(1, last));
  for (int i = 0; i <= steps; ++i) {
    const double frame = scene.first_frame + std::round(static_cast<double>(last) * i / steps);
    const double time_s = time_of_frame_s(scene.footage, frame);
    const double speed_mps = glm::length(intruder.trajectory.velocity_mps(time_s));
    const double z_m = intruder.trajectory.position_m(time_s).z;
    if (speed_mps > extremes.fastest_mps) extremes.fastest_mps = speed_mps, extremes.fastest_frame = frame;
    if (z_m > extremes.lowest_z_m) extremes.lowest_z_m = z_m, extremes.lowest_frame = frame;
  }
  return extremes;
}

void check_flight(const Scene& scene, const SceneIntruder& intruder, const std::string& key,
                  std::vector<Problem>& issues) {
  const auto intruders = static_cast<int>(std::min<std::size_t>(kSamplesOfAll, scene.intruders.size()));
  const int samples = std::clamp(kSamplesOfAll / intruders, kMinSamples, kMaxSamples);
  const Extremes extremes = extremes_of(scene, intruder, samples);
  if (extremes.fastest_mps > kFastestAircraft_mps)
    issues.push_back(
        {key,
         fmt::format("\"{}\" flies at {} m/s at {}, faster than any aircraft; move its waypoints nearer "
                     "together or their frames apart",
                     intruder.name, short_text(extremes.fastest_mps), nearest_frame_text(extremes.fastest_frame))});
  // Where the camera itself lies below z = 0, the project's world has its ground elsewhere.
  if (extremes.lowest_z_m > 0 && camera_height_m(scene) >= 0)
    issues.push_back(
        {key, fmt::format("\"{}\" is {} m below the ground at {}; the ground is z = 0, and heights are negative z",
                          intruder.name, short_text(extremes.lowest_z_m), nearest_frame_text(extremes.lowest_frame))});
}

// The waypoints of a path whose shape depends on their times; none of an approximating spline.
std::vector<TimedWaypoint> shaping_waypoints(const TrajectoryPlan& plan, const Scene& scene) {
  if (plan.spline != SplineKind::interpolating) return {};
  return timed_waypoints(plan.waypoints, scene);
}

// The first of equal ones.
const Overshoot& farthest(const std::vector<Overshoot>& overshoots) {
  return *std::max_element(overshoots.begin(), overshoots.end(),
                           [](const Overshoot& a, const Overshoot& b) { return a.overshoot_m < b.overshoot_m; });
}

std::string overshoot_text(const Overshoot& worst, std::size_t others, const std::string& name,
                           const std::vector<double>& frames) {
  const std::string elsewhere =
      others > 0 ? fmt::format(" (and in {} other {})", others, others == 1 ? "leg" : "legs") : std::string();
  return fmt::format(
      "\"{}\" overshoots {:g} m off the straight way between its waypoints of frames {:.10g} and {:.10g}, where no leg "
      "is longer than {:g} m{}: the frames do not go with the distances; leave them out to spread them evenly, add "
      "waypoints in between, or set trajectory.spline to approximating",
      name, worst.overshoot_m, frames[worst.leg], frames[worst.leg + 1], worst.max_leg_m, elsewhere);
}

// A problem where the path overshoots farther off the straight line between two waypoints than any leg around is long.
// It names the worst leg and counts the others.
std::optional<Problem> overshoot_issue(const Project& project, std::size_t intruder, const Scene& scene) {
  const IntruderSettings& settings = project.intruders[intruder];
  const std::vector<TimedWaypoint> waypoints = shaping_waypoints(settings.trajectory, scene);
  if (waypoints.empty()) return std::nullopt;
  const std::vector<Overshoot> overshoots = overshoots_of(waypoints);
  if (overshoots.empty()) return std::nullopt;
  const std::vector<double> frames = waypoint_frames(settings.trajectory.waypoints, scene);
  return Problem{key_of_intruder(intruder) + ".trajectory",
                 overshoot_text(farthest(overshoots), overshoots.size() - 1, settings.name, frames)};
}

// Settings that ask for what the others leave no room for, and which nothing else would say.
std::vector<Problem> settings_without_effect(const Project& project, const Scene& scene) {
  std::vector<Problem> idle;
  const bool is_direct = project.compositing.method == MethodChoice::direct;
  const auto say = [&](const std::string& key, const std::string& why) {
    idle.push_back({key, "has no effect: " + why});
  };
  const std::string by_direct = "it takes compositing.method direct";
  if (scene.clouds && !is_direct) say("footage.cloud_distance_m", by_direct);
  if (project.light.ground_shadow > 0) {
    if (!is_direct) say("light.ground_shadow", by_direct);
    if (scene.is_thermal) say("light.ground_shadow", "thermal footage shows no sunlight");
    if (is_direct && !scene.is_thermal && project.light.kind != LightKind::sun)
      say("light.ground_shadow", "it takes light.kind sun; a point light casts none on the ground");
  }
  for (std::size_t i = 0; i < project.intruders.size(); ++i) {
    const std::string key = key_of_intruder(i);
    const auto say_of = [&](const char* setting, bool is_asked_for) {
      if (is_asked_for && (scene.is_thermal || !is_direct))
        say(key + setting, scene.is_thermal ? "thermal footage shows none" : by_direct);
    };
    say_of(".contrail.strands", project.intruders[i].contrail.strands > 0);
    say_of(".lights", !project.intruders[i].lights.is_dark());
  }
  return idle;
}

}  // namespace

std::optional<double> path_condition(const Project& project, std::size_t intruder, const Scene& scene) {
  const std::vector<TimedWaypoint> waypoints = shaping_waypoints(project.intruders[intruder].trajectory, scene);
  if (waypoints.empty()) return std::nullopt;
  return interpolation_condition(waypoints);
}

std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene,
                                         const std::vector<int>& intruder_of_project) {
  std::vector<Problem> issues;
  for (const Warning& warning : scene.camera.warnings) issues.push_back({"footage.calibration", warning.text()});
  check_mask(scene.own_body, "footage.own_body_mask", "the own body", issues);
  check_mask(scene.occluder.mask, "footage.occluder_mask", "what stands nearer than the intruders", issues);
  if (camera_height_m(scene) < 0)
    issues.push_back({"camera.position_m", "lies below the ground; the ground is z = 0, and heights are negative z"});
  for (Problem& idle : settings_without_effect(project, scene)) issues.push_back(std::move(idle));
  for (std::size_t i = 0; i < intruder_of_project.size(); ++i) {
    if (intruder_of_project[i] < 0) continue;
    const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(intruder_of_project[i])];
    const std::string key = key_of_intruder(i);
    // The limits are those of aircraft; an insect is smaller.
    if (intruder.model != nullptr && !intruder.is_distractor)
      check_model(project.intruders[i].model, *intruder.model, key + ".model", issues);
    check_flight(scene, intruder, key + ".trajectory", issues);
    if (std::optional<Problem> overshoot = overshoot_issue(project, i, scene)) issues.push_back(*std::move(overshoot));
    for (Problem& mistake : lint(project, i, scene, static_cast<std::size_t>(intruder_of_project[i])))
      issues.push_back(std::move(mistake));
  }
  return issues;
}

std::vector<Problem> plausibility_issues(const Project& project, const Scene& scene) {
  std::vector<int> in_order;
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) in_order.push_back(static_cast<int>(i));
  return plausibility_issues(project, scene, in_order);
}

}  // namespace sigs
