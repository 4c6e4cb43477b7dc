// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <memory>

#include "editor/preview/opened_footage.h"
#include "editor/views/inspector/problems.h"
#include "scene/draft.h"
#include "scene/scene_files.h"
#include "view_fixture.h"

namespace sigs::editor {
namespace {

constexpr int kFrames = 40;

Project with_intruders() {
  Project project;
  for (const char* const name : {"glider", "helicopter"}) {
    IntruderSettings intruder;
    intruder.name = name;
    intruder.trajectory.waypoints.resize(1);
    project.intruders.push_back(intruder);
  }
  return project;
}

struct Fixture : ViewFixture {
  Fixture() : ViewFixture(with_intruders()) {}

  // A newer revision, in which the intruders are in view in so many frames; surveyed: of how many frames that is known.
  void show(int glider, int helicopter, int surveyed = kFrames) {
    ++revision;
    SceneFiles files;
    auto scene = std::make_shared<OpenedScene>(
        OpenedScene{.revision = revision,
                    .project = std::make_shared<const Project>(with_intruders()),
                    .footage = std::make_shared<const Footage>(Footage{.video = VideoInfo{}}),
                    .draft = draft_scene(with_intruders(), placeholder_footage(with_intruders()), files)});
    scene->draft.scene.first_frame = 10;
    scene->draft.scene.last_frame = 10 + kFrames - 1;
    shown.scene = std::move(scene);
    shown.surveys.clear();
    for (const int visible : {glider, helicopter}) {
      auto survey = std::make_shared<Survey>();
      survey->revision = revision;
      survey->estimates.resize(static_cast<std::size_t>(surveyed));
      for (int n = 0; n < visible && n < surveyed; ++n)
        survey->estimates[static_cast<std::size_t>(n)].visibility_state = VisibilityState::in_view;
      shown.surveys.push_back(std::move(survey));
    }
  }

  std::uint64_t revision = 0;
  LossOfView loss;
};

TEST_CASE("a change that takes an intruder out of view is said once, with what was and what is") {
  Fixture window;
  CHECK_FALSE(window.loss.found(window.context));  // nothing is open
  window.show(40, 30);
  CHECK_FALSE(window.loss.found(window.context));  // nothing was before
  window.show(20, 30);
  CHECK_FALSE(window.loss.found(window.context));  // half is left
  window.show(20, 0);
  CHECK(window.loss.found(window.context) ==
        "helicopter is in view in 0 of 40 frames now, in 30 before this change; Undo takes it back");
  CHECK_FALSE(window.loss.found(window.context));
  window.show(20, 30);
  CHECK_FALSE(window.loss.found(window.context));  // taken back
  window.show(9, 30);
  CHECK(window.loss.found(window.context).value_or("").find("glider is in view in 9 of 40") == 0);
}

TEST_CASE("nothing is said of a survey that is not whole, until it is") {
  Fixture window;
  window.show(40, 40);
  CHECK_FALSE(window.loss.found(window.context));
  window.show(0, 40, kFrames / 2);
  CHECK_FALSE(window.loss.found(window.context));
  --window.revision;  // the same change, with all frames
  window.show(0, 40);
  CHECK(window.loss.found(window.context));
}

TEST_CASE("another project is not compared with the one before, nor are grey frames with footage") {
  Fixture window;
  window.show(40, 40);
  CHECK_FALSE(window.loss.found(window.context));
  window.show(0, 0);
  auto scene = std::make_shared<OpenedScene>(*window.shown.scene);
  scene->footage = std::make_shared<const Footage>(Footage{.problem = "cannot be read"});
  window.shown.scene = std::move(scene);
  CHECK_FALSE(window.loss.found(window.context));
  window.document = Document(with_intruders(), window.document.last_number() + 1);
  window.show(0, 0);
  CHECK_FALSE(window.loss.found(window.context));
}

}  // namespace
}  // namespace sigs::editor
