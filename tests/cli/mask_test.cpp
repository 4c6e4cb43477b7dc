// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "occlusion/detect.h"
#include "occlusion/synthetic_clip.h"
#include "support/test_data.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// The method that finds a body in so small a clip.
const std::string kPaper = " --method paper ";

struct Clip {
  TemporaryFolder folder;
  std::string video = (folder / "flight.mkv").string();
  std::string out = (folder / "out").string();

  explicit Clip(int frames = 40) { write_flight(video, frames); }
  [[nodiscard]] std::string mask() const { return out + "/m.png"; }
  [[nodiscard]] std::string command() const { return "mask " + video + kPaper + "--out " + mask() + " "; }
};

OwnBody expected(const std::string& video, int first_frame, int frames, int every = 1, double soft_edge_px = 1) {
  FrameSource footage = FrameSource::open(video).value();
  const OwnBodySettings settings{
      .method = OwnBodyMethod::paper, .frames = frames, .every = every, .soft_edge_px = soft_edge_px};
  return detect_own_body(footage, first_frame, settings, {}).value();
}

cv::Mat image(const std::string& path) {
  return cv::imread(path, cv::IMREAD_UNCHANGED);
}

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return !a.empty() && a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

std::string few_seconds(const std::string& video, const std::string& seconds) {
  return "warning: " + video + ": only " + seconds +
         " s of footage were looked through, parts of the world may be masked; look at the mask, or take 10 s or "
         "more\n";
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) found.push_back(line);
  return found;
}

}  // namespace

TEST_CASE("a mask is the detection's result, its path on stdout and its share on stderr") {
  const Clip clip;
  const Run run = run_sigs(clip.command() + "--confidence " + clip.out + "/sure.png");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.out == clip.mask() + "\n" + clip.out + "/sure.png\n");
  const OwnBody found = expected(clip.video, 0, 40);
  REQUIRE(found.share > 0.1);
  char line[80];
  std::snprintf(line, sizeof line, "own body: %.1f %% of the image, 40 frames used\n", 100 * found.share);
  CHECK(run.err == line + few_seconds(clip.video, "1.6"));
  CHECK(equal(image(clip.mask()), found.mask));
  CHECK(equal(image(clip.out + "/sure.png"), found.confidence));
  CHECK(image(clip.out + "/sure.png").type() == CV_16UC1);
}

TEST_CASE("without a name the mask is called after the video and lies in the current folder") {
  const Clip clip;
  fs::create_directories(clip.out);
  const std::string command =
      "cd " + clip.out + " && " + (build_dir() / "sigs").string() + " mask ../flight.mkv" + kPaper + ">/dev/null 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(equal(image(clip.out + "/flight.own-body.png"), expected(clip.video, 0, 40).mask));
}

TEST_CASE("the same command gives the same bytes twice and replaces a mask with force alone") {
  const Clip clip;
  REQUIRE(run_sigs(clip.command() + "--frames 20").status == 0);
  const std::string before = read_text(clip.mask()).value();
  const Run again = run_sigs(clip.command());
  CHECK(again.status == 73);
  CHECK(again.err == "error: " + clip.mask() + ": exists already; --force overwrites it\n");
  CHECK(read_text(clip.mask()).value() == before);
  CHECK(run_sigs(clip.command() + "--frames 20 --force").status == 0);
  CHECK(read_text(clip.mask()).value() == before);
}

TEST_CASE("options choose the frames and settings the rest") {
  const Clip clip;
  const Run run = run_sigs(clip.command() + "--frames 21 --every 4 --set own_body.soft_edge_px=6 --set " +
                           "footage.first_frame=10");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.find(", 6 frames used") != std::string::npos);
  CHECK(equal(image(clip.mask()), expected(clip.video, 10, 21, 4, 6).mask));
}

TEST_CASE("stages are numbered from the frame to the tinted mask") {
  const Clip clip;
  const std::string stages = clip.out + "/stages";
  const Run run = run_sigs(clip.command() + "--stages " + stages);
  CHECK_MESSAGE(run.status == 0, run.err);
  std::vector<std::string> names{clip.mask()};
  for (const char* const name : {"00_frame", "01_difference_sum", "02_canny", "03_dilated", "04_rough", "05_sobel",
                                 "06_closed", "07_padded", "08_filled", "09_refined", "10_overlay"})
    names.push_back(stages + "/" + name + ".png");
  CHECK(lines(run.out) == names);
  FrameSource footage = FrameSource::open(clip.video).value();
  const cv::Mat frame = bgr_of(footage.read(20).value());
  CHECK(equal(image(stages + "/00_frame.png"), frame));
  const cv::Mat overlay = image(stages + "/10_overlay.png");
  const cv::Mat mask = image(clip.mask());
  REQUIRE(overlay.size() == frame.size());
  // Untouched outside; inside halfway to magenta.
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x) {
      const cv::Vec3b before = frame.at<cv::Vec3b>(y, x);
      const cv::Vec3b after = overlay.at<cv::Vec3b>(y, x);
      if (mask.at<uchar>(y, x) == 0) CHECK(after == before);
      if (mask.at<uchar>(y, x) == 255) CHECK(std::abs(2 * after[1] - before[1]) <= 1);
    }
}

TEST_CASE("of a project the footage, range and settings are used, and other missing files do not matter") {
  const Clip clip;
  const std::string project = (clip.folder / "p.json").string();
  write_file(project, R"({"sigs": 1, "footage": {"video": "flight.mkv", "calibration": "gone.xml", "first_frame": 4,
    "last_frame": 29, "own_body_mask": "gone.png"}, "own_body": {"method": "paper", "soft_edge_px": 5, "every": 2}})");
  const Run run = run_sigs("mask " + project + " --out " + clip.mask());
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.find(", 13 frames used") != std::string::npos);
  CHECK(equal(image(clip.mask()), expected(clip.video, 4, 26, 2, 5).mask));
  REQUIRE(run_sigs("mask " + project + " --force --frames 10 --every 3 --out " + clip.mask()).status == 0);
  CHECK(equal(image(clip.mask()), expected(clip.video, 4, 10, 3, 5).mask));
}

TEST_CASE("a mask hides the intruder in the project whose footage it was made from") {
  TinyProject tiny;
  write_flight(tiny.file("clip.mkv"), 10, {64, 48});
  const std::string body = tiny.file("body.png").string();
  REQUIRE(run_sigs("mask " + tiny.project() + kPaper + "--out " + body).status == 0);
  const std::string command = "export " + tiny.project() + " --masks png --force --out " + tiny.out();
  const std::string intruder_png = tiny.out() + "/tiny.masks/frame_000005.png";
  REQUIRE(run_sigs(command).status == 0);
  const cv::Mat hidden = image(body) == 255;
  REQUIRE(cv::countNonZero(image(intruder_png) & hidden) > 0);
  const Run run = run_sigs(command + " --set footage.own_body_mask=body.png");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(cv::countNonZero(image(intruder_png) & hidden) == 0);
}

TEST_CASE("a mask from less than ten seconds of footage comes with a warning") {
  const TemporaryFolder folder;
  const std::string video = (folder / "c.mkv").string();
  const auto errors_of = [&](const std::string& more) {
    const Run run = run_sigs("mask " + video + kPaper + "--force --out " + (folder / "m.png").string() + " " + more);
    CHECK_MESSAGE(run.status == 0, run.err);
    return lines(run.err);
  };
  write_flight(video, 250);  // at 25 frames a second
  CHECK(errors_of("").size() == 1);
  CHECK(errors_of("--every 3").size() == 1);
  const std::vector<std::string> errors = errors_of("--frames 248");
  REQUIRE(errors.size() == 2);
  CHECK(errors[1] + "\n" == few_seconds(video, "9.9"));
}

TEST_CASE("a mask of more than half the image comes with a warning") {
  const TemporaryFolder folder;
  const std::string video = (folder / "c.mkv").string();
  for (const int height : {20, 60}) {
    write_luma_clip(video, 250, [height](int n) {
      cv::Mat luma = flight_luma(n);
      luma(cv::Rect(0, luma.rows - height, luma.cols, height)).setTo(40);
      return luma;
    });
    const Run run = run_sigs("mask " + video + kPaper + "--force --out " + (folder / "m.png").string());
    CHECK_MESSAGE(run.status == 0, run.err);
    const std::string warning = "\nwarning: " + video + ": more than half of the image is masked; look whether";
    CHECK_MESSAGE((run.err.find(warning) != std::string::npos) == (height == 60), run.err);
  }
}

TEST_CASE("progress of a detection ends at the last frame") {
  const Clip clip;
  CHECK(run_sigs(clip.command() + "--force --progress plain").err.find("frame 40 of 40, 0:00 left\n") !=
        std::string::npos);
  CHECK(run_sigs(clip.command() + "--force --progress json").err.find("{\"done\": 40, \"total\": 40, ") !=
        std::string::npos);
}

TEST_CASE("an interrupted detection exits with status 130 and leaves no file") {
  const TinyProject tiny(3000);
  const std::string program = (build_dir() / "sigs").string();
  const std::string video = tiny.file("clip.mkv").string();
  const std::string mask = tiny.out() + "/m.png";
  const std::string stages = tiny.out();
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), "sigs", "mask", video.c_str(), "--frames", "100000", "--out", mask.c_str(), "--stages",
          stages.c_str(), nullptr);
    _exit(127);
  }
  while (tiny.files_out() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK_FALSE(fs::exists(tiny.out()));
}

}  // namespace sigs::test
