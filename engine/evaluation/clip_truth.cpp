// SPDX-License-Identifier: MIT
#include "evaluation/clip_truth.h"

#include <glm/geometric.hpp>
#include <utility>

namespace sigs {

namespace {

std::string count_of_intruders(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " intruder" : " intruders");
}

// The first frame says who there is.
Result<void> add_targets(ClipTruth& clip, const std::vector<TargetInFrame>& targets) {
  for (const TargetInFrame& target : targets) {
    if (!clip.targets.empty() && target.id <= clip.targets.back().id) {
      const std::string before = std::to_string(clip.targets.back().id);
      clip.targets.clear();
      return fail("", "intruder " + std::to_string(target.id) + " stands behind intruder " + before +
                          ": they must be in order, each once");
    }
    clip.targets.push_back({.id = target.id, .name = target.name});
  }
  return {};
}

Result<void> check_targets(const ClipTruth& clip, int index, const std::vector<TargetInFrame>& targets) {
  const std::string frame = "frame " + std::to_string(index);
  if (targets.size() != clip.targets.size())
    return fail("", frame + " has " + count_of_intruders(targets.size()) + ", the frames before it " +
                        std::to_string(clip.targets.size()));
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (targets[i].id != clip.targets[i].id)
      return fail("", frame + " has intruder " + std::to_string(targets[i].id) + " where the frames before it have " +
                          std::to_string(clip.targets[i].id));
  return {};
}

}  // namespace

TargetFrame target_frame_of(const IntruderTruth& truth) {
  TargetFrame frame{.amodal_box = truth.amodal_box,
                    .visible_fraction = truth.visible_fraction,
                    .visible_pixels = truth.visible_pixels,
                    .distance_m = glm::length(truth.position_m),
                    .horizon = truth.horizon};
  if (truth.visible_box) frame.visible = box_of(*truth.visible_box);
  return frame;
}

Box box_of(const cv::Rect& pixels) {
  return {pixels.x - 0.5, pixels.y - 0.5, double(pixels.width), double(pixels.height)};
}

Result<void> add_frame(ClipTruth& clip, int index, double time_s, const std::vector<TargetInFrame>& targets) {
  const int next = clip.footage.first_frame + clip.frames();
  if (index != next)
    return fail("", "frame " + std::to_string(index) + " stands where frame " + std::to_string(next) + " belongs");
  const Result<void> known = clip.frames() == 0 ? add_targets(clip, targets) : check_targets(clip, index, targets);
  if (!known) return fail(known.error());
  clip.times_s.push_back(time_s);
  for (std::size_t i = 0; i < targets.size(); ++i) clip.targets[i].frames.push_back(targets[i].frame);
  return {};
}

Result<void> add_frame(ClipTruth& clip, const FrameTruth& truth) {
  std::vector<TargetInFrame> targets;
  targets.reserve(truth.intruders.size());
  for (const IntruderTruth& intruder : truth.intruders)
    targets.push_back({.id = intruder.id, .name = intruder.name, .frame = target_frame_of(intruder)});
  return add_frame(clip, truth.index, truth.time_s, targets);
}

}  // namespace sigs
