// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "geo/geodetic.h"
#include "project/project.h"
#include "project/validate.h"
#include "scene/model.h"
#include "spline/piecewise_cubic.h"
#include "spline/trajectory.h"
#include "video/frame_source.h"

namespace sigs {

// The size and the frame times of the footage: all that a scene needs to know of it.
struct FootageShape {
  cv::Size size_px;
  std::optional<ImagePart> part = {};  // of the footage's images, which calibrations may be made for
  std::vector<double> times_s;     // presentation time of each frame; the first is 0 but of the further cameras of a
                                   // rig, whose times are those of the rig's clock
  double frame_interval_s = 0.04;  // nominal; extrapolates the times before the first and after the last frame
};

// What a scene has to know of a video.
[[nodiscard]] FootageShape shape_of(const VideoInfo& video);

// Time of a frame in seconds. The frame may be fractional (linear between its neighbours) and may lie beyond the
// footage's ends (extrapolated with frame_interval_s). Without any times: frame * frame_interval_s.
[[nodiscard]] double time_of_frame_s(const FootageShape& footage, double frame);

// The reverse: the frame, with fractions, at a time. Of frames with the same time the first.
[[nodiscard]] double frame_at_time(const FootageShape& footage, double time_s);

// The frames that waypoints, and the attitudes of a table, count.
struct Timeline {
  FootageShape footage;
  int first_frame = 0;
  int last_frame = 0;  // included
};

// A point light and ambient light, or the sun, sky and ground. Colours are linear; 1: a white surface that is lit
// squarely becomes white.
struct SceneLight {
  LightKind kind = LightKind::point;
  glm::dvec3 position_m{0, 0, 0};                // of the point light, world
  glm::dvec3 color{1, 1, 1};                     // of the point light or of the sun
  double ambient = 0.35;                         // share of the point light that comes from everywhere, 0..1
  std::optional<double> sun_azimuth_rad = {};    // from world X to the right; none: by time and place
  std::optional<double> sun_elevation_rad = {};  // above the horizon, as it is seen; likewise (scene/scene_light.h)
  glm::dvec3 sky_color{0, 0, 0};
  glm::dvec3 ground_color{0, 0, 0};
  double exposure = 1;                     // factor of sun, sky and ground
  double ground_shadow = 0;                // share of the ground's light that a shadow takes, 0..1; 0: none is drawn
  std::optional<double> white_cdpm2 = {};  // LightSettings::white_cdpm2
};

struct SceneIntruder {
  std::string name;
  const Model* model = nullptr;  // one of Scene::models
  Trajectory trajectory;
  bool is_distractor = false;  // RoleChoice::distractor
  ContrailSettings contrail = {};
  LampSettings lights = {};
};

// Attitude of the aircraft that carries the camera, at one moment. The identity: wings level, nose along world X.
struct PlatformAttitude {
  double time_s = 0;
  glm::dquat world_from_platform{1, 0, 0, 0};
};

// Standard deviation of the camera's attitude at one moment: of small turns about the camera's X, Y and Z.
struct AttitudeDeviation {
  double time_s = 0;
  glm::dvec3 sd_rad{0, 0, 0};
};

// How long the shutter is open at one moment.
struct ExposureTime {
  double time_s = 0;
  double exposure_s = 0;
};

// Where the camera's pose comes from, for the truth: format and quantity of a log; empty: the project's settings.
struct PoseSource {
  std::string position;
  std::string attitude;
};

// The camera moves along world X at constant speed (paper, section 3.1.3) unless its path is known. Its attitude is
// constant unless the attitudes of the platform are known.
struct CameraMotion {
  Pose<frame::World, frame::Camera> world_from_camera_at_start;  // at time 0, with the platform level
  double speed_mps = 0;
  std::vector<PlatformAttitude> attitudes = {};     // by rising time; empty: always level
  std::shared_ptr<const PiecewiseCubic> path = {};  // the camera's place in the world; null: straight on
  std::vector<AttitudeDeviation> deviations = {};   // by rising time; empty: not known
  double readout_s = 0;                             // of the rolling shutter, first to last row; 0: all rows at once
  std::vector<ExposureTime> exposures = {};         // by rising time; empty: not known, taken as 0
  std::optional<double> logged_white_cdpm2 = {};    // Track::white_cdpm2 amid the project's frames
  PoseSource source = {};
  std::optional<Pose<frame::Body, frame::Camera>> mount = {};  // on what all of this describes; none: it is the camera
  glm::bvec3 moves_with_start{true, true, true};  // whether camera.position_m moves the path along world X, Y, Z: not
                                                  // where the project states the world's origin on the Earth
};

// What stands in the world between the camera and intruders that are farther away than it, such as trees and hills.
struct Occluder {
  cv::Mat mask;                                         // CV_32FC1 of the footage's size, 0..1; empty: nothing does
  Pose<frame::World, frame::Camera> world_from_camera;  // at the frame that the mask was made of
  double distance_m = 0;                                // from there; 0: nearer than any intruder, and its own
                                                        // parallax is not known

  // Whether it hides what is this far away.
  [[nodiscard]] bool hides(double intruder_distance_m) const {
    return !mask.empty() && intruder_distance_m > distance_m;
  }
};

// The clouds that the footage shows, which hide what is farther away. Their distance is assumed.
struct Clouds {
  double distance_m = 0;  // from the camera to where they begin
  double depth_m = 0;     // over which they become as thick as they look

  // The share of the clouds' depth before what is this far away, 0..1.
  [[nodiscard]] double depth_before(double intruder_distance_m) const {
    const double in_them_m = intruder_distance_m - distance_m;
    if (!(in_them_m > 0)) return 0;
    return in_them_m < depth_m ? in_them_m / depth_m : 1;
  }
};

// A project with everything that it names opened and checked. It does not change after it has been opened.
struct Scene {
  Camera camera;
  CameraMotion motion;
  SceneLight light;
  std::vector<std::shared_ptr<const Model>> models;  // each once, however many intruders use it; see SceneFiles
  std::vector<SceneIntruder> intruders;              // in the project's order
  cv::Mat own_body;  // CV_32FC1 of the footage's size, 0..1: 1 where the own body hides everything; empty: no mask
  Occluder occluder;
  std::optional<Clouds> clouds = {};
  BoxesByFrame real_aircraft = {};  // that the footage itself shows
  CompositingSettings compositing;
  bool rotors_count = true;  // in boxes, areas and visible shares; false: the aircraft is measured without them
  AppearanceSettings appearance;
  FootageShape footage;
  int first_frame = 0;                          // of the footage, from 0
  int last_frame = 0;                           // included
  std::optional<Timeline> timeline = {};        // of the first camera of a rig; none: that of the footage itself
  bool is_thermal = false;                      // Spectrum::thermal: models and light are as model.h has them
  HeatPalette palette = HeatPalette::gray;      // the colours in which a thermal camera shows heat
  bool horizon_is_known = false;                // the project, or the camera's log, states the camera's attitude
  std::optional<LocalFrame> earth = {};         // where the world lies on the Earth, if that is known
  std::optional<double> utc_at_frame_0_s = {};  // seconds since 1970 without leap seconds, if the camera's log knows
  std::vector<Warning> warnings;                // from reading the files
  std::vector<Problem> issues;  // settings that can be used but are implausible, by field (scene/plausibility.h)
};

// The camera that the compositing method works with: the footage's; for the method `plain`, which knows no lens
// distortion, the pinhole with the same focal lengths and principal point.
[[nodiscard]] Camera compositing_camera(const Scene& scene);

}  // namespace sigs
