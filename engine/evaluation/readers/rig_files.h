// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// What an export of several cameras on one aircraft writes of all of them, NAME.rig.json and NAME.rig.csv
// (docs/rigs.md), reduced to what scoring needs. Times are the rig's, as in the labels of each camera.

// Where an intruder is at the time of a frame of the first camera.
struct RigPlace {
  double time_s = 0;
  glm::dvec3 p_in_body{0, 0, 0};  // metres from the aircraft's origin, in its axes: X out of the nose, Y right, Z down
};

// From the camera that shows an intruder to the next one. Indices are those of RigClip::cameras.
struct RigHandover {
  std::size_t from = 0;
  std::size_t to = 0;
  double time_s = 0;  // of the last frame in which `from` shows it
  double gap_s = 0;   // from there to the first frame in which `to` shows it; negative: both did for as long
};

struct RigTarget {
  int id = 0;
  std::string name;
  std::vector<RigPlace> places;  // by rising time, at least one
  std::vector<RigHandover> handovers;
};

struct RigClip {
  std::string name;
  std::vector<std::string> cameras;           // names, in the rig's order
  std::vector<std::filesystem::path> labels;  // of each camera: NAME.CAMERA.xml beside the file
  std::vector<RigTarget> targets;             // all intruders, distractors too
};

// Reads NAME.rig.json and, beside it, NAME.rig.csv. Errors: cannot_read; bad_data with the file and its field or line.
[[nodiscard]] Result<RigClip> read_rig(const std::filesystem::path& path);

// The place at a time, by a straight line through those before and after it. Before the first and after the last one,
// where other cameras may have frames, the line of the nearest two goes on for as long as these are apart.
[[nodiscard]] glm::dvec3 place_at(const RigTarget& target, double time_s);

}  // namespace sigs
