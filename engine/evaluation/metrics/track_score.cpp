// SPDX-License-Identifier: MIT
#include "evaluation/metrics/track_score.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/ensure.h"
#include "base/statistics.h"

namespace sigs {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::optional<Box>& true_box(const TargetFrame& truth, const TrackPolicy& policy) {
  return policy.truth == TruthBox::visible ? truth.visible : truth.amodal_box;
}

// Whether the target can be followed: some of it must be visible.
bool is_trackable(const TargetFrame& truth, const TrackPolicy& policy) {
  return truth.visible.has_value() && true_box(truth, policy).has_value();
}

bool is_counted(int frame, const TargetFrame& truth, const TrackPolicy& policy) {
  return frame >= policy.from_frame && is_trackable(truth, policy) &&
         truth.visible_fraction >= policy.min_visible_fraction;
}

// 0 for an error of 0, also of a box without width.
double share_of(double error, double size) {
  return error == 0 ? 0 : error / size;
}

void compare(FrameScore& score, const Box& truth, const Box& reported) {
  const double dx = (reported.x + reported.width / 2) - (truth.x + truth.width / 2);
  const double dy = (reported.y + reported.height / 2) - (truth.y + truth.height / 2);
  score.dx_px = dx;
  score.dy_px = dy;
  score.center_error_px = std::hypot(dx, dy);
  score.normalized_error = std::hypot(share_of(dx, truth.width), share_of(dy, truth.height));
  score.overlap = overlap(truth, reported);
}

FrameScore frame_score(int frame, double time_s, const TargetFrame& truth, const Results& results,
                       const TrackPolicy& policy) {
  FrameScore score{.frame = frame, .time_s = time_s, .truth = true_box(truth, policy), .distance_m = truth.distance_m};
  const ReportedBox* reported = results.best_at(frame);
  const std::optional<Box>& box = true_box(truth, policy);
  score.is_scored = is_counted(frame, truth, policy) && !results.initializations.contains(frame);
  score.is_reported = reported != nullptr;
  if (reported) score.reported = reported->box;
  if (box && reported) compare(score, *box, reported->box);
  score.is_lost = score.is_scored && !exceeds(score.overlap, 0);
  return score;
}

template <std::size_t kSteps, class Meets>
std::array<double, kSteps> curve_of(const TrackScore& score, Meets&& meets) {
  std::array<double, kSteps> curve{};
  for (std::size_t step = 0; step < kSteps; ++step) {
    const auto met = std::ranges::count_if(
        score.frames, [&](const FrameScore& frame) { return frame.is_scored && meets(frame, static_cast<int>(step)); });
    curve[step] = score.scored > 0 ? static_cast<double>(met) / score.scored : kNaN;
  }
  return curve;
}

void count_frames(TrackScore& score) {
  for (const FrameScore& frame : score.frames) {
    score.scored += frame.is_scored;
    score.reported += frame.is_scored && frame.is_reported;
    score.lost += frame.is_lost;
  }
}

void sum_errors(TrackScore& score) {
  std::vector<double> errors;
  std::vector<double> dx;
  std::vector<double> dy;
  std::vector<double> overlaps;
  for (const FrameScore& frame : score.frames) {
    if (!frame.is_scored) continue;
    overlaps.push_back(frame.overlap);
    if (!frame.is_reported) continue;
    errors.push_back(*frame.center_error_px);
    dx.push_back(*frame.dx_px);
    dy.push_back(*frame.dy_px);
  }
  score.mean_center_error_px = mean(errors);
  score.median_center_error_px = quantile(errors, 0.5);
  score.p95_center_error_px = quantile(errors, 0.95);
  score.mean_dx_px = mean(dx);
  score.mean_dy_px = mean(dy);
  score.mean_overlap = mean(overlaps);
}

void compute_curves(TrackScore& score) {
  score.precision = curve_of<kPrecisionSteps>(score, [](const FrameScore& frame, int step) {
    return frame.center_error_px && !exceeds(*frame.center_error_px, step);
  });
  score.precision_at_20 = score.precision[20];
  score.success = curve_of<kSuccessSteps>(score, [](const FrameScore& frame, int step) {
    constexpr int kLast = kSuccessSteps - 1;
    return step < kLast ? exceeds(frame.overlap, step / double(kLast)) : !exceeds(1, frame.overlap);
  });
  score.success_auc = mean(score.success);
  score.normalized_precision = curve_of<kNormalizedSteps>(score, [](const FrameScore& frame, int step) {
    return frame.normalized_error && !exceeds(*frame.normalized_error, step / 100.0);
  });
  score.normalized_precision_auc = mean(score.normalized_precision);
}

}  // namespace

TrackScore score_track(const ClipTruth& clip, const TargetTruth& target, const Results& results,
                       const TrackPolicy& policy) {
  ENSURE(target.frames.size() == clip.times_s.size());
  TrackScore score{.name = results.name, .frames_per_s = results.frames_per_s};
  score.frames.reserve(target.frames.size());
  for (std::size_t i = 0; i < target.frames.size(); ++i) {
    const int frame = clip.footage.first_frame + static_cast<int>(i);
    const TargetFrame& truth = target.frames[i];
    score.frames.push_back(frame_score(frame, clip.times_s[i], truth, results, policy));
    if (score.frames.back().is_reported && frame >= policy.from_frame && !is_trackable(truth, policy))
      ++score.reported_absent;
  }
  count_frames(score);
  sum_errors(score);
  compute_curves(score);
  return score;
}

std::optional<int> first_frame_to_track(const ClipTruth& clip, const TargetTruth& target, const TrackPolicy& policy,
                                        double min_side_px) {
  for (std::size_t i = 0; i < target.frames.size(); ++i) {
    const int frame = clip.footage.first_frame + static_cast<int>(i);
    const TargetFrame& truth = target.frames[i];
    if (!is_counted(frame, truth, policy)) continue;
    const Box& box = *true_box(truth, policy);
    if (std::min(box.width, box.height) >= min_side_px) return frame;
  }
  return std::nullopt;
}

std::optional<TrackPolicy> policy_from_start(const ClipTruth& clip, const TargetTruth& target, TrackPolicy policy,
                                             double min_side_px) {
  const std::optional<int> first = first_frame_to_track(clip, target, policy, min_side_px);
  if (!first) return std::nullopt;
  policy.from_frame = *first;
  return policy;
}

namespace {

// All frames of the clips, one behind the other; frames_per_s is of all frames by all time.
TrackScore pooled_score(const std::string& name, const std::vector<const TrackScore*>& clips) {
  TrackScore score{.name = name};
  double frames = 0;
  double time_s = 0;
  for (const TrackScore* const clip : clips) {
    score.frames.insert(score.frames.end(), clip->frames.begin(), clip->frames.end());
    score.reported_absent += clip->reported_absent;
    if (!clip->frames_per_s || !(*clip->frames_per_s > 0)) continue;
    frames += static_cast<double>(clip->frames.size());
    time_s += static_cast<double>(clip->frames.size()) / *clip->frames_per_s;
  }
  if (time_s > 0) score.frames_per_s = frames / time_s;
  count_frames(score);
  sum_errors(score);
  compute_curves(score);
  return score;
}

double mean_over_clips(const TrackSetReport& report, std::size_t tracker,
                       const std::function<double(const TrackScore&)>& figure) {
  double sum = 0;
  int clips = 0;
  for (const TrackSetClip& clip : report.clips) {
    const TrackScore& score = clip.scores[tracker];
    const double value = score.scored > 0 ? figure(score) : std::nan("");
    if (!std::isfinite(value)) continue;
    sum += value;
    ++clips;
  }
  return clips > 0 ? sum / clips : std::nan("");
}

TrackSetFigures figures_of(const TrackSetReport& report, std::size_t tracker) {
  std::vector<const TrackScore*> scores;
  for (const TrackSetClip& clip : report.clips) scores.push_back(&clip.scores[tracker]);
  const auto mean = [&](const std::function<double(const TrackScore&)>& figure) {
    return mean_over_clips(report, tracker, figure);
  };
  return {.over_frames = pooled_score(report.trackers[tracker], scores),
          .clips_center_error_px = mean([](const TrackScore& s) { return s.mean_center_error_px; }),
          .clips_precision_at_20 = mean([](const TrackScore& s) { return s.precision_at_20; }),
          .clips_success_auc = mean([](const TrackScore& s) { return s.success_auc; }),
          .clips_normalized_precision_auc = mean([](const TrackScore& s) { return s.normalized_precision_auc; }),
          .clips_mean_overlap = mean([](const TrackScore& s) { return s.mean_overlap; }),
          .clips_lost_share = mean([](const TrackScore& s) { return static_cast<double>(s.lost) / s.scored; }),
          .frames_success = share_interval(success_by_frames(report, tracker)),
          .clips_success = share_interval(success_by_clips(report, tracker))};
}

// Sum of overlaps and number of frames scored in the slice.
GroupShare overlaps_in(const TrackSetClip& clip, const TrackScore& score, const SliceRule& rule) {
  ENSURE(clip.truth.size() == score.frames.size());
  GroupShare share;
  for (std::size_t i = 0; i < score.frames.size(); ++i) {
    if (!score.frames[i].is_scored || !rule.has(clip.truth[i])) continue;
    share.whole += 1;
    share.part += score.frames[i].overlap;
  }
  return share;
}

TrackSlice track_slice(const TrackSetReport& report, std::size_t tracker, const SliceRule& rule) {
  std::vector<GroupShare> groups;
  GroupShare sum;
  for (const TrackSetClip& clip : report.clips) {
    const GroupShare share = overlaps_in(clip, clip.scores[tracker], rule);
    if (share.whole == 0) continue;
    groups.push_back(share);
    sum.part += share.part;
    sum.whole += share.whole;
  }
  return {.by = rule.by,
          .name = rule.name,
          .frames = static_cast<int>(sum.whole),
          .mean_overlap = sum.whole > 0 ? sum.part / sum.whole : std::nan(""),
          .interval = share_interval(groups)};
}

std::vector<GroupShare> success_of(const TrackSetReport& report, std::size_t tracker, bool by_frames) {
  std::vector<GroupShare> groups;
  for (const TrackSetClip& clip : report.clips) {
    const TrackScore& score = clip.scores[tracker];
    const double weight = by_frames ? score.scored : 1;
    groups.push_back(score.scored > 0 ? GroupShare{score.success_auc * weight, weight} : GroupShare{});
  }
  return groups;
}

}  // namespace

std::vector<GroupShare> success_by_frames(const TrackSetReport& report, std::size_t tracker) {
  return success_of(report, tracker, true);
}

std::vector<GroupShare> success_by_clips(const TrackSetReport& report, std::size_t tracker) {
  return success_of(report, tracker, false);
}

void complete(TrackSetReport& report) {
  const std::vector<SliceRule> rules = slice_rules();
  report.figures.clear();
  report.slices.clear();
  for (std::size_t tracker = 0; tracker < report.trackers.size(); ++tracker) {
    report.figures.push_back(figures_of(report, tracker));
    report.slices.emplace_back();
    for (const SliceRule& rule : rules) report.slices.back().push_back(track_slice(report, tracker, rule));
  }
}

}  // namespace sigs
