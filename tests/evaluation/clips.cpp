// SPDX-License-Identifier: MIT
#include "evaluation/clips.h"

#include <cmath>

namespace sigs::test {

ClipTruth clip_of(int frames, double rate_hz, const std::function<TargetFrame(int)>& target, int first_frame) {
  ClipTruth clip{.footage = {.video = "clip.mp4",
                             .size_px = {1280, 960},
                             .first_frame = first_frame,
                             .last_frame = first_frame + frames - 1,
                             .frame_rate_num = static_cast<int>(std::lround(rate_hz * 1000)),
                             .frame_rate_den = 1000}};
  for (int i = 0; i < frames; ++i) clip.times_s.push_back((first_frame + i) / rate_hz);
  add_target(clip, target);
  return clip;
}

void add_target(ClipTruth& clip, const std::function<TargetFrame(int)>& target) {
  TargetTruth truth{.id = static_cast<int>(clip.targets.size()), .name = "glider"};
  for (int i = 0; i < clip.frames(); ++i) truth.frames.push_back(target(i));
  clip.targets.push_back(std::move(truth));
}

TargetFrame visible_at(const Box& box, double distance_m) {
  return {.visible = box, .amodal_box = box, .visible_fraction = 1, .distance_m = distance_m};
}

void report(Results& results, int frame, const Box& box, int track, double score) {
  results.frames[frame].push_back({.box = box, .score = score, .track = track});
}

Box moved(const Box& box, double dx, double dy) {
  return {box.x + dx, box.y + dy, box.width, box.height};
}

FootageTruth three_frames() {
  return {.video = "clip.mp4", .size_px = {1280, 960}, .first_frame = 100, .last_frame = 102};
}

}  // namespace sigs::test
