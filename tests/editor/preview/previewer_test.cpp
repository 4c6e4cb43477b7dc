// SPDX-License-Identifier: MIT
#include "editor/preview/preview_output.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <thread>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "export/export_project.h"
#include "preview_client.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

constexpr int kFrame = 120;  // the aircraft is large and its blur soft

Project moved(Project project, double by_m) {
  project.intruders[0].trajectory.waypoints[1].position_m.y += by_m;
  return project;
}

// By the engine's own functions, without the editor.
struct Engine {
  explicit Engine(const Project& project)
      : source(FrameSource::open(resolved(project, project.footage.video)).value()),
        scene(open_scene(project, shape_of(source.info())).value()) {}

  ComposedFrame composed(int frame, Stages stages = Stages::leave_out) {
    return compose_frame(scene, frame, source.read(frame).value(), context, stages).value();
  }

  FrameSource source;
  Scene scene;
  ComposeContext context;
};

}  // namespace

TEST_CASE("the preview is byte for byte what the program writes as a frame") {
  const TemporaryFolder folder;
  PreviewClient preview_client({.ahead = 0});
  std::uint64_t number = 0;
  for (const auto& [method, name] :
       {std::pair(MethodChoice::direct, "direct"), {MethodChoice::classic, "classic"}, {MethodChoice::plain, "plain"}})
    for (const char* project_name : {"head-on", "two-intruders"}) {
      Project project = sample(project_name);
      project.compositing.method = method;
      const std::string out = (folder / (std::string(name) + project_name)).string();
      const test::Run run = run_sigs("frame " + project.file.string() + " --frame " + std::to_string(kFrame) +
                                     " --set compositing.method=" + name + " --out " + out);
      REQUIRE_MESSAGE(run.status == 0, run.err);
      const cv::Mat written = cv::imread(out + "/frame_" + std::to_string(kFrame) + ".png", cv::IMREAD_UNCHANGED);
      const PreviewOutput shown = preview_client.show(frame_of(revision(++number, project), kFrame));
      REQUIRE(shown.image->problem.empty());
      CHECK(shown.image->frame == kFrame);
      CHECK(is_same_image(shown.image->bgr.whole(), written));
    }
}

TEST_CASE("with the camera's attitude known the preview is still what the program writes as a frame") {
  const TemporaryFolder folder;
  REQUIRE(
      write_text(folder / "gyro.csv", "frame,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n119,2,1,-3\n121,-2,3,-1\n", true));
  Project project = sample("head-on");
  project.camera.attitude_file = (folder / "gyro.csv").string();
  const std::string out = (folder / "out").string();
  const test::Run run = run_sigs("frame " + project.file.string() + " --frame " + std::to_string(kFrame) +
                                 " --set camera.attitude_file=" + project.camera.attitude_file + " --out " + out);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const cv::Mat written = cv::imread(out + "/frame_" + std::to_string(kFrame) + ".png", cv::IMREAD_UNCHANGED);
  PreviewClient preview_client({.ahead = 0});
  const PreviewOutput shaken = preview_client.show(frame_of(revision(1, project), kFrame));
  CHECK(is_same_image(shaken.image->bgr.whole(), written));
  project.camera.attitude_file.clear();
  CHECK_FALSE(is_same_image(preview_client.show(frame_of(revision(2, project), kFrame)).image->bgr.whole(), written));
}

TEST_CASE("mask, truth, untouched frame, stages and the other method are those of the engine") {
  const Project project = sample("head-on");
  Engine engine(project);
  PreviewClient preview_client({.ahead = 0});
  PreviewRequest wanted = frame_of(revision(1, project), kFrame);
  wanted.footage = true;
  wanted.stages = true;
  wanted.compare_with = MethodChoice::classic;
  preview_client.want(wanted);
  const PreviewOutput shown = preview_client.wait(
      [](const PreviewOutput& s) { return s.image_is_current && s.footage && s.staged && s.compared; });

  const ComposedFrame composed = engine.composed(kFrame, Stages::keep);
  CHECK(is_same_image(shown.image->bgr.whole(), bgr_of(composed.image)));
  CHECK(is_same_image(shown.image->mask, composed.mask));
  CHECK(shown.image->truth.time_s == composed.truth.time_s);
  CHECK(shown.image->truth.intruders.at(0).visible_fraction == composed.truth.intruders.at(0).visible_fraction);
  CHECK(is_same_image(shown.footage->whole(), bgr_of(engine.source.read(kFrame).value())));
  CHECK(is_same_image(shown.staged->bgr.whole(), bgr_of(composed.image)));
  REQUIRE(shown.staged->stages.size() == composed.stages.size());
  for (std::size_t i = 0; i < composed.stages.size(); ++i) {
    CHECK(shown.staged->stages[i].name == composed.stages[i].name);
    CHECK(is_same_image(shown.staged->stages[i].image, composed.stages[i].image));
  }
  Project classic = project;
  classic.compositing.method = MethodChoice::classic;
  CHECK(shown.compared->method == MethodChoice::classic);
  CHECK(is_same_image(shown.compared->bgr.whole(), bgr_of(Engine(classic).composed(kFrame).image)));
}

TEST_CASE("another lens after the first warps as by itself") {
  const TemporaryFolder folder;
  Project one = sample("head-on");
  one.compositing.method = MethodChoice::classic;
  Project other = one;
  const std::string path = (folder / "pinhole.yml").string();
  REQUIRE(write_text(path,
                     "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n"
                     "  data: [800., 0., 640., 0., 800., 480., 0., 0., 1.]\n"
                     "distortion_coefficients: !!opencv-matrix\n  rows: 1\n  cols: 4\n  dt: d\n"
                     "  data: [-0.2, 0.02, 0., 0.]\nimage_width: 1280\nimage_height: 960\n",
                     true));
  other.footage.calibration = path;
  PreviewClient preview_client({.ahead = 0});
  CHECK(is_same_image(preview_client.show(frame_of(revision(1, one), kFrame)).image->bgr.whole(),
                      bgr_of(Engine(one).composed(kFrame).image)));
  CHECK(is_same_image(preview_client.show(frame_of(revision(2, other), kFrame)).image->bgr.whole(),
                      bgr_of(Engine(other).composed(kFrame).image)));
}

TEST_CASE("boxes of real aircraft that are written anew reach the truth of the frame that is shown") {
  const TemporaryFolder folder;
  Project project = sample("head-on");
  project.footage.real_aircraft = (folder / "real.csv").string();
  REQUIRE(write_text(folder / "real.csv", "frame,label,x,y,w,h\n120,A,11,21,6,5\n", true));
  PreviewClient preview_client({.ahead = 0});
  const PreviewRequest wanted = frame_of(revision(1, project), kFrame);
  CHECK(preview_client.show(wanted).image->truth.real_aircraft == std::vector<cv::Rect>{{10, 20, 6, 5}});
  REQUIRE(write_text(folder / "real.csv", "frame,label,x,y,w,h\n120,A,111,21,60,50\n", true));
  preview_client.want(wanted);
  const std::vector<cv::Rect> moved_boxes{{110, 20, 60, 50}};
  preview_client.wait(
      [&](const PreviewOutput& s) { return s.image_is_current && s.image->truth.real_aircraft == moved_boxes; });
}

TEST_CASE("the next frames are composed ahead and a cached frame is shown at once") {
  PreviewClient preview_client({.cache_bytes = std::size_t(1) << 30, .ahead = 12});
  PreviewRequest wanted = frame_of(revision(1, sample("head-on")), 10);
  wanted.range_last = 18;
  preview_client.show(wanted);
  const PreviewOutput shown =
      preview_client.wait([](const PreviewOutput& s) { return s.cached.size() == 200 && s.cached[18]; });
  for (int frame = 0; frame < 200; ++frame)
    CHECK(shown.cached[static_cast<std::size_t>(frame)] == (frame >= 10 && frame <= 18));
  for (const int frame : {17, 11, 18, 10}) {
    wanted.frame = frame;
    preview_client.want(wanted);
    CHECK(preview_client.shown().image_is_current);
    CHECK(preview_client.shown().image->frame == frame);
  }
  wanted.revision = revision(2, moved(sample("head-on"), 5));
  preview_client.show(wanted);
  CHECK_FALSE(preview_client.shown().cached[17]);
  wanted.revision = revision(1, sample("head-on"));  // undo brings the whole revision back
  wanted.frame = 17;
  preview_client.want(wanted);
  CHECK(preview_client.shown().image_is_current);
}

TEST_CASE("a change that touches no image keeps the images") {
  PreviewClient preview_client;
  Project project = sample("head-on");
  const PreviewOutput before = preview_client.show(frame_of(revision(1, project), 30));
  project.name = "another";
  project.output.crf = 30;
  const PreviewOutput after = preview_client.show(frame_of(revision(2, project), 30));
  CHECK(after.image == before.image);
  const PreviewOutput opened = preview_client.wait([](const PreviewOutput& s) { return s.scene->revision == 2; });
  CHECK(opened.scene->project->name == "another");
}

TEST_CASE("while prefetching is paused nothing is fetched ahead") {
  PreviewClient preview_client;
  preview_client.set_prefetch_paused(true);
  preview_client.show(frame_of(revision(1, sample("head-on")), 10));
  preview_client.wait([](const PreviewOutput& s) { return !s.busy; });
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // far longer than edits are waited for
  const std::vector<bool> cached = preview_client.shown().cached;
  CHECK(std::count(cached.begin(), cached.end(), true) == 1);
  preview_client.set_prefetch_paused(false);
  preview_client.wait([](const PreviewOutput& s) { return s.cached[20]; });
}

TEST_CASE("a cache too small for anything still shows the right image") {
  const Project project = sample("head-on");
  PreviewClient preview_client({.cache_bytes = 1000, .ahead = 48});
  Engine engine(project);
  for (const int frame : {5, 6, 100})
    CHECK(is_same_image(preview_client.show(frame_of(revision(1, project), frame)).image->bgr.whole(),
                        bgr_of(engine.composed(frame).image)));
  preview_client.wait([](const PreviewOutput& s) { return !s.busy; });
}

TEST_CASE("a fast series of requests ends at the right image") {
  const Project project = sample("head-on");
  std::mt19937 random(3);
  PreviewClient preview_client({.cache_bytes = std::size_t(64) << 20, .ahead = 8});
  PreviewRequest wanted;
  for (int i = 1; i <= 400; ++i) {
    const auto any = [&random](int maximum) { return std::uniform_int_distribution<int>(0, maximum)(random); };
    const int step = any(60);
    wanted = frame_of(revision(static_cast<std::uint64_t>(1 + step), moved(project, step)), any(230) - 10);
    wanted.direction = any(1) == 0 ? 1 : -1;
    wanted.playing = any(1) == 0;
    wanted.footage = any(3) == 0;
    wanted.stages = any(9) == 0;
    if (any(30) == 0) wanted.compare_with = MethodChoice::plain;
    if (any(3) == 0) wanted.turntable = {{any(2), 0.1 * i, {64, 48}}};
    preview_client.want(wanted);
    if (i % 8 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(any(20)));
    const PreviewOutput shown = preview_client.shown();
    if (shown.image) CHECK(shown.image->problem.empty());
  }
  wanted = frame_of(revision(500, moved(project, 3.5)), kFrame);
  const PreviewOutput shown = preview_client.show(wanted);
  CHECK(shown.image->revision == 500);
  CHECK(is_same_image(shown.image->bgr.whole(), bgr_of(Engine(moved(project, 3.5)).composed(kFrame).image)));
}

TEST_CASE("edits that come faster than images do not stop the preview") {
  const Project project = sample("head-on");
  PreviewClient preview_client({.ahead = 0});
  preview_client.show(frame_of(revision(1, project), kFrame));
  std::uint64_t observed = 1;
  int images = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  for (std::uint64_t number = 2; std::chrono::steady_clock::now() < end; ++number) {
    preview_client.want(frame_of(revision(number, moved(project, 0.01 * static_cast<double>(number))), kFrame));
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
    const std::uint64_t shown = preview_client.shown().image->revision;
    CHECK(shown >= observed);  // never back in time
    images += shown != observed ? 1 : 0;
    observed = shown;
  }
  CHECK(images >= 5);  // some tens on any machine that is not overloaded
}

TEST_CASE("what is shown when a drag has ended is the frame that the program writes, whatever the camera's look") {
  const TemporaryFolder folder;
  PreviewClient preview_client({.ahead = 0});
  std::uint64_t number = 0;
  for (const bool has_look : {false, true}) {
    Project project = sample("head-on");
    project.footage.video = resolved(project, project.footage.video).string();
    project.footage.calibration = resolved(project, project.footage.calibration).string();
    project.footage.own_body_mask = resolved(project, project.footage.own_body_mask).string();
    project.intruders[0].model.file = resolved(project, project.intruders[0].model.file).string();
    if (has_look) {  // what changes pixels beyond the intruder's own
      project.appearance.sharpening = 1.5;
      project.appearance.sharpening_px = 2;
      project.appearance.chroma_blur_px = 2;
      project.appearance.grain = {.sd_dark = 2, .sd_bright = 3, .sd_chroma = 2};
      project.appearance.codec = {.match = CodecMatchChoice::h264, .quantiser = 30.0};
    }
    for (int step = 1; step <= 30; ++step) {
      preview_client.want(frame_of(revision(++number, moved(project, 0.2 * step)), kFrame));
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
    const PreviewOutput shown = preview_client.show(frame_of(revision(number, moved(project, 6)), kFrame));
    REQUIRE(shown.image->problem.empty());
    CHECK_FALSE(shown.image->bgr.patch.empty());

    const std::string name = has_look ? "look" : "plain";
    const std::filesystem::path file = folder / (name + ".json");
    REQUIRE(write_project(moved(project, 6), file, true));
    const std::string out = (folder / name).string();
    const test::Run run = run_sigs("frame " + file.string() + " --frame " + std::to_string(kFrame) + " --out " + out);
    REQUIRE_MESSAGE(run.status == 0, run.err);
    const cv::Mat written = cv::imread(out + "/frame_" + std::to_string(kFrame) + ".png", cv::IMREAD_UNCHANGED);
    CHECK(is_same_image(shown.image->bgr.whole(), written));
  }
}

TEST_CASE("all images of a drag share the footage under them, and the model by itself is not drawn again") {
  const Project project = sample("head-on");
  PreviewClient preview_client({.ahead = 0});
  PreviewRequest wanted = frame_of(revision(1, project), kFrame);
  wanted.turntable = {{0, 0.3, {64, 48}}};
  wanted.footage = true;
  preview_client.want(wanted);
  const PreviewOutput first =
      preview_client.wait([](const PreviewOutput& s) { return s.image_is_current && s.model && s.footage; });
  for (std::uint64_t number = 2; number <= 5; ++number) {
    wanted.revision = revision(number, moved(project, static_cast<double>(number)));
    const PreviewOutput shown = preview_client.show(wanted);
    CHECK(shown.image->bgr.ground.samples() == first.image->bgr.ground.samples());
    CHECK(shown.footage->samples() == first.image->bgr.ground.samples());
  }
  preview_client.wait([](const PreviewOutput& s) { return !s.busy; });
  CHECK(preview_client.shown().model == first.model);
  Project longer = project;
  longer.intruders[0].model.length_m = 40;
  wanted.revision = revision(6, longer);
  preview_client.want(wanted);
  const PreviewOutput shown = preview_client.wait([&](const PreviewOutput& s) { return s.model != first.model; });
  CHECK(shown.model->size_m.x > first.model->size_m.x);
}

#ifdef __SANITIZE_THREAD__
constexpr int kMoreFrames = 5000;  // until there are images: all takes many times as long
#else
constexpr int kMoreFrames = 0;
#endif

TEST_CASE("scrubbing faster than decoding still shows images") {
  PreviewClient preview_client({.ahead = 0});
  const Revision project = revision(1, sample("head-on"));
  preview_client.show(frame_of(project, 0));
  int last = 0;
  int images = 0;
  for (int turn = 0; turn < 250 || (turn < 250 + kMoreFrames && images < 3); ++turn) {
    preview_client.want(frame_of(project, 1 + turn * 37 % 199));
    std::this_thread::sleep_for(std::chrono::milliseconds(8));
    images += preview_client.shown().image->frame != last ? 1 : 0;
    last = preview_client.shown().image->frame;
  }
  CHECK(images >= 3);
}

TEST_CASE("a busy previewer is destroyed promptly") {
  // One step of either thread: a frame composed, or decoded from its keyframe on. On a busy machine that is measured.
  const auto before = std::chrono::steady_clock::now();
  PreviewClient({.ahead = 0}).show(frame_of(revision(1, sample("head-on")), 150));
  const auto step = std::chrono::steady_clock::now() - before;
  const auto promptly = std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(3), 2 * step);
  for (const int after_ms : {0, 5, 60, 300}) {
    std::chrono::steady_clock::time_point start;
    {
      PreviewClient preview_client;
      PreviewRequest wanted = frame_of(revision(1, sample("head-on")), 150);
      wanted.playing = true;
      wanted.turntable = {{0, 0.3, {200, 200}}};
      preview_client.want(wanted);
      std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
      start = std::chrono::steady_clock::now();
    }
    CHECK(std::chrono::steady_clock::now() - start < promptly);
  }
}
