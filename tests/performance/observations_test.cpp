// SPDX-License-Identifier: MIT
#include "performance/observations.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "evaluation/clips.h"

namespace sigs::test {
namespace {

const Box kTarget{599.5, 399.5, 20, 10};
const Box kElsewhere{99.5, 99.5, 20, 10};

// 100 frames, ten a second, from 1000 m on by 8 m a frame.
PerformanceClip made_clip(const std::function<TargetFrame(int)>& target = {}) {
  PerformanceClip clip;
  clip.detected.name = "clip";
  clip.detected.truth = clip_of(
      100, 10, target ? target : [](int i) { return visible_at(kTarget, 1000.0 - 8 * i); });
  return clip;
}

Observations observed(const std::vector<PerformanceClip>& clips, const PerformancePolicy& policy = {}) {
  const Result<Observations> observations = observations_of("some", clips, policy);
  REQUIRE(observations);
  return *observations;
}

ObservedEncounter the_encounter(const PerformanceClip& clip, const PerformancePolicy& policy = {}) {
  const Observations observations = observed({clip}, policy);
  REQUIRE(observations.encounters.size() == 1);
  return observations.encounters[0];
}

}  // namespace

TEST_CASE("a track is declared at the third match of five frames") {
  PerformanceClip clip = made_clip();
  for (const int frame : {10, 13, 16, 20, 22, 24, 30}) report(clip.detected.results, frame, kTarget, 4);
  const ObservedEncounter encounter = the_encounter(clip);
  REQUIRE(encounter.declared);
  CHECK(encounter.declared->range_m == 1000 - 8 * 24);
  CHECK(encounter.declared->time_s == doctest::Approx(2.4).epsilon(1e-12));
  CHECK(*encounter.latency_s == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(encounter.frames[24].is_declared);
  CHECK_FALSE(encounter.frames[23].is_declared);
  CHECK(encounter.frames[99].is_declared);  // from then on
  CHECK_FALSE(encounter.is_declared_at_once);
  // 60 m before the range is least, at 80 m/s: the clip's last frame is 2.5 s away from the point of closest approach
  // on straight flight; without positions nothing is known of it.
  CHECK(std::isnan(encounter.declared->time_left_s));
}

TEST_CASE("matches of different tracks do not add up, boxes without a track do") {
  PerformanceClip changing = made_clip(), none = made_clip();
  for (int frame = 10; frame < 60; ++frame) {
    report(changing.detected.results, frame, kTarget, frame);
    report(none.detected.results, frame, kTarget, kNoTrack);
  }
  CHECK_FALSE(the_encounter(changing).declared);
  CHECK(the_encounter(none).declared->range_m == 1000 - 8 * 12);
  CHECK_FALSE(observed({none}).has_tracks);
  CHECK(observed({changing}).has_tracks);
}

TEST_CASE("latency moves the declaration along the flight, to the clip's end at most") {
  PerformanceClip clip = made_clip();
  for (int frame = 10; frame < 60; ++frame) report(clip.detected.results, frame, kTarget);
  PerformancePolicy policy;
  policy.latency_s = 0.55;
  CHECK(the_encounter(clip, policy).declared->range_m == doctest::Approx(1000 - 80 * (1.2 + 0.55)).epsilon(1e-12));
  policy.latency_s = 100;
  CHECK(the_encounter(clip, policy).declared->range_m == 1000 - 8 * 99);
}

TEST_CASE("the time left is until the closest approach, beyond the clip on straight flight") {
  // 30 m to the side of a point 1000 m ahead, closing at 80 m/s.
  PerformanceClip clip = made_clip([](int i) {
    TargetFrame frame = visible_at(kTarget, std::hypot(1000.0 - 8 * i, 30.0));
    set_geometry(frame, {1000.0 - 8 * i, 30, 0}, {1, 0, 0, 0}, {0, 0, 0, 1});
    return frame;
  });
  for (int frame = 10; frame < 60; ++frame) report(clip.detected.results, frame, kTarget);
  const ObservedEncounter encounter = the_encounter(clip);
  CHECK(encounter.declared->time_left_s == doctest::Approx(1000.0 / 80 - 1.2).epsilon(1e-9));
  // Its nose points back along X, so it is seen head-on; 180 degrees about Z are the attitude's.
  CHECK(encounter.frames[0].aspect_rad == doctest::Approx(std::atan2(30.0, 1000.0)).epsilon(1e-9));
  CHECK(encounter.closing_speed_mps == doctest::Approx(80).epsilon(0.01));
}

TEST_CASE("errors of bearing and elevation are those of the lens") {
  // A pinhole of 500 px; the target's place is the pixel (640, 480) + (50, -25).
  PerformanceClip clip = made_clip([](int i) {
    TargetFrame frame = visible_at({689.5 - 10, 454.5 - 5, 20, 10}, 1000.0 - 8 * i);
    set_geometry(frame, {1000, 100, -50}, {1, 0, 0, 0}, {1, 0, 0, 0});
    frame.distance_m = 1000.0 - 8 * i;
    return frame;
  });
  clip.ray_of_pixel = [](double x, double y) -> std::optional<glm::dvec3> {
    return glm::dvec3(1, (x - 640) / 500, (y - 480) / 500);
  };
  Results& results = clip.detected.results;
  for (int frame = 0; frame < 5; ++frame) report(results, frame, {694.5 - 10, 455 - 5, 20, 10});  // 5 px to the right
  results.frames[2][0].distance_m = 1100;
  const ObservedEncounter encounter = the_encounter(clip);
  REQUIRE(encounter.frames[0].angle_error_rad);
  CHECK(encounter.frames[0].angle_error_rad->x == doctest::Approx(std::atan(0.109) - std::atan(0.1)).epsilon(1e-9));
  CHECK(encounter.frames[0].angle_error_rad->y ==
        doctest::Approx(std::atan2(0.05, std::hypot(1, 0.109)) - std::atan2(0.05, std::hypot(1, 0.1))).epsilon(1e-9));
  CHECK_FALSE(encounter.frames[0].range_error);
  CHECK(*encounter.frames[2].range_error == doctest::Approx(1100.0 / 984 - 1).epsilon(1e-12));
  CHECK_FALSE(encounter.frames[5].angle_error_rad);
}

TEST_CASE("a drop-out has the length of its frames and the cause of the first of them") {
  const auto causes = [](const PerformanceClip& clip, const PerformancePolicy& policy = {}) {
    return the_encounter(clip, policy).drop_outs;
  };
  const auto with_gap = [](const std::function<void(TargetFrame&)>& change) {
    PerformanceClip clip = made_clip([&](int i) {
      TargetFrame frame = visible_at(kTarget, 1000.0 - 8 * i);
      frame.horizon = HorizonSide::above;
      if (i >= 40 && i < 45) change(frame);
      return frame;
    });
    for (int frame = 10; frame < 100; ++frame)
      if (frame < 40 || frame >= 45) report(clip.detected.results, frame, kTarget);
    return clip;
  };
  const auto cause_of = [&](const std::function<void(TargetFrame&)>& change) {
    const std::vector<DropOut> found = causes(with_gap(change));
    REQUIRE(found.size() == 1);
    CHECK(found[0].length_s == doctest::Approx(0.5).epsilon(1e-9));
    CHECK_FALSE(found[0].is_last);
    return found[0].cause;
  };
  CHECK(cause_of([](TargetFrame&) {}) == DropOutCause::other);
  CHECK(cause_of([](TargetFrame& f) { f.amodal_box = Box{1279, 100, 20, 10}; }) == DropOutCause::left_image);
  CHECK(cause_of([](TargetFrame& f) { f.cloud_hidden = 0.6; }) == DropOutCause::clouds);
  CHECK(cause_of([](TargetFrame& f) { f.visible.reset(); }) == DropOutCause::hidden);
  CHECK(cause_of([](TargetFrame& f) { f.visible_fraction = 0.4; }) == DropOutCause::hidden);
  CHECK(cause_of([](TargetFrame& f) { f.horizon = HorizonSide::below; }) == DropOutCause::crossed_horizon);
  CHECK(cause_of([](TargetFrame& f) { f.visible = Box{600, 400, 7, 3}; }) == DropOutCause::small);
  CHECK(cause_of([](TargetFrame& f) { f.rms_contrast = 0.09; }) == DropOutCause::low_contrast);
  PerformanceClip off = with_gap([](TargetFrame&) {});
  report(off.detected.results, 40, moved(kTarget, 18, 0));  // a tenth of each: 0.05 of both
  CHECK(causes(off)[0].cause == DropOutCause::box);
  PerformanceClip weak = with_gap([](TargetFrame&) {});
  report(weak.detected.results, 40, kTarget, 0, 0.1);
  PerformancePolicy strict;
  strict.matching.min_score = 0.5;
  CHECK(causes(weak, strict)[0].cause == DropOutCause::score);
  // One that never ends.
  PerformanceClip ends = made_clip();
  for (int frame = 10; frame < 90; ++frame) report(ends.detected.results, frame, kTarget);
  REQUIRE(causes(ends).size() == 1);
  CHECK(causes(ends)[0].is_last);
  CHECK(causes(ends)[0].length_s == doctest::Approx(1.0).epsilon(1e-9));
  CHECK(causes(made_clip()).empty());  // never detected: no drop-out
}

TEST_CASE("false tracks are declared as others are") {
  PerformanceClip clip = made_clip(), empty = made_clip();
  empty.detected.truth.targets.clear();
  for (const int frame : {10, 12, 14, 50}) report(empty.detected.results, frame, kElsewhere, 3);     // declared
  for (const int frame : {10, 14, 18, 22}) report(empty.detected.results, frame, kElsewhere, 4);     // 2 of 5 at most
  for (const int frame : {60, 61, 62}) report(empty.detected.results, frame, kElsewhere, kNoTrack);  // declared
  for (const int frame : {70, 80, 90}) report(empty.detected.results, frame, kTarget, kNoTrack);     // each by itself
  for (int frame = 10; frame < 20; ++frame) report(clip.detected.results, frame, kTarget, 9);
  const Observations observations = observed({clip, empty});
  CHECK(observations.empty.declared == 2);
  CHECK(observations.empty.boxes == 14);
  CHECK(observations.empty.clips == 1);
  CHECK(observations.empty.hours == doctest::Approx(10.0 / 3600).epsilon(1e-9));
  CHECK(observations.all.clips == 2);
  CHECK(observations.all.declared == 2);
  CHECK(observations.encounters.size() == 1);
}

TEST_CASE("what performance needs of a truth is asked for") {
  PerformanceClip clip = made_clip();
  clip.detected.truth.has_times = false;
  CHECK_FALSE(observations_of("some", {clip}, {}));
  clip = made_clip();
  clip.detected.truth.has_ids = false;
  CHECK_FALSE(observations_of("some", {clip}, {}));
  clip = made_clip();
  clip.detected.truth.targets[0].frames[7].distance_m = std::nan("");
  const Result<Observations> without = observations_of("some", {clip}, {});
  REQUIRE_FALSE(without);
  CHECK(without.error().where == "clip");
  CHECK(without.error().what.find("no range") != std::string::npos);
  // Frames in which it is not visible need none.
  clip.detected.truth.targets[0].frames[7].visible.reset();
  CHECK(observations_of("some", {clip}, {}));
}

TEST_CASE("angles at the edges of the sphere") {
  CHECK(angles_of({1, 0, 0}) == glm::dvec2(0, 0));
  CHECK(angles_of({0, 1, 0}).x == doctest::Approx(std::numbers::pi / 2));
  CHECK(angles_of({0, 0, -1}).y == doctest::Approx(std::numbers::pi / 2));  // straight up
  CHECK(angles_of({-1, 0, 0}).x == doctest::Approx(std::numbers::pi));
  CHECK(angles_of({0, 0, 0}) == glm::dvec2(0, 0));
}

}  // namespace sigs::test
