// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/partial_file.h"
#include "cli/tiny_project.h"
#include "editor/preview/previewer.h"
#include "support/test_data.h"
#include "viewer.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

Wanted frame_of(Revision revision, int frame) {
  return {.revision = std::move(revision), .frame = frame, .range_first = 0, .range_last = 199};
}

bool names(const std::vector<Problem>& problems, const std::string& field) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.field == field; });
}

bool is_plain_grey(const cv::Mat& bgr) {
  return cv::norm(bgr, cv::Mat(bgr.size(), CV_8UC3, cv::Scalar(bgr.at<cv::Vec3b>(0, 0))), cv::NORM_INF) == 0;
}

}  // namespace

TEST_CASE("without footage intruders fly before grey") {
  Project project = sample("head-on");
  for (const char* video : {"", "nowhere.mp4"}) {
    project.footage.video = video;
    Viewer viewer;
    const Shown shown = viewer.show(frame_of(revision(1, project), 100));
    REQUIRE(shown.picture->bgr.size() == cv::Size(1280, 960));
    const cv::Vec3b grey = shown.picture->bgr.at<cv::Vec3b>(0, 0);
    CHECK(grey == cv::Vec3b::all(130));  // (128 - 16) * 255 / 219
    CHECK_FALSE(is_plain_grey(shown.picture->bgr));
    CHECK_FALSE(shown.picture->mask.empty());
    CHECK_FALSE(shown.scene->footage->video.has_value());
    CHECK_FALSE(shown.scene->footage->problem.empty());
    CHECK_FALSE(shown.opening);
    CHECK(shown.scene->footage->shape.times_s.size() == 250);
    viewer.wait([](const Shown& s) { return s.cached.size() == 250 && s.cached[101]; });
  }
}

TEST_CASE("a project of nothing at all has a picture") {
  Viewer viewer;
  const Shown shown = viewer.show(frame_of(revision(1, Project()), 3));
  CHECK(is_plain_grey(shown.picture->bgr));
  CHECK(shown.surveys.empty());
  CHECK(shown.scene->draft.problems.size() > 0);
}

TEST_CASE("a missing model, calibration and mask are named and stood in for") {
  Project project = sample("head-on");
  project.intruders[0].model.file = "nowhere.obj";
  project.footage.calibration = "nowhere.xml";
  project.footage.own_body_mask = "nowhere.png";
  Viewer viewer;
  Wanted wanted = frame_of(revision(1, project), 100);
  wanted.turntable = {{0, 0, {64, 64}}};
  viewer.want(wanted);
  const Shown shown = viewer.wait([](const Shown& s) { return s.picture_is_current && s.model; });
  CHECK_FALSE(shown.picture->mask.empty());
  CHECK(names(shown.scene->draft.problems, "intruders[0].model.file"));
  CHECK(names(shown.scene->draft.problems, "footage.calibration"));
  CHECK(names(shown.scene->draft.problems, "footage.own_body_mask"));
  CHECK_FALSE(shown.model->problem.empty());
  CHECK_FALSE(shown.model->rgba.empty());  // the cross
}

TEST_CASE("an intruder without waypoints has an empty survey and a model to look at") {
  Project project = sample("head-on");
  project.intruders[0].trajectory.waypoints.clear();
  Viewer viewer;
  Wanted wanted = frame_of(revision(1, project), 100);
  wanted.turntable = {{0, 0, {64, 64}}};
  viewer.want(wanted);
  const Shown shown = viewer.wait([](const Shown& s) { return s.picture_is_current && s.model && s.surveys.at(0); });
  CHECK(shown.picture->mask.empty());
  CHECK(shown.surveys[0]->outlooks.empty());
  CHECK(shown.model->problem.empty());
  wanted.turntable->intruder = 7;  // there is none
  viewer.want(wanted);
  wanted.turntable->size_px = {0, 10};
  wanted.turntable->intruder = 0;
  viewer.want(wanted);
  viewer.wait([](const Shown& s) { return !s.busy; });
}

TEST_CASE(
    "a frame that cannot be used shows the one that stands in for it and says why, its neighbours are themselves") {
  // JPEG pictures one after the other; from the fifth on they have another size, which no frame source gives out.
  std::string bytes;
  for (int i = 0; i < 8; ++i) {
    std::vector<uchar> jpeg;
    cv::imencode(".jpg",
                 cv::Mat(i < 4 ? cv::Size(128, 96) : cv::Size(64, 48), CV_8UC3, cv::Scalar(40, i < 4 ? 90 : 190, 200)),
                 jpeg);
    bytes.append(jpeg.begin(), jpeg.end());
  }
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / "two-sizes.mjpeg", bytes, false));
  Project project = sample("head-on");
  project.footage.video = folder / "two-sizes.mjpeg";
  Viewer viewer;
  const Shown good = viewer.show(frame_of(revision(1, project), 2));
  REQUIRE(good.scene->footage->video.has_value());
  CHECK(good.picture->problem.empty());
  CHECK(good.picture->bgr.size() == cv::Size(128, 96));
  const Shown bad = viewer.show(frame_of(revision(1, project), 6));
  CHECK(bad.picture->frame == 6);
  CHECK(bad.picture->problem.find("two-sizes.mjpeg") != std::string::npos);
  CHECK(bad.picture->bgr.size() == cv::Size(128, 96));
  CHECK(bad.picture->problem.find("frame 6") != std::string::npos);
  CHECK(cv::norm(bad.picture->bgr, good.picture->bgr, cv::NORM_INF) == 0);
  CHECK(viewer.show(frame_of(revision(1, project), 3)).picture->problem.empty());
}

TEST_CASE("footage that takes for ever to open holds up neither the model nor other footage nor the end") {
  const TinyProject tiny;
  fs::resize_file(tiny.file("clip.mkv"), std::uintmax_t{1} << 38);  // sparse: its end is looked for for minutes
  Project project = sample("head-on");
  Project slow = project;
  slow.footage.video = tiny.file("clip.mkv");
  std::chrono::steady_clock::time_point end;
  {
    Viewer viewer;
    Wanted wanted = frame_of(revision(1, slow), 20);
    wanted.turntable = {{0, 0, {64, 64}}};
    viewer.want(wanted);
    const Shown waiting = viewer.wait([](const Shown& s) { return s.model && s.opening; });
    CHECK(waiting.scene == nullptr);
    CHECK(waiting.busy);
    CHECK_FALSE(viewer.show(frame_of(revision(2, project), 20)).opening);
    viewer.want(wanted);
    viewer.wait([](const Shown& s) { return s.opening; });
    CHECK(viewer.shown().picture->revision == 2);
    end = std::chrono::steady_clock::now();
  }
  CHECK(std::chrono::steady_clock::now() - end < std::chrono::seconds(3));
}

TEST_CASE("footage that is no video is grey and says why") {
  const TemporaryFolder folder;
  Project project = sample("head-on");
  REQUIRE(write_text(folder / "no.mp4", "this is no video", false));
  project.footage.calibration = resolved(project, project.footage.calibration);
  project.footage.video = folder / "no.mp4";
  Viewer viewer;
  const Shown shown = viewer.show(frame_of(revision(1, project), 0));
  CHECK(shown.scene->footage->problem.find("no.mp4") != std::string::npos);
}

TEST_CASE("a video that appears on disk is taken up by itself") {
  const TemporaryFolder folder;
  Project project = sample("head-on");
  const fs::path real = resolved(project, project.footage.video);
  project.footage.video = folder / "late.mp4";
  Viewer viewer;
  const Revision same = revision(1, project);
  viewer.show(frame_of(same, 20));
  CHECK_FALSE(viewer.shown().scene->footage->video.has_value());
  fs::copy_file(real, folder / "late.mp4");
  const Shown shown = viewer.wait([](const Shown& s) { return s.scene->footage->video && s.picture_is_current; });
  CHECK(shown.picture->problem.empty());
  CHECK(shown.scene->footage->shape.times_s.size() == 200);
}

TEST_CASE("a mask that is replaced on disk hides at once, without any edit") {
  const TemporaryFolder folder;
  const fs::path mask = folder / "mask.png";
  const auto put_mask = [&](uchar share) {
    std::vector<uchar> png;
    cv::imencode(".png", cv::Mat(960, 1280, CV_8UC1, cv::Scalar(share)), png);
    REQUIRE(write_text(mask, {reinterpret_cast<const char*>(png.data()), png.size()}, true));
  };
  put_mask(0);
  Project project = sample("head-on");
  project.footage.own_body_mask = mask;
  Viewer viewer;
  const Revision same = revision(1, project);
  REQUIRE(cv::countNonZero(viewer.show(frame_of(same, 100)).picture->mask) > 0);
  put_mask(255);
  viewer.wait([](const Shown& s) { return s.picture_is_current && cv::countNonZero(s.picture->mask) == 0; });
}

TEST_CASE("an attitude file that is saved again turns the camera at once, without any edit") {
  const TemporaryFolder folder;
  const fs::path gyro = folder / "gyro.csv";
  const std::string header = "frame,roll_deg,pitch_deg,yaw_deg\n";
  REQUIRE(write_text(gyro, header + "0,0,0,0\n", true));
  Project project = sample("head-on");
  project.camera.attitude_file = gyro;
  Viewer viewer;
  const Revision same = revision(1, project);
  REQUIRE(cv::countNonZero(viewer.show(frame_of(same, 100)).picture->mask) > 0);
  REQUIRE(write_text(gyro, header + "0,0,0,0\n100,0,0,90\n", true));  // looks away
  viewer.wait([](const Shown& s) { return s.picture_is_current && cv::countNonZero(s.picture->mask) == 0; });
}

TEST_CASE("other footage is opened aside and the old picture stays until it is there") {
  Viewer viewer;
  Project project = sample("head-on");
  const Shown before = viewer.show(frame_of(revision(1, project), 20));
  Project other = project;
  other.footage.video = "nowhere.mp4";
  viewer.want(frame_of(revision(2, other), 20));
  CHECK(viewer.shown().picture == before.picture);
  CHECK_FALSE(viewer.shown().picture_is_current);
  viewer.wait(is_current);
  // There and back faster than anything can be opened.
  for (std::uint64_t i = 0; i < 40; ++i) {
    viewer.want(frame_of(i % 2 == 0 ? revision(1, project) : revision(2, other), static_cast<int>(20 + i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(i % 7));
  }
  viewer.want(frame_of(revision(1, project), 20));
  const Shown after = viewer.wait([](const Shown& s) { return s.picture_is_current && s.scene->footage->video; });
  CHECK_FALSE(after.opening);
  CHECK(is_same_picture(after.picture->bgr, before.picture->bgr));
}

TEST_CASE("a wish beyond the footage shows its last frame") {
  Viewer viewer;
  const Revision project = revision(1, sample("head-on"));
  CHECK(viewer.show(frame_of(project, 5000)).picture->frame == 199);
  CHECK(viewer.show(frame_of(project, -1)).picture->frame == 0);
}
