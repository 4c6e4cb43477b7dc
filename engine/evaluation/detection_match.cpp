// SPDX-License-Identifier: MIT
#include "evaluation/detection_match.h"

#include <algorithm>
#include <cmath>

#include "evaluation/overlap.h"

namespace sigs {

namespace {

Box enlarged_to(const Box& box, double area_px2) {
  const double area = box.width * box.height;
  if (area >= area_px2) return box;
  const double side = std::sqrt(area_px2);
  const double scale = area > 0 ? std::sqrt(area_px2 / area) : 0;
  const double width = area > 0 ? box.width * scale : side;
  const double height = area > 0 ? box.height * scale : side;
  return {box.x + (box.width - width) / 2, box.y + (box.height - height) / 2, width, height};
}

double overlap_with(const std::optional<Box>& truth, const Box& reported, const DetectionPolicy& policy) {
  return truth ? extended_overlap(*truth, reported, policy.min_area_px2) : 0;
}

// One report against all that is there. Adds what it matches; false: it is near nothing.
bool matches_or_is_near(const ClipTruth& truth, std::size_t frame, const ReportedBox& reported,
                        const DetectionPolicy& policy, ClipMatches& matches) {
  double nearest = 0;
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const TargetFrame& target = truth.targets[i].frames[frame];
    const double visible = overlap_with(target.visible, reported.box, policy);
    nearest = std::max({nearest, visible, overlap_with(target.amodal_box, reported.box, policy)});
    if (target.visible && !exceeds(policy.match_overlap, visible)) matches.tracks[i][frame].insert(reported.track);
  }
  return !exceeds(policy.false_overlap, nearest);
}

}  // namespace

double extended_overlap(const Box& truth, const Box& reported, double min_area_px2) {
  if (truth.width * truth.height >= min_area_px2) return overlap(truth, reported);
  return overlap(enlarged_to(truth, min_area_px2), enlarged_to(reported, min_area_px2));
}

ClipMatches matches_of(const DetectedClip& clip, const DetectionPolicy& policy) {
  const ClipTruth& truth = clip.truth;
  ClipMatches matches;
  matches.tracks.assign(truth.targets.size(), std::vector<std::set<int>>(truth.times_s.size()));
  for (const auto& [number, boxes] : clip.results.frames) {
    const int frame = number - truth.footage.first_frame;
    if (frame < 0 || frame >= truth.frames()) continue;
    for (const ReportedBox& reported : boxes) {
      if (reported.score < policy.min_score) continue;
      if (matches_or_is_near(truth, static_cast<std::size_t>(frame), reported, policy, matches)) continue;
      ++matches.false_boxes;
      if (reported.track == kNoTrack) {
        ++matches.untracked_false_boxes;
      } else {
        matches.false_tracks.insert(reported.track);
      }
    }
  }
  return matches;
}

}  // namespace sigs
