// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <opencv2/imgproc.hpp>

#include "ego_motion/ego_motion.h"
#include "support/test_data.h"
#include "video/video_writer.h"

namespace sigs::test {

namespace {

Camera small_camera() {
  return {.lens = *Lens::make({.fx = 250, .fy = 250, .cx = 159.5, .cy = 119.5}), .size_px = {320, 240}};
}

Result<EgoMotion> estimate_of(const std::filesystem::path& folder, int frames, const cv::Mat& luma) {
  Frame frame = blank_frame(PixelLayout::gray, {320, 240}, {});
  luma.copyTo(frame.planes[0]);
  Result<VideoWriter> writer =
      VideoWriter::open(folder / "clip.mkv", {.size_px = {320, 240}, .layout = PixelLayout::gray});
  REQUIRE(writer);
  for (int n = 0; n < frames; ++n) {
    frame.time_s = n / 25.0;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
  Result<FrameSource> footage = FrameSource::open(folder / "clip.mkv");
  REQUIRE(footage);
  return estimate_ego_motion(*footage, small_camera(), {}, nullptr, {}, {});
}

}  // namespace

TEST_CASE("of a blank sky, and of an image that stands still, nothing is claimed and the frames are named") {
  cv::Mat noise(240, 320, CV_8UC1);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {9, 9}, 2);
  for (const cv::Mat& luma : {cv::Mat(240, 320, CV_8UC1, cv::Scalar(180)), noise}) {
    const TemporaryFolder folder;
    const Result<EgoMotion> motion = estimate_of(folder.path(), 20, luma);
    REQUIRE(motion);
    REQUIRE(motion->frames.size() == 20);
    for (std::size_t k = 1; k < 20; ++k) {
      CHECK(motion->frames[k].is_lost);
      CHECK(motion->frames[k].sd_rad.z == doctest::Approx(kUnknownRotation_rad));
    }
    bool is_named = false;
    for (const Warning& warning : motion->warnings)
      is_named = is_named || warning.what.find("1-19") != std::string::npos;
    CHECK(is_named);
    CHECK(track_of(*motion, "clip.mkv").ned_from_camera.values.size() == 1);
  }
}

TEST_CASE("footage of one frame is refused") {
  const TemporaryFolder folder;
  const Result<EgoMotion> motion = estimate_of(folder.path(), 1, cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)));
  REQUIRE_FALSE(motion);
  CHECK(motion.error().text().find("1 frame") != std::string::npos);
}

}  // namespace sigs::test
