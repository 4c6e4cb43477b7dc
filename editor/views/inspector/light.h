// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/geometry/light_direction.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// The light's fields, and where it stands as the camera sees it in the playhead's frame.
class LightBlock {
 public:
  void draw(const Studio& studio, FieldRows& rows);

 private:
  struct Seen {
    glm::dvec3 camera_m{0, 0, 0};
    double camera_bearing_rad = 0;
  };
  [[nodiscard]] static Seen seen_from(const Studio& studio);
  void draw_direction(const Studio& studio, FieldRows& rows, const Seen& seen);
  void draw_presets(const Studio& studio, const Seen& seen) const;

  // While it is dragged: a light overhead has no bearing to read back.
  std::optional<LightDirection> dragged_;
};

}  // namespace sigs::editor
