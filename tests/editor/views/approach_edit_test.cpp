// SPDX-License-Identifier: MIT
#include "editor/views/encounter/approach_edit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "editor/views/view_fixture.h"
#include "encounter/encounter.h"
#include "project/places.h"
#include "scene/flight.h"
#include "scene/scene_parts.h"
#include "spline/piecewise_cubic.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

FootageShape footage_of_8_s() {
  FootageShape shape{.size_px = {1280, 960}};
  for (int i = 0; i < 200; ++i) shape.times_s.push_back(0.04 * i);
  return shape;
}

Project flown_by(std::vector<WaypointSettings> waypoints) {
  Project project;
  project.camera.position_m = {0, 0, -150};
  project.camera.speed_mps = 22;
  project.intruders.resize(1);
  project.intruders[0].trajectory.waypoints = std::move(waypoints);
  return project;
}

// Flies past at frame 100, 4 s, where the camera is at X 88: 30 m to the right and 10 m above it.
Project passing() {
  return flown_by({{.frame = 0, .position_m = {288, 30, -160}}, {.frame = 199, .position_m = {-110, 30, -160}}});
}

// As the editor has it, without a window and without files: each edit opens a scene anew.
struct Authoring : ViewFixture {
  explicit Authoring(const Project& project, std::shared_ptr<const PiecewiseCubic> path = {})
      : ViewFixture(project), camera_path(std::move(path)) {
    document.set_frame_count(200);
    open();
  }
  void open() {
    OpenedScene opened{.revision = document.revision().number,
                       .project = document.revision().project,
                       .draft = {.scene = bare_scene(document.project(), footage_of_8_s())}};
    Scene& scene = opened.draft.scene;
    scene.last_frame = 199;
    scene.motion.path = camera_path;
    for (std::size_t i = 0; i < document.project().intruders.size(); ++i) {
      scene.intruders.push_back(
          {.name = "intruder", .trajectory = scene_trajectory(document.project(), i, scene).value()});
      opened.draft.intruder_of_project.push_back(static_cast<int>(i));
    }
    shown.scene = std::make_shared<const OpenedScene>(std::move(opened));
  }
  void apply() {
    ViewFixture::apply();
    open();
  }
  [[nodiscard]] PresentApproach present() const { return present_approach(context, 0).value(); }
  // One gesture of the form or the handle.
  std::string ask(const PlannedApproach& wanted) {
    const ApproachStart start = approach_start(context, 0).value();
    std::string reason = change_approach(context, start, wanted, "gesture");
    edits.end_gesture();
    apply();
    return reason;
  }
  [[nodiscard]] const std::vector<WaypointSettings>& waypoints() const {
    return document.project().intruders[0].trajectory.waypoints;
  }

  std::shared_ptr<const PiecewiseCubic> camera_path;
};

// By the search over the scene's flights, which knows nothing of the form: 1 mm and 1 ms.
void check_truth(const Authoring& it, const PlannedApproach& wanted) {
  const Scene& scene = it.shown.scene->draft.scene;
  const EncounterTrack own = encounter_track_of_camera(scene);
  const EncounterTrack flight = encounter_track_of_intruder(scene, 0);
  const NearestMoment found = encounter_of(own, flight, {}).value().nearest_horizontal;
  CHECK(std::abs(found.time_s - wanted.time_s) < 1e-3);
  CHECK(std::abs(found.horizontal_m - std::abs(wanted.miss_m)) < 1e-3);
  CHECK(std::abs(found.vertical_m - wanted.vertical_miss_m) < 1e-3);
  const RelativeQuantities then = relative_quantities(own.at(wanted.time_s), flight.at(wanted.time_s));
  CHECK(std::abs(then.horizontal_speed_mps - wanted.closing_speed_mps) < 1e-3);
}

std::shared_ptr<const PiecewiseCubic> curving_path() {
  return std::make_shared<const PiecewiseCubic>(interpolating_spline(std::vector<TimedWaypoint>{
      {-1, {-20, -3, -150}}, {1, {21, 1, -151}}, {3, {60, 12, -154}}, {5, {95, 31, -152}}, {9, {150, 84, -149}}}));
}

}  // namespace

TEST_CASE("the form is filled from the flight that is there") {
  const Authoring it(passing());
  const PresentApproach present = it.present();
  // The intruder flies 398 m in 7.96 s: 50 m/s towards the camera, which flies 22.
  CHECK(present.approach.closing_speed_mps == doctest::Approx(72));
  CHECK(present.approach.time_s == doctest::Approx(4));
  CHECK(present.frame == doctest::Approx(100));
  CHECK(present.approach.miss_m == doctest::Approx(30));
  CHECK(present.approach.vertical_miss_m == doctest::Approx(10));
  CHECK(std::abs(present.approach.bearing_rad) < 1e-9);
  CHECK(present.is_within);
  CHECK(present.is_straight);
}

TEST_CASE("an encounter asked for comes true, with a straight camera and one that curves as its log says") {
  const PlannedApproach wanted{.time_s = 5.123,
                               .miss_m = -42.5,
                               .vertical_miss_m = 17.25,
                               .closing_speed_mps = 61,
                               .climb_mps = -1.5,
                               .bearing_rad = 35 * kDegree};
  for (const auto& path : {std::shared_ptr<const PiecewiseCubic>(), curving_path()}) {
    Authoring it(passing(), path);
    CHECK(it.ask(wanted).empty());
    CHECK(it.waypoints().size() == 2);
    check_truth(it, wanted);
    const PresentApproach present = it.present();
    CHECK(present.approach.miss_m == doctest::Approx(wanted.miss_m));
    CHECK(present.approach.bearing_rad == doctest::Approx(wanted.bearing_rad));
  }
}

TEST_CASE("a drag of many steps is one step of undo, and each step is measured from its beginning") {
  Authoring it(passing());
  const Project before = it.document.project();
  const ApproachStart start = approach_start(it.context, 0).value();
  PlannedApproach wanted = start.present.approach;
  for (int step = 1; step <= 20; ++step) {
    wanted.miss_m = 30 + step;
    CHECK(change_approach(it.context, start, wanted, "drag").empty());
    it.apply();
  }
  it.edits.end_gesture();
  it.apply();
  check_truth(it, wanted);
  CHECK(it.document.undo_name() == "change closest approach");
  it.edits.undo();
  it.apply();
  CHECK(it.document.project() == before);
  CHECK_FALSE(it.document.can_undo());
}

namespace {

Project curving() {
  return flown_by({{.frame = 0, .position_m = {300, 20, -160}},
                   {.frame = 90, .position_m = {110, 45, -165}},
                   {.frame = 199, .position_m = {-120, 10, -150}}});
}

// The horizontal acceleration in the middle of the clip, by differences of the flight's positions.
glm::dvec3 acceleration_mps2(const Authoring& it, double time_s) {
  const EncounterTrack flight = encounter_track_of_intruder(it.shown.scene->draft.scene, 0);
  constexpr double kStep_s = 0.05;
  const auto at = [&](double t_s) { return flight.at(t_s).position_m; };
  return (at(time_s + kStep_s) - 2.0 * at(time_s) + at(time_s - kStep_s)) / (kStep_s * kStep_s);
}

// By the search over the scene's flights.
NearestMoment nearest_3d(const Authoring& it) {
  const Scene& scene = it.shown.scene->draft.scene;
  return encounter_of(encounter_track_of_camera(scene), encounter_track_of_intruder(scene, 0), {}).value().nearest;
}

}  // namespace

TEST_CASE("a miss moves a curved flight as a whole") {
  const Project curved = curving();
  Authoring it(curved);
  CHECK_FALSE(it.present().is_straight);
  PlannedApproach wanted = it.present().approach;
  wanted.miss_m += 12;
  wanted.vertical_miss_m -= 7;
  CHECK(it.ask(wanted).empty());
  REQUIRE(it.waypoints().size() == 3);
  check_truth(it, wanted);
  const glm::dvec3 moved_m = it.waypoints()[1].position_m - curved.intruders[0].trajectory.waypoints[1].position_m;
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(glm::distance(it.waypoints()[i].position_m - curved.intruders[0].trajectory.waypoints[i].position_m,
                        moved_m) < 1e-9);
  CHECK(moved_m.z == doctest::Approx(7));
}

TEST_CASE("a curve stays a curve of the same accelerations whatever number is changed, and the number comes true") {
  struct Change {
    const char* name;
    void (*make)(PlannedApproach&);
  };
  const Change changes[] = {{"speed", [](PlannedApproach& a) { a.closing_speed_mps = 80; }},
                            {"time", [](PlannedApproach& a) { a.time_s += 0.7; }},
                            {"bearing", [](PlannedApproach& a) { a.bearing_rad += 40 * kDegree; }},
                            {"climb", [](PlannedApproach& a) { a.climb_mps = 2.5; }}};
  for (const auto& path : {std::shared_ptr<const PiecewiseCubic>(), curving_path()})
    for (const Change& change : changes) {
      CAPTURE(change.name);
      Authoring it(curving(), path);
      const PlannedApproach before = it.present().approach;
      PlannedApproach wanted = before;
      change.make(wanted);
      const double size_mps2 = glm::length(acceleration_mps2(it, before.time_s));
      CHECK(size_mps2 > 0.5);
      const std::string reason = it.ask(wanted);
      CHECK_MESSAGE(reason.empty(), reason);
      CHECK(it.waypoints().size() == 3);
      CHECK_FALSE(it.present().is_straight);
      check_truth(it, wanted);
      CHECK(glm::length(acceleration_mps2(it, wanted.time_s)) == doctest::Approx(size_mps2).epsilon(1e-6));
    }
}

TEST_CASE("a curve becomes straight when that is asked for, and its closest approach stays") {
  Authoring it(curving());
  const PlannedApproach wanted = it.present().approach;
  CHECK(make_straight(it.context, approach_start(it.context, 0).value()).empty());
  it.apply();
  CHECK(it.waypoints().size() == 2);
  CHECK(it.present().is_straight);
  check_truth(it, wanted);
}

TEST_CASE("the least distance in space is shown, and comes true when it is asked for") {
  for (const Project& project : {passing(), curving()})
    for (const double distance_m : {12.5, 44.0, 90.0}) {
      Authoring it(project);
      CHECK(it.present().nearest_3d.range_m == doctest::Approx(nearest_3d(it).range_m));
      const ApproachStart start = approach_start(it.context, 0).value();
      const auto wanted = approach_at_distance(start, distance_m);
      REQUIRE(wanted);
      CHECK(wanted->miss_m / wanted->vertical_miss_m ==
            doctest::Approx(start.present.approach.miss_m / start.present.approach.vertical_miss_m));
      CHECK(it.ask(*wanted).empty());
      CHECK(std::abs(nearest_3d(it).range_m - distance_m) < 2e-3);  // found to 1 mm, shown to 1 cm
    }
  // 30 m beside and 10 m above in level flight: the closed form.
  CHECK(Authoring(passing()).present().nearest_3d.range_m == doctest::Approx(std::sqrt(1000.0)));
}

TEST_CASE("what cannot be is named and changes nothing") {
  Authoring it(passing());
  const Project before = it.document.project();
  const auto reason = [&](auto change) {
    PlannedApproach wanted = it.present().approach;
    change(wanted);
    return it.ask(wanted);
  };
  CHECK(reason([](PlannedApproach& a) { a.time_s = 8.5; }).starts_with("time: 8.5 s is outside of the clip"));
  CHECK(reason([](PlannedApproach& a) { a.closing_speed_mps = 0; }).starts_with("closing speed: "));
  CHECK(reason([](PlannedApproach& a) { a.miss_m = 3e8; }).find("1e8 m") != std::string::npos);
  CHECK(reason([](PlannedApproach& a) { a.vertical_miss_m = INFINITY; }) != "");
  CHECK(it.document.project() == before);
  CHECK_FALSE(it.document.can_undo());
}

TEST_CASE("a clip that ends before the closest approach says so, and a number makes one within") {
  Authoring it(
      flown_by({{.frame = 0, .position_m = {2000, 100, -150}}, {.frame = 199, .position_m = {1600, 60, -150}}}));
  const PresentApproach present = it.present();
  CHECK_FALSE(present.is_within);
  CHECK(present.frame == doctest::Approx(199));
  PlannedApproach wanted = present.approach;
  wanted.miss_m = 50;
  CHECK(it.ask(wanted).empty());
  CHECK(it.present().is_within);
  check_truth(it, wanted);
}

TEST_CASE("a hovering pair has no direction: the closing speed comes first") {
  Authoring it(flown_by({{.frame = 0, .position_m = {60, 5, -150}}}));
  it.document.apply(ChangeProject{"stop", [](Project& project) { project.camera.speed_mps = 0; }, ""});
  it.open();
  PlannedApproach wanted = it.present().approach;
  CHECK(wanted.closing_speed_mps == 0);
  wanted.vertical_miss_m = 10;
  CHECK(it.ask(wanted).starts_with("closing speed: "));
  wanted.closing_speed_mps = 30;
  wanted.time_s = 4;
  CHECK(it.ask(wanted).empty());
  check_truth(it, wanted);
}

TEST_CASE("waypoints that are places on the Earth stay places") {
  Project project = passing();
  project.geo = {.latitude_deg = 47.5, .longitude_deg = 8.25, .height_m = 400, .heading_deg = 30};
  for (WaypointSettings& waypoint : project.intruders[0].trajectory.waypoints) {
    const GeodeticPosition place = stated_frame(project.geo)->place_of(waypoint.position_m);
    waypoint.place = {place.latitude_deg, place.longitude_deg, place.height_m};
  }
  Authoring it(project);
  PlannedApproach wanted = it.present().approach;
  wanted.closing_speed_mps = 90;
  wanted.bearing_rad = -20 * kDegree;
  CHECK(it.ask(wanted).empty());
  for (const WaypointSettings& waypoint : it.waypoints()) CHECK(waypoint.place.has_value());
  check_truth(it, wanted);
}

TEST_CASE("while the scene is older than the document nothing can be started") {
  Authoring it(passing());
  it.document.apply(ChangeProject{"name", [](Project& project) { project.name = "other"; }, ""});
  CHECK_FALSE(approach_start(it.context, 0).has_value());
  CHECK(present_approach(it.context, 0).has_value());
  CHECK_FALSE(present_approach(it.context, 3).has_value());
  it.shown.scene.reset();
  CHECK_FALSE(present_approach(it.context, 0).has_value());
}
