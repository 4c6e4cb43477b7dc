// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <doctest/doctest.h>

#include <cmath>

#include "editor/widgets/texts.h"

namespace sigs::editor {

namespace {

FrameScore reported(int frame, double error_px, bool lost = false) {
  return {.frame = frame,
          .is_scored = true,
          .is_reported = true,
          .dx_px = error_px,
          .dy_px = 0,
          .center_error_px = error_px,
          .overlap = lost ? 0 : 0.5,
          .is_lost = lost};
}

FrameScore silent(int frame) {
  return {.frame = frame, .is_scored = true, .is_lost = true};
}

// The truth has no box, the tracker says there is one.
FrameScore absent(int frame) {
  return {.frame = frame, .is_reported = true};
}

ScoredTracker tracker_of(int color, std::vector<FrameScore> frames) {
  auto score = std::make_shared<TrackScore>();
  score->frames = std::move(frames);
  return {.file = {.id = color + 1, .path = "/data/run/kcf.csv", .color = color},
          .name = "kcf",
          .results = std::make_shared<Results>(),
          .score = score};
}

// Frames 20 to 26.
Scored scored() {
  return {.trackers = {tracker_of(0, {absent(20), reported(21, 3), silent(22), silent(23), reported(24, 250, true),
                                      reported(25, 4), reported(26, 5)}),
                       tracker_of(1, {absent(20), reported(21, 1), reported(22, 1), reported(23, 1), reported(24, 2),
                                      reported(25, 2), reported(26, 2)})},
          .target = "cube",
          .first_frame = 20,
          .truth = TruthKind::measured};
}

}  // namespace

TEST_CASE("a curve has gaps where nothing is compared, and says where the target was lost") {
  const ErrorCurves curves = error_curves(scored());
  CHECK(curves.first_frame == 20);
  REQUIRE(curves.curves.size() == 2);
  const ErrorCurve& curve = curves.curves[0];
  REQUIRE(curve.errors_px.size() == 7);
  CHECK(std::isnan(curve.errors_px[0]));
  CHECK(curve.errors_px[1] == 3);
  CHECK(std::isnan(curve.errors_px[2]));
  CHECK(std::isnan(curve.errors_px[3]));
  CHECK(curve.errors_px[4] == 250);
  REQUIRE(curve.lost.size() == 2);
  CHECK(curve.lost[0].first_frame == 22);
  CHECK(curve.lost[0].last_frame == 23);
  CHECK(curve.lost[0].moment == TrackerMoment::silent);
  CHECK(curve.lost[1].first_frame == 24);
  CHECK(curve.lost[1].last_frame == 24);
  CHECK(curve.lost[1].moment == TrackerMoment::lost);
  CHECK(curves.curves[1].lost.empty());
}

TEST_CASE("all curves share a scale from 0 to beyond the largest error, on which small ones differ visibly") {
  const ErrorCurves curves = error_curves(scored());
  CHECK(curves.max_px == 250);
  CHECK(curves.scale.share_of(0) == 0);
  CHECK(curves.scale.share_of(250) < 1);
  CHECK(curves.scale.share_of(250) > 0.9);
  CHECK(curves.scale.share_of(3) - curves.scale.share_of(1) > 0.08);
}

TEST_CASE("a tracker that is not shown has no curve and does not stretch the scale") {
  Scored half = scored();
  half.trackers[0].file.is_shown = false;
  const ErrorCurves curves = error_curves(half);
  REQUIRE(curves.curves.size() == 1);
  CHECK(curves.curves[0].color == 1);
  CHECK(curves.max_px == 2);
  Scored unread = scored();
  unread.trackers[0].score = nullptr;
  CHECK(error_curves(unread).curves.size() == 1);
  CHECK(error_curves({}).curves.empty());
  CHECK(error_curves({}).max_px == 0);
}

TEST_CASE("a frame's state has a text: an error, lost, silent, not scored, unknown") {
  const Scored all = scored();
  const ScoredTracker& tracker = all.trackers[0];
  CHECK(moment_text(tracker, 20, 20) == "not scored");
  CHECK(moment_text(tracker, 20, 21) == "3.00 px");
  CHECK(moment_text(tracker, 20, 22) == "no report");
  CHECK(moment_text(tracker, 20, 24) == "lost, 250 px");
  for (const int beyond : {19, 27, -5}) CHECK(moment_text(tracker, 20, beyond) == "-");
  CHECK(moment_of({}, 20, 21) == TrackerMoment::unknown);
}

TEST_CASE("numbers have their significant digits, and a value that is not finite is a dash") {
  CHECK(pixels_text(0.404) == "0.40 px");
  CHECK(pixels_text(13.37) == "13.4 px");
  CHECK(pixels_text(1234.5) == "1234 px");
  CHECK(pixels_text(NAN) == "-");
  CHECK(signed_text(-0.001) == "+0.00");
  CHECK(signed_text(-12.34) == "-12.3");
  CHECK(signed_text(NAN) == "-");
  CHECK(percent_text(0.934) == "93 %");
  CHECK(percent_text(NAN) == "-");
}

TEST_CASE("the reference of the figures is always named") {
  Scored now = scored();
  CHECK(truth_text(now).find("sigs evaluate track") != std::string::npos);
  now.truth = TruthKind::outlines;
  now.truth_done = 120;
  now.truth_total = 200;
  CHECK(truth_text(now).find("About") == 0);
  CHECK(truth_text(now).find("120 of 200") != std::string::npos);
  now.truth_problem = "clip.mp4: is not there";
  CHECK(truth_text(now).find("clip.mp4") != std::string::npos);
  now.target.clear();
  CHECK(truth_text(now).find("no intruder") != std::string::npos);
}

TEST_CASE("trackers of one name are distinguished by their folders") {
  Scored all = scored();
  CHECK(shown_name(all, all.trackers[0]) == "run/kcf");
  all.trackers[1].name = "mil";
  CHECK(shown_name(all, all.trackers[0]) == "kcf");
}

}  // namespace sigs::editor
