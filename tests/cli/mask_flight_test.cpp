// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/program.h"
#include "docs/markdown.h"
#include "flights/flights.h"
#include "occlusion/detect.h"
#include "support/test_data.h"
#include "video/video_writer.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// As footage comes: H.264 in MP4.
void clip(const flights::Flight& flight, int frames, double rate_hz, const fs::path& path) {
  const VideoFormat format{
      .codec = VideoCodec::h264, .container = Container::mp4, .crf = 20, .size_px = flight.size_px};
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) throw std::runtime_error(writer.error().text());
  for (int n = 0; n < frames; ++n) {
    Frame frame = frame_of_bgr(flight.bgr(n), format.layout, format.color);
    frame.time_s = n / rate_hz;
    if (!writer->write(frame, n)) throw std::runtime_error("clip");
  }
  if (!writer->finish()) throw std::runtime_error("clip");
}

struct RenderedFlight {
  TemporaryFolder folder;
  flights::Flight flight;
  std::string video = (folder / "flight.mp4").string();
  std::string mask = (folder / "mask.png").string();

  explicit RenderedFlight(const std::string& name, int frames = 120, double rate_hz = 25)
      : flight(flights::by_name(name, {.size_px = {320, 240}, .frames = frames})) {
    clip(flight, frames, rate_hz, video);
  }
  [[nodiscard]] Run run(const std::string& more = "") const {
    return run_sigs("mask " + video + " --out " + mask + " " + more);
  }
  [[nodiscard]] cv::Mat found() const { return cv::imread(mask, cv::IMREAD_UNCHANGED); }
};

// "`canny` edges; `closed`" names canny and closed.
std::vector<std::string> steps_named(const std::string& cell) {
  std::vector<std::string> names;
  std::istringstream in(cell);
  for (std::string step, name; std::getline(in, step, ';');) {
    std::istringstream(step) >> name;
    names.push_back(name);
  }
  return names;
}

// Between the frame and the overlay: FOLDER/03_closed.png is closed.
std::vector<std::string> steps_written(const std::string& out, const std::string& folder) {
  std::vector<std::string> names;
  for (const std::string& path : lines_of(out))
    if (path.starts_with(folder + "/")) names.push_back(fs::path(path).stem().string().substr(3));
  REQUIRE(names.size() >= 2);
  return {names.begin() + 1, names.end() - 1};
}

// Only what this run has written, though another method has written there before.
void check_alone_in(const std::string& folder, const std::string& out) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    CHECK_MESSAGE(out.find(entry.path().string() + "\n") != std::string::npos, entry.path().string());
}

}  // namespace

TEST_CASE("the aircraft's nose is detected in a flight's footage") {
  const RenderedFlight flight_clip("nose");
  const Run run = flight_clip.run();
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.starts_with("own body: "));
  CHECK(intersection_over_union(flight_clip.found(), flight_clip.flight.own_body) >= 0.9);
}

TEST_CASE("a flight without an own body in view gives a black mask and a note") {
  const RenderedFlight flight_clip("none");
  const Run run = flight_clip.run();
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.starts_with("own body: none found, 120 frames used; the mask is black\nwarning: "));
  CHECK_MESSAGE(run.err.find(": only 4.8 s of footage were looked through") != std::string::npos, run.err);
  CHECK(flight_clip.found().size() == flight_clip.flight.size_px);
  CHECK(cv::countNonZero(flight_clip.found()) == 0);
}

TEST_CASE("a stationary camera gives no mask and a reason") {
  const RenderedFlight flight_clip("still");
  const Run run = flight_clip.run();
  CHECK(run.status == 65);
  CHECK_MESSAGE(run.err.find("move") != std::string::npos, run.err);
  CHECK_MESSAGE(run.err.ends_with("; take a longer part of the flight, with turns\n"), run.err);
  CHECK_FALSE(fs::exists(flight_clip.mask));
}

TEST_CASE("two undecidable frames of a flight are reported as too few") {
  const RenderedFlight flight_clip("none");
  const Run run = flight_clip.run("--frames 2");
  CHECK(run.status == 65);
  CHECK_MESSAGE(run.err.starts_with("error: " + flight_clip.video + ": 2 frames are too few to tell: "), run.err);
  CHECK_MESSAGE(run.err.ends_with("; take a longer part of the flight, with turns\n"), run.err);
}

TEST_CASE("a detection that stops early reports when and gives nearly the same mask") {
  const RenderedFlight flight_clip("nose", 400, 10);
  REQUIRE(flight_clip.run().status == 0);
  const cv::Mat whole = flight_clip.found();
  const Run run = flight_clip.run("--force --set own_body.settled_percent=5");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(run.err.find("\nconverged after ") != std::string::npos, run.err);
  // The last check alone may have changed 5 %.
  CHECK(intersection_over_union(flight_clip.found(), whole) >= 0.9);
}

TEST_CASE("the command line's page names the steps of both methods in their order") {
  const RenderedFlight flight_clip("nose", 30);
  const auto rows = table_rows(page("command-line.md"), "| method | steps |");
  REQUIRE(rows.size() == 2);
  const std::string folder = (flight_clip.folder / "steps").string();
  for (const std::vector<std::string>& row : {rows[0], rows[1], rows[0]}) {
    const Run run = flight_clip.run("--force --method " + row[0] + " --stages " + folder);
    CHECK_MESSAGE(run.status == 0, run.err);
    CHECK_MESSAGE(steps_named(row[1]) == steps_written(run.out, folder), row[0]);
    check_alone_in(folder, run.out);
  }
}

TEST_CASE("the own body of the sample footage is found") {
  const TemporaryFolder folder;
  const std::string mask = (folder / "m.png").string();
  REQUIRE(run_sigs("mask " + (source_dir() / "assets/footage/sample.mp4").string() + " --out " + mask).status == 0);
  const cv::Mat truth =
      cv::imread((source_dir() / "assets/footage/sample_own_body.png").string(), cv::IMREAD_GRAYSCALE);
  CHECK(intersection_over_union(cv::imread(mask, cv::IMREAD_UNCHANGED), truth) >= 0.9);
}

}  // namespace sigs::test
