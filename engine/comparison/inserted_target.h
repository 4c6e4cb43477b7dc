// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "appearance/target_look.h"
#include "base/image.h"
#include "base/result.h"
#include "frame/composed_frame.h"
#include "project/project.h"
#include "scene/posed_intruder.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "video/frame_source.h"

namespace sigs {

// Successive frames of a clip with a box of the target in each; the look is measured in the middle one, the flicker
// over all of them.
struct Stretch {
  int middle = 0;  // number in the clip of the middle frame
  std::vector<Frame> frames;
  std::vector<Box> boxes;

  // Frames before the middle one.
  [[nodiscard]] int reach() const { return static_cast<int>(frames.size()) / 2; }
  [[nodiscard]] const Frame& middle_frame() const { return frames[frames.size() / 2]; }
  [[nodiscard]] const Box& middle_box() const { return boxes[boxes.size() / 2]; }
};

inline constexpr int kStretchReach = 3;  // frames before and after the middle one

// The stretch around a frame. Where the clip or the boxes end within it, the middle frame alone; none where that has no
// box. Errors are those of FrameSource::read.
//   reach  frames before and after the middle one
[[nodiscard]] Result<std::optional<Stretch>> stretch_around(FrameSource& footage,
                                                            const std::vector<std::optional<Box>>& boxes, int middle,
                                                            int reach = kStretchReach);

// A target as it was measured.
struct MeasuredTarget {
  TargetLook look;  // in the middle frame
  cv::Mat image;    // CV_8UC3, BGR: its surroundings there
  // Its centroid in the successive frames against the middle one; empty where it was not found in each.
  std::vector<cv::Point2d> path_px;
};

// Measures a target in successive frames, the middle one being the one that counts. None where it cannot be told from
// the background there.
//   boxes  loose, one for each frame
[[nodiscard]] std::optional<MeasuredTarget> measured_target(std::span<const Frame> frames, std::span<const Box> boxes);

// Reads where a target is in each frame of a clip: CSV with a header line and the columns frame,label,x,y,w,h in this
// order; frames count from 0, x and y are MATLAB's pixels, whose first one has its centre at (1, 1), as in the
// published boxes of the Svanstrom data set (doi:10.5281/zenodo.5500576). Returns boxes by frame, none where a frame
// has no line or a box without area. Where a frame has several lines the first one counts. Errors: cannot_read;
// bad_data (file and line) for what is no number, a frame beyond 10 million, no box at all.
[[nodiscard]] Result<std::vector<std::optional<Box>>> read_target_boxes(const std::filesystem::path& csv);

// Whether the intruder moves with the camera's shake, as a project's does that has the camera's track. The shake is
// taken from the real target's path.
enum class CameraShake { none, as_real_target };

// From where the intruder is seen, and how that changes.
struct InsertedView {
  std::uint32_t seed = 1;     // chooses among the attitudes
  int tries = 1;              // views to choose from: the one whose silhouette's area is most like the real one's
  double highest_rad = 0.45;  // elevation above the horizon: what is seen small is far, and so low
  std::optional<double> growth_per_s = {};  // as IntruderPose::growth_per_s; none: it flies with 60 m/s
};

// The first intruder of a project, put into the frames of a real target, with a silhouette as wide and of about the
// same aspect as the real one's, moving as that moves.
class Insertion {
 public:
  // Chooses the attitude and finds the distance. The project's footage and camera give way to the clip's frames.
  //   middle_px  where, in the middle frame (similar_place() in appearance/target_look.h)
  // The stretch, files and context must outlive this object. Errors: as posed_scene and compose_frame.
  [[nodiscard]] static Result<Insertion> make(const Project& project, const Stretch& stretch, const FootageShape& shape,
                                              const MeasuredTarget& real, cv::Point2d middle_px,
                                              const InsertedView& view, SceneFiles& files, ComposeContext& context);

  // The frames with the intruder of a project that differs from the one above only in how things look, and its boxes.
  struct Composed {
    std::vector<Frame> frames;
    std::vector<Box> boxes;  // loose
  };
  [[nodiscard]] Result<Composed> composed(const Project& project, CameraShake shake);

  // The middle frame alone, measured; without flicker. None as below.
  [[nodiscard]] Result<std::optional<MeasuredTarget>> middle_target(const Project& project, CameraShake shake);

  // All frames, measured. None where it cannot be told from the background, or lies outside the image.
  [[nodiscard]] Result<std::optional<MeasuredTarget>> target(const Project& project, CameraShake shake);

 private:
  Insertion(const Stretch& stretch, const FootageShape& shape, SceneFiles& files, ComposeContext& context)
      : stretch_(&stretch), shape_(shape), files_(&files), context_(&context) {}
  [[nodiscard]] Result<Composed> composed_between(const Project& project, std::size_t first, std::size_t end);

  const Stretch* stretch_;
  FootageShape shape_;
  SceneFiles* files_;
  ComposeContext* context_;
  IntruderPose pose_;
  std::vector<cv::Point2d> real_path_px_;
};

}  // namespace sigs
