// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <doctest/doctest.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

#include "flights/flights.h"
#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"
#include "video/clips.h"

namespace {

using namespace sigs;

const cv::Size kSize{320, 240};
const cv::Size kSoftSize{640, 480};
constexpr int kFrames = 120;

cv::Mat luma_of(const flights::Flight& flight, int frame) {
  cv::Mat luma;
  cv::cvtColor(flight.bgr(frame), luma, cv::COLOR_BGR2GRAY);
  return luma;
}

Verdict verdict_on(const std::function<cv::Mat(int)>& luma, cv::Size size, int frames,
                   KeepStages keep = KeepStages::no) {
  const auto method = stable_method({}, size);
  for (int n = 0; n < frames; ++n) method->add(luma(n));
  return method->verdict(keep);
}

Verdict verdict_after(const flights::Flight& flight, int frames, KeepStages keep = KeepStages::no) {
  return verdict_on([&](int n) { return luma_of(flight, n); }, flight.size_px, frames, keep);
}

flights::Flight flight_named(const std::string& name) {
  return flights::by_name(name, {.size_px = kSize, .frames = kFrames});
}

bool is_same(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace

TEST_CASE("the static own body is found in synthetic flights") {
  for (const char* name : {"nose", "wing tip left", "white before bright sky", "propeller", "letterbox",
                           "cockpit frame", "exposure drift", "straight road below", "grey on grey"}) {
    CAPTURE(name);
    const flights::Flight flight = flight_named(name);
    const Verdict verdict = verdict_after(flight, kFrames);
    CHECK_FALSE(verdict.undecided);
    CHECK(intersection_over_union(verdict.own_body, flight.own_body) >= 0.95);
  }
}

TEST_CASE("nothing is found where there is no body") {
  const Verdict verdict = verdict_after(flight_named("none"), kFrames);
  CHECK_FALSE(verdict.undecided);
  CHECK(cv::countNonZero(verdict.own_body) == 0);
}

TEST_CASE("a plain body before soft clouds, whose texture is below the grain, is found after H.264") {
  const test::SoftClouds clip;
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "clouds.mp4";
  test::write_h264_clip(path, clip.frames, 18, test::soft_clouds_luma(clip));
  FrameSource footage = test::opened(path);
  const Result<OwnBody> found = detect_own_body(footage, 0, {}, {});
  REQUIRE_MESSAGE(found, found.error().text());
  CHECK(intersection_over_union(found->mask, test::soft_clouds_body()) >= 0.95);
}

TEST_CASE("a body before soft clouds is found by its steady brightness, plain or painted, also while exposure swings") {
  for (const test::SoftClouds& clip : {test::SoftClouds{.paint_contrast = 0},
                                       {.cloud_contrast = 127},
                                       {.px_per_frame = 2},
                                       {.paint_contrast = 0, .exposure = 0.15}}) {
    CAPTURE(clip.cloud_contrast);
    CAPTURE(clip.px_per_frame);
    const Verdict verdict = verdict_on(test::soft_clouds_luma(clip), kSoftSize, clip.frames);
    CHECK_FALSE(verdict.undecided);
    CHECK(intersection_over_union(verdict.own_body, test::soft_clouds_body()) >= 0.95);
    // The boom, which is far from where coarse cuts place it, is as sure as the nose.
    CHECK(cv::mean(verdict.confidence, test::soft_clouds_body())[0] > 0.9);
  }
}

TEST_CASE("soft clouds alone are world, and a camera that stands still before them is undecided") {
  for (const double exposure : {0.0, 0.15}) {
    const Verdict clouds =
        verdict_on(test::soft_clouds_luma({.has_body = false, .exposure = exposure}), kSoftSize, 160);
    CHECK(cv::countNonZero(clouds.own_body) == 0);
    const Verdict still = verdict_on(test::soft_clouds_luma({.px_per_frame = 0, .exposure = exposure}), kSoftSize, 80);
    CHECK(still.undecided);
    CHECK(cv::countNonZero(still.own_body) == 0);
  }
}

TEST_CASE("nothing is found in real clips without a body") {
  if (!test::has_real_data()) return;
  for (const char* name : {"video/ground_udacity_road_540p.mp4", "track/V_AIRPLANE_001.mp4", "track/V_AIRPLANE_020.mp4",
                           "track/V_AIRPLANE_037.mp4", "track/V_HELICOPTER_024.mp4", "track/V_DRONE_012.mp4"}) {
    CAPTURE(name);
    FrameSource footage = test::opened(test::real_data() / name);
    const Result<OwnBody> found = detect_own_body(footage, 0, {.frames = 150}, {});
    CHECK((!found || found->share == 0));
  }
}

TEST_CASE("a stationary camera is undecided, also where something passes by") {
  for (const char* name : {"still", "still, one mover"}) {
    CAPTURE(name);
    const Verdict verdict = verdict_after(flight_named(name), 60);
    CHECK(verdict.undecided);
    CHECK(cv::countNonZero(verdict.own_body) == 0);
    CHECK(cv::norm(verdict.confidence - 0.5, cv::NORM_INF) == 0);
  }
}

TEST_CASE("no frame, one frame and black frames are undecided, at any size") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 700), cv::Size(1300, 2), cv::Size(320, 240)}) {
    const auto method = stable_method({}, size);
    CHECK(method->verdict(KeepStages::no).undecided);
    for (int n = 0; n < 20; ++n) {
      method->add(cv::Mat::zeros(size, CV_8UC1));
      const Verdict verdict = method->verdict(KeepStages::yes);
      CHECK(verdict.undecided);
      CHECK(verdict.own_body.size() == size);
      CHECK(verdict.confidence.size() == size);
    }
  }
}

TEST_CASE("an intermediate verdict changes nothing, nor does the number of threads") {
  const flights::Flight flight = flight_named("nose");
  const auto method = stable_method({}, flight.size_px);
  const int threads = cv::getNumThreads();
  for (int n = 0; n < kFrames; ++n) {
    method->add(luma_of(flight, n));
    if (n % 37 == 5) CHECK(method->verdict(KeepStages::no).own_body.size() == kSize);
  }
  cv::setNumThreads(1);
  const Verdict checked = method->verdict(KeepStages::no);
  cv::setNumThreads(threads);
  const Verdict verdict = verdict_after(flight, kFrames);
  CHECK(is_same(checked.own_body, verdict.own_body));
  CHECK(is_same(checked.confidence, verdict.confidence));
}

TEST_CASE("confidence agrees with the mask, and the stages are images of the footage's size") {
  const flights::Flight flight = flight_named("cockpit frame");
  const Verdict verdict = verdict_after(flight, kFrames, KeepStages::yes);
  CHECK(cv::countNonZero((verdict.confidence < 0.5) & verdict.own_body) == 0);
  CHECK(cv::countNonZero((verdict.confidence > 0.5) & ~verdict.own_body) == 0);
  CHECK(cv::mean(verdict.confidence, flight.own_body)[0] > 0.9);
  CHECK(cv::mean(verdict.confidence, ~flight.own_body)[0] < 0.25);
  CHECK(verdict.stages.size() >= 7);
  for (const DetectionStage& stage : verdict.stages) {
    CHECK(stage.image.size() == kSize);
    CHECK(stage.image.type() == CV_8UC1);
  }
}
