// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "editor/geometry/image_drag.h"
#include "editor/views/context.h"

namespace sigs::editor {

// The footage's camera in one frame, with the lens that the images are made through.
struct FootageCamera {
  int frame = 0;
  CameraPose world_from_camera;
  Lens lens;

  [[nodiscard]] double distance_m(const glm::dvec3& p_in_world) const {
    return glm::distance(p_in_world, world_from_camera.translation_m);
  }
};

// By the newest scene that is open; none where there is none. The `plain` method knows no lens: a pinhole.
[[nodiscard]] std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame);

// A waypoint as that camera sees it. In the waypoint's own frame it is where the intruder is.
struct WaypointMark {
  int intruder = 0;
  int waypoint = 0;
  double frame = 0;  // that it stands in
  glm::dvec3 position_m{0, 0, 0};
  glm::dvec2 pixel{0, 0};
};

// Of the document's project, all intruders; those without an image are left out. Kept until project, scene or frame
// change.
class WaypointMarks {
 public:
  [[nodiscard]] const std::vector<WaypointMark>& of(const ViewContext& context, const FootageCamera& eye);

 private:
  struct MadeFor {
    std::uint64_t document = 0;
    std::uint64_t scene = 0;
    int frame = 0;
    [[nodiscard]] bool operator==(const MadeFor&) const = default;
  };
  MadeFor made_for_;
  std::vector<WaypointMark> marks_;
};

// The project's number of an intruder that the scene counts otherwise (FrameTruth and stages do); none where the
// project has changed since.
[[nodiscard]] std::optional<int> project_intruder(const ViewContext& context, int in_scene);

// And back; none for one without waypoints.
[[nodiscard]] std::optional<int> scene_intruder(const ViewContext& context, int in_project);

}  // namespace sigs::editor
