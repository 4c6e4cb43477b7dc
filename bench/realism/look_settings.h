// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "project/project.h"

namespace sigs::bench {

// One way to set how an inserted aircraft looks.
struct LookSettings {
  std::string name;  // "default", "matched", "best"
  // JSON files for all clips, or folders with CLIP.json for each, one after the other; none: the defaults.
  std::vector<std::filesystem::path> from;
  bool shakes = false;  // the camera's shake is known: it is taken from the real target's path
};

// Whether the camera's shake is known in a clip: as the settings say; of a whole project, whether it names a track.
[[nodiscard]] bool shakes_in(const LookSettings& settings, const std::string& clip);

// Applies what the file says of light, compositing, appearance and camera.exposure_s; its other members are left alone,
// so that whole projects can be given. Stops the program where a file is not there or a setting is not known.
void apply(const LookSettings& settings, const std::string& clip, Project& project);

}  // namespace sigs::bench
