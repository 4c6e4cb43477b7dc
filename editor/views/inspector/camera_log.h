// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editor/preview/preview_output.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// Place, mounting and speed of the camera; what its log decides cannot be edited.
void draw_camera(const ViewContext& context, FieldRows& rows);

// The log by which the camera moves, what it gives, and the estimate from the footage with its progress.
void draw_camera_log(const ViewContext& context, FieldRows& rows);

// Where the world lies on the Earth, as stated and as the scene has it.
void draw_place_on_earth(const ViewContext& context, FieldRows& rows);

// What the camera's log gives in the open scene, a line each: position, attitude, and its standard deviation at a time
// of the footage, readout. Empty: nothing comes from a file.
[[nodiscard]] std::vector<std::string> lines_of_motion(const CameraMotion& motion, double time_s);

// "47.1234567, 8.7654321, 512.3 m; X heads 93.2 from north"; "": not known.
[[nodiscard]] std::string place_text(const Scene& scene);

}  // namespace sigs::editor
