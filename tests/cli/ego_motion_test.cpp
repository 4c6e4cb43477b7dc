// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/input_file.h"
#include "cli/program.h"
#include "support/test_data.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Twelve frames of random grey that moves by 2 px a frame.
void write_moving_noise(const std::filesystem::path& path) {
  cv::Mat noise(120, 240, CV_8UC1);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {5, 5}, 1.5);
  Result<VideoWriter> writer = VideoWriter::open(path, {.size_px = {160, 120}, .layout = PixelLayout::gray});
  REQUIRE(writer);
  Frame frame = blank_frame(PixelLayout::gray, {160, 120}, {});
  for (int n = 0; n < 12; ++n) {
    noise(cv::Rect(2 * n, 0, 160, 120)).copyTo(frame.planes[0]);
    frame.time_s = n / 25.0;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
}

}  // namespace

TEST_CASE("attitudes are written as CSV, a row for each frame, and drawn as a PNG") {
  const TemporaryFolder folder;
  write_moving_noise(folder / "clip.mkv");
  const std::string lens = (source_dir() / "assets/calibrations/sample.xml").string();
  const std::string csv = (folder / "a.csv").string();
  const std::string plot = (folder / "a.png").string();
  const std::string call = "ego-motion " + (folder / "clip.mkv").string() + " --calibration " + lens;
  const Run run = run_sigs(call + " --out " + csv + " --plot " + plot);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const std::string bytes = read_text(plot).value();
  CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const cv::Mat drawn = cv::imread(plot);
  CHECK(drawn.cols == 1200);
  CHECK(drawn.rows > 100);
  CHECK(run_sigs("telemetry " + csv).status == 0);
  CHECK(run_sigs(call + " --out " + csv).status == 73);
  CHECK(run_sigs(call + " --out " + (folder / "b.csv").string() + " --plot " + (folder / "b.svg").string()).status ==
        64);
  CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
}
