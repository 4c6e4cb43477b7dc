// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "mesh/mesh.h"
#include "project/project.h"
#include "project/validate.h"
#include "spline/trajectory.h"

namespace sigs {

// What a scene has to know of its footage.
struct FootageShape {
  cv::Size size_px;
  std::vector<double> times_s;     // presentation time of each frame, from 0
  double frame_interval_s = 0.04;  // nominal; carries on before the first and after the last frame
};

struct SceneLight {
  glm::dvec3 position_m{0, 0, 0};  // world
  glm::dvec3 color{1, 1, 1};
  double ambient = 0.35;
};

// An aircraft to draw, and the points to measure it by (scene/measuring_points.h).
struct Model {
  Mesh mesh;
  std::vector<glm::vec3> points_m;     // body axes
  std::vector<glm::vec3> outermost_m;  // the few of them that bound it
};

struct SceneIntruder {
  std::string name;
  const Model* model = nullptr;  // one of Scene::models
  Trajectory trajectory;
};

// How what carries the camera is turned: level with its nose along world X where it is 1.
struct CarrierAttitude {
  double time_s = 0;
  glm::dquat world_from_carrier{1, 0, 0, 0};
};

// The camera flies straight along world X (paper section 3.1.3). Its attitude is constant unless the carrier's turns
// are known.
struct CameraMotion {
  Pose<frame::World, frame::Camera> world_from_camera_at_start;  // with the carrier level
  double speed_mps = 0;
  std::vector<CarrierAttitude> turns = {};  // times rise; empty: always level
};

// Everything that a project names, opened and checked; nothing in it changes any more.
struct Scene {
  Camera camera;
  CameraMotion motion;
  SceneLight light;
  std::vector<std::shared_ptr<const Model>> models;  // each once, however many intruders fly it; see SceneFiles
  std::vector<SceneIntruder> intruders;
  cv::Mat own_body;  // CV_32FC1 of the footage's size, 1 where the own body hides everything; empty: no mask
  CompositingSettings compositing;
  FootageShape footage;
  int first_frame = 0;
  int last_frame = 0;             // included
  bool horizon_is_known = false;  // somebody has said how the camera is turned
  std::vector<Warning> warnings;  // of the files that were read
  std::vector<Problem> issues;    // what can be used but is hardly meant, by field (scene/plausibility.h)
};

// Errors name project file and field: "x.json: intruders[0].model.file: no such file".
[[nodiscard]] Result<Scene> open_scene(const Project& project, const FootageShape& footage);

// The same, but takes files that were read before from `files` (scene/scene_files.h).
class SceneFiles;
[[nodiscard]] Result<Scene> open_scene(const Project& project, const FootageShape& footage, SceneFiles& files);

// Time of a frame, also of fractions and beyond the footage's ends.
[[nodiscard]] double time_of_frame_s(const FootageShape& footage, double frame);

}  // namespace sigs
