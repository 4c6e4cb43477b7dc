// SPDX-License-Identifier: MIT
#include "performance/observations.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/statistics.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// The best box on a target, whatever its score.
struct BestBox {
  const ReportedBox* box = nullptr;
  double overlap = 0;
};

BestBox best_box(const DetectedClip& clip, int number, const TargetFrame& truth, const DetectionPolicy& policy) {
  BestBox best;
  const auto found = clip.results.frames.find(number);
  if (found == clip.results.frames.end() || !truth.visible) return best;
  for (const ReportedBox& box : found->second) {
    const double overlap = extended_overlap(*truth.visible, box.box, policy.min_area_px2);
    const bool counts = box.score >= policy.min_score;
    const bool best_counts = best.box && best.box->score >= policy.min_score;
    if (overlap > 0 && (!best.box || counts > best_counts || (counts == best_counts && overlap > best.overlap)))
      best = {&box, overlap};
  }
  return best;
}

// In which frames m of the last n have a track in common. Boxes without a track are one.
std::vector<bool> declared_frames(const std::vector<std::set<int>>& tracks, const PerformancePolicy& policy) {
  std::vector<bool> declared(tracks.size());
  std::map<int, int> counts;
  const auto window = static_cast<std::size_t>(policy.declare_window);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (const int track : tracks[i]) ++counts[track];
    if (i >= window)
      for (const int track : tracks[i - window]) --counts[track];
    declared[i] = std::ranges::any_of(counts, [&](const auto& count) { return count.second >= policy.declare_hits; });
  }
  return declared;
}

// Part of a box within the image.
double share_inside(const Box& box, cv::Size size_px) {
  const double width = std::min(box.x + box.width, size_px.width - 0.5) - std::max(box.x, -0.5);
  const double height = std::min(box.y + box.height, size_px.height - 0.5) - std::max(box.y, -0.5);
  const double area = box.width * box.height;
  return area > 0 ? std::max(0.0, width) * std::max(0.0, height) / area : 1;
}

DropOutCause cause_of(const PerformanceClip& clip, const TargetFrame& truth, const TargetFrame& before, int number,
                      const DetectionPolicy& policy) {
  if (truth.amodal_box && share_inside(*truth.amodal_box, clip.detected.truth.footage.size_px) < 0.5)
    return DropOutCause::left_image;
  if (truth.cloud_hidden > 0.5) return DropOutCause::clouds;
  if (!truth.visible) return truth.amodal_box ? DropOutCause::hidden : DropOutCause::left_image;
  if (truth.visible_fraction < 0.5) return DropOutCause::hidden;
  const BestBox best = best_box(clip.detected, number, truth, policy);
  if (best.box && !exceeds(policy.match_overlap, best.overlap)) return DropOutCause::score;
  if (best.box && !exceeds(policy.false_overlap, best.overlap)) return DropOutCause::box;
  if (before.horizon == HorizonSide::above && (truth.horizon == HorizonSide::on || truth.horizon == HorizonSide::below))
    return DropOutCause::crossed_horizon;
  if (std::max(truth.visible->width, truth.visible->height) < 8) return DropOutCause::small;
  if (truth.rms_contrast && *truth.rms_contrast < 0.1) return DropOutCause::low_contrast;
  return DropOutCause::other;
}

// From the first match on.
std::vector<DropOut> drop_outs_of(const PerformanceClip& clip, const TargetTruth& target,
                                  const std::vector<std::set<int>>& tracks, double rate_hz,
                                  const DetectionPolicy& policy) {
  std::vector<DropOut> found;
  const auto frames = static_cast<int>(tracks.size());
  int last_match = -1;
  const auto add = [&](int end, bool is_last) {
    if (last_match < 0 || end - last_match < 2) return;
    const auto at = static_cast<std::size_t>(last_match);
    found.push_back({.length_s = (end - last_match - 1) / rate_hz,
                     .cause = cause_of(clip, target.frames[at + 1], target.frames[at],
                                       clip.detected.truth.footage.first_frame + last_match + 1, policy),
                     .is_last = is_last});
  };
  for (int i = 0; i < frames; ++i) {
    if (tracks[static_cast<std::size_t>(i)].empty()) continue;
    add(i, false);
    last_match = i;
  }
  add(frames, true);
  return found;
}

void set_errors(SeenFrame& seen, const PerformanceClip& clip, const TargetFrame& truth, const ReportedBox& reported) {
  if (reported.distance_m) seen.range_error = *reported.distance_m / truth.distance_m - 1;
  if (!truth.position_m || !clip.ray_of_pixel) return;
  const Box& box = reported.box;
  const std::optional<glm::dvec3> ray = clip.ray_of_pixel(box.x + box.width / 2, box.y + box.height / 2);
  if (!ray) return;
  const glm::dvec2 found = angles_of(*ray), is = angles_of(*truth.position_m);
  seen.angle_error_rad = glm::dvec2(std::remainder(found.x - is.x, 2 * std::numbers::pi), found.y - is.y);
}

// Time and distance of a straight flight's nearest point from a place with this relative velocity, else NaN.
double time_to_nearest_s(const glm::dvec3& offset_m, const glm::dvec3& velocity_mps) {
  const double square = glm::dot(velocity_mps, velocity_mps);
  return square > 1e-12 ? -glm::dot(offset_m, velocity_mps) / square : kNoValue;
}

// When the range is least: within the clip or, if it still falls at the end, on straight flight after it.
double nearest_time_s(const ClipTruth& clip, const TargetTruth& target) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < target.frames.size(); ++i)
    if (std::isfinite(target.frames[i].distance_m) &&
        (!least || target.frames[i].distance_m < target.frames[*least].distance_m))
      least = i;
  if (!least) return kNoValue;
  const std::size_t last = target.frames.size() - 1;
  if (*least < last) return clip.times_s[*least];
  const std::size_t before = last >= 5 ? last - 5 : 0;
  const double step_s = clip.times_s[last] - clip.times_s[before];
  const TargetFrame& end = target.frames[last];
  const TargetFrame& start = target.frames[before];
  if (!(step_s > 0) || !end.offset_m || !start.offset_m) return kNoValue;
  // Against the camera's own platform: both fly on as in the last frames.
  const glm::dvec3 velocity_mps = (*end.offset_m - *start.offset_m) / step_s;
  return clip.times_s[last] + std::max(0.0, time_to_nearest_s(*end.offset_m, velocity_mps));
}

// The range at a time, linear between frames; that of the last frame after it.
double range_at(const ClipTruth& clip, const TargetTruth& target, double time_s) {
  const auto next = std::ranges::lower_bound(clip.times_s, time_s);
  if (next == clip.times_s.end()) return target.frames.back().distance_m;
  const auto i = static_cast<std::size_t>(next - clip.times_s.begin());
  if (i == 0 || *next == time_s) return target.frames[i].distance_m;
  const double part = (time_s - clip.times_s[i - 1]) / (*next - clip.times_s[i - 1]);
  return target.frames[i - 1].distance_m + part * (target.frames[i].distance_m - target.frames[i - 1].distance_m);
}

double closing_speed_of(const ClipTruth& clip, const TargetTruth& target) {
  double last_s = nearest_time_s(clip, target);
  if (std::isnan(last_s)) last_s = clip.times_s.back();
  std::optional<std::size_t> first, last;
  for (std::size_t i = 0; i < target.frames.size() && clip.times_s[i] <= last_s; ++i) {
    if (!target.frames[i].visible) continue;
    if (!first) first = i;
    last = i;
  }
  if (!first || clip.times_s[*last] <= clip.times_s[*first]) return kNoValue;
  return (target.frames[*first].distance_m - target.frames[*last].distance_m) /
         (clip.times_s[*last] - clip.times_s[*first]);
}

ObservedEncounter encounter_of(const PerformanceClip& clip, std::size_t index, const std::vector<std::set<int>>& tracks,
                               const PerformancePolicy& policy) {
  const ClipTruth& truth = clip.detected.truth;
  const TargetTruth& target = truth.targets[index];
  ObservedEncounter encounter{.clip = clip.detected.name,
                              .target = target.id,
                              .name = target.name,
                              .tags = clip.tags,
                              .frames = {},
                              .drop_outs = drop_outs_of(clip, target, tracks, rate_hz_of(truth), policy.matching),
                              .closing_speed_mps = closing_speed_of(truth, target)};
  if (const auto kind = clip.kinds.find(target.id); kind != clip.kinds.end()) encounter.tags["kind"] = kind->second;
  const std::vector<bool> declared = declared_frames(tracks, policy);
  for (std::size_t i = 0; i < target.frames.size(); ++i) {
    const TargetFrame& frame = target.frames[i];
    if (declared[i] && !encounter.declared) {
      const double time_s = truth.times_s[i] + policy.latency_s;
      encounter.declared = {.time_s = time_s,
                            .range_m = range_at(truth, target, time_s),
                            .time_left_s = nearest_time_s(truth, target) - time_s};
    }
    if (!frame.visible) continue;
    const int number = truth.footage.first_frame + static_cast<int>(i);
    SeenFrame seen{.frame = number,
                   .time_s = truth.times_s[i],
                   .range_m = frame.distance_m,
                   .is_detected = !tracks[i].empty(),
                   .is_declared = encounter.declared.has_value(),
                   .horizon = frame.horizon,
                   .aspect_rad = frame.aspect_rad.value_or(kNoValue),
                   .size_px = std::max(frame.visible->width, frame.visible->height),
                   .contrast = frame.rms_contrast.value_or(kNoValue),
                   .visible_fraction = frame.visible_fraction};
    if (seen.is_detected) {
      if (!encounter.latency_s)
        encounter.latency_s = seen.time_s - (encounter.frames.empty() ? seen.time_s : encounter.frames.front().time_s);
      if (const BestBox best = best_box(clip.detected, number, frame, policy.matching); best.box)
        set_errors(seen, clip, frame, *best.box);
    }
    encounter.frames.push_back(seen);
  }
  if (encounter.declared && !encounter.frames.empty()) {
    const auto first =
        static_cast<std::size_t>(std::min<std::ptrdiff_t>(policy.declare_hits, std::ssize(encounter.frames)));
    encounter.is_declared_at_once = encounter.frames[first - 1].is_declared;
  }
  return encounter;
}

// --- False tracks. A box without a track continues the one of the last frames that it overlaps.

struct FalseChain {
  Box box;
  std::vector<int> frames;
};

bool is_declared_chain(const std::vector<int>& frames, const PerformancePolicy& policy) {
  const auto hits = static_cast<std::size_t>(policy.declare_hits);
  for (std::size_t i = hits - 1; i < frames.size(); ++i)
    if (frames[i] - frames[i + 1 - hits] < policy.declare_window) return true;
  return false;
}

void add_false_tracks(FalseTracks& sum, const DetectedClip& clip, const ClipMatches& matches,
                      const PerformancePolicy& policy) {
  std::map<int, std::vector<int>> tracks;
  std::vector<FalseChain> chains;
  for (const auto& [frame, box] : matches.false_reports) {
    if (box.track != kNoTrack) {
      tracks[box.track].push_back(frame);
      continue;
    }
    const auto near = std::ranges::find_if(chains, [&, frame = frame, &box = box](const FalseChain& chain) {
      return frame > chain.frames.back() && frame - chain.frames.back() < policy.declare_window &&
             !exceeds(policy.matching.match_overlap,
                      extended_overlap(chain.box, box.box, policy.matching.min_area_px2));
    });
    FalseChain& chain = near != chains.end() ? *near : chains.emplace_back();
    chain.box = box.box;
    chain.frames.push_back(frame);
  }
  sum.boxes += matches.false_boxes;
  for (const auto& [track, frames] : tracks) sum.declared += is_declared_chain(frames, policy);
  for (const FalseChain& chain : chains) sum.declared += is_declared_chain(chain.frames, policy);
  sum.hours += clip.truth.frames() / rate_hz_of(clip.truth) / 3600;
  ++sum.clips;
}

Result<void> check_clip(const ClipTruth& truth, const std::string& name) {
  if (!truth.has_times) return fail(name, "the truth has no frame rate, which performance needs; --rate states one");
  if (!truth.has_ids)
    return fail(name, "the truth does not say which boxes are of one object, which performance needs");
  for (const TargetTruth& target : truth.targets)
    for (const TargetFrame& frame : target.frames)
      if (frame.visible && !(frame.distance_m > 0 && std::isfinite(frame.distance_m)))
        return fail(name, "the truth has no range of intruder " + std::to_string(target.id) +
                              " in some frames, which performance by range needs");
  return {};
}

}  // namespace

const char* name_of(DropOutCause cause) {
  constexpr std::array<const char*, kDropOutCauses> kNames{"left the image",
                                                           "behind clouds",
                                                           "hidden",
                                                           "score too low",
                                                           "box off",
                                                           "crossed the horizon",
                                                           "small (below 8 px)",
                                                           "low contrast (below 0.1)",
                                                           "none of these"};
  return kNames.at(static_cast<std::size_t>(cause));
}

glm::dvec2 angles_of(const glm::dvec3& in_camera) {
  return {std::atan2(in_camera.y, in_camera.x), std::atan2(-in_camera.z, std::hypot(in_camera.x, in_camera.y))};
}

Result<Observations> observations_of(const std::string& detector, const std::vector<PerformanceClip>& clips,
                                     const PerformancePolicy& policy) {
  Observations observations{.detector = detector, .encounters = {}, .all = {}, .empty = {}};
  std::vector<double> rates;
  for (const PerformanceClip& clip : clips) {
    const ClipTruth& truth = clip.detected.truth;
    if (const Result<void> good = check_clip(truth, clip.detected.name); !good) return fail(good.error());
    const ClipMatches matches = matches_of(clip.detected, policy.matching);
    bool is_empty = true;
    for (std::size_t i = 0; i < truth.targets.size(); ++i) {
      ObservedEncounter encounter = encounter_of(clip, i, matches.tracks[i], policy);
      if (encounter.frames.empty()) continue;
      is_empty = false;
      observations.encounters.push_back(std::move(encounter));
    }
    add_false_tracks(observations.all, clip.detected, matches, policy);
    if (is_empty) add_false_tracks(observations.empty, clip.detected, matches, policy);
    for (const auto& [frame, boxes] : clip.detected.results.frames)
      for (const ReportedBox& box : boxes) observations.has_tracks |= box.track != kNoTrack;
    rates.push_back(rate_hz_of(truth));
  }
  observations.rate_hz = median(rates);
  return observations;
}

}  // namespace sigs
