// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/input_file.h"
#include "camera/camera.h"
#include "cli/program.h"
#include "support/test_data.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Frames of one grey: nothing moves, nothing has edges.
void write_even_clip(const std::filesystem::path& path) {
  Result<VideoWriter> writer = VideoWriter::open(path, {.size_px = {160, 120}, .layout = PixelLayout::gray});
  REQUIRE(writer);
  Frame frame = blank_frame(PixelLayout::gray, {160, 120}, {});
  for (int n = 0; n < 6; ++n) {
    frame.time_s = n / 25.0;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
}

}  // namespace

TEST_CASE("footage that shows no field of view is refused with the reason of each method, and nothing is written") {
  const TemporaryFolder folder;
  write_even_clip(folder / "even.mkv");
  const std::string clip = (folder / "even.mkv").string();
  const std::string out = (folder / "camera.xml").string();
  const Run run = run_sigs("calibrate " + clip + " --out " + out);
  CHECK(run.status == 65);
  for (const char* const word : {"gyroscope", "turns", "--fov", "--board"})
    CHECK_MESSAGE(run.err.find(word) != std::string::npos, run.err);
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(run_sigs("calibrate " + clip + " " + clip + " --out " + out).status == 64);
  CHECK(run_sigs("calibrate " + clip + " --out " + clip + " --force").status == 73);
  CHECK(run_sigs("calibrate " + clip + " --out " + out + " --log " + (folder / "none.csv").string()).status == 66);
}

TEST_CASE("a field of view that is given becomes a calibration that is marked as rough") {
  const TemporaryFolder folder;
  write_even_clip(folder / "even.mkv");
  const auto out = folder / "camera.xml";
  const auto json = folder / "camera.json";
  const auto plot = folder / "camera.png";
  const Run run = run_sigs("calibrate " + (folder / "even.mkv").string() + " --fov 90 --out " + out.string() +
                           " --json " + json.string() + " --plot " + plot.string());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.find("rough: field of view 90.0 degrees") != std::string::npos);
  const Result<Camera> camera = read_calibration(out);
  REQUIRE(camera);
  CHECK(camera->lens.parameters().fx == doctest::Approx(80));  // half of the width
  CHECK(read_text(out)->find("rough calibration") != std::string::npos);
  CHECK(nlohmann::json::parse(*read_text(json))["rough"] == true);
  CHECK_FALSE(cv::imread(plot.string()).empty());
}

TEST_CASE("the real coast clip shows its field of view by the gyroscope that the camera has recorded") {
  if (!has_real_data()) return;
  const TemporaryFolder folder;
  const auto json = folder / "coast.json";
  const Run run = run_sigs("calibrate " + (real_data() / "video/air_karma_gopro_coast.mp4").string() + " --out " +
                           (folder / "coast.xml").string() + " --json " + json.string());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const auto found = nlohmann::json::parse(*read_text(json));
  CHECK(found["source"] == "gyroscope");
  // The whole image's motion by phase correlation, against the gyroscope's axis, has 562.8 px per radian.
  CHECK(found["lens"]["focal_px"].get<double>() == doctest::Approx(562.8).epsilon(0.02));
  // The same has -13 to -15 ms (engine/ego_motion/README.md).
  CHECK(found["gyroscope"]["offset_s"].get<double>() == doctest::Approx(-0.014).epsilon(0.4));
}
