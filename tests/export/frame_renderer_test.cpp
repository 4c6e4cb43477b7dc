// SPDX-License-Identifier: MIT
#include "export/frame_renderer.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "export/frame_stream.h"
#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

constexpr int kFlightFrames = 6;
const cv::Size kFlightSize(160, 120);

// Two aircraft that fly through a clip of six frames.
void prepare_flight(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), kFlightSize, kFlightFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.camera.speed_mps = 20;
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {60, -6, -148}},
                                                           {.frame = 5, .position_m = {65, 9, -143}}};
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {90, 12, -151}},
                                                           {.frame = 5, .position_m = {86, -9, -150}}};
}

ComposedFrame rendered(FrameRenderer& renderer, const Project& project, int frame, const GivenPoses& poses = {}) {
  Result<ComposedFrame> composed = renderer.render(project, frame, poses);
  if (!composed) FAIL(composed.error().text());
  return std::move(*composed);
}

std::vector<ComposedFrame> streamed(const Project& project, int jobs) {
  FrameStream stream = FrameStream::open(project).value();
  stream.start(jobs);
  std::vector<ComposedFrame> frames;
  while (std::optional<ComposedFrame> frame = stream.next().value()) frames.push_back(std::move(*frame));
  return frames;
}

}  // namespace

TEST_CASE("frames rendered one by one in any order are those of the stream") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  const std::vector<ComposedFrame> all = streamed(scenario.project, 2);
  REQUIRE(all.size() == kFlightFrames);
  FrameRenderer renderer;
  for (const int frame : {4, 0, 5, 4, 1}) {
    const ComposedFrame one = rendered(renderer, scenario.project, frame);
    const ComposedFrame& other = all[static_cast<std::size_t>(frame)];
    CHECK(other.truth.index == frame);
    CHECK(same_planes(one.image, other.image));
    CHECK(same_bytes(one.mask, other.mask));
    CHECK(one.truth.intruders[0].position_m == other.truth.intruders[0].position_m);
  }
}

TEST_CASE("the truth has the boxes of real aircraft, clipped to the image, in their frames alone") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  write_file(scenario.path("real.csv"), "frame,label,x,y,w,h\n4,A,11,21,6,5\n4,A,151,1,40,10\n4,A,900,900,4,4\n");
  scenario.project.footage.real_aircraft = "real.csv";
  FrameRenderer renderer;
  CHECK(rendered(renderer, scenario.project, 3).truth.real_aircraft.empty());
  // The pixel (1, 1) of the file is the first one.
  CHECK(rendered(renderer, scenario.project, 4).truth.real_aircraft ==
        std::vector<cv::Rect>{{10, 20, 6, 5}, {150, 0, 10, 10}});
  write_file(scenario.path("real.csv"), "frame,label,x,y,w,h\n4,A,11,x,6,5\n");
  const Result<ComposedFrame> wrong = FrameRenderer().render(scenario.project, 4);
  REQUIRE_FALSE(wrong);
  CHECK(wrong.error().text().find("footage.real_aircraft: ") != std::string::npos);
  CHECK(wrong.error().text().find("line 2") != std::string::npos);
}

TEST_CASE("frames of images have the times that the project states, also after these have changed") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  std::filesystem::create_directory(scenario.path("images"));
  for (int n = 0; n < kFlightFrames; ++n)
    cv::imwrite(scenario.path("images/" + std::to_string(n) + ".png").string(),
                cv::Mat(kFlightSize, CV_8UC3, cv::Scalar(90 + n, 80, 70)));
  std::ofstream(scenario.path("times.txt")) << "0\n0.05\n0.2\n0.7\n0.8\n1.1\n";
  Project project = scenario.project;
  project.footage.video = "images";
  FrameRenderer renderer;
  // Frame 3 by hand: 3 / 25, 3 / 10, the fourth line of the file, 3 / 5; the camera flies 20 m/s along X.
  const auto check_time = [&](double time_s) {
    const ComposedFrame one = rendered(renderer, project, 3);
    CHECK(one.image.time_s == doctest::Approx(time_s));
    CHECK(one.truth.time_s == doctest::Approx(time_s));
    CHECK(one.truth.camera_position_m.x == doctest::Approx(20 * time_s));
    const ComposedFrame other = std::move(streamed(project, 1)[3]);
    CHECK(same_planes(one.image, other.image));
    CHECK(one.truth.intruders[0].position_m == other.truth.intruders[0].position_m);
  };
  check_time(0.12);
  project.footage.frame_rate_hz = 10;
  check_time(0.3);
  project.footage.frame_rate_hz.reset();
  project.footage.timestamps = "times.txt";
  check_time(0.7);
  project.footage.timestamps.clear();
  project.footage.frame_rate_hz = 5;
  check_time(0.6);
}

TEST_CASE("a stream that is closed early ends its threads, and one can be started again") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  FrameStream stream = FrameStream::open(scenario.project).value();
  for (int pass = 0; pass < 2; ++pass) {
    stream.start(2);
    CHECK(stream.next().value()->truth.index == 0);
    CHECK(stream.next().value()->truth.index == 1);
  }
  CHECK(stream.range().last == kFlightFrames - 1);
}

TEST_CASE("a trajectory that changes from frame to frame uploads no mesh again") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  FrameRenderer renderer;
  CHECK(rendered(renderer, scenario.project, 2).op_counts.bytes_uploaded > 0);
  for (const double y_m : {0.0, 3.0, 6.0}) {
    scenario.project.intruders[0].trajectory.waypoints[0].position_m.y = y_m;
    CHECK(rendered(renderer, scenario.project, 2).op_counts.bytes_uploaded == 0);
    const GivenPoses poses{.intruders = {{.intruder = 1, .pose = {{80, y_m, -150}}}}};
    const ComposedFrame frame = rendered(renderer, scenario.project, 2, poses);
    CHECK(frame.op_counts.bytes_uploaded == 0);
    CHECK(frame.truth.intruders[1].position_m.y == doctest::Approx(y_m));
  }
}

TEST_CASE("an edited project is rendered as if it had been opened anew") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  FrameRenderer renderer;
  static_cast<void>(rendered(renderer, scenario.project, 3));
  write_obj(scenario.path("other.obj"), {{{-8, -3, -1}, {8, 3, 1}}}, 1);
  std::vector<Project> edits(4, scenario.project);
  edits[0].intruders[0].trajectory.waypoints[0].position_m.y = 4;
  edits[1].intruders[1].model.file = "other.obj";  // the first model is in use still
  edits[2].intruders.pop_back();
  edits[2].intruders[0].model.file = "other.obj";  // the first one is not
  edits[3].light.ambient = 0.9;
  for (const Project& edit : edits) {
    FrameRenderer fresh;
    CHECK(same_planes(rendered(renderer, edit, 3).image, rendered(fresh, edit, 3).image));
  }
}

TEST_CASE("poses hold for their call alone") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  FrameRenderer renderer;
  const ComposedFrame before = rendered(renderer, scenario.project, 3);
  const GivenPoses away{.intruders = {{.intruder = 0, .pose = {{-100, 0, 0}}}}};
  CHECK(!same_planes(rendered(renderer, scenario.project, 3, away).image, before.image));
  CHECK(same_planes(rendered(renderer, scenario.project, 3).image, before.image));
}

TEST_CASE("an error leaves a renderer that goes on") {
  Scenario scenario(kFlightSize, kFlightFrames);
  prepare_flight(scenario);
  FrameRenderer renderer;
  const ComposedFrame before = rendered(renderer, scenario.project, 3);
  write_footage(scenario.path("short.mkv"), kFlightSize, 2, PixelLayout::yuv420);
  Project wrong = scenario.project;
  wrong.footage.video = "short.mkv";
  wrong.intruders[0].model.file = "none.obj";
  CHECK(renderer.render(wrong, 0).error().kind == ErrorKind::cannot_read);
  wrong.footage.video = "none.mkv";
  CHECK(renderer.render(wrong, 0).error().kind == ErrorKind::cannot_read);
  for (const int frame : {-1, kFlightFrames}) {
    const Result<ComposedFrame> none = renderer.render(scenario.project, frame);
    REQUIRE(!none);
    CHECK(none.error().kind == ErrorKind::usage);
  }
  CHECK(same_planes(rendered(renderer, scenario.project, 3).image, before.image));
}

}  // namespace sigs::test
