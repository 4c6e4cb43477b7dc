// SPDX-License-Identifier: MIT
#include "editor/preview/scoring.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "camera/lens.h"
#include "comes_true.h"
#include "preview_client.h"

namespace sigs::test {

using namespace sigs::editor;

namespace {

using Scene = std::shared_ptr<const OpenedScene>;
constexpr int kFrames = 40;

Scene scene_of(const Project& project) {
  FootageShape shape{.size_px = {1280, 960}, .frame_interval_s = 0.04};
  for (int i = 0; i < kFrames; ++i) shape.times_s.push_back(0.04 * i);
  auto footage = std::make_shared<Footage>(Footage{.shape = shape, .video = VideoInfo{}});
  OpenedScene scene{
      .content = content_id_of(project),
      .project = std::make_shared<const Project>(project),
      .footage = footage,
      .draft = {.scene = {.camera = {*Lens::make({LensModel::brown_conrady, 900, 900, 640, 480, {}}), {1280, 960}}}}};
  scene.draft.scene.footage = shape;
  scene.draft.scene.last_frame = kFrames - 1;
  return std::make_shared<const OpenedScene>(std::move(scene));
}

Project project_at(double height_m) {
  Project project;
  project.camera.position_m = {0, 0, -height_m};
  return project;
}

// Shows frames without intruders; `holds` keeps it from finishing.
struct TruthBuilderFixture {
  std::atomic<bool> holds = false;
  std::atomic<int> begun = 0;
  std::atomic<int> ended = 0;
  TruthBuilder maker{[] {},
                     [this](const Project&, int, const TruthBuilder::OnFrame& on_frame) { return stream(on_frame); },
                     std::chrono::milliseconds(1)};

  ~TruthBuilderFixture() { holds = false; }

  Result<void> stream(const TruthBuilder::OnFrame& on_frame) {
    ++begun;
    Result<void> step;
    for (int i = 0; i < kFrames && step; ++i) {
      while (holds && i == kFrames / 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      step = on_frame({.truth = {.index = i, .time_s = 0.04 * i}});
    }
    ++ended;
    return step;
  }

  bool finds(const Scene& scene) {
    return comes_true([&] {
      const TruthState state = maker.state();
      return state.clip != nullptr && state.scene == scene;
    });
  }
};

}  // namespace

TEST_CASE("the truth of a scene has all its frames, and their number in advance") {
  TruthBuilderFixture fixture;
  const Scene scene = scene_of(project_at(100));
  fixture.maker.want(scene);
  REQUIRE(fixture.finds(scene));
  const TruthState state = fixture.maker.state();
  CHECK(state.clip->frames() == kFrames);
  CHECK(state.done == kFrames);
  CHECK(state.total == kFrames);
  CHECK(fixture.begun == 1);
}

TEST_CASE("undo finds the truth measured before, and settings of the export change nothing") {
  TruthBuilderFixture fixture;
  const Scene first = scene_of(project_at(100));
  const Scene second = scene_of(project_at(200));
  fixture.maker.want(first);
  REQUIRE(fixture.finds(first));
  const auto clip = fixture.maker.state().clip;
  fixture.maker.want(second);
  REQUIRE(fixture.finds(second));
  CHECK(fixture.maker.state().clip != clip);
  CHECK(fixture.begun == 2);
  Project renamed = project_at(100);
  renamed.name = "another name";
  renamed.output.crf = 7;
  const Scene third = scene_of(renamed);
  fixture.maker.want(third);
  REQUIRE(fixture.finds(third));
  CHECK(fixture.maker.state().clip == clip);
  CHECK(fixture.begun == 2);
}

TEST_CASE("the work is abandoned for other images, and restarted when they come back") {
  TruthBuilderFixture fixture;
  fixture.holds = true;
  const Scene first = scene_of(project_at(100));
  const Scene second = scene_of(project_at(200));
  fixture.maker.want(first);
  REQUIRE(comes_true([&] { return fixture.maker.state().done > 0; }));
  CHECK(fixture.maker.state().clip == nullptr);
  fixture.maker.want(second);
  fixture.holds = false;
  REQUIRE(fixture.finds(second));
  CHECK(fixture.begun == 2);
  fixture.maker.want(first);
  REQUIRE(fixture.finds(first));
  CHECK(fixture.begun == 3);
}

TEST_CASE("the work continues where the images stay the same") {
  TruthBuilderFixture fixture;
  fixture.holds = true;
  const Scene first = scene_of(project_at(100));
  Project renamed = project_at(100);
  renamed.name = "another name";
  const Scene same = scene_of(renamed);
  fixture.maker.want(first);
  REQUIRE(comes_true([&] { return fixture.maker.state().done > 0; }));
  fixture.maker.want(same);
  fixture.holds = false;
  REQUIRE(fixture.finds(same));
  CHECK(fixture.begun == 1);
}

TEST_CASE("a request for nothing ends the work, and so does the end of the program") {
  TruthBuilderFixture fixture;
  fixture.holds = true;
  fixture.maker.want(scene_of(project_at(100)));
  REQUIRE(comes_true([&] { return fixture.maker.state().done > 0; }));
  fixture.maker.want(nullptr);
  fixture.holds = false;
  REQUIRE(comes_true([&] { return fixture.ended == 1; }));
  CHECK(fixture.maker.state().scene == nullptr);
  CHECK(fixture.maker.state().clip == nullptr);
}

TEST_CASE("footage that is missing and problems of the project are why there is no measured truth") {
  TruthBuilderFixture fixture;
  const Scene valid = scene_of(project_at(100));
  OpenedScene greyed = *valid;
  greyed.footage =
      std::make_shared<Footage>(Footage{.shape = valid->footage->shape, .problem = "gone.mp4: is not there"});
  fixture.maker.want(std::make_shared<const OpenedScene>(greyed));
  REQUIRE(comes_true([&] { return fixture.maker.state().problem == "gone.mp4: is not there"; }));
  OpenedScene faulty = *valid;
  faulty.draft.problems.push_back({"camera.speed_mps", "must be finite", ErrorKind::bad_project});
  fixture.maker.want(std::make_shared<const OpenedScene>(faulty));
  REQUIRE(comes_true([&] { return fixture.maker.state().problem == "the project has problems"; }));
  CHECK(fixture.begun == 0);
}

}  // namespace sigs::test
