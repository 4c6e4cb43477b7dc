// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "truth/annotation.h"

namespace sigs {

// The truth of a whole clip, from an annotation file or from composed frames, reduced to what scoring needs.

// One intruder in one frame. Boxes are edges in pixels (base/image.h): the left edge of an annotation's box of whole
// pixels is x - 0.5.
struct TargetFrame {
  std::optional<Box> visible;     // around its visible pixels; nullopt: none is visible
  std::optional<Box> amodal_box;  // around the whole of it, hidden or not; nullopt: no part of it has an image
  double visible_fraction = 0;    // of the whole, 0 to 1
  int visible_pixels = 0;         // number of them; 0 also where a file does not give it
  double distance_m = 0;          // from the camera; NaN: not known
  HorizonSide horizon = HorizonSide::unknown;
  std::optional<double> rms_contrast = {};  // of its visible pixels against the footage; none: not known
  // Of its reference point, less the camera's place; none: the truth does not have it.
  std::optional<glm::dvec3> position_m = {};  // in the camera's axes: X along the optical axis, Y right, Z down
  std::optional<glm::dvec3> offset_m = {};    // in the world's
  // Between its nose and the line from it to the camera: 0 head-on, pi/2 from the side, pi from behind.
  std::optional<double> aspect_rad = {};
  double cloud_hidden = 0;  // share of its coverage that clouds take
};

// Positions and aspect, from the reference point in the camera's axes and two attitudes in the world.
void set_geometry(TargetFrame& frame, const glm::dvec3& position_m, const glm::dquat& world_from_camera,
                  const glm::dquat& world_from_body);

// One intruder in all frames.
struct TargetTruth {
  int id = 0;
  std::string name;
  std::vector<TargetFrame> frames;  // one for each of ClipTruth::times_s
};

// The truth of a clip: frames footage.first_frame to last_frame. Distractors are no targets: what a detector finds
// there is a false alarm.
struct ClipTruth {
  FootageTruth footage;
  std::vector<double> times_s;                      // of each frame
  std::vector<TargetTruth> targets;                 // by id
  std::vector<glm::dvec3> camera_positions_m = {};  // in the world, of each frame; empty: not known
  // Of truths that other programs have written (truth_files.h):
  std::vector<std::vector<Box>> ignored =
      {};                 // of each frame, boxes that no report has to match; empty: there are none
  bool has_ids = true;    // a target is one object throughout; else its boxes are of any objects
  bool has_times = true;  // times_s are known; else they are frames at an invented rate

  [[nodiscard]] int frames() const { return static_cast<int>(times_s.size()); }
};

// What scoring needs of an intruder's truth.
[[nodiscard]] TargetFrame target_frame_of(const IntruderTruth& truth, const glm::dquat& world_from_camera);

// The edges of a rectangle of whole pixels.
[[nodiscard]] Box box_of(const cv::Rect& pixels);

// An intruder with its truth in one frame.
struct TargetInFrame {
  int id = 0;
  std::string name;
  TargetFrame frame;
};

// Appends the next frame; the first one defines the targets, in rising order of their ids. index is the footage's
// number. Error bad_data, without a place: it is not the frame after the last one (or footage.first_frame), or its
// intruders are not those of the frames before.
[[nodiscard]] Result<void> add_frame(ClipTruth& clip, const FrameTruth& truth);
[[nodiscard]] Result<void> add_frame(ClipTruth& clip, int index, double time_s,
                                     const std::vector<TargetInFrame>& targets);

// Reads a SIGS annotation file (NAME.xml, docs/annotation-format.md). It must have each frame of the range in its
// element footage. Errors: cannot_read; bad_data with file and line.
[[nodiscard]] Result<ClipTruth> read_truth(const std::filesystem::path& path);

}  // namespace sigs
