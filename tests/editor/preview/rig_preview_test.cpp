// SPDX-License-Identifier: MIT
#include "editor/preview/rig_preview.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "editor/preview/surveys.h"
#include "preview_client.h"
#include "project/project.h"
#include "scene/scene_parts.h"

using namespace sigs;
using namespace sigs::editor;
using namespace sigs::test;

namespace {

FootageShape shape_at(double rate_hz, double begin_s, int frames) {
  FootageShape shape{.size_px = {640, 480}, .frame_interval_s = 1 / rate_hz};
  for (int i = 0; i < frames; ++i) shape.times_s.push_back(begin_s + i / rate_hz);
  return shape;
}

// By looking at every frame; of two that are as near the earlier.
int nearest_by_search(const std::vector<double>& times_s, double time_s) {
  int best = 0;
  for (int i = 0; i < static_cast<int>(times_s.size()); ++i)
    if (std::abs(times_s[static_cast<std::size_t>(i)] - time_s) <
        std::abs(times_s[static_cast<std::size_t>(best)] - time_s) - 1e-9)
      best = i;
  return best;
}

// 25 frames a second from 1.213 s on, beside a first camera of 30 from 0 on; it films until that has ended.
Scene second_of_rig() {
  Scene scene = bare_scene(Project(), shape_at(25, 1.213, 60));
  scene.first_frame = 0;
  scene.last_frame = 43;
  scene.timeline = Timeline{shape_at(30, 0, 90), 0, 89};
  return scene;
}

}  // namespace

TEST_CASE("a frame of the timeline is shown by the frame of a camera that is nearest in time") {
  const Scene scene = second_of_rig();
  for (int frame = 0; frame < 90; ++frame) {
    CAPTURE(frame);
    const double time_s = scene.timeline->footage.times_s[static_cast<std::size_t>(frame)];
    CHECK(own_frame_at(scene, frame) == nearest_by_search(scene.footage.times_s, time_s));
  }
  for (int frame = 0; frame < 43; ++frame) {
    const double time_s = scene.footage.times_s[static_cast<std::size_t>(frame)];
    CHECK(counted_frame_at(scene, frame) == nearest_by_search(scene.timeline->footage.times_s, time_s));
  }
  Scene alone = scene;
  alone.timeline.reset();
  CHECK(own_frame_at(alone, 17) == 17);
  CHECK(own_frame_at(alone, 99) == 59);
  CHECK(counted_frame_at(alone, 17) == 17);
  CHECK(counted_frames(alone).last_frame == 43);
}

TEST_CASE("a camera films in the frames of the timeline whose times lie within its own") {
  const Scene scene = second_of_rig();
  const CountedFrames filmed = filmed_frames(scene);
  // From 1.213 s less half of 40 ms, that is 35.8 frames of 1/30 s.
  CHECK(filmed.first_frame == 36);
  CHECK(filmed.last_frame == 88);  // 1.213 + 43 / 25 + 0.02 = 2.953 s lies in frame 88
  CHECK(counted_frames(scene).first_frame == 0);
}

TEST_CASE(
    "on the timeline a survey has the state of the nearest frame of the camera, and its flags are there in time") {
  const Scene scene = second_of_rig();
  auto own = std::make_shared<Survey>(Survey{.revision = 3, .first_frame = 0});
  for (int frame = 0; frame <= 43; ++frame) {
    own->estimates.push_back({.frame = frame, .distance_m = 100.0 + frame});
    own->flight.push_back({.time_s = scene.footage.times_s[static_cast<std::size_t>(frame)]});
  }
  own->flags.push_back({.first_frame = 10, .last_frame = 20});
  own->closest = {.frame = 30, .time_s = scene.footage.times_s[30], .distance_m = 130};
  const std::shared_ptr<const Survey> counted = on_timeline(own, scene);
  CHECK(counted->revision == 3);
  CHECK(counted->first_frame == 36);
  REQUIRE(counted->estimates.size() == 53);
  for (std::size_t i = 0; i < counted->estimates.size(); ++i) {
    const int frame = 36 + static_cast<int>(i);
    const double time_s = scene.timeline->footage.times_s[static_cast<std::size_t>(frame)];
    CHECK(counted->estimates[i].frame == frame);
    CHECK(counted->estimates[i].distance_m == 100.0 + nearest_by_search(scene.footage.times_s, time_s));
    CHECK(std::abs(counted->flight[i].time_s - time_s) <= 0.02 + 1e-9);  // half of a frame of 25 a second
  }
  // Frames of 1/30 s.
  CHECK(counted->flags[0].first_frame == doctest::Approx(30 * scene.footage.times_s[10]));
  CHECK(counted->closest.frame == doctest::Approx(30 * scene.footage.times_s[30]));
  Scene alone = scene;
  alone.timeline.reset();
  CHECK(on_timeline(own, alone) == own);
  CHECK(on_timeline(nullptr, scene) == nullptr);
}

TEST_CASE("each camera of a rig is shown as a preview of its own would, by one playhead") {
  // The same footage twice: the second camera looks to the side and began ten frames later.
  Project project = sample("two-intruders");
  RigCamera camera{.name = "first", .footage = std::exchange(project.footage, {}), .mount = {}, .clock = {}};
  project.cameras = {camera, camera};
  project.cameras[1].name = "second";
  project.cameras[1].mount.yaw_deg = 4;
  project.cameras[1].clock.offset_s = 0.4;
  Document document(project);
  document.set_frame_count(200);
  RigPreview preview({}, [] {});
  const auto wait = [&](bool all_images, const auto& is_there) {
    for (int i = 0; i < 6000; ++i) {
      preview.want(document, {.active = {.revision = document.revision(),
                                         .frame = document.playhead(),
                                         .range_last = document.last_frame()},
                              .all_images = all_images});
      const std::vector<PreviewOutput>& shown = preview.shown(document);
      if (shown.size() == 2 && is_there(shown)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  document.apply(Edit(GoToFrame{50}));
  const auto has_surveys = [](const PreviewOutput& one) {
    return one.scene && !one.surveys.empty() && one.surveys[0] && !one.surveys[0]->estimates.empty();
  };
  REQUIRE(wait(false, [&](const auto& shown) {
    return shown[0].image_is_current && has_surveys(shown[0]) && has_surveys(shown[1]);
  }));
  // Nobody looks at the second one: of it the scene alone is known.
  CHECK(preview.shown(document)[1].image == nullptr);
  CHECK(preview.shown(document)[1].scene->draft.problems.empty());
  REQUIRE(wait(true, [](const auto& shown) { return shown[0].image_is_current && shown[1].image_is_current; }));
  const std::vector<PreviewOutput>& shown = preview.shown(document);
  const double interval_s = shown[0].scene->draft.scene.footage.times_s[1];
  CHECK(shown[0].image->frame == 50);
  CHECK(shown[1].image->frame == std::lround(50 - 0.4 / interval_s));
  // Its image is that of a project with it alone.
  PreviewClient alone;
  alone.want({.revision = {1, std::make_shared<const Project>(seen_by(project, 1))},
              .frame = shown[1].image->frame,
              .range_last = 199});
  const PreviewOutput expected = alone.wait([](const PreviewOutput& s) { return s.image_is_current; });
  CHECK(is_same_image(shown[1].image->bgr.whole(), expected.image->bgr.whole()));
  CHECK(shown[1].image->truth.intruders.size() == 2);
}
