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

#include "base/staged_outputs.h"
#include "cli/tiny_project.h"
#include "editor/preview/preview_output.h"
#include "preview_client.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

bool names(const std::vector<Problem>& problems, const std::string& field) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.field == field; });
}

bool is_plain_grey(const cv::Mat& bgr) {
  return cv::norm(bgr, cv::Mat(bgr.size(), CV_8UC3, cv::Scalar(bgr.at<cv::Vec3b>(0, 0))), cv::NORM_INF) == 0;
}

}  // namespace

TEST_CASE("without footage intruders are shown over grey") {
  Project project = sample("head-on");
  for (const char* video : {"", "nowhere.mp4"}) {
    project.footage.video = video;
    PreviewClient preview_client;
    const PreviewOutput shown = preview_client.show(frame_of(revision(1, project), 100));
    REQUIRE(shown.image->bgr.whole().size() == cv::Size(1280, 960));
    const cv::Vec3b grey = shown.image->bgr.whole().at<cv::Vec3b>(0, 0);
    CHECK(grey == cv::Vec3b::all(130));  // (128 - 16) * 255 / 219
    CHECK_FALSE(is_plain_grey(shown.image->bgr.whole()));
    CHECK_FALSE(shown.image->mask.empty());
    CHECK_FALSE(shown.scene->footage->video.has_value());
    CHECK_FALSE(shown.scene->footage->problem.empty());
    CHECK_FALSE(shown.opening);
    CHECK(shown.scene->footage->shape.times_s.size() == 250);
    preview_client.wait([](const PreviewOutput& s) { return s.cached.size() == 250 && s.cached[101]; });
  }
}

TEST_CASE("an empty project has an image") {
  PreviewClient preview_client;
  const PreviewOutput shown = preview_client.show(frame_of(revision(1, Project()), 3));
  CHECK(is_plain_grey(shown.image->bgr.whole()));
  CHECK(shown.surveys.empty());
  CHECK(shown.scene->draft.problems.size() > 0);
}

TEST_CASE("a missing model, calibration and mask are named and replaced by placeholders") {
  Project project = sample("head-on");
  project.intruders[0].model.file = "nowhere.obj";
  project.footage.calibration = "nowhere.xml";
  project.footage.own_body_mask = "nowhere.png";
  PreviewClient preview_client;
  PreviewRequest wanted = frame_of(revision(1, project), 100);
  wanted.turntable = {{0, 0, {64, 64}}};
  preview_client.want(wanted);
  const PreviewOutput shown = preview_client.wait([](const PreviewOutput& s) { return s.image_is_current && s.model; });
  CHECK_FALSE(shown.image->mask.empty());
  CHECK(names(shown.scene->draft.problems, "intruders[0].model.file"));
  CHECK(names(shown.scene->draft.problems, "footage.calibration"));
  CHECK(names(shown.scene->draft.problems, "footage.own_body_mask"));
  CHECK_FALSE(shown.model->problem.empty());
  CHECK_FALSE(shown.model->rgba.empty());  // the cross
}

TEST_CASE("an intruder without waypoints has an empty survey and a model that can be shown") {
  Project project = sample("head-on");
  project.intruders[0].trajectory.waypoints.clear();
  PreviewClient preview_client;
  PreviewRequest wanted = frame_of(revision(1, project), 100);
  wanted.turntable = {{0, 0, {64, 64}}};
  preview_client.want(wanted);
  const PreviewOutput shown =
      preview_client.wait([](const PreviewOutput& s) { return s.image_is_current && s.model && s.surveys.at(0); });
  CHECK(shown.image->mask.empty());
  CHECK(shown.surveys[0]->estimates.empty());
  CHECK(shown.model->problem.empty());
  wanted.turntable->intruder = 7;  // there is none
  preview_client.want(wanted);
  wanted.turntable->size_px = {0, 10};
  wanted.turntable->intruder = 0;
  preview_client.want(wanted);
  preview_client.wait([](const PreviewOutput& s) { return !s.busy; });
}

TEST_CASE("a frame that cannot be used shows the one that replaces it and says why, its neighbours are themselves") {
  // JPEG images one after the other; from the fifth on they have another size, which no frame source gives out.
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
  project.intruders.clear();  // which would be elsewhere in each frame
  PreviewClient preview_client;
  const PreviewOutput good = preview_client.show(frame_of(revision(1, project), 2));
  REQUIRE(good.scene->footage->video.has_value());
  CHECK(good.image->problem.empty());
  CHECK(good.image->bgr.whole().size() == cv::Size(128, 96));
  const PreviewOutput bad = preview_client.show(frame_of(revision(1, project), 6));
  CHECK(bad.image->frame == 6);
  CHECK(bad.image->problem.find("two-sizes.mjpeg") != std::string::npos);
  CHECK(bad.image->bgr.whole().size() == cv::Size(128, 96));
  CHECK(bad.image->problem.find("frame 6") != std::string::npos);
  CHECK(cv::norm(bad.image->bgr.whole(), good.image->bgr.whole(), cv::NORM_INF) == 0);
  CHECK(preview_client.show(frame_of(revision(1, project), 3)).image->problem.empty());
}

TEST_CASE("footage that never finishes opening delays neither the model nor other footage nor the end") {
  const TinyProject tiny;
  fs::resize_file(tiny.file("clip.mkv"), std::uintmax_t{1} << 38);  // sparse: its end is looked for for minutes
  Project project = sample("head-on");
  Project slow = project;
  slow.footage.video = tiny.file("clip.mkv");
  std::chrono::steady_clock::time_point end;
  {
    PreviewClient preview_client;
    PreviewRequest wanted = frame_of(revision(1, slow), 20);
    wanted.turntable = {{0, 0, {64, 64}}};
    preview_client.want(wanted);
    const PreviewOutput waiting = preview_client.wait([](const PreviewOutput& s) { return s.model && s.opening; });
    CHECK(waiting.scene == nullptr);
    CHECK(waiting.busy);
    CHECK_FALSE(preview_client.show(frame_of(revision(2, project), 20)).opening);
    preview_client.want(wanted);
    preview_client.wait([](const PreviewOutput& s) { return s.opening; });
    CHECK(preview_client.shown().image->revision == 2);
    end = std::chrono::steady_clock::now();
  }
  CHECK(std::chrono::steady_clock::now() - end < std::chrono::seconds(3));
}

TEST_CASE("a file that is not a video gives grey footage and a reason") {
  const TemporaryFolder folder;
  Project project = sample("head-on");
  REQUIRE(write_text(folder / "no.mp4", "this is no video", false));
  project.footage.calibration = resolved(project, project.footage.calibration);
  project.footage.video = folder / "no.mp4";
  PreviewClient preview_client;
  const PreviewOutput shown = preview_client.show(frame_of(revision(1, project), 0));
  CHECK(shown.scene->footage->problem.find("no.mp4") != std::string::npos);
}

TEST_CASE("a video that appears on disk is opened without a request") {
  const TemporaryFolder folder;
  Project project = sample("head-on");
  const fs::path real = resolved(project, project.footage.video);
  project.footage.video = folder / "late.mp4";
  PreviewClient preview_client;
  const Revision same = revision(1, project);
  preview_client.show(frame_of(same, 20));
  CHECK_FALSE(preview_client.shown().scene->footage->video.has_value());
  fs::copy_file(real, folder / "late.mp4");
  const PreviewOutput shown =
      preview_client.wait([](const PreviewOutput& s) { return s.scene->footage->video && s.image_is_current; });
  CHECK(shown.image->problem.empty());
  CHECK(shown.scene->footage->shape.times_s.size() == 200);
}

TEST_CASE("a mask that is replaced on disk takes effect at once, without any edit") {
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
  PreviewClient preview_client;
  const Revision same = revision(1, project);
  REQUIRE(cv::countNonZero(preview_client.show(frame_of(same, 100)).image->mask) > 0);
  put_mask(255);
  preview_client.wait(
      [](const PreviewOutput& s) { return s.image_is_current && cv::countNonZero(s.image->mask) == 0; });
}

TEST_CASE("an attitude file that is saved again turns the camera at once, without any edit") {
  const TemporaryFolder folder;
  const fs::path gyro = folder / "gyro.csv";
  const std::string header = "frame,roll_deg,pitch_deg,yaw_deg\n";
  REQUIRE(write_text(gyro, header + "0,0,0,0\n", true));
  Project project = sample("head-on");
  project.camera.attitude_file = gyro;
  PreviewClient preview_client;
  const Revision same = revision(1, project);
  REQUIRE(cv::countNonZero(preview_client.show(frame_of(same, 100)).image->mask) > 0);
  REQUIRE(write_text(gyro, header + "0,0,0,0\n100,0,0,90\n", true));  // looks away
  preview_client.wait(
      [](const PreviewOutput& s) { return s.image_is_current && cv::countNonZero(s.image->mask) == 0; });
}

TEST_CASE("other footage is opened in the background and the old image stays until then") {
  PreviewClient preview_client;
  Project project = sample("head-on");
  const PreviewOutput before = preview_client.show(frame_of(revision(1, project), 20));
  Project other = project;
  other.footage.video = "nowhere.mp4";
  preview_client.want(frame_of(revision(2, other), 20));
  CHECK(preview_client.shown().image == before.image);
  CHECK_FALSE(preview_client.shown().image_is_current);
  preview_client.wait(is_current);
  // To other footage and back faster than it can be opened.
  for (std::uint64_t i = 0; i < 40; ++i) {
    preview_client.want(frame_of(i % 2 == 0 ? revision(1, project) : revision(2, other), static_cast<int>(20 + i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(i % 7));
  }
  preview_client.want(frame_of(revision(1, project), 20));
  const PreviewOutput after =
      preview_client.wait([](const PreviewOutput& s) { return s.image_is_current && s.scene->footage->video; });
  CHECK_FALSE(after.opening);
  CHECK(is_same_image(after.image->bgr.whole(), before.image->bgr.whole()));
}

TEST_CASE("a request beyond the footage shows its last frame") {
  PreviewClient preview_client;
  const Revision project = revision(1, sample("head-on"));
  CHECK(preview_client.show(frame_of(project, 5000)).image->frame == 199);
  CHECK(preview_client.show(frame_of(project, -1)).image->frame == 0);
}
