// SPDX-License-Identifier: MIT
#include "occlusion/detect.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"
#include "video/clips.h"

namespace sigs::test {
namespace {

// The method that decides on any footage in which anything differs: these tests are about the code around it.
OwnBodySettings settings_with(int frames, int every = 1) {
  return {.method = OwnBodyMethod::paper, .frames = frames, .every = every};
}

Result<OwnBody> detected(const std::filesystem::path& path, const OwnBodySettings& settings, int first_frame = 0,
                         const DetectionControl& control = {}) {
  FrameSource footage = opened(path);
  return detect_own_body(footage, first_frame, settings, control);
}

// Frame by frame, without anything read ahead.
Verdict frame_by_frame(const std::filesystem::path& path, const OwnBodySettings& settings,
                       const std::vector<int>& frames) {
  FrameSource footage = opened(path);
  const std::unique_ptr<DetectionMethod> method = detection_method(settings, footage.info().size_px);
  for (const int n : frames) method->add(footage.read(n).value().planes[0]);
  return method->verdict(KeepStages::no);
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

void check_fails(const Result<OwnBody>& found, const std::filesystem::path& path, const std::string& what) {
  REQUIRE_FALSE(found.has_value());
  CHECK(found.error().kind == ErrorKind::bad_data);
  CHECK_MESSAGE(found.error().where.starts_with(path.string()), found.error().where);
  CHECK_MESSAGE(found.error().what.find(what) != std::string::npos, found.error().what);
}

}  // namespace

TEST_CASE("the used frames are the requested ones and the mask is the method's with a soft edge") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv");
  OwnBodySettings settings = settings_with(20, 3);
  settings.soft_edge_px = 4;
  const OwnBody found = detected(folder / "c.mkv", settings, 5).value();
  CHECK(found.frames_used == 7);
  CHECK(found.frames_passed == 19);
  CHECK_FALSE(found.converged);
  const Verdict expected = frame_by_frame(folder / "c.mkv", settings, {5, 8, 11, 14, 17, 20, 23});
  CHECK(equal(found.mask, soft_edged(expected.own_body, 4)));
  CHECK(found.share == doctest::Approx(cv::countNonZero(expected.own_body) / (96.0 * 72)));
  REQUIRE(found.confidence.type() == CV_16UC1);
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 96; ++x)
      CHECK(std::abs(found.confidence.at<ushort>(y, x) - 65535.0 * expected.confidence.at<float>(y, x)) <= 0.51);
}

TEST_CASE("all frames are used where there are fewer than asked for") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv", 10);
  CHECK(detected(folder / "c.mkv", settings_with(1500)).value().frames_used == 10);
  CHECK(detected(folder / "c.mkv", settings_with(1500), 8).value().frames_used == 2);
  CHECK(detected(folder / "c.mkv", settings_with(1500, 9)).value().frames_used == 2);
}

TEST_CASE("fewer than two frames are an error that says why") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv", 10);
  check_fails(detected(folder / "c.mkv", settings_with(1500), 9), folder / "c.mkv", "only 1 frame can be used; at");
  check_fails(detected(folder / "c.mkv", settings_with(1500, 10)), folder / "c.mkv",
              "only 1 frame can be used, each 10th is taken; at least 2");
}

TEST_CASE("equal frames are an error however many they are and one that differs ends it") {
  const TemporaryFolder folder;
  write_luma_clip(folder / "still.mkv", 12, [](int) { return flight_luma(0); });
  check_fails(detected(folder / "still.mkv", settings_with(1500)), folder / "still.mkv",
              "nothing moves: all 12 frames are equal");
  write_luma_clip(folder / "last.mkv", 12, [](int n) { return flight_luma(n == 11 ? 1 : 0); });
  CHECK(detected(folder / "last.mkv", settings_with(1500)).has_value());
  check_fails(detected(folder / "last.mkv", settings_with(11)), folder / "last.mkv", "nothing moves");
}

TEST_CASE("an undecided method gives an error and no mask") {
  const TemporaryFolder folder;
  // One sample flickers.
  write_luma_clip(folder / "c.mkv", 30, [](int n) {
    cv::Mat luma = flight_luma(0);
    luma.at<uchar>(3, 3) = static_cast<uchar>(n % 2 == 0 ? 100 : 103);
    return luma;
  });
  OwnBodySettings settings = settings_with(1500);
  settings.method = OwnBodyMethod::stable;
  const Result<OwnBody> found = detected(folder / "c.mkv", settings);
  REQUIRE_FALSE(found.has_value());
  CHECK(found.error().kind == ErrorKind::bad_data);
  CHECK(found.error().where == (folder / "c.mkv").string());
}

TEST_CASE("damaged frames are left out with a warning that counts them") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv");
  std::vector<uint8_t> bytes = bytes_of(folder / "c.mkv");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 200; ++i) bytes[i] = static_cast<uint8_t>(bytes[i] + 1);
  write_bytes(folder / "c.mkv", bytes);
  FrameSource footage = opened(folder / "c.mkv");
  std::vector<int> intact;
  for (int n = 0; n < footage.info().frame_count(); ++n)
    if (!footage.read(n).value().damaged) intact.push_back(n);
  const int damaged = footage.info().frame_count() - static_cast<int>(intact.size());
  REQUIRE(damaged > 0);
  const OwnBody found = detected(folder / "c.mkv", settings_with(1500)).value();
  CHECK(found.frames_used == static_cast<int>(intact.size()));
  REQUIRE(found.warnings.size() == 1);
  CHECK(found.warnings[0].what.starts_with(std::to_string(damaged) + " of "));
  CHECK(equal(found.mask, frame_by_frame(folder / "c.mkv", settings_with(1500), intact).own_body));
}

TEST_CASE("an image size that changes is an error that names the frame and what to do") {
  const TemporaryFolder folder;
  const std::string codec = "-c:v libx264 -pix_fmt yuv420p -f h264";
  if (!make_clip(codec, folder / "large.h264", "testsrc2=size=128x96:rate=25:duration=1") ||
      !make_clip(codec, folder / "small.h264", "testsrc2=size=64x48:rate=25:duration=1"))
    return;
  std::vector<uint8_t> both = bytes_of(folder / "large.h264");
  const std::vector<uint8_t> small = bytes_of(folder / "small.h264");
  both.insert(both.end(), small.begin(), small.end());
  write_bytes(folder / "both.h264", both);
  const Result<OwnBody> found = detected(folder / "both.h264", settings_with(1500));
  check_fails(found, folder / "both.h264", "the image's size changes from 128x96 to 64x48; own_body.frames = 25 ends");
  CHECK(found.error().where.ends_with(": frame 25"));
  CHECK(detected(folder / "both.h264", settings_with(25)).has_value());
}

TEST_CASE("a cancelled detection ends soon with this error") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv", 100);
  std::atomic<bool> cancel = false;
  int passed = 0;
  const DetectionControl control{.progress =
                                     [&](int done, int) {
                                       passed = done;
                                       cancel = done == 10;
                                     },
                                 .cancel = &cancel};
  const Result<OwnBody> found = detected(folder / "c.mkv", settings_with(1500), 0, control);
  REQUIRE_FALSE(found.has_value());
  CHECK(found.error().kind == ErrorKind::interrupted);
  CHECK(passed == 10);
}

TEST_CASE("progress counts the frames passed up to those to be passed") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv", 10);
  std::vector<std::pair<int, int>> heard;
  const DetectionControl control{.progress = [&](int done, int total) { heard.emplace_back(done, total); }};
  REQUIRE(detected(folder / "c.mkv", settings_with(9, 3), 1, control).has_value());
  CHECK(heard == std::vector<std::pair<int, int>>{{1, 7}, {4, 7}, {7, 7}});
}

TEST_CASE("stages are made where requested and change nothing") {
  const TemporaryFolder folder;
  write_flight(folder / "c.mkv");
  const OwnBody without = detected(folder / "c.mkv", settings_with(1500)).value();
  const OwnBody with = detected(folder / "c.mkv", settings_with(1500), 0, {.stages = KeepStages::yes}).value();
  CHECK(without.stages.empty());
  REQUIRE_FALSE(with.stages.empty());
  for (const DetectionStage& stage : with.stages) {
    CHECK_MESSAGE(stage.image.type() == CV_8UC1, stage.name);
    CHECK_MESSAGE(stage.image.size() == cv::Size(96, 72), stage.name);
  }
  CHECK(equal(without.mask, with.mask));
  CHECK(equal(without.confidence, with.confidence));
}

}  // namespace sigs::test
