// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "project/project.h"
#include "project/validate.h"
#include "scene/scene.h"

namespace sigs {

// What those who begin often get wrong, with what to do about it. Each is one line in the field to be changed.

// Of an intruder's model and waypoints: axes that do not go with the shape of the model (mesh/geometry.h), waypoints
// whose frames the footage does not have, and positions that look as if they were in kilometres or had z pointing up.
// Distractors, which have other shapes than aircraft, are checked for waypoints alone.
//   intruder        index in the project's intruders
//   scene_intruder  the same in the scene
[[nodiscard]] std::vector<Problem> lint(const Project& project, std::size_t intruder, const Scene& scene,
                                        std::size_t scene_intruder);

// Where an intruder that is never in the image passes it: "at frame 12 it is nearest to the image, 40 degrees left of
// it"; "it is behind the camera". Of the reference point alone, at 200 frames at most. Empty where it is in the image.
//   intruder  index in scene.intruders
[[nodiscard]] std::string where_out_of_view(const Scene& scene, std::size_t intruder);

// What footage has that an intruder cannot follow, in the field footage.video: the camera's stabilisation has moved the
// images, as the header or the log in the video says. Reads both; a long recording's log takes a second.
//   log  that the camera follows; one with the attitudes of the images makes it no mistake. Empty: none
[[nodiscard]] std::vector<Problem> footage_mistakes(const std::filesystem::path& video,
                                                    const std::filesystem::path& log = {});

}  // namespace sigs
