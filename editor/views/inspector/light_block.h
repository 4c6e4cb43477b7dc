// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/geometry/orbit_camera.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The fields of the kind of light that the project has; of the point light also its bearing, elevation and distance
// from the camera in the playhead's frame, with presets.
class LightBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  // The camera in the playhead's frame: its place in the world, and its heading from world X to the right.
  struct Viewpoint {
    glm::dvec3 camera_m{0, 0, 0};
    double camera_bearing_rad = 0;
  };
  [[nodiscard]] static Viewpoint viewpoint_of(const ViewContext& context);
  void draw_direction(const ViewContext& context, FieldRows& rows, const Viewpoint& viewpoint);
  // The button with which something lit is boxed in the footage; what is found while it is looked at.
  static void draw_lit_like(const ViewContext& context);
  // Buttons that put the light behind, above or beside the camera: the sun's direction, or a point light at the
  // distance that it has.
  void draw_presets(const ViewContext& context, const Viewpoint& viewpoint) const;

  // While it is dragged: a light overhead has no bearing to read back.
  std::optional<LightDirection> dragged_;
};

}  // namespace sigs::editor
