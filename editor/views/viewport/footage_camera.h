// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "editor/geometry/lens_projection.h"
#include "editor/views/context.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// The footage's camera in one frame, with the lens that the images are made through. Overlays are projected by it, so
// they lie where compositing puts the intruders.
struct FootageCamera {
  int frame = 0;
  CameraPose world_from_camera;
  Lens lens;

  // From the camera.
  [[nodiscard]] double distance_m(const glm::dvec3& p_in_world) const {
    return glm::distance(p_in_world, world_from_camera.translation_m);
  }
};

// The camera of a frame (of the footage, from 0) in the newest scene that is open; nothing while no scene is open. For
// the `plain` method, which ignores the lens, it is a pinhole camera with the same intrinsics.
[[nodiscard]] std::optional<FootageCamera> footage_camera_at(const ViewContext& context, int frame);

// A waypoint projected into the image of that camera. In the waypoint's own frame its pixel is where the intruder is.
// The indices count in the project.
struct WaypointMark {
  int intruder = 0;
  int waypoint = 0;
  // The waypoint's moment; not whole where frames are spread evenly.
  double frame = 0;
  // In the world.
  glm::dvec3 position_m{0, 0, 0};
  // Of the image, pixel centres at whole numbers. It may lie outside of the image.
  glm::dvec2 pixel{0, 0};
};

// Marks of all waypoints of all intruders of the document's project; waypoints that the lens does not image are left
// out. The marks are computed again only when the project, the scene or the frame has changed.
class WaypointMarks {
 public:
  // Valid until the next call.
  [[nodiscard]] const std::vector<WaypointMark>& of(const ViewContext& context, const FootageCamera& eye);

 private:
  // Revision of the document and of the scene, and the frame, that the marks are of.
  struct MadeFor {
    std::uint64_t document = 0;
    std::uint64_t scene = 0;
    int frame = 0;
    [[nodiscard]] bool operator==(const MadeFor&) const = default;
  };
  MadeFor made_for_;
  std::vector<WaypointMark> marks_;
};

// The index in the project of an intruder given by its index in the scene (as FrameTruth and stages count). The scene
// leaves out intruders without waypoints. Nothing while no scene is open and for an index that it does not have. Both
// this and the next go by the scene that is open, which may be of an older revision than the document.
[[nodiscard]] std::optional<int> project_intruder(const ViewContext& context, int in_scene);

// The index in the scene of an intruder given by its index in the project; nothing for one without waypoints.
[[nodiscard]] std::optional<int> scene_intruder(const ViewContext& context, int in_project);

// The paths of all intruders over the scene's range, projected with the camera of one frame: pale before that frame,
// bright after it. The polylines are computed again only when the scene or the frame has changed.
class PathOverlay {
 public:
  // Draws nothing while no scene is open.
  void draw(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye);

 private:
  struct PathPiece {
    int intruder = 0;  // the scene's number
    bool past = false;
    std::vector<PixelLine> lines;
  };
  // Computes the polylines, in pixels of the image.
  void make(const Scene& scene, const FootageCamera& eye);

  std::uint64_t scene_ = 0;
  int frame_ = -1;
  std::vector<PathPiece> pieces_;
};

// The horizon of a flat earth through the camera's lens, as a line over the image; nothing where the image does not
// show it.
void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye);

}  // namespace sigs::editor
