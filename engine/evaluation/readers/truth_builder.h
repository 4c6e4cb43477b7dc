// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "evaluation/readers/truth_files.h"

namespace sigs {

// What the readers of truths (truth_files.h) share: boxes are collected and checked here, whatever the layout.

// One true box as a layout states it.
struct TrueBox {
  int frame = 0;                // the footage's number
  std::optional<int> id;        // of the object; none: the layout has no identities
  std::string name;             // of the object; empty: its class
  std::string category;         // class, as the layout calls it
  Box box;                      // edges
  double visible_fraction = 1;  // of the object
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  HorizonSide horizon = HorizonSide::unknown;
  std::optional<double> rms_contrast = {};
  std::optional<Box> amodal_box = {};
  bool is_ignored = false;  // marked so by the file
};

// Collects the boxes of one clip.
class TruthBuilder {
 public:
  // footage: its frames, size and video. times_s: of each frame, rising, or empty for frames at rate_hz; both missing:
  // the clip has no times. options must outlive the builder.
  TruthBuilder(FootageTruth footage, double rate_hz, std::vector<double> times_s, const TruthOptions& options);

  // Error bad_data with an empty place: numbers that are not finite or beyond 1e9, no area, a share outside 0 to 1, a
  // frame outside the clip, the same id twice in a frame.
  [[nodiscard]] Result<void> add(const TrueBox& box);

  // The clip with all that was added; call it once. Error bad_data with an empty place: more frames of more objects
  // than the boxes account for.
  [[nodiscard]] Result<TruthClip> clip(std::string name, FramesOfImages images);

 private:
  [[nodiscard]] Result<void> check(const TrueBox& box) const;
  void number_boxes();  // by their place in the frame, where some have no identity

  ClipTruth clip_;
  const TruthOptions& options_;
  std::vector<TrueBox> boxes_;
  std::set<std::pair<int, int>> there_;  // frame and id
  std::set<std::string> categories_;
};

// The most frames of one clip that is read; more are a mistake of the file.
inline constexpr int kMaxClipFrames = 10'000'000;

// Checks a number of frames that a header states against the rows that the file has, before memory is taken for them.
//   stated_by  the header's field, for the message
[[nodiscard]] Result<void> check_length(int frames, std::size_t boxes, const char* stated_by);

// Adds the images' names without folder and extension, where only one image has it (FramesOfImages::by_name).
void add_short_names(FramesOfImages& images);

// The frame of each image of a folder of numbered images by the number at the end of its name, or, for stills, its
// place. Error bad_data: a name without number, a number twice, a gap.
[[nodiscard]] Result<std::vector<int>> frames_of_images(const std::vector<std::string>& names, bool stills);

// The folders of MOT sequences (with gt/gt.txt): the path itself, or those in it.
[[nodiscard]] std::vector<std::filesystem::path> mot_sequences_in(const std::filesystem::path& path);

// The readers of each layout. path exists.
[[nodiscard]] Result<std::vector<TruthClip>> read_aot_clips(const std::filesystem::path& path, const TruthOptions&);
[[nodiscard]] Result<std::vector<TruthClip>> read_coco_clips(const std::filesystem::path& path, const TruthOptions&);
[[nodiscard]] Result<std::vector<TruthClip>> read_mot_clips(const std::filesystem::path& path, const TruthOptions&);
[[nodiscard]] Result<std::vector<TruthClip>> read_yolo_clips(const std::filesystem::path& path, const TruthOptions&);

}  // namespace sigs
