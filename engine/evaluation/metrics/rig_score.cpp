// SPDX-License-Identifier: MIT
#include "evaluation/metrics/rig_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/ensure.h"

namespace sigs {

namespace {

struct TimeSpan {
  double first_s = 0;
  double last_s = 0;
};

// Spans that do not touch, by rising time.
using TimeSpans = std::vector<TimeSpan>;

TimeSpans united(TimeSpans spans) {
  std::ranges::sort(spans, {}, &TimeSpan::first_s);
  TimeSpans apart;
  for (const TimeSpan& span : spans) {
    if (!apart.empty() && span.first_s <= apart.back().last_s)
      apart.back().last_s = std::max(apart.back().last_s, span.last_s);
    else
      apart.push_back(span);
  }
  return apart;
}

double length_within_s(const TimeSpans& spans, double from_s, double to_s) {
  double length_s = 0;
  for (const TimeSpan& span : spans)
    length_s += std::max(0.0, std::min(span.last_s, to_s) - std::max(span.first_s, from_s));
  return length_s;
}

constexpr double kForever_s = std::numeric_limits<double>::infinity();

// The time that a frame stands for.
TimeSpan span_of(const ClipTruth& clip, std::size_t frame) {
  const std::vector<double>& times_s = clip.times_s;
  const std::size_t last = times_s.size() - 1;
  const double before_s = frame > 0 ? times_s[frame] - times_s[frame - 1] : std::nan("");
  const double after_s = frame < last ? times_s[frame + 1] - times_s[frame] : std::nan("");
  const double alone_s = 1 / rate_hz_of(clip);  // of a single frame
  const double to_left_s = frame > 0 ? before_s : frame < last ? after_s : alone_s;
  const double to_right_s = frame < last ? after_s : to_left_s;
  return {times_s[frame] - to_left_s / 2, times_s[frame] + to_right_s / 2};
}

RigDetection detection_at(const RigTarget& target, std::size_t camera, double time_s) {
  const glm::dvec3 p_in_body = place_at(target, time_s);
  return {.camera = camera,
          .time_s = time_s,
          .range_m = glm::length(p_in_body),
          .bearing_rad = std::atan2(p_in_body.y, p_in_body.x),
          .elevation_rad = std::atan2(-p_in_body.z, std::hypot(p_in_body.x, p_in_body.y))};
}

// What cameras show and detect of one intruder.
struct SeenAndDetected {
  TimeSpans seen;
  TimeSpans detected;
  std::vector<double> seen_at_s;
  std::vector<std::pair<double, std::size_t>> detected_at;  // time and camera

  void add(const SeenAndDetected& other) {
    seen.insert(seen.end(), other.seen.begin(), other.seen.end());
    detected.insert(detected.end(), other.detected.begin(), other.detected.end());
    seen_at_s.insert(seen_at_s.end(), other.seen_at_s.begin(), other.seen_at_s.end());
    detected_at.insert(detected_at.end(), other.detected_at.begin(), other.detected_at.end());
  }
  void unite() {
    seen = united(std::move(seen));
    detected = united(std::move(detected));
    std::ranges::sort(seen_at_s);
    std::ranges::sort(detected_at);
  }
};

SeenAndDetected seen_by_camera(const ClipTruth& clip, const TargetTruth& target,
                               const std::vector<std::set<int>>& tracks, std::size_t camera) {
  SeenAndDetected sum;
  for (std::size_t frame = 0; frame < clip.times_s.size(); ++frame) {
    if (!target.frames[frame].visible) continue;
    sum.seen.push_back(span_of(clip, frame));
    sum.seen_at_s.push_back(clip.times_s[frame]);
    if (tracks[frame].empty()) continue;
    sum.detected.push_back(sum.seen.back());
    sum.detected_at.emplace_back(clip.times_s[frame], camera);
  }
  sum.unite();
  return sum;
}

RigShare share_of(const RigTarget& target, const SeenAndDetected& sum) {
  RigShare share{.seen_s = length_within_s(sum.seen, -kForever_s, kForever_s),
                 .detected_s = length_within_s(sum.detected, -kForever_s, kForever_s)};
  if (!sum.seen_at_s.empty()) share.first_seen_s = sum.seen_at_s.front();
  if (!sum.detected_at.empty())
    share.first = detection_at(target, sum.detected_at.front().second, sum.detected_at.front().first);
  return share;
}

RigHandoverScore score_of(const RigTarget& target, const RigHandover& handover, const SeenAndDetected& any) {
  constexpr double kRounding_s = 1e-5;  // times in files have six digits
  RigHandoverScore score{.truth = handover};
  double from_s = -kForever_s;
  double to_s = kForever_s;
  for (const auto& [time_s, camera] : any.detected_at) {
    if (time_s > handover.time_s + kRounding_s) {
      score.first_after = detection_at(target, camera, time_s);
      to_s = time_s;
      break;
    }
    // Of equal times the first camera.
    if (!score.last_before || time_s > score.last_before->time_s)
      score.last_before = detection_at(target, camera, time_s);
    from_s = time_s;
  }
  // What is detected lies within what is seen.
  const double lost_s = length_within_s(any.seen, from_s, to_s) - length_within_s(any.detected, from_s, to_s);
  score.loss_s = lost_s > kRounding_s ? lost_s : 0;
  return score;
}

}  // namespace

double RigShare::share() const {
  return seen_s > 0 ? detected_s / seen_s : std::numeric_limits<double>::quiet_NaN();
}

RigScore score_rig(const std::string& name, const RigClip& rig, const std::vector<DetectedClip>& clips,
                   const DetectionPolicy& policy) {
  ENSURE(clips.size() == rig.cameras.size());
  RigScore score{.name = name};
  std::vector<ClipMatches> matches;
  for (const DetectedClip& clip : clips) {
    matches.push_back(matches_of(clip, policy));
    score.false_alarm_boxes.push_back(matches.back().false_boxes);
  }
  for (const RigTarget& target : rig.targets) {
    RigTargetScore of_target{.target = target.id, .name = target.name};
    SeenAndDetected any;
    bool is_target = false;
    for (std::size_t k = 0; k < clips.size(); ++k) {
      const std::vector<TargetTruth>& of_camera = clips[k].truth.targets;
      const auto found = std::ranges::find(of_camera, target.id, &TargetTruth::id);
      SeenAndDetected seen;
      if (found != of_camera.end()) {
        is_target = true;
        seen = seen_by_camera(clips[k].truth, *found, matches[k].tracks[found - of_camera.begin()], k);
      }
      of_target.cameras.push_back(share_of(target, seen));
      any.add(seen);
    }
    if (!is_target) continue;
    any.unite();
    of_target.any = share_of(target, any);
    for (const RigHandover& handover : target.handovers) of_target.handovers.push_back(score_of(target, handover, any));
    score.targets.push_back(std::move(of_target));
  }
  return score;
}

}  // namespace sigs
