// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "editor/preview/preview_output.h"
#include "evaluation/readers/clip_truth.h"

namespace sigs::editor {

// Makes the surveys of a scene in small slices, so that a long one delays nothing else. Frames come first, for all
// intruders at once, then what needs the whole flight.
class SurveyBuilder {
 public:
  // Begins the surveys of a scene, and drops those of the one before.
  void begin(std::shared_ptr<const OpenedScene> scene);

  // For which Survey::encounter is made, first of all; it is made anew for others. Empty: it is not made.
  void want_volumes(std::vector<WellClearVolume> volumes);

  // Whether there is nothing left to do; true without a scene.
  [[nodiscard]] bool done() const {
    return !scene_ || (next_frame_ > last_frame() && next_whole_ >= surveys_.size() && !has_encounter_to_make());
  }

  // Works for about budget_s seconds, at least one step. True where there is enough new to be shown.
  bool work(double budget_s);

  // The surveys as far as they are made, one for each intruder of the project; one without a path has an empty one.
  [[nodiscard]] std::vector<std::shared_ptr<const Survey>> surveys();

 private:
  [[nodiscard]] int last_frame() const { return scene_->draft.scene.last_frame; }
  void step();
  void look_at_frame(int frame);
  void look_at_camera(double time_s);
  void look_at_whole(std::size_t intruder);
  [[nodiscard]] bool has_encounter_to_make() const { return !volumes_.empty() && next_encounter_ < surveys_.size(); }
  void look_at_encounter(std::size_t intruder);

  std::shared_ptr<const OpenedScene> scene_;
  std::optional<VisibilityEstimator> points_;
  std::vector<Survey> surveys_;
  int next_frame_ = 0;
  std::size_t next_whole_ = 0;
  std::vector<WellClearVolume> volumes_;
  std::size_t next_encounter_ = 0;
  std::size_t handed_out_ = 0;  // frames that the last call of surveys() gave out
};

// The camera's turn at a time of the footage; without `before` its yaw is within 180 degrees of 0, else of that turn's.
// Standard deviations are to first order: those of the three angles come from small turns about the camera's own axes
// that do not depend on each other; straight up or down, where roll and yaw are the same, they are at most 180 degrees.
[[nodiscard]] CameraTurn camera_turn_at(const CameraMotion& motion, double time_s, const CameraTurn* before);

// What result files of this scene's footage count in.
[[nodiscard]] FootageTruth footage_truth_of(const OpenedScene& scene);

// The survey of a camera of a rig by the frames that the timeline counts: of each the state in the camera's frame that
// is nearest in time, for as long as that camera films. Of a scene without a timeline of its own it is the same.
[[nodiscard]] std::shared_ptr<const Survey> on_timeline(const std::shared_ptr<const Survey>& survey,
                                                        const Scene& scene);

// The footage's truth as far as it is known without drawing: by the outlines of the surveys, one for each of the
// project's intruders. Boxes are within a pixel or so of those that are measured in drawn frames; what stands behind
// the own body in part counts as seen whole. Null where a survey is missing or not complete.
[[nodiscard]] std::shared_ptr<const ClipTruth> outline_truth(const OpenedScene& scene,
                                                             const std::vector<std::shared_ptr<const Survey>>& surveys);

}  // namespace sigs::editor
