// SPDX-License-Identifier: MIT
#include "export/export_files.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

const cv::Size kImageSize(64, 48);

VideoFormat images_format() {
  return {.codec = VideoCodec::png, .size_px = kImageSize, .layout = PixelLayout::gray};
}

VideoWriter images_in(const fs::path& folder) {
  fs::create_directories(folder);
  Result<VideoWriter> writer = VideoWriter::open(folder, images_format());
  REQUIRE(writer.has_value());
  return std::move(*writer);
}

std::string image_name(int number) {
  return "frame_00000" + std::to_string(number) + ".png";
}

// No image of this number can be written into the folder.
void block(const fs::path& folder, int number) {
  fs::create_directories(folder / image_name(number) / "wall");
}

int images_there(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) count += entry.is_regular_file() ? 1 : 0;
  return count;
}

ComposedFrame frame_to_write(int number) {
  ComposedFrame frame{.image = grainy_frame(kImageSize, number), .mask = cv::Mat(kImageSize, CV_8UC1, cv::Scalar(9))};
  frame.image.time_s = number / 25.0;
  frame.truth.index = number;
  return frame;
}

VideoInfo footage_info() {
  VideoInfo info;
  info.size_px = kImageSize;
  info.path = "footage.mkv";
  return info;
}

Scene empty_scene() {
  return {.camera = {*Lens::make({.fx = 100, .fy = 100, .cx = 50, .cy = 40}), kImageSize}};
}

}  // namespace

TEST_CASE("every frame passed to a writer is written after it has finished") {
  const Scenario scenario;
  const fs::path folder = scenario.path("images");
  WriterThread writer(images_in(folder));
  for (int n = 0; n < 9; ++n) {
    const Frame frame = grainy_frame(kImageSize, n, PixelLayout::gray);
    CHECK((n % 3 == 1 ? writer.put_blank(n / 25.0, n) : writer.put(frame, n)));
  }
  CHECK(!writer.join());
  CHECK(images_there(folder) == 9);
  CHECK(writer.finish().has_value());
  CHECK(writer.spent_s() > 0);
}

TEST_CASE("a writer reports the frame that failed and writes nothing after it") {
  const Scenario scenario;
  const fs::path folder = scenario.path("images");
  WriterThread writer(images_in(folder));
  block(folder, 3);
  block(folder, 5);
  bool goes_on = true;
  int handed_over = 0;
  for (; goes_on && handed_over < 1000; ++handed_over)
    goes_on = writer.put(grainy_frame(kImageSize, handed_over), handed_over % 9);
  CHECK(!goes_on);
  const std::optional<FrameFailure> failure = writer.join();
  REQUIRE(failure);
  CHECK(failure->frame == 3);
  CHECK(failure->error.kind == ErrorKind::write_failed);
  CHECK(images_there(folder) == 3);
}

TEST_CASE("a destroyed writer does not wait for queued frames") {
  const Scenario scenario;
  const fs::path folder = scenario.path("images");
  {
    WriterThread writer(images_in(folder));
    for (int n = 0; n < 3; ++n) CHECK(writer.put(grainy_frame(kImageSize, n), n));
  }
  CHECK(images_there(folder) <= 3);
}

TEST_CASE("of several failing outputs the first frame's error is reported and of one frame the video's") {
  struct Case {
    int video_fails_at, masks_fail_at;
    const char* told;
  };
  for (const Case& fault : {Case{5, 4, "masks"}, Case{4, 5, "video"}, Case{4, 4, "video"}, Case{8, 0, "masks"}})
    for (int run = 0; run < 5; ++run) {
      const auto& [video_fails_at, masks_fail_at, told] = fault;
      CAPTURE(fault.video_fails_at);
      CAPTURE(fault.masks_fail_at);
      Scenario scenario;
      scenario.project.output.codec = VideoCodec::png;
      scenario.project.output.masks = MasksChoice::png;
      scenario.project.output.labels = {};
      const ExportRequest request{.project = scenario.project, .folder = scenario.path("out")};
      Result<ExportFiles> files = ExportFiles::open({request, footage_info(), empty_scene(), {0, 8}});
      REQUIRE(files.has_value());
      // Unfinished images lie in the staging folder, under their final names.
      for (const auto& entry : fs::recursive_directory_iterator(scenario.path("out"))) {
        if (!entry.is_directory() || entry.path().parent_path().filename() != "new") continue;
        const bool is_masks = entry.path().filename().string().find("masks") != std::string::npos;
        block(entry.path(), is_masks ? masks_fail_at : video_fails_at);
      }
      Result<void> step;
      for (int n = 0; step && n <= 8; ++n) step = files->write(frame_to_write(n));
      if (step) step = files->join();
      REQUIRE(!step);
      const bool tells_masks = step.error().text().find(".masks") != std::string::npos;
      CHECK(tells_masks == (std::string(told) == "masks"));
      CHECK(step.error().text().find(image_name(std::min(video_fails_at, masks_fail_at))) != std::string::npos);
    }
}

}  // namespace sigs::test
