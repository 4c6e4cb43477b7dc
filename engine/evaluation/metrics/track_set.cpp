// SPDX-License-Identifier: MIT
#include "evaluation/metrics/track_set.h"

#include <cmath>
#include <functional>

#include "base/ensure.h"

namespace sigs {

namespace {

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
