// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "truth/annotation.h"

namespace sigs {

// One intruder in one frame, as far as scoring needs it. Boxes are edges in pixels (base/image.h): of the annotation's
// whole-pixel box x, y, width, height the left edge is x - 0.5.
struct TargetFrame {
  std::optional<Box> visible;     // around its visible pixels; none: nothing of it can be seen
  std::optional<Box> amodal_box;  // the whole of it, hidden or not
  double visible_fraction = 0;
  int visible_pixels = 0;  // 0 where the file does not say
  double distance_m = 0;
  HorizonSide horizon = HorizonSide::unknown;
};

struct TargetTruth {
  int id = 0;
  std::string name;
  std::vector<TargetFrame> frames;  // one for each of ClipTruth::times_s
};

// The truth of a clip: frames ClipTruth::footage.first_frame to last_frame.
struct ClipTruth {
  FootageTruth footage;
  std::vector<double> times_s;
  std::vector<TargetTruth> targets;  // by id

  [[nodiscard]] int frames() const { return static_cast<int>(times_s.size()); }
};

[[nodiscard]] TargetFrame target_frame_of(const IntruderTruth& truth);

// Edges of a rectangle of whole pixels.
[[nodiscard]] Box box_of(const cv::Rect& pixels);

struct TargetInFrame {
  int id = 0;
  std::string name;
  TargetFrame frame;
};

// Adds the next frame; the first says which targets there are. Error bad_data, without a place: it is not the next one
// of footage.first_frame, ..., or its intruders are not those of the frames before.
[[nodiscard]] Result<void> add_frame(ClipTruth& clip, const FrameTruth& truth);
[[nodiscard]] Result<void> add_frame(ClipTruth& clip, int index, double time_s,
                                     const std::vector<TargetInFrame>& targets);

// Reads a SIGS annotation file (NAME.xml). Errors name the file and the line. The frames are those that its footage
// element says, without a gap.
[[nodiscard]] Result<ClipTruth> read_truth(const std::filesystem::path& path);

}  // namespace sigs
