// SPDX-License-Identifier: MIT
#include "evaluation/metrics/track_score.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "evaluation/clips.h"
#include "evaluation/reports/report.h"
#include "evaluation/reports/report_files.h"

namespace sigs::test {
namespace {

const Box kFollowed{99.5, 49.5, 20, 10};

// A clip of `frames` frames in which the first tracker is `dx` px beside the truth and the second reports every other
// frame, exactly.
TrackSetClip scored_clip(const std::string& name, int frames, double dx, double distance_m) {
  const ClipTruth clip = clip_of(frames, 10, [&](int) { return visible_at(kFollowed, distance_m); });
  Results beside{.name = "beside"};
  Results exact{.name = "exact"};
  for (int i = 0; i < frames; ++i) {
    report(beside, i, moved(kFollowed, dx, 0));
    if (i % 2 == 0) report(exact, i, kFollowed);
  }
  TrackSetClip scored{.name = name, .target = "intruder 0", .truth = clip.targets[0].frames};
  for (const Results& results : {beside, exact})
    scored.scores.push_back(score_track(clip, clip.targets[0], results, {}));
  return scored;
}

// 10 frames 4 px beside, 30 frames 12 px beside, 20 frames 25 px beside (no overlap).
TrackSetReport three_clips() {
  TrackSetReport report{
      .trackers = {"beside", "exact"},
      .clips = {scored_clip("a", 10, 4, 50), scored_clip("b", 30, 12, 200), scored_clip("c", 20, 25, 200)}};
  complete(report);
  return report;
}

// Boxes of the same size, dx px apart: (20 - dx) of 20 + dx columns in common.
double overlap_at(double dx) {
  return dx < 20 ? (20 - dx) / (20 + dx) : 0;
}

// Thresholds 0, 0.05, ... 1 that an overlap exceeds, of 21.
double auc_of(double overlap) {
  int exceeded = 0;
  for (int i = 0; i <= 20; ++i) exceeded += overlap > i / 20.0 + 1e-9;
  return exceeded / 21.0;
}

}  // namespace

TEST_CASE("over frames each frame counts alike, over clips each clip") {
  const TrackSetReport report = three_clips();
  REQUIRE(report.figures.size() == 2);
  const TrackSetFigures& beside = report.figures[0];
  CHECK(beside.over_frames.scored == 60);
  CHECK(beside.over_frames.mean_center_error_px == doctest::Approx((10 * 4 + 30 * 12 + 20 * 25) / 60.0));
  CHECK(beside.clips_center_error_px == doctest::Approx((4 + 12 + 25) / 3.0));
  CHECK(beside.over_frames.precision_at_20 == doctest::Approx(40 / 60.0));
  CHECK(beside.clips_precision_at_20 == doctest::Approx(2 / 3.0));
  const double aucs[] = {auc_of(overlap_at(4)), auc_of(overlap_at(12)), auc_of(0)};
  CHECK(beside.over_frames.success_auc == doctest::Approx((10 * aucs[0] + 30 * aucs[1] + 20 * aucs[2]) / 60));
  CHECK(beside.clips_success_auc == doctest::Approx((aucs[0] + aucs[1] + aucs[2]) / 3));
  CHECK(beside.clips_mean_overlap == doctest::Approx((overlap_at(4) + overlap_at(12)) / 3));
  CHECK(beside.over_frames.lost == 20);
  CHECK(beside.clips_lost_share == doctest::Approx(1 / 3.0));
  // The 4 ways to draw three clips that are all the same one are rarer than 2.5 % each side: 1 of 27 is 3.7 %.
  CHECK(beside.clips_success.low == doctest::Approx(aucs[2]));
  CHECK(beside.clips_success.high == doctest::Approx(aucs[0]));
  const TrackSetFigures& exact = report.figures[1];
  CHECK(exact.over_frames.reported == 30);
  CHECK(exact.over_frames.mean_overlap == doctest::Approx(0.5));
  CHECK(exact.frames_success.low == doctest::Approx(exact.frames_success.high));  // alike in every clip
}

TEST_CASE("slices of tracks have the mean overlap of their frames") {
  const TrackSetReport report = three_clips();
  std::map<std::string, TrackSlice> slices;
  for (const TrackSlice& slice : report.slices[0]) slices[slice.by + "/" + slice.name] = slice;
  CHECK(slices["all/any"].frames == 60);
  CHECK(slices["all/any"].mean_overlap == doctest::Approx((10 * overlap_at(4) + 30 * overlap_at(12)) / 60));
  CHECK(slices["range/below 100 m"].frames == 10);
  CHECK(slices["range/below 100 m"].mean_overlap == doctest::Approx(overlap_at(4)));
  CHECK(slices["range/100 to 300 m"].frames == 50);
  CHECK(slices["range/100 to 300 m"].interval.low == doctest::Approx(0));
  CHECK(slices["size/16 to 32 px"].frames == 60);
  CHECK(slices["size/from 64 px"].frames == 0);
  CHECK(std::isnan(slices["size/from 64 px"].mean_overlap));
}

TEST_CASE("the report of many clips has them all, in rows and in JSON") {
  const TrackSetReport report = three_clips();
  const nlohmann::json json = nlohmann::json::parse(evaluation_json(report));
  CHECK(json["kind"] == "track_set");
  CHECK(json["clips"].size() == 3);
  CHECK(json["trackers"][0]["over_clips"]["success_auc"].get<double>() ==
        doctest::Approx(report.figures[0].clips_success_auc));
  CHECK(json["trackers"][0]["frames_by"]["range"].size() == 2);
  const std::string rows = clips_csv(report);
  CHECK(std::count(rows.begin(), rows.end(), '\n') == 1 + 3 * 2);
  CHECK(summary_csv(report).find("\nexact,3,60,30,30,0,") != std::string::npos);
  CHECK(table_text(report).find("exact ") != std::string::npos);
  CHECK(intervals_text(report).find("exact less beside: ") != std::string::npos);
  CHECK(slices_text(report).find("100 to 300 m") != std::string::npos);
}

}  // namespace sigs::test
