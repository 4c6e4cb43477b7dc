// SPDX-License-Identifier: MIT
#include "evaluation/airborne_metrics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "evaluation/overlap.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

constexpr double kFrameRounding = 1e-3;  // times in files have six digits, so 3 s may be 29.99997 frames

const TargetFrame& frame_at(const TargetTruth& target, int frame) {
  return target.frames[static_cast<std::size_t>(frame)];
}

int length_of(const EncounterSpan& encounter) {
  return encounter.last - encounter.first + 1;
}

int window_frames(const EncounterSpan& encounter, double rate_hz, const DetectionPolicy& policy) {
  const double frames = std::clamp(std::round(policy.window_s * rate_hz), 1.0, double(length_of(encounter)));
  return static_cast<int>(frames);
}

bool is_confirmed(const TargetTruth& target, std::span<const std::set<int>> tracks, int first, int last,
                  const DetectionPolicy& policy) {
  std::map<int, int> frames_of_track;
  int in_range = 0;
  int most = 0;
  for (int frame = first; frame <= last; ++frame) {
    if (!is_in_range(frame_at(target, frame), policy)) continue;
    ++in_range;
    for (const int track : tracks[static_cast<std::size_t>(frame)]) most = std::max(most, ++frames_of_track[track]);
  }
  return most > 0 && !exceeds(policy.min_window_share, double(most) / in_range);
}

}  // namespace

double rate_hz_of(const ClipTruth& clip) {
  const double length_s = clip.frames() > 1 ? clip.times_s.back() - clip.times_s.front() : 0;
  if (length_s > 0 && std::isfinite(length_s)) return (clip.frames() - 1) / length_s;
  return rate_hz(clip.footage);
}

bool is_in_range(const TargetFrame& frame, const DetectionPolicy& policy) {
  return frame.visible && frame.distance_m <= policy.max_range_m;
}

std::vector<EncounterSpan> encounters_of(const TargetTruth& target, double rate_hz, const DetectionPolicy& policy) {
  std::vector<EncounterSpan> found;
  const double max_gap_frames = policy.max_gap_s * rate_hz + kFrameRounding;
  for (int frame = 0; frame < static_cast<int>(target.frames.size()); ++frame) {
    if (!is_in_range(frame_at(target, frame), policy)) continue;
    const bool continues = !found.empty() && frame - found.back().last - 1 <= max_gap_frames;
    if (continues) {
      found.back().last = frame;
    } else {
      found.push_back({frame, frame});
    }
  }
  return found;
}

bool is_long_enough(const EncounterSpan& encounter, double rate_hz, const DetectionPolicy& policy) {
  return length_of(encounter) >= policy.min_encounter_s * rate_hz - kFrameRounding;
}

std::optional<int> confirmed_at(const EncounterSpan& encounter, const TargetTruth& target,
                                std::span<const std::set<int>> tracks, double rate_hz, const DetectionPolicy& policy) {
  const int window = window_frames(encounter, rate_hz, policy);
  for (int last = encounter.first + window - 1; last <= encounter.last; ++last)
    if (is_confirmed(target, tracks, last - window + 1, last, policy)) return last;
  return std::nullopt;
}

int deadline_of(const EncounterSpan& encounter, const TargetTruth& target, double rate_hz,
                const DetectionPolicy& policy) {
  int last_far = encounter.first - 1;
  while (last_far < encounter.last) {
    const TargetFrame& next = frame_at(target, last_far + 1);
    if (is_in_range(next, policy) && next.distance_m < policy.detect_range_m) break;
    ++last_far;
  }
  return std::max(last_far, encounter.first + window_frames(encounter, rate_hz, policy) - 1);
}

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

// At least half of the report lies in a box that is ignored (COCO counts its crowd regions so), or it is near one.
bool is_near_ignored(const ClipTruth& truth, std::size_t frame, const Box& reported, const DetectionPolicy& policy) {
  if (truth.ignored.empty()) return false;
  return std::ranges::any_of(truth.ignored[frame], [&](const Box& box) {
    const double width = std::min(box.x + box.width, reported.x + reported.width) - std::max(box.x, reported.x);
    const double height = std::min(box.y + box.height, reported.y + reported.height) - std::max(box.y, reported.y);
    const double share = width > 0 && height > 0 ? width * height / (reported.width * reported.height) : 0;
    return share >= 0.5 || !exceeds(policy.false_overlap, extended_overlap(box, reported, policy.min_area_px2));
  });
}

// Compares one report with all targets and adds its matches. Returns false for a false alarm, near none of them.
bool matches_or_is_near(const ClipTruth& truth, std::size_t frame, const ReportedBox& reported,
                        const DetectionPolicy& policy, ClipMatches& matches) {
  double nearest = 0;
  for (std::size_t i = 0; i < truth.targets.size(); ++i) {
    const TargetFrame& target = truth.targets[i].frames[frame];
    const double visible = overlap_with(target.visible, reported.box, policy);
    nearest = std::max({nearest, visible, overlap_with(target.amodal_box, reported.box, policy)});
    if (target.visible && !exceeds(policy.match_overlap, visible)) matches.tracks[i][frame].insert(reported.track);
  }
  return !exceeds(policy.false_overlap, nearest) || is_near_ignored(truth, frame, reported.box, policy);
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
