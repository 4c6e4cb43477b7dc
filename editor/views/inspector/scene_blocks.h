// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/geometry/orbit_camera.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The light's fields, and where it stands as the camera sees it in the playhead's frame.
class LightBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  struct Viewpoint {
    glm::dvec3 camera_m{0, 0, 0};
    double camera_bearing_rad = 0;
  };
  [[nodiscard]] static Viewpoint viewpoint_of(const ViewContext& context);
  void draw_direction(const ViewContext& context, FieldRows& rows, const Viewpoint& viewpoint);
  void draw_presets(const ViewContext& context, const Viewpoint& viewpoint) const;

  // While it is dragged: a light overhead has no bearing to read back.
  std::optional<LightDirection> dragged_;
};

// Footage, calibration and own-body mask, and what was found in them.
void draw_inputs(const ViewContext& context, FieldRows& rows);

// The intruders, and the model of the one that is worked on.
class ModelBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_list(const ViewContext& context, const FieldRows& rows);
  void draw_preview(const ViewContext& context, int intruder);

  double turn_rad_ = 0;  // of the turntable
};

}  // namespace sigs::editor
