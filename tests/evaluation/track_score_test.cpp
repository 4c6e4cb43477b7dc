// SPDX-License-Identifier: MIT
#include "evaluation/metrics/track_score.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "evaluation/clips.h"

namespace sigs::test {
namespace {

constexpr double kExact = 1e-9;  // well above the rounding of sums of a hundred doubles

const Box kTrueBox{299.5, 199.5, 40, 10};

ClipTruth still_clip(int frames = 100) {
  return clip_of(frames, 25, [](int) { return visible_at(kTrueBox); });
}

// The tracker reports the truth, shifted by (dx, dy) in frame i.
template <class Offset>
TrackScore score_moved(const ClipTruth& clip, Offset&& offset, const TrackPolicy& policy = {}) {
  Results results{.name = "some"};
  for (int i = 0; i < clip.frames(); ++i) {
    const auto [dx, dy] = offset(i);
    if (const auto& box = clip.targets[0].frames[static_cast<std::size_t>(i)].visible)
      report(results, clip.footage.first_frame + i, moved(*box, dx, dy));
  }
  return score_track(clip, clip.targets[0], results, policy);
}

bool near(double a, double b) {
  return std::abs(a - b) < kExact;
}

}  // namespace

TEST_CASE("a tracker off by (3, 4) has a centre error of 5 everywhere") {
  // Along a curve and over changing sizes: neither may matter.
  const ClipTruth clip = clip_of(300, 25, [](int i) {
    return visible_at({1000.3 + 300 * std::sin(i / 30.0), 400.7 + i, 20 + i / 7.0, 9 + i / 11.0});
  });
  const TrackScore score = score_moved(clip, [](int) { return std::pair(3.0, 4.0); });
  CHECK(score.scored == 300);
  CHECK(score.reported == 300);
  for (const FrameScore& frame : score.frames) {
    CHECK(near(*frame.center_error_px, 5));
    CHECK(near(*frame.dx_px, 3));
    CHECK(near(*frame.dy_px, 4));
  }
  for (const double error : {score.mean_center_error_px, score.median_center_error_px, score.p95_center_error_px})
    CHECK(near(error, 5));
  CHECK(near(score.mean_dx_px, 3));
  CHECK(near(score.mean_dy_px, 4));
  // Rounding in the last digits must not push a frame past the threshold it stands on.
  for (int step = 0; step < kPrecisionSteps; ++step)
    CHECK(score.precision[static_cast<std::size_t>(step)] == (step < 5 ? 0 : 1));
  CHECK(score.precision_at_20 == 1);
}

TEST_CASE("signs: right of the truth and below it are positive") {
  const TrackScore score = score_moved(still_clip(), [](int) { return std::pair(-7.25, 2.5); });
  CHECK(near(score.mean_dx_px, -7.25));
  CHECK(near(score.mean_dy_px, 2.5));
}

TEST_CASE("a perfect tracker has the best value of every measure") {
  const ClipTruth clip = clip_of(50, 25, [](int i) { return visible_at({0.1 * i, 0.3 * i, 7.7, 3.3}); });
  const TrackScore score = score_moved(clip, [](int) { return std::pair(0.0, 0.0); });
  for (const double share : score.precision) CHECK(share == 1);
  for (const double share : score.success) CHECK(share == 1);
  for (const double share : score.normalized_precision) CHECK(share == 1);
  CHECK(score.success_auc == 1);
  CHECK(score.normalized_precision_auc == 1);
  CHECK(score.lost == 0);
  CHECK(near(score.mean_overlap, 1));
  CHECK(score.mean_center_error_px == 0);
}

TEST_CASE("boxes of one size, shifted by s times their width, overlap by (1 - s) / (1 + s)") {
  for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 0.999, 1.0, 1.5}) {
    CAPTURE(share);
    const double expected = share >= 1 ? 0 : (1 - share) / (1 + share);
    const TrackScore score = score_moved(still_clip(), [&](int) { return std::pair(share * kTrueBox.width, 0.0); });
    CHECK(near(score.mean_overlap, expected));
    CHECK(score.lost == (share >= 1 ? 100 : 0));
    // Thresholds k / 20 that are less than the overlap, over 21.
    int passed = 0;
    for (int k = 0; k <= 20; ++k) passed += k < 20 ? k / 20.0 < expected - kExact : expected >= 1;
    CHECK(near(score.success_auc, passed / 21.0));
  }
}

TEST_CASE("an overlap of just one half is not more than one half") {
  // A third of the width: (1 - 1/3) / (1 + 1/3) = 1/2.
  const ClipTruth clip = clip_of(1, 25, [](int) { return visible_at({0.1, 0.7, 30, 30}); });
  const TrackScore score = score_moved(clip, [](int) { return std::pair(10.0, 0.0); });
  CHECK(score.success[9] == 1);
  CHECK(score.success[10] == 0);
}

TEST_CASE("an error that grows evenly gives a precision curve that does too") {
  // Frame i of 0 to 99 is off by i/2 px: at threshold t there are 2 t + 1 frames.
  const TrackScore score = score_moved(still_clip(), [](int i) { return std::pair(i / 2.0, 0.0); });
  for (int t = 0; t < kPrecisionSteps; ++t)
    CHECK(near(score.precision[static_cast<std::size_t>(t)], std::min(2 * t + 1, 100) / 100.0));
  CHECK(near(score.precision_at_20, 0.41));
  CHECK(near(score.mean_center_error_px, 24.75));
  CHECK(near(score.median_center_error_px, 24.75));
  CHECK(near(score.p95_center_error_px, 0.95 * 49.5));  // linear between neighbours
  // Normalised by a width of 40: threshold k/100 holds errors up to 0.4 k px.
  for (int k = 0; k < kNormalizedSteps; ++k)
    CHECK(near(score.normalized_precision[static_cast<std::size_t>(k)], (4 * k / 5 + 1) / 100.0));
}

TEST_CASE("normalised errors are shares of the true width and height") {
  const TrackScore score = score_moved(still_clip(), [](int) { return std::pair(12.0, 4.0); });
  // (12/40, 4/10) = (0.3, 0.4)
  for (const FrameScore& frame : score.frames) CHECK(near(*frame.normalized_error, 0.5));
  CHECK(score.normalized_precision[49] == 0);
  CHECK(score.normalized_precision[50] == 1);
  CHECK(near(score.normalized_precision_auc, 1.0 / 51));
}

TEST_CASE("five frames calculated manually") {
  const ClipTruth clip = clip_of(
      5, 10,
      [](int) {
        return visible_at({0, 0, 10, 10});
      },
      100);
  Results results{.name = "hand", .frames_per_s = 33.0};
  report(results, 100, {0, 0, 10, 10});    // perfect
  report(results, 101, {6, 8, 10, 10});    // error 10, both 4*2 = 8, overlap 8/192
  report(results, 102, {0, 0, 10, 20});    // error 5 (down), overlap 1/2
  report(results, 104, {30, 40, 10, 10});  // error 50, disjoint; and nothing in 103
  const TrackScore score = score_track(clip, clip.targets[0], results, {});
  CHECK(score.scored == 5);
  CHECK(score.reported == 4);
  CHECK(score.lost == 2);
  CHECK(near(score.mean_center_error_px, (0 + 10 + 5 + 50) / 4.0));
  CHECK(near(score.median_center_error_px, 7.5));
  CHECK(near(score.p95_center_error_px, 10 + 0.85 * 40));  // place 0.95 * 3 = 2.85 of 0, 5, 10, 50
  CHECK(near(score.mean_dx_px, (0 + 6 + 0 + 30) / 4.0));
  CHECK(near(score.mean_dy_px, (0 + 8 + 5 + 40) / 4.0));
  CHECK(near(score.precision[0], 0.2));
  CHECK(near(score.precision[5], 0.4));
  CHECK(near(score.precision[9], 0.4));
  CHECK(near(score.precision_at_20, 0.6));
  CHECK(near(score.precision[49], 0.6));
  CHECK(near(score.precision[50], 0.8));
  CHECK(near(score.mean_overlap, (1 + 8.0 / 192 + 0.5) / 5));
  // Overlaps 1, 0.0416..., 0.5, 0, 0 exceed 21, 1, 10, 0 and 0 thresholds.
  CHECK(near(score.success_auc, (21 + 1 + 10) / (5.0 * 21)));
  CHECK(near(score.success[0], 0.6));
  CHECK(near(score.success[20], 0.2));
  CHECK(*score.frames_per_s == 33);
  CHECK(score.name == "hand");
  CHECK(score.frames[3].frame == 103);
  CHECK(near(score.frames[3].time_s, 10.3));
  CHECK(score.frames[3].is_lost);
  CHECK_FALSE(score.frames[3].is_reported);
  CHECK_FALSE(score.frames[3].center_error_px);
  CHECK(score.frames[3].overlap == 0);
  CHECK(score.frames[4].is_lost);
}

TEST_CASE("the share of lost frames is what the success curve lacks at zero") {
  const TrackScore score = score_moved(still_clip(), [](int i) { return std::pair(i * 1.0, 0.0); });
  CHECK(score.lost == 60);
  CHECK(near(score.success[0], 1 - score.lost / 100.0));
}

TEST_CASE("frames without the intruder are not scored, and what is reported in them is counted") {
  const ClipTruth clip = clip_of(10, 25, [](int i) {
    TargetFrame frame = visible_at(kTrueBox);
    if (i % 2 == 1) frame.visible.reset();  // hidden wholly: the silhouette stays
    if (i == 9) frame.amodal_box.reset();
    return frame;
  });
  Results results;
  for (const int frame : {0, 1, 2, 3, 9}) report(results, frame, kTrueBox);
  for (const TruthBox box : {TruthBox::visible, TruthBox::amodal}) {
    const TrackScore score = score_track(clip, clip.targets[0], results, {.truth = box});
    CHECK(score.scored == 5);
    CHECK(score.reported == 2);
    CHECK(score.lost == 3);
    CHECK(score.reported_absent == 3);
    CHECK_FALSE(score.frames[1].is_scored);
    CHECK(score.frames[1].is_reported);
    CHECK_FALSE(score.frames[1].is_lost);
    // A frame with a report has a box in the truth.
    CHECK(score.frames[1].center_error_px.has_value() == (box == TruthBox::amodal));
    CHECK(score.mean_center_error_px == 0);
  }
  // Frames before the start are not scored.
  CHECK(score_track(clip, clip.targets[0], results, {.from_frame = 2}).reported_absent == 2);
}

TEST_CASE("the policy determines which frames are scored and against which box") {
  const ClipTruth clip = clip_of(
      10, 25,
      [](int i) {
        TargetFrame frame = visible_at(kTrueBox);
        frame.amodal_box = moved(kTrueBox, -10, 0);
        frame.visible_fraction = i / 10.0;
        return frame;
      },
      50);
  Results results;
  for (int frame = 50; frame < 60; ++frame) report(results, frame, kTrueBox);
  results.initializations = {59};
  const TrackScore all = score_track(clip, clip.targets[0], results, {});
  CHECK(all.scored == 9);  // frame 59 was given
  CHECK_FALSE(all.frames[9].is_scored);
  CHECK(all.mean_dx_px == 0);
  const TrackScore late = score_track(clip, clip.targets[0], results, {.from_frame = 54});
  CHECK(late.scored == 5);
  CHECK_FALSE(late.frames[3].is_scored);
  CHECK(late.frames[4].is_scored);
  const TrackScore seen = score_track(clip, clip.targets[0], results, {.min_visible_fraction = 0.7});
  CHECK(seen.scored == 2);
  CHECK(seen.frames[7].is_scored);
  CHECK(near(score_track(clip, clip.targets[0], results, {.truth = TruthBox::amodal}).mean_dx_px, 10));
}

TEST_CASE("where nothing is scored or reported, a mean is NaN and no number") {
  const ClipTruth clip = still_clip(3);
  const TrackScore silent = score_track(clip, clip.targets[0], {}, {});
  CHECK(silent.scored == 3);
  CHECK(silent.lost == 3);
  CHECK(std::isnan(silent.mean_center_error_px));
  CHECK(std::isnan(silent.median_center_error_px));
  CHECK(std::isnan(silent.p95_center_error_px));
  CHECK(std::isnan(silent.mean_dx_px));
  CHECK(silent.mean_overlap == 0);
  CHECK(silent.success_auc == 0);
  CHECK(silent.precision_at_20 == 0);
  CHECK_FALSE(silent.frames_per_s);

  const ClipTruth absent = clip_of(3, 25, [](int) { return TargetFrame{}; });
  const TrackScore none = score_track(absent, absent.targets[0], {}, {});
  CHECK(none.scored == 0);
  CHECK(std::isnan(none.precision_at_20));
  CHECK(std::isnan(none.success_auc));
  CHECK(std::isnan(none.mean_overlap));
  CHECK(std::isnan(none.normalized_precision_auc));

  const ClipTruth empty = clip_of(0, 25, [](int) { return TargetFrame{}; });
  CHECK(score_track(empty, empty.targets[0], {}, {}).frames.empty());
}

TEST_CASE("the mean, median and 95 % of one frame are the same") {
  const TrackScore score = score_moved(still_clip(1), [](int) { return std::pair(0.0, -8.0); });
  CHECK(score.mean_center_error_px == 8);
  CHECK(score.median_center_error_px == 8);
  CHECK(score.p95_center_error_px == 8);
}

TEST_CASE("a truth without width has infinite normalised errors, and none where the centres agree") {
  const ClipTruth clip = clip_of(2, 25, [](int) {
    TargetFrame frame = visible_at(kTrueBox);
    frame.amodal_box = Box{10, 10, 0, 5};
    return frame;
  });
  Results results;
  report(results, 0, {9, 10, 2, 5});
  report(results, 1, {10, 10, 2, 5});
  const TrackScore score = score_track(clip, clip.targets[0], results, {.truth = TruthBox::amodal});
  CHECK(*score.frames[0].normalized_error == 0);
  CHECK(std::isinf(*score.frames[1].normalized_error));
  CHECK(score.normalized_precision[50] == 0.5);
  CHECK(score.lost == 2);
}

TEST_CASE("a tracker starts in the first frame that shows enough of the intruder") {
  const ClipTruth clip = clip_of(
      10, 25,
      [](int i) {
        if (i < 2) return TargetFrame{};
        TargetFrame frame = visible_at({100, 100, 2.0 * i, 1.0 * i});  // 4x2, 6x3, ...
        frame.amodal_box = Box{100, 100, 50, 50};
        frame.visible_fraction = i / 10.0;
        return frame;
      },
      200);
  const TargetTruth& target = clip.targets[0];
  CHECK(first_frame_to_track(clip, target, {}, 0) == 202);
  CHECK(first_frame_to_track(clip, target, {}, 3) == 203);
  CHECK(first_frame_to_track(clip, target, {}, 9) == 209);
  CHECK_FALSE(first_frame_to_track(clip, target, {}, 9.5));
  CHECK(first_frame_to_track(clip, target, {.from_frame = 206}, 3) == 206);
  CHECK(first_frame_to_track(clip, target, {.min_visible_fraction = 0.5}, 3) == 205);
  CHECK(first_frame_to_track(clip, target, {.truth = TruthBox::amodal}, 40) == 202);
}

}  // namespace sigs::test
