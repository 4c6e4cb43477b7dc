// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/input_file.h"
#include "base/staged_outputs.h"
#include "cli/program.h"
#include "project/json.h"
#include "support/test_data.h"
#include "telemetry/track.h"
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
  CHECK(drawn.cols == 1440);  // of module plot
  CHECK(drawn.rows > 100);
  CHECK(run_sigs("telemetry " + csv).status == 0);
  CHECK(run_sigs(call + " --out " + csv).status == 73);
  CHECK(run_sigs(call + " --out " + (folder / "b.csv").string() + " --plot " + (folder / "b.svg").string()).status ==
        64);
  CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
}

TEST_CASE("a project is made to follow its footage's motion, with the file beside it and no mount's angles") {
  const TemporaryFolder folder;
  write_moving_noise(folder / "clip.mkv");
  const std::string project = (folder / "p.json").string();
  const std::string lens = (source_dir() / "assets/calibrations/sample.xml").string();
  REQUIRE(write_text(project,
                     R"({"sigs": 1, "name": "p", "footage": {"video": "clip.mkv", "calibration": ")" + lens +
                         R"("}, "camera": {"attitude_deg": {"roll": 1, "pitch": -18.7, "yaw": 4}}, "intruders": []})",
                     true));
  CHECK(run_sigs("ego-motion --into " + project + " --calibration " + lens).status == 64);
  const Run run = run_sigs("ego-motion --into " + project);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const Result<ReadProject> followed = read_project(project);
  REQUIRE(followed);
  const CameraSettings& camera = followed->project.camera;
  CHECK(camera.track.file == "p.attitude.csv");
  CHECK(camera.track.mount == TrackMountChoice::none);
  CHECK(camera.pitch_deg == -18.7);  // no horizon is in sight: it stays that of the start
  CHECK(camera.yaw_deg == 4);
  const Run again = run_sigs("ego-motion --into " + project);
  CHECK(again.status == 73);  // the file is there
  CHECK(run_sigs("ego-motion --into " + project + " --force").status == 0);
}

TEST_CASE("footage that shows nothing of its motion fails and leaves no file, unless that is allowed") {
  const TemporaryFolder folder;
  Result<VideoWriter> writer =
      VideoWriter::open(folder / "sky.mkv", {.size_px = {160, 120}, .layout = PixelLayout::gray});
  REQUIRE(writer);
  Frame frame = blank_frame(PixelLayout::gray, {160, 120}, {});
  for (int n = 0; n < 12; ++n) {
    frame.planes[0] = cv::Scalar(180 + n);
    frame.time_s = n / 25.0;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
  const std::string csv = (folder / "a.csv").string();
  const std::string call = "ego-motion " + (folder / "sky.mkv").string() + " --calibration " +
                           (source_dir() / "assets/calibrations/sample.xml").string() + " --out " + csv;
  const Run run = run_sigs(call);
  CHECK(run.status == 65);
  CHECK(run.err.find("11 of 12 frames") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(csv));
  const Run allowed = run_sigs(call + " --max-unknown 100");
  CHECK(allowed.status == 0);
  CHECK(allowed.err.find("warning: " + (folder / "sky.mkv").string() + ": how the camera turned") == 0);
}

TEST_CASE("attitudes of images are at the times that are stated") {
  const TemporaryFolder folder;
  cv::Mat noise(120, 240, CV_8UC1);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {5, 5}, 1.5);
  std::filesystem::create_directory(folder / "images");
  std::string times;
  for (int n = 0; n < 6; ++n) {
    cv::imwrite((folder / "images" / (std::to_string(n) + ".png")).string(), noise(cv::Rect(2 * n, 0, 160, 120)));
    times += std::to_string(0.1 * n + 0.01 * n * n) + "\n";
  }
  write_file(folder / "times.txt", times);
  const std::string call = "ego-motion " + (folder / "images").string() + " --calibration " +
                           (source_dir() / "assets/calibrations/sample.xml").string() + " --force --out " +
                           (folder / "a.csv").string();
  const auto last_time_s = [&](const std::string& options) {
    const Run run = run_sigs(call + options);
    REQUIRE_MESSAGE(run.status == 0, run.err);
    const Track track = read_track(folder / "a.csv", {}).value();
    return track.ned_from_camera.times_s.back();
  };
  CHECK(last_time_s("") == doctest::Approx(5 / 25.0));
  CHECK(last_time_s(" --frame-rate 10") == doctest::Approx(5 / 10.0));
  CHECK(last_time_s(" --timestamps " + (folder / "times.txt").string()) == doctest::Approx(0.75));  // 0.5 + 0.25
  CHECK(run_sigs(call + " --frame-rate 0").status == 64);
}

// A file of times with too few lines is refused only by who reads it.
TEST_CASE("every command that takes footage in images takes its times") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "images");
  cv::Mat noise(96, 128, CV_8UC1);
  cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (int n = 0; n < 4; ++n) cv::imwrite((folder / "images" / (std::to_string(n) + ".png")).string(), noise);
  write_file(folder / "times.txt", "0\n0.1\n0.4\n0.5\n");
  write_file(folder / "short.txt", "0\n0.1\n");
  const std::string images = (folder / "images").string(),
                    lens = (source_dir() / "assets/calibrations/sample.xml").string();
  const std::string times = " --timestamps " + (folder / "times.txt").string();
  for (const std::string& call :
       {"init " + images + " --out " + (folder / "p.json").string(), "appearance " + images,
        "compare " + images + " --frame 2 --box 50,40,20,20",
        "calibrate " + images + " --out " + (folder / "lens.xml").string(),
        "ego-motion " + images + " --calibration " + lens + " --out " + (folder / "a.csv").string()}) {
    CAPTURE(call);
    const Run refused = run_sigs(call + " --timestamps " + (folder / "short.txt").string());
    CHECK(refused.status == 65);
    CHECK(refused.err.find("short.txt") != std::string::npos);
    CHECK(run_sigs(call + times + " --frame-rate 10").status == 64);
  }
  const std::string project = (folder / "p.json").string();
  const Run matched = run_sigs("init " + images + times + " --out " + project);
  REQUIRE_MESSAGE(matched.status == 0, matched.err);
  // Noise shows no lens and no colours: one line, which names where the reasons are. The images keep their samples:
  // PNG.
  CHECK(matched.err.find("appearance.chroma_blur_px: the footage does not show them") != std::string::npos);
  CHECK(matched.err.find("p.notes.txt says why") != std::string::npos);
  CHECK(matched.err.find("found: appearance.codec.match: none") != std::string::npos);
  CHECK(matched.err.find("guessed: footage.spectrum: thermal: the footage is gray and as small") != std::string::npos);
  CHECK(read_project(project)->project.footage.timestamps == "times.txt");
  CHECK(run_sigs("appearance " + project + " --frame-rate 10").status == 64);
  CHECK(run_sigs("ego-motion --into " + project + times).status == 64);
}
