// SPDX-License-Identifier: MIT
#include "evaluation/metrics/detection_score.h"

#include <doctest/doctest.h>

#include "evaluation/reports/report.h"

#include <cmath>

#include "evaluation/clips.h"

namespace sigs::test {
namespace {

constexpr double kRate_hz = 10;  // the published frame counts are of clips at this rate
const Box kTarget{599.5, 399.5, 20, 10};
const Box kElsewhere{99.5, 99.5, 20, 10};

// Approaches by 5 m a frame from 600 m: nearer than 300 m from frame 61 on, 1 m at the end of 120 frames.
double approaching_m(int frame) {
  return std::max(600.0 - 5 * frame, 1.0);
}

ClipTruth approach(int frames = 120) {
  return clip_of(frames, kRate_hz, [](int i) { return visible_at(kTarget, approaching_m(i)); });
}

// The intruder matched in frames first to last.
Results matched(int first, int last, int track = 0) {
  Results results{.name = "some"};
  for (int frame = first; frame <= last; ++frame) report(results, frame, kTarget, track);
  return results;
}

DetectionScore score_of(const ClipTruth& clip, const Results& results, const DetectionPolicy& policy = {}) {
  return score_detections("some", {{"clip", clip, results}}, policy);
}

bool is_detected(const ClipTruth& clip, const Results& results) {
  const DetectionScore score = score_of(clip, results);
  REQUIRE(score.encounters.size() == 1);
  return score.encounters[0].is_detected;
}

int encounters(const std::function<TargetFrame(int)>& target, int frames = 120, double rate_hz = kRate_hz) {
  return score_of(clip_of(frames, rate_hz, target), {}).all.encounters;
}

}  // namespace

TEST_CASE("extended overlap is the plain one where the truth is large enough") {
  CHECK(extended_overlap({0, 0, 10, 10}, {5, 0, 10, 10}, 100) == doctest::Approx(1.0 / 3).epsilon(1e-12));
  // A small report on a large truth stays small.
  CHECK(extended_overlap({0, 0, 20, 10}, {0, 0, 2, 1}, 100) == doctest::Approx(0.01).epsilon(1e-12));
}

TEST_CASE("extended overlap grows a small truth and the report on it about their middles") {
  // 2x2 at a distance of 5: grown to 10x10 they share half of each.
  CHECK(extended_overlap({0, 0, 2, 2}, {5, 0, 2, 2}, 100) == doctest::Approx(50.0 / 150).epsilon(1e-12));
  // 8x2 grows to 20x5, the shape kept; a report of that very box is all of it.
  CHECK(extended_overlap({6, 1.5, 8, 2}, {0, 0, 20, 5}, 100) == doctest::Approx(1).epsilon(1e-12));
  // A report larger than that stays as it is: 10x10 in 20x20.
  CHECK(extended_overlap({9, 9, 2, 2}, {0, 0, 20, 20}, 100) == doctest::Approx(0.25).epsilon(1e-12));
  // A line has no shape to keep.
  CHECK(extended_overlap({5, 2, 0, 6}, {0, 0, 10, 10}, 100) == doctest::Approx(1).epsilon(1e-12));
  CHECK(extended_overlap({0, 0, 2, 2}, {10.1, 0, 2, 2}, 100) == 0);
}

TEST_CASE("an encounter tracked early enough is detected") {
  const DetectionScore score = score_of(approach(), matched(30, 60));  // the 31 frames before 300 m is passed
  REQUIRE(score.encounters.size() == 1);
  const EncounterScore& encounter = score.encounters[0];
  CHECK(encounter.clip == "clip");
  CHECK(encounter.first_frame == 0);
  CHECK(encounter.last_frame == 119);
  CHECK(encounter.is_detected);
  CHECK(*encounter.first_detection_range_m == 450);
  CHECK(*encounter.first_detection_time_s == doctest::Approx(3.0).epsilon(1e-9));
  // Matches in 15 of 30 frames first from 15 to 44.
  CHECK(*encounter.confirmed_range_m == approaching_m(44));
  CHECK(*encounter.confirmed_time_s == doctest::Approx(4.4).epsilon(1e-9));
  CHECK(encounter.frames_visible == 120);
  CHECK(encounter.frames_matched == 31);
  CHECK(score.all.detected == 1);
  CHECK(score.all.rate() == 1);
  CHECK(score.mean_first_range_m == 450);
}

TEST_CASE("half the frames of the last window before 300 m are enough, one less is not") {
  CHECK(is_detected(approach(), matched(46, 60)));
  CHECK_FALSE(is_detected(approach(), matched(47, 119)));  // too late, however long
  CHECK_FALSE(is_detected(approach(), matched(46, 59)));
  // Every other frame will do: 15 of 30.
  Results half;
  for (int frame = 31; frame <= 60; frame += 2) report(half, frame, kTarget);
  CHECK(is_detected(approach(), half));
}

TEST_CASE("a late detection has a range and a time all the same") {
  const DetectionScore score = score_of(approach(), matched(100, 119));
  CHECK_FALSE(score.encounters[0].is_detected);
  CHECK(*score.encounters[0].first_detection_range_m == 100);
  CHECK(score.encounters[0].confirmed_range_m.has_value());
  CHECK(score.all.rate() == 0);
}

TEST_CASE("matches of different tracks do not add up to one tracked intruder") {
  Results broken;
  for (int frame = 31; frame <= 60; ++frame) report(broken, frame, kTarget, frame);
  CHECK_FALSE(is_detected(approach(), broken));
  // A detector without tracks is judged by its matches alone.
  CHECK(is_detected(approach(), matched(31, 60, kNoTrack)));
  // One that gives it another track half of the time still matches it in half the frames.
  Results two = matched(31, 45, 1);
  for (int frame = 46; frame <= 60; ++frame) report(two, frame, kTarget, 2);
  CHECK(is_detected(approach(), two));
}

TEST_CASE("an encounter that begins near is detected in its first three seconds, or not at all") {
  const ClipTruth clip = clip_of(60, kRate_hz, [](int i) { return visible_at(kTarget, 200 - i); });
  CHECK(is_detected(clip, matched(0, 29)));
  CHECK(is_detected(clip, matched(15, 40)));
  CHECK_FALSE(is_detected(clip, matched(16, 59)));
}

TEST_CASE("an intruder that flies away must be detected before it is near, which is in the first window") {
  const ClipTruth clip = clip_of(80, kRate_hz, [](int i) { return visible_at(kTarget, 200.0 + 5 * i); });
  CHECK(is_detected(clip, matched(10, 40)));
  CHECK_FALSE(is_detected(clip, matched(30, 79)));  // beyond 300 m again by then, but it was near before
}

TEST_CASE("just 300 m is not nearer than 300 m") {
  const ClipTruth clip = clip_of(60, kRate_hz, [](int i) { return visible_at(kTarget, i < 59 ? 300 : 299); });
  CHECK(is_detected(clip, matched(29, 58)));
  CHECK(is_detected(clip, matched(44, 58)));
  CHECK_FALSE(is_detected(clip, matched(45, 59)));
}

TEST_CASE("a gap of three frames lies within an encounter, one of four ends it") {
  const auto with_gap = [](int length) {
    return [length](int i) { return i >= 50 && i < 50 + length ? TargetFrame{} : visible_at(kTarget, 250); };
  };
  CHECK(encounters(with_gap(0)) == 1);
  CHECK(encounters(with_gap(3)) == 1);
  CHECK(encounters(with_gap(4)) == 2);
  // Out of range is a gap as well.
  const auto far_amid = [](int length) {
    return [length](int i) { return visible_at(kTarget, i >= 50 && i < 50 + length ? 701 : 250); };
  };
  CHECK(encounters(far_amid(3)) == 1);
  CHECK(encounters(far_amid(4)) == 2);
}

TEST_CASE("frames of a gap are not required") {
  const ClipTruth clip = clip_of(33, kRate_hz, [](int i) {
    return i >= 10 && i < 13 ? TargetFrame{.distance_m = 250} : visible_at(kTarget, 250);
  });
  // The first window, 0 to 29, has 27 frames to be matched in: 14 are enough, 13 are not.
  CHECK(is_detected(clip, matched(16, 29)));
  CHECK_FALSE(is_detected(clip, matched(17, 29)));
  CHECK(score_of(clip, {}).encounters[0].frames_visible == 30);
}

TEST_CASE("an encounter lasts at least three seconds") {
  const auto for_frames = [](int count) {
    return [count](int i) { return i < count ? visible_at(kTarget, 250) : TargetFrame{}; };
  };
  CHECK(encounters(for_frames(29)) == 0);
  CHECK(encounters(for_frames(30)) == 1);
  CHECK(encounters(for_frames(74), 120, 25) == 0);
  CHECK(encounters(for_frames(75), 120, 25) == 1);
  CHECK(encounters(for_frames(89), 120, 30000.0 / 1001) == 0);  // 89.91 frames
  CHECK(encounters(for_frames(90), 120, 30000.0 / 1001) == 1);
}

TEST_CASE("times of six digits do not cost an encounter a frame, nor a window") {
  const auto with_last_time = [](double last_s) {
    ClipTruth clip =
        clip_of(30, kRate_hz, [](int i) { return i >= 10 && i < 13 ? TargetFrame{} : visible_at(kTarget, 250); });
    clip.times_s.back() = last_s;
    return score_of(clip, {}).all.encounters;
  };
  CHECK(with_last_time(2.9) == 1);
  CHECK(with_last_time(2.899999) == 1);  // 10.000003 Hz: 3 s would be 30.00001 frames
  CHECK(with_last_time(2.900001) == 1);  // 9.999997 Hz: 0.3 s would be 2.999999 frames
  // 30.3 frames are 30: half of them are 15.
  const ClipTruth clip = clip_of(60, 10.1, [](int) { return visible_at(kTarget, 250); });
  CHECK(is_detected(clip, matched(15, 29)));
}

TEST_CASE("an intruder that stays beyond the range is not required, and is counted separately") {
  const ClipTruth clip = clip_of(60, kRate_hz, [](int) { return visible_at(kTarget, 331); });
  const DetectionScore score = score_of(clip, matched(0, 59));
  CHECK(score.all.encounters == 0);
  CHECK(std::isnan(score.all.rate()));
  CHECK(score.encounters_too_far == 1);
  CHECK(score.frame_detection_rate == 1);  // but its frames are
  CHECK(score.false_alarm_boxes == 0);
  CHECK(score_of(clip, {}, {.max_closest_range_m = 331}).all.encounters == 1);
  // Beyond the maximum range nothing is required, and no report of an intruder there is a false alarm.
  const DetectionScore far =
      score_of(clip_of(60, kRate_hz, [](int) { return visible_at(kTarget, 701); }), matched(0, 59));
  CHECK(far.encounters_too_far == 0);
  CHECK(std::isnan(far.frame_detection_rate));
  CHECK(far.false_alarm_boxes == 0);
}

TEST_CASE("an encounter's side of the horizon is that of all its frames, or on it") {
  const auto side = [](HorizonSide first, HorizonSide last) {
    return score_of(clip_of(60, kRate_hz,
                            [=](int i) {
                              TargetFrame frame = visible_at(kTarget, 250);
                              frame.horizon = i < 59 ? first : last;
                              return frame;
                            }),
                    matched(0, 59));
  };
  const DetectionScore above = side(HorizonSide::above, HorizonSide::above);
  CHECK(above.above_horizon.detected == 1);
  CHECK(above.on_horizon.encounters + above.below_horizon.encounters == 0);
  CHECK(side(HorizonSide::below, HorizonSide::below).below_horizon.detected == 1);
  CHECK(side(HorizonSide::below, HorizonSide::above).on_horizon.detected == 1);
  CHECK(side(HorizonSide::above, HorizonSide::on).on_horizon.detected == 1);
  // Unknown in one frame is unknown for the encounter.
  const DetectionScore unknown = side(HorizonSide::above, HorizonSide::unknown);
  CHECK(unknown.unknown_horizon.detected == 1);
  CHECK(unknown.above_horizon.encounters + unknown.on_horizon.encounters == 0);
}

TEST_CASE("false alarms are counted by track for the hour and by box for the frame") {
  Results results = matched(0, 119, 1);
  for (int frame = 10; frame < 20; ++frame) report(results, frame, kElsewhere, 2);
  report(results, 50, kElsewhere, 3);
  report(results, 51, kElsewhere, 1);  // a good track that is elsewhere once
  report(results, 60, kElsewhere, kNoTrack);
  report(results, 61, kElsewhere, kNoTrack);
  report(results, 500, kElsewhere, 9);  // no frames of the clip
  report(results, 120, kElsewhere, 9);
  report(results, -1, kElsewhere, 9);
  const DetectionScore score = score_of(approach(), results);
  CHECK(score.false_alarm_boxes == 14);
  CHECK(score.false_alarm_tracks == 5);
  CHECK(score.frames == 120);
  CHECK(score.hours == doctest::Approx(12.0 / 3600).epsilon(1e-9));
  CHECK(score.false_alarms_per_hour == doctest::Approx(5 * 300).epsilon(1e-9));
  CHECK(score.false_boxes_per_frame == doctest::Approx(14.0 / 120).epsilon(1e-12));
}

TEST_CASE("some reports are neither a match nor a false alarm") {
  // Boxes 20 wide, shifted by d: overlap (20 - d) / (20 + d).
  const auto at_overlap = [](double overlap) {
    Results results;
    report(results, 0, moved(kTarget, 20 * (1 - overlap) / (1 + overlap), 0));
    return score_of(clip_of(1, kRate_hz, [](int) { return visible_at(kTarget); }), results);
  };
  CHECK(at_overlap(0.2).frame_detection_rate == 1);
  CHECK(at_overlap(0.199).frame_detection_rate == 0);
  CHECK(at_overlap(0.199).false_alarm_boxes == 0);
  CHECK(at_overlap(0.02).false_alarm_boxes == 0);
  CHECK(at_overlap(0.019).false_alarm_boxes == 1);
}

TEST_CASE("a report where a hidden intruder is raises no false alarm, and detects nothing") {
  const ClipTruth clip = clip_of(40, kRate_hz, [](int) {
    TargetFrame frame = visible_at(kTarget, 250);
    frame.visible.reset();
    return frame;
  });
  const DetectionScore score = score_of(clip, matched(0, 39));
  CHECK(score.false_alarm_boxes == 0);
  CHECK(score.all.encounters == 0);
  CHECK(std::isnan(score.frame_detection_rate));
}

TEST_CASE("reports of a low score are ignored") {
  Results results = matched(0, 119);
  for (int frame = 0; frame < 60; ++frame) results.frames[frame][0].score = 0.3;
  report(results, 70, kElsewhere, 2, 0.3);
  const DetectionScore strict = score_of(approach(), results, {.min_score = 0.5});
  CHECK(strict.frame_detection_rate == 0.5);
  CHECK(strict.false_alarm_boxes == 0);
  CHECK_FALSE(strict.encounters[0].is_detected);
  CHECK(score_of(approach(), results, {.min_score = 0.3}).false_alarm_boxes == 1);
  CHECK(strict.negative_scores_ignored == 0);
}

TEST_CASE("reports of negative scores are ignored unless they are asked for, and how many are is said") {
  Results results = matched(0, 119);
  for (auto& [frame, reports] : results.frames) reports[0].score = frame < 50 ? -0.5 : 0.5;
  const DetectionScore score = score_of(approach(), results);
  CHECK(score.negative_scores_ignored == 50);
  DetectionReport report;
  report.scores = {score};
  report.scores[0].name = "mine";
  CHECK(std::ranges::count(uncounted_in(report), "mine: 50 reports of a score below 0 left out (--min-score)") == 1);
  CHECK(score_of(approach(), results, {.min_score = -1}).negative_scores_ignored == 0);
  CHECK(score_of(approach(), results, {.min_score = -1}).frame_detection_rate == 1);
}

TEST_CASE("one report may match two intruders that are close together") {
  ClipTruth clip = approach();
  add_target(clip, [](int i) { return visible_at(moved(kTarget, 3, 0), approaching_m(i)); });
  const DetectionScore score = score_of(clip, matched(0, 59));
  CHECK(score.all.encounters == 2);
  CHECK(score.all.detected == 2);
  CHECK(score.encounters[1].target == 1);
  CHECK(score.frame_detection_rate == 0.5);
}

TEST_CASE("several clips add up, and their tracks are independent") {
  Results noisy = matched(30, 60);
  report(noisy, 0, kElsewhere, 7);
  Results silent;
  report(silent, 0, kElsewhere, 7);
  const DetectionScore score = score_detections(
      "some", {{"one", approach(), noisy}, {"two", approach(), silent}, {"three", approach(60), {}}}, {});
  CHECK(score.frames == 300);
  CHECK(score.hours == doctest::Approx(30.0 / 3600).epsilon(1e-9));
  CHECK(score.false_alarm_tracks == 2);
  // The third ends at 305 m: near enough to count.
  CHECK(score.all.encounters == 3);
  CHECK(score.all.detected == 1);
  CHECK(score.encounters[1].clip == "two");
  CHECK(score.mean_first_range_m == 450);  // of the one that was detected at all
  CHECK(score.frame_detection_rate == doctest::Approx(31.0 / 300).epsilon(1e-12));
}

TEST_CASE("without clips there are no rates") {
  for (const std::vector<DetectedClip>& clips :
       {std::vector<DetectedClip>{}, std::vector<DetectedClip>{{"empty", clip_of(0, 10, {}), {}}}}) {
    const DetectionScore score = score_detections("some", clips, {});
    CHECK(score.hours == 0);
    CHECK(score.frames == 0);
    CHECK(std::isnan(score.false_alarms_per_hour));
    CHECK(std::isnan(score.false_boxes_per_frame));
    CHECK(std::isnan(score.frame_detection_rate));
    CHECK(std::isnan(score.mean_first_range_m));
    CHECK(std::isnan(score.all.rate()));
  }
}

TEST_CASE("the rate of a clip is that of its times, or the nominal one") {
  ClipTruth clip = approach(11);
  CHECK(rate_hz_of(clip) == doctest::Approx(10).epsilon(1e-12));
  for (double& time_s : clip.times_s) time_s *= 2;
  CHECK(rate_hz_of(clip) == doctest::Approx(5).epsilon(1e-12));
  CHECK(rate_hz_of(approach(1)) == 10);
  for (double& time_s : clip.times_s) time_s = 0;
  CHECK(rate_hz_of(clip) == 10);
}

TEST_CASE("an encounter that is too short is counted separately, and a sentence names the option") {
  const ClipTruth clip = approach();
  DetectionPolicy policy;
  policy.min_encounter_s = 1000;
  const DetectionScore score = score_detections("blind", {{.name = "one", .truth = clip}}, policy);
  CHECK(score.all.encounters == 0);
  CHECK(score.encounters_too_short == 1);
  CHECK(score.encounters_too_far == 0);
  const std::vector<std::string> reasons = uncounted_in({.clips = {"one"}, .policy = policy, .scores = {score}});
  REQUIRE(reasons.size() == 1);
  CHECK(reasons.front() == "1 encounter is not counted: shorter than 1000 s (--min-encounter)");
}

TEST_CASE("a clip whose length in seconds is beyond a double counts by its nominal rate") {
  ClipTruth clip = approach();
  clip.footage.frame_rate_num = 10;
  clip.footage.frame_rate_den = 1;
  clip.times_s.front() = -1.7e308;
  clip.times_s.back() = 1.7e308;
  CHECK(rate_hz_of(clip) == 10);
}

}  // namespace sigs::test
