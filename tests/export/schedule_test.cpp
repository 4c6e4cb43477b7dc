// SPDX-License-Identifier: MIT
#include "export/schedule.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <stdexcept>

#include "base/staged_outputs.h"
#include "dataset/tiny_plan.h"
#include "export/export_project.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

using Videos = std::vector<std::size_t>;

// Of the first project: 100 frames of 640x512 each.
std::vector<PendingVideo> videos_of(const std::vector<Project>& projects, cv::Size footage_px = {640, 512}) {
  std::vector<PendingVideo> videos;
  for (const Project& project : projects) videos.push_back({&project, {0, 99}, footage_px});
  return videos;
}

Project of_clip(const std::string& clip, VideoCodec codec = VideoCodec::ffv1) {
  Project project;
  project.footage.video = clip;
  project.output.codec = codec;
  return project;
}

std::size_t largest(const Schedule& schedule) {
  std::size_t most = 0;
  for (const Batch& batch : schedule.batches) most = std::max(most, batch.videos.size());
  return most;
}

DatasetRequest with_jobs(const fs::path& folder, int jobs, bool resume = false) {
  return {.folder = folder, .source = synthetic_source(), .jobs = jobs, .resume = resume};
}

// Videos of the same clip, each with a flight and frames of its own.
struct PartlyCommonFrames : TinyPlan {
  explicit PartlyCommonFrames(VideoCodec codec = VideoCodec::ffv1) : TinyPlan(6, 12) {
    for (std::size_t i = 0; i < plan.videos.size(); ++i) {
      Project& project = plan.videos[i].project;
      project.footage.first_frame = static_cast<int>(i % 3);
      project.footage.last_frame = 11 - static_cast<int>(i % 2);
      project.output.codec = codec;
    }
  }
};

}  // namespace

TEST_CASE("videos of one clip with about the same frames share a decoder, in groups of about the same size") {
  const std::vector<Project> projects(20, of_clip("/a.mp4"));
  const Schedule schedule = schedule_of(videos_of(projects), 0, 2);
  REQUIRE(schedule.batches.size() == 3);
  std::set<std::size_t> all;
  for (const Batch& batch : schedule.batches) {
    CHECK(batch.kind == Batch::Kind::shared);
    CHECK(batch.videos.size() >= 6);
    CHECK(std::ranges::is_sorted(batch.videos));
    all.insert(batch.videos.begin(), batch.videos.end());
  }
  CHECK(all.size() == 20);
  CHECK(schedule.batches_at_a_time == 1);
  CHECK(schedule_of(videos_of(projects), 0, 96).batches_at_a_time == 3);
}

TEST_CASE("as many videos at a time as jobs says") {
  const std::vector<Project> projects(20, of_clip("/a.mp4"));
  for (const int jobs : {1, 2, 3, 5, 8, 16}) {
    CAPTURE(jobs);
    const Schedule schedule = schedule_of(videos_of(projects), jobs, 4);
    CHECK(largest(schedule) * static_cast<std::size_t>(schedule.batches_at_a_time) <= static_cast<std::size_t>(jobs));
    CHECK(largest(schedule) >= static_cast<std::size_t>(std::min(jobs, 6)) - (jobs == 3 ? 1 : 0));
    for (const Batch& batch : schedule.batches) CHECK((batch.kind == Batch::Kind::shared) == (batch.videos.size() > 1));
  }
}

TEST_CASE("other footage, other frames and frames that need quantisers are not shared") {
  std::vector<Project> projects{of_clip("/a.mp4"), of_clip("/b.mp4"), of_clip("/a.mp4"), of_clip("/a.mp4"),
                                of_clip("/a.mp4")};
  projects[2].footage.frame_rate_hz = 20;
  projects[3].appearance.codec.match = CodecMatchChoice::footage;
  std::vector<PendingVideo> videos = videos_of(projects);
  videos[4].frames = {51, 150};
  CHECK(largest(schedule_of(videos, 0, 2)) == 1);
  videos[4].frames = {50, 149};
  CHECK(schedule_of(videos, 0, 2).batches.front().videos == Videos{0, 4});
  videos[4].frames = {0, 200};
  CHECK(largest(schedule_of(videos, 0, 2)) == 1);
}

TEST_CASE(
    "fewer videos share a decoder where they need much memory, and none that encoders take most of the time for") {
  const std::vector<Project> lossless(8, of_clip("/a.mp4"));
  const std::vector<Project> coded(8, of_clip("/a.mp4", VideoCodec::h264));
  CHECK(largest(schedule_of(videos_of(lossless, {1280, 960}), 0, 2)) == 8);
  CHECK(largest(schedule_of(videos_of(lossless, {3840, 2160}), 0, 2)) == 2);
  CHECK(largest(schedule_of(videos_of(lossless, {7680, 4320}), 0, 2)) == 1);
  CHECK(largest(schedule_of(videos_of(coded, {64, 48}), 0, 2)) == 1);
}

TEST_CASE("each video of a shared batch gets a source of its own; none where the clip cannot be opened") {
  TinyPlan tiny(3, 6);
  std::vector<PendingVideo> videos;
  for (const PlannedVideo& video : tiny.plan.videos) videos.push_back({&video.project, {0, 5}, {64, 48}});
  const Schedule schedule = schedule_of(videos, 0, 2);
  REQUIRE(schedule.batches.size() == 1);
  std::atomic<int> shared{0};
  const auto read_all = [&](std::size_t video, FrameSource* footage) {
    for (int n = 0; footage != nullptr && n < 6; ++n) shared += footage->read(n).value().coded != nullptr ? 1 : 0;
    if (video == 1) throw std::runtime_error("of one");  // the others are read to their ends
  };
  CHECK_THROWS_AS(make_sharing(schedule.batches[0], videos, nullptr, read_all), std::runtime_error);
  CHECK(shared == 18);
  fs::remove(tiny.inputs().file("clip.mkv"));
  std::atomic<int> without{0};
  make_sharing(schedule.batches[0], videos, nullptr,
               [&](std::size_t, FrameSource* footage) { without += footage == nullptr ? 1 : 0; });
  CHECK(without == 3);
}

TEST_CASE("images are made one after the other, those of one clip together and forwards") {
  const std::vector<Project> projects(120, of_clip("/a.mp4", VideoCodec::png));
  std::vector<PendingVideo> images = videos_of(projects);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const int frame = static_cast<int>((i * 37) % 120);
    images[i].frames = {frame, frame};
  }
  const Schedule schedule = schedule_of(images, 0, 2);
  CHECK(schedule.batches.size() == 3);
  CHECK(schedule.batches_at_a_time == 2);
  int last = -1;
  for (const Batch& batch : schedule.batches) {
    CHECK(batch.kind == Batch::Kind::images);
    for (const std::size_t image : batch.videos) {
      CHECK(images[image].frames.first > last);
      last = images[image].frames.first;
    }
  }
}

TEST_CASE("videos that share a decoder have the bytes of exports of their own, however many they are") {
  for (const VideoCodec codec : {VideoCodec::ffv1, VideoCodec::png, VideoCodec::mjpeg}) {
    CAPTURE(static_cast<int>(codec));
    const PartlyCommonFrames tiny(codec);
    CHECK(made(tiny.plan, with_jobs(tiny.out("alone"), 1)).exported == 6);
    for (const int jobs : {0, 2, 4}) {
      CAPTURE(jobs);
      const fs::path folder = tiny.out("jobs" + std::to_string(jobs));
      CHECK(made(tiny.plan, with_jobs(folder, jobs)).exported == 6);
      CHECK(contents_of(folder) == contents_of(tiny.out("alone")));
    }
    const Project& project = tiny.plan.videos[4].project;
    REQUIRE(export_project({.project = project, .folder = tiny.out("export")}, {}));
    CHECK(text_of(tiny.out("export") / "v4.xml") == text_of(tiny.out("jobs0") / "v4/v4.xml"));
  }
}

TEST_CASE("a video that fails does not change the others that share its decoder") {
  PartlyCommonFrames tiny;
  CHECK(made(tiny.plan, with_jobs(tiny.out("whole"), 1)).exported == 6);
  tiny.plan.videos[1].project.intruders[0].model.file = tiny.inputs().file("none.obj").string();
  fs::create_directories(tiny.out() / "v3");
  write_file(tiny.out() / "v3/mine.txt", "mine");
  const DatasetReport report = made(tiny.plan, with_jobs(tiny.out(), 0, true));
  CHECK(report.exported == 4);
  REQUIRE(report.failures.size() == 2);
  CHECK(report.failures[0].video == "v1");
  CHECK(report.failures[0].error.kind == ErrorKind::cannot_read);
  CHECK(report.failures[1].video == "v3");
  CHECK(report.failures[1].error.kind == ErrorKind::cannot_create);
  for (const char* const video : {"v0", "v2", "v4", "v5"})
    CHECK(contents_of(tiny.out() / video) == contents_of(tiny.out("whole") / video));
}

TEST_CASE("each video of a damaged clip says so as it does alone") {
  TinyPlan tiny(4, 12);
  const fs::path clip = tiny.inputs().file("clip.mkv");
  std::string bytes = text_of(clip);
  bytes[bytes.size() * 3 / 4] = static_cast<char>(bytes[bytes.size() * 3 / 4] ^ 1);
  write_file(clip, bytes);
  std::vector<std::string> texts;
  for (const int jobs : {1, 0}) {
    const DatasetReport report = made(tiny.plan, with_jobs(tiny.out(), jobs));
    REQUIRE(report.failures.size() == 4);
    for (const VideoFailure& failure : report.failures) texts.push_back(failure.error.text());
  }
  CHECK(texts[0].find("damaged") != std::string::npos);
  for (const std::string& text : texts) CHECK(text == texts[0]);
}

TEST_CASE("an interruption ends all videos that share a decoder; resuming makes the rest, with the same bytes") {
  const PartlyCommonFrames tiny;
  CHECK(made(tiny.plan, with_jobs(tiny.out("whole"), 1)).exported == 6);
  for (const int frames : {1, 20, 40}) {
    CAPTURE(frames);
    const fs::path folder = tiny.out("stopped" + std::to_string(frames));
    std::atomic<bool> stop{false};
    const DatasetControl control{.progress = [&](int done, int) { stop = stop || done >= frames; }, .cancel = &stop};
    const Result<DatasetReport> report = make_dataset(tiny.plan, with_jobs(folder, 0), control);
    REQUIRE_FALSE(report);
    CHECK(report.error().kind == ErrorKind::interrupted);
    CHECK_FALSE(fs::exists(folder / ".part"));
    CHECK_FALSE(fs::exists(folder / "index.json"));
    CHECK(made(tiny.plan, with_jobs(folder, 0, true)).failures.empty());
    CHECK(contents_of(folder) == contents_of(tiny.out("whole")));
  }
}
