// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <pugixml.hpp>
#include <string>
#include <thread>
#include <vector>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6;
constexpr MethodChoice kMethods[] = {MethodChoice::direct, MethodChoice::classic, MethodChoice::plain};

// A clip of six small frames through a distorting lens, with two aircraft, blur and an own body.
void prepare(Scenario& scenario, PixelLayout layout = PixelLayout::yuv420) {
  const cv::Size size = scenario.size_px();
  write_footage(scenario.path("footage.mkv"), size, kFrames, layout);
  write_calibration(scenario.path("lens.xml"), {160, 0, 81, 0, 161, 58, 0, 0, 1}, {-0.15, 0.03, 0.001, 0, 0}, size);
  cv::Mat body = cv::Mat::zeros(size, CV_8UC1);
  body.rowRange(size.height - 30, size.height).setTo(255);
  cv::imwrite(scenario.path("body.png").string(), body);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.footage.calibration = "lens.xml";
  scenario.project.footage.own_body_mask = "body.png";
  scenario.project.camera.speed_mps = 20;
  scenario.project.compositing.blur_px_per_m = 0.02;
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {40, -6, -148}},
                                                           {.frame = 5, .position_m = {45, 9, -143}}};
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {70, 12, -151}},
                                                           {.frame = 5, .position_m = {66, -9, -150}}};
}

ExportReport exported(const Scenario& scenario, const std::string& folder, int jobs,
                      std::optional<FrameRange> frames = {}) {
  const Result<ExportReport> report = export_project(
      {.project = scenario.project, .folder = scenario.path(folder), .frames = frames, .jobs = jobs}, {});
  if (!report) FAIL(report.error().text());
  return *report;
}

const cv::Size kSize(160, 120);

}  // namespace

TEST_CASE("an export gives the same bytes on one thread and on several and every time") {
  constexpr VideoCodec kCodecs[] = {VideoCodec::ffv1, VideoCodec::h264,  VideoCodec::hevc,
                                    VideoCodec::av1,  VideoCodec::mjpeg, VideoCodec::png,
                                    VideoCodec::tiff, VideoCodec::jpeg,  VideoCodec::raw};
  Scenario scenario(kSize, kFrames);
  prepare(scenario);
  int number = 0;
  for (const MethodChoice method : kMethods)
    for (const VideoCodec codec : kCodecs) {
      CAPTURE(static_cast<int>(method));
      CAPTURE(static_cast<int>(codec));
      scenario.project.compositing.method = method;
      scenario.project.output.codec = codec;
      scenario.project.output.masks = codec == VideoCodec::png ? MasksChoice::png : MasksChoice::video;
      const std::string name = "out" + std::to_string(number++);
      const ExportReport report = exported(scenario, name + "a", 1);
      exported(scenario, name + "b", 2);
      exported(scenario, name + "c", 1);
      const auto files = contents_of(scenario.path(name + "a"));
      const int images = writes_images(codec) ? kFrames : 1;
      CHECK(files.size() == images + (codec == VideoCodec::png ? kFrames : 1) + 1);
      CHECK(report.written.size() == 3);
      CHECK(report.frames == kFrames);
      CHECK(files == contents_of(scenario.path(name + "b")));
      CHECK(files == contents_of(scenario.path(name + "c")));
    }
}

TEST_CASE("intruders larger than the image give the same bytes on every number of threads") {
  constexpr int kNearFrames = 8;
  Scenario scenario({640, 480}, kNearFrames);
  write_footage(scenario.path("footage.mkv"), scenario.size_px(), kNearFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {6, -3, -148}},
                                                           {.frame = 7, .position_m = {4, 2, -149}}};
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {
      {.frame = 0, .position_m = {2, 4, -151}}, {.frame = 7, .position_m = {-1, -2, -150}}};  // past the camera
  exported(scenario, "one", 1);
  const auto files = contents_of(scenario.path("one"));
  for (const int jobs : {2, 3, 8}) {
    CAPTURE(jobs);
    const std::string name = "on" + std::to_string(jobs);
    exported(scenario, name, jobs);
    CHECK(files == contents_of(scenario.path(name)));
  }
}

TEST_CASE("an exported frame is the very image that compose_frame gives") {
  for (const PixelLayout layout : {PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::gray})
    for (const MethodChoice method : kMethods) {
      if (layout != PixelLayout::yuv420 && method != MethodChoice::direct) continue;
      CAPTURE(static_cast<int>(layout));
      CAPTURE(static_cast<int>(method));
      Scenario scenario(kSize, kFrames);
      prepare(scenario, layout);
      scenario.project.compositing.method = method;
      exported(scenario, "out", 2);
      const RawVideo video = raw_video(scenario.path("out/lot.mkv"), kFrames);
      const RawVideo masks = raw_video(scenario.path("out/lot.masks.mkv"), kFrames);
      REQUIRE(video.images.size() == kFrames);
      REQUIRE(masks.images.size() == kFrames);
      const Scene scene = scenario.opened();
      for (int n = kFrames - 1; n >= 0; --n) {
        const ComposedFrame frame = composed(scene, n, grainy_frame(kSize, n, layout));
        for (std::size_t plane = 0; plane < static_cast<std::size_t>(frame.image.plane_count()); ++plane)
          CHECK(same_bytes(frame.image.planes[plane], video.images[static_cast<std::size_t>(n)].planes[plane]));
        REQUIRE(!frame.mask.empty());
        CHECK(same_bytes(frame.mask, masks.images[static_cast<std::size_t>(n)].planes[0]));
      }
    }
}

TEST_CASE("a frame does not depend on the frames and the thread and the context before it") {
  Scenario scenario(kSize, kFrames);
  prepare(scenario);
  const Scene scene = scenario.opened();
  std::vector<ComposedFrame> alone;
  for (int n = 0; n < kFrames; ++n) alone.push_back(composed(scene, n, grainy_frame(kSize, n)));
  const auto check_on_one_bench = [&](std::vector<int> order) {
    ComposeContext context;
    bool same = true;
    for (const int n : order) {
      const Result<ComposedFrame> frame = compose_frame(scene, n, grainy_frame(kSize, n), context);
      const ComposedFrame& truth = alone[static_cast<std::size_t>(n)];
      same = same && frame && same_planes(frame->image, truth.image) && same_bytes(frame->mask, truth.mask);
    }
    return same;
  };
  CHECK(check_on_one_bench({0, 1, 2, 3, 4, 5}));
  CHECK(check_on_one_bench({5, 0, 5, 3, 1, 4, 2, 0}));
  bool same[2] = {false, false};
  std::thread a([&] { same[0] = check_on_one_bench({3, 2, 1, 0}); });
  std::thread b([&] { same[1] = check_on_one_bench({0, 5, 1, 4}); });
  a.join();
  b.join();
  CHECK(same[0]);
  CHECK(same[1]);
}

TEST_CASE("keeping the stages does not change the image") {
  for (const MethodChoice method : kMethods) {
    CAPTURE(static_cast<int>(method));
    Scenario scenario(kSize, kFrames);
    prepare(scenario);
    scenario.project.compositing.method = method;
    const Scene scene = scenario.opened();
    const Frame background = grainy_frame(kSize, 2);
    const ComposedFrame plain = composed(scene, 2, background);
    ComposeContext context;
    const Result<ComposedFrame> looked = compose_frame(scene, 2, background, context, Stages::keep);
    REQUIRE(looked.has_value());
    CHECK(plain.stages.empty());
    CHECK(looked->stages.size() >= 5);
    CHECK(same_planes(plain.image, looked->image));
    CHECK(same_bytes(plain.mask, looked->mask));
    for (const Stage& stage : looked->stages) {
      CAPTURE(stage.name);
      CHECK(!stage.image.empty());
      CHECK((stage.image.type() == CV_8UC3 || stage.image.type() == CV_8UC1));
    }
    CHECK(looked->stages.back().name == "output");
    CHECK(same_bytes(looked->stages.back().image, bgr_of(plain.image)));
  }
}

TEST_CASE("the given background is unchanged") {
  Scenario scenario(kSize, kFrames);
  prepare(scenario);
  const Frame background = grainy_frame(kSize, 1);
  const ComposedFrame frame = composed(scenario.opened(), 1, background);
  CHECK(!same_planes(frame.image, background));
  CHECK(same_planes(background, grainy_frame(kSize, 1)));
}

TEST_CASE("a range of frames keeps the numbers and times of the footage") {
  Scenario scenario(kSize, kFrames);
  prepare(scenario);
  exported(scenario, "whole", 1);
  exported(scenario, "part", 2, FrameRange{2, 4});
  const RawVideo whole = raw_video(scenario.path("whole/lot.mkv"), 100);
  const RawVideo part = raw_video(scenario.path("part/lot.mkv"), 100);
  REQUIRE(part.images.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t plane = 0; plane < 3; ++plane)
      CHECK(same_bytes(part.images[i].planes[plane], whole.images[i + 2].planes[plane]));

  pugi::xml_document document;
  REQUIRE(document.load_file(scenario.path("part/lot.xml").c_str()));
  const pugi::xml_node footage = document.child("sigs").child("footage");
  CHECK(footage.attribute("first_frame").as_int() == 2);
  CHECK(footage.attribute("last_frame").as_int() == 4);
  CHECK(std::string(footage.attribute("video").value()) == "footage.mkv");
  int number = 2;
  for (const pugi::xml_node frame : document.child("sigs").children("frame")) {
    CHECK(frame.attribute("index").as_int() == number);
    CHECK(frame.attribute("time_s").as_double() == doctest::Approx(number / 25.0).epsilon(1e-9));
    ++number;
  }
  CHECK(number == 5);

  scenario.project.output = {.codec = VideoCodec::png, .masks = MasksChoice::png};
  exported(scenario, "images", 2, FrameRange{2, 4});
  for (const char* const folder : {"images/lot", "images/lot.masks"}) {
    CHECK(!fs::exists(scenario.path(folder) / "frame_000001.png"));
    for (const char* const name : {"frame_000002.png", "frame_000003.png", "frame_000004.png"})
      CHECK(fs::exists(scenario.path(folder) / name));
    CHECK(!fs::exists(scenario.path(folder) / "frame_000005.png"));
  }
}

TEST_CASE("the annotation file says what compose_frame measures") {
  Scenario scenario(kSize, kFrames);
  prepare(scenario);
  exported(scenario, "out", 2);
  pugi::xml_document document;
  REQUIRE(document.load_file(scenario.path("out/lot.xml").c_str()));
  const Scene scene = scenario.opened();
  int n = 0;
  for (const pugi::xml_node node : document.child("sigs").children("frame")) {
    const FrameTruth truth = composed(scene, n, grainy_frame(kSize, n)).truth;
    CHECK(node.attribute("index").as_int() == n);
    CHECK(std::abs(node.child("camera").attribute("x_m").as_double() - truth.camera_position_m.x) < 1e-6);
    CHECK(truth.camera_position_m.x == doctest::Approx(20 * n / 25.0));  // 20 m/s, 25 frames a second
    std::size_t id = 0;
    for (const pugi::xml_node intruder : node.children("intruder")) {
      const IntruderTruth& wanted = truth.intruders.at(id);
      CHECK(intruder.attribute("id").as_int() == static_cast<int>(id));
      CHECK(std::abs(intruder.child("position").attribute("y_m").as_double() - wanted.position_m.y) < 1e-6);
      CHECK(std::abs(intruder.child("distance").attribute("m").as_double() - glm::length(wanted.position_m)) < 1e-6);
      CHECK(std::abs(intruder.child("silhouette").attribute("x").as_double() - wanted.amodal_box->x) < 1e-4);
      CHECK(std::abs(intruder.attribute("visible_fraction").as_double() - wanted.visible_fraction) < 1e-6);
      CHECK(intruder.child("box").attribute("width").as_int() == (wanted.visible_box ? wanted.visible_box->width : 0));
      ++id;
    }
    CHECK(id == 2);
    ++n;
  }
  CHECK(n == kFrames);
}

}  // namespace sigs::test
