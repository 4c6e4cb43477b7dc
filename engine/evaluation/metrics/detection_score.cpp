// SPDX-License-Identifier: MIT
#include "evaluation/metrics/detection_score.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/ensure.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

// The frames of an encounter, counted from 0 in the clip, both included: one target is visible and in range in all of
// them except for short gaps.
struct EncounterSpan {
  int first = 0;
  int last = 0;
};

constexpr double kFrameRounding = 1e-3;  // times in files have six digits, so 3 s may be 29.99997 frames

const TargetFrame& frame_at(const TargetTruth& target, int frame) {
  return target.frames[static_cast<std::size_t>(frame)];
}

// Some of it is visible, within max_range_m.
bool is_seen_in_range(const TargetFrame& frame, const DetectionPolicy& policy) {
  return frame.visible && frame.distance_m <= policy.max_range_m;
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
    if (!is_seen_in_range(frame_at(target, frame), policy)) continue;
    ++in_range;
    for (const int track : tracks[static_cast<std::size_t>(frame)]) most = std::max(most, ++frames_of_track[track]);
  }
  return most > 0 && !exceeds(policy.min_window_share, double(most) / in_range);
}

// All encounters of a target, in order, of any duration and minimum range.
std::vector<EncounterSpan> encounters_of(const TargetTruth& target, double rate_hz, const DetectionPolicy& policy) {
  std::vector<EncounterSpan> found;
  const double max_gap_frames = policy.max_gap_s * rate_hz + kFrameRounding;
  for (int frame = 0; frame < static_cast<int>(target.frames.size()); ++frame) {
    if (!is_seen_in_range(frame_at(target, frame), policy)) continue;
    if (!found.empty() && frame - found.back().last - 1 <= max_gap_frames)
      found.back().last = frame;
    else
      found.push_back({frame, frame});
  }
  return found;
}

// The last frame of the first window in which one track matches the target in at least min_window_share of the frames
// in which the target is in range; boxes without a track together count as one. Windows have window_s, or the length
// of a shorter encounter, and lie within the encounter.
std::optional<int> confirmed_at(const EncounterSpan& encounter, const TargetTruth& target,
                                std::span<const std::set<int>> tracks, double rate_hz, const DetectionPolicy& policy) {
  const int window = window_frames(encounter, rate_hz, policy);
  for (int last = encounter.first + window - 1; last <= encounter.last; ++last)
    if (is_confirmed(target, tracks, last - window + 1, last, policy)) return last;
  return std::nullopt;
}

// The last frame at which a confirmation is in time: the one before the target first comes nearer than detect_range_m,
// but not before the end of the first window.
int deadline_of(const EncounterSpan& encounter, const TargetTruth& target, double rate_hz,
                const DetectionPolicy& policy) {
  int last_far = encounter.first - 1;
  while (last_far < encounter.last) {
    const TargetFrame& next = frame_at(target, last_far + 1);
    if (is_seen_in_range(next, policy) && next.distance_m < policy.detect_range_m) break;
    ++last_far;
  }
  return std::max(last_far, encounter.first + window_frames(encounter, rate_hz, policy) - 1);
}

// One target of one clip, with what matches it in each frame.
struct MatchedTarget {
  const DetectedClip& clip;
  const TargetTruth& target;
  std::span<const std::set<int>> tracks;
  double rate_hz = 0;
};

template <class Visit>
void for_frames_in_range(const MatchedTarget& matched_target, const EncounterSpan& encounter,
                         const DetectionPolicy& policy, Visit&& visit) {
  for (int frame = encounter.first; frame <= encounter.last; ++frame) {
    const TargetFrame& truth = matched_target.target.frames[static_cast<std::size_t>(frame)];
    if (is_seen_in_range(truth, policy)) visit(frame, truth);
  }
}

// Above or below in all its frames, else on. Unknown where it is so in any.
HorizonSide horizon_of(const MatchedTarget& matched_target, const EncounterSpan& encounter,
                       const DetectionPolicy& policy) {
  std::set<HorizonSide> sides;
  for_frames_in_range(matched_target, encounter, policy,
                      [&](int, const TargetFrame& truth) { sides.insert(truth.horizon); });
  if (sides.contains(HorizonSide::unknown)) return HorizonSide::unknown;
  return sides.size() == 1 ? *sides.begin() : HorizonSide::on;
}

EncounterScore score_of(const MatchedTarget& matched_target, const EncounterSpan& encounter,
                        const DetectionPolicy& policy) {
  const ClipTruth& clip = matched_target.clip.truth;
  const auto time_in_s = [&](int frame) {
    return clip.times_s[static_cast<std::size_t>(frame)] - clip.times_s[static_cast<std::size_t>(encounter.first)];
  };
  EncounterScore score{.clip = matched_target.clip.name,
                       .target = matched_target.target.id,
                       .first_frame = clip.footage.first_frame + encounter.first,
                       .last_frame = clip.footage.first_frame + encounter.last,
                       .horizon = horizon_of(matched_target, encounter, policy),
                       .min_range_m = std::numeric_limits<double>::infinity()};
  for_frames_in_range(matched_target, encounter, policy, [&](int frame, const TargetFrame& truth) {
    score.min_range_m = std::min(score.min_range_m, truth.distance_m);
    ++score.frames_visible;
    if (matched_target.tracks[static_cast<std::size_t>(frame)].empty()) return;
    if (score.frames_matched++ > 0) return;
    score.first_detection_range_m = truth.distance_m;
    score.first_detection_time_s = time_in_s(frame);
  });
  const std::optional<int> confirmed =
      confirmed_at(encounter, matched_target.target, matched_target.tracks, matched_target.rate_hz, policy);
  if (!confirmed) return score;
  score.confirmed_range_m = matched_target.target.frames[static_cast<std::size_t>(*confirmed)].distance_m;
  score.confirmed_time_s = time_in_s(*confirmed);
  score.is_detected = *confirmed <= deadline_of(encounter, matched_target.target, matched_target.rate_hz, policy);
  return score;
}

// In the order of HorizonSide.
constexpr std::array kRatesByHorizon{&DetectionScore::below_horizon, &DetectionScore::on_horizon,
                                     &DetectionScore::above_horizon, &DetectionScore::unknown_horizon};

void add_encounter(DetectionScore& sum, EncounterScore encounter, const DetectionPolicy& policy) {
  if (encounter.min_range_m > policy.max_closest_range_m) {
    ++sum.encounters_too_far;
    return;
  }
  for (const auto rate : {&DetectionScore::all, kRatesByHorizon.at(static_cast<std::size_t>(encounter.horizon))}) {
    ++(sum.*rate).encounters;
    (sum.*rate).detected += encounter.is_detected;
  }
  sum.encounters.push_back(std::move(encounter));
}

// (frame, target) pairs that a detector is asked for, and those it has.
struct Pairs {
  int all = 0;
  int matched = 0;
};

void add_clip(DetectionScore& sum, Pairs& pairs, const DetectedClip& clip, const DetectionPolicy& policy) {
  const double rate_hz = rate_hz_of(clip.truth);
  ENSURE(rate_hz > 0);
  const ClipMatches matches = matches_of(clip, policy);
  sum.frames += clip.truth.frames();
  sum.hours += clip.truth.has_times ? clip.truth.frames() / rate_hz / 3600 : std::numeric_limits<double>::quiet_NaN();
  sum.false_alarm_boxes += matches.false_boxes;
  sum.negative_scores_ignored += matches.negative_scores;
  sum.false_alarm_tracks += static_cast<int>(matches.false_tracks.size()) + matches.untracked_false_boxes;
  for (std::size_t i = 0; i < clip.truth.targets.size(); ++i) {
    const MatchedTarget matched_target{clip, clip.truth.targets[i], matches.tracks[i], rate_hz};
    const bool has_encounters = clip.truth.has_ids && clip.truth.has_times;
    const std::vector<EncounterSpan> encounters =
        has_encounters ? encounters_of(matched_target.target, rate_hz, policy) : std::vector<EncounterSpan>();
    for (const EncounterSpan& encounter : encounters) {
      if (length_of(encounter) >= policy.min_encounter_s * rate_hz - kFrameRounding)
        add_encounter(sum, score_of(matched_target, encounter, policy), policy);
      else
        ++sum.encounters_too_short;
    }
    for_frames_in_range(matched_target, {0, clip.truth.frames() - 1}, policy, [&](int frame, const TargetFrame&) {
      ++pairs.all;
      pairs.matched += !matched_target.tracks[static_cast<std::size_t>(frame)].empty();
    });
  }
}

double mean_first_range_m(const std::vector<EncounterScore>& encounters) {
  double sum_m = 0;
  int detected = 0;
  for (const EncounterScore& encounter : encounters) {
    sum_m += encounter.first_detection_range_m.value_or(0);
    detected += encounter.first_detection_range_m.has_value();
  }
  return ratio(sum_m, detected);
}

}  // namespace

std::vector<std::string> left_out_of(const std::vector<DetectedClip>& clips) {
  int objects = 0;
  int without_range = 0;
  int without_ids = 0;
  int without_times = 0;
  for (const DetectedClip& clip : clips) {
    without_ids += !clip.truth.has_ids;
    without_times += !clip.truth.has_times;
    for (const TargetTruth& target : clip.truth.targets) {
      const auto is_seen = [](const TargetFrame& frame) { return frame.visible.has_value(); };
      objects += std::ranges::any_of(target.frames, is_seen);
      without_range +=
          std::ranges::any_of(target.frames, is_seen) && std::ranges::none_of(target.frames, [&](const TargetFrame& f) {
            return is_seen(f) && std::isfinite(f.distance_m);
          });
    }
  }
  const auto of_clips = [&](int count) {
    return count == static_cast<int>(clips.size()) ? std::string("the truth")
                                                   : fmt::format("the truth of {} of {} clips", count, clips.size());
  };
  std::vector<std::string> sentences;
  if (without_range > 0 && without_range == objects)
    sentences.emplace_back("the truth has no ranges: EDR, AFDR and the range of first detection are left out");
  else if (without_range > 0)
    sentences.push_back(fmt::format(
        "the range of {} of {} objects is not known: EDR, AFDR and the range of first detection are of the others",
        without_range, objects));
  if (without_ids > 0)
    sentences.push_back(
        of_clips(without_ids) +
        " does not say which boxes are of one object: EDR and the range of first detection leave it out");
  if (without_times > 0)
    sentences.push_back(of_clips(without_times) +
                        " has no frame rate: EDR leaves it out, and HFAR is left out; --rate states one");
  return sentences;
}

double DetectionRate::rate() const {
  return ratio(detected, encounters);
}

DetectionScore score_detections(const std::string& name, const std::vector<DetectedClip>& clips,
                                const DetectionPolicy& policy) {
  DetectionScore score{.name = name};
  Pairs pairs;
  for (const DetectedClip& clip : clips) add_clip(score, pairs, clip, policy);
  score.false_alarms_per_hour = ratio(score.false_alarm_tracks, score.hours);
  score.false_boxes_per_frame = ratio(score.false_alarm_boxes, score.frames);
  score.frame_detection_rate = ratio(pairs.matched, pairs.all);
  score.mean_first_range_m = mean_first_range_m(score.encounters);
  return score;
}

double rate_hz_of(const ClipTruth& clip) {
  const double length_s = clip.frames() > 1 ? clip.times_s.back() - clip.times_s.front() : 0;
  if (length_s > 0 && std::isfinite(length_s)) return (clip.frames() - 1) / length_s;
  return rate_hz(clip.footage);
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
      if (reported.score < policy.min_score) {
        matches.negative_scores += reported.score < 0 ? 1 : 0;
        continue;
      }
      if (matches_or_is_near(truth, static_cast<std::size_t>(frame), reported, policy, matches)) continue;
      ++matches.false_boxes;
      matches.false_reports.emplace_back(frame, reported);
      if (reported.track == kNoTrack)
        ++matches.untracked_false_boxes;
      else
        matches.false_tracks.insert(reported.track);
    }
  }
  return matches;
}

}  // namespace sigs
