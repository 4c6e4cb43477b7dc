// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "editor/geometry/lens_projection.h"
#include "editor/preview/preview_output.h"
#include "editor/views/context.h"

namespace sigs::editor {

// A curve as a polyline: points at parameters that grow.
struct CurveSamples {
  std::vector<double> at;
  std::vector<glm::dvec3> points_m;

  // On the polyline, between its ends; the ends beyond them. Needs a point at least.
  [[nodiscard]] glm::dvec3 point_at(double parameter) const;
};

// Samples a curve where it bends: pieces are halved, the one whose middle lies farthest off the middle of its chord
// first, until none lies farther than tolerance_m or `maximum` points are there (at least 2). Parameters of `through`
// that lie within first
// .. last get a point of their own, up to half of `maximum`. last <= first: a single point.
[[nodiscard]] CurveSamples sampled_curve(const std::function<glm::dvec3(double)>& curve, double first, double last,
                                         std::span<const double> through, double tolerance_m, std::size_t maximum);

// The stretch of a polyline between two parameters, with its ends; nothing where they leave no stretch.
[[nodiscard]] std::vector<glm::dvec3> stretch(const CurveSamples& samples, double from, double to);

// A place on a trajectory and where it leads, for a mark across it.
struct WorldTick {
  glm::dvec3 at_m{0, 0, 0};
  glm::dvec3 next_m{0, 0, 0};
};

// An intruder's path through the world, over the range and as far as its waypoints go. Parameters are frames of the
// footage.
struct WorldCurve {
  // Index in the project.
  int intruder = 0;
  CurveSamples samples;  // by frame
  double range_first = 0;
  double range_last = 0;
  std::vector<WorldTick> ticks;  // at even steps of time over the range
};

// The edge of the image as rays of the camera frame, once around; rays of length 1, or that reach X = 1 where the
// whole image lies well before the camera.
struct ImageBorder {
  std::vector<glm::dvec3> rays;
  std::vector<std::size_t> corners;  // which of them are the image's corners
};

// What takes some time to find out of an opened scene, found once for each. revision is the scene's; 0: no scene yet.
struct WorldModel {
  std::uint64_t revision = 0;
  std::vector<WorldCurve> curves;
  ImageBorder border;
  CurveSamples camera_path;  // of the camera over the scene's range, by frame
  // Distance of the farthest intruder from the camera, over the range; 0: there is none.
  double farthest_m = 0;
};
[[nodiscard]] WorldModel world_model(const OpenedScene& opened);

// The image borders of the cameras of a rig, each found once for its scene; one without a scene yet has none.
class RigBorders {
 public:
  void follow(const std::vector<PreviewOutput>& rig);
  [[nodiscard]] const ImageBorder& of(std::size_t camera) const { return borders_[camera].border; }
  [[nodiscard]] std::size_t size() const { return borders_.size(); }

 private:
  struct Known {
    std::shared_ptr<const OpenedScene> scene;
    ImageBorder border;
  };
  std::vector<Known> borders_;
};
[[nodiscard]] ImageBorder image_border(const Camera& camera);

// An aircraft at the playhead's moment. Those of the scene that is open: without one there are none.
struct WorldBody {
  int intruder = 0;  // of the project
  Pose<frame::World, frame::Body> world_from_body;
  std::shared_ptr<const Model> model;
};
// A camera of a rig at the playhead's moment.
struct WorldCamera {
  std::string name;
  CameraPose world_from_camera;
  bool is_active = false;
};
// The playhead's moment, with the camera of views/context.h.
struct WorldMoment {
  double time_s = 0;
  CameraPose world_from_camera;
  std::vector<WorldCamera> cameras;  // of a rig, by their index; else none
  std::vector<WorldBody> bodies;
};
[[nodiscard]] WorldMoment world_moment(const ViewContext& context);

// Everything near that should be in sight when a project is first shown: camera, trajectories within the range,
// waypoints; the light only while it is selected.
[[nodiscard]] std::vector<glm::dvec3> points_of_interest(const ViewContext& context, const WorldModel& model);

}  // namespace sigs::editor
