// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include "dataset/flight_contexts.h"
#include "dataset/flight_plan.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const std::vector<CameraSettings> kCameras{
    {.speed_mps = 22},
    {.position_m = {50, 20, -2500}, .speed_mps = 0},
    {.position_m = {0, 0, -3000}, .roll_deg = -8, .pitch_deg = 4, .yaw_deg = 25, .speed_mps = 60}};

// The intruder's position in the image in percent, through the lens; far off where it has no image.
glm::dvec2 place_percent(const FlightContext& context, const glm::dvec3& from_camera_m) {
  const std::optional<glm::dvec2> pixel = context.lens.lens.pixel(in_camera(context, from_camera_m));
  if (!pixel) return glm::dvec2(1e9);
  return (*pixel + 0.5) / glm::dvec2(context.lens.size_px.width, context.lens.size_px.height) * 100.0;
}

struct ViewedFrame {
  glm::dvec3 from_camera_m{0, 0, 0};
  glm::dvec2 place_percent{0, 0};
};

std::vector<ViewedFrame> viewed_frames(const FlightContext& context, const PlannedFlight& flight) {
  const Trajectory trajectory = trajectory_of(context, flight);
  std::vector<ViewedFrame> frames;
  for (int frame = context.frames.first; frame <= context.frames.last; ++frame) {
    const glm::dvec3 p_m = relative_position_m(context, trajectory, time_of_frame_s(context.footage, frame));
    frames.push_back({p_m, place_percent(context, p_m)});
  }
  return frames;
}

bool in_image(const glm::dvec2& percent) {
  return percent.x > 0 && percent.x < 100 && percent.y > 0 && percent.y < 100;
}

// Runs a check for every lens and camera.
template <class Test>
void for_all_stages(const Test& test) {
  const FootageShape footage = footage_of(80, 0.01);
  for (const NamedLens& lens : example_lenses())
    for (const CameraSettings& camera : kCameras) {
      CAPTURE(lens.name);
      CAPTURE(camera.yaw_deg);
      test(FlightContext{.camera = camera, .lens = lens.camera, .footage = footage, .frames = {5, 74}});
    }
}

PlannedFlight planned(FlightKind kind, const std::map<std::string, double>& given, const FlightContext& context) {
  auto flight = planned_flight(kind, values_with(kind, given), context);
  if (!flight) FAIL(flight.error());
  return *flight;
}

// Points are rounded to 2^-10 m: in percent of the image, with a margin.
double rounding_percent(const FlightContext& context, const glm::dvec3& from_camera_m) {
  const double px_per_rad = context.lens.lens.pixels_per_radian(in_camera(context, from_camera_m));
  return 100.0 / 960 * px_per_rad * 0.001 / glm::length(from_camera_m) + 1e-6;
}

}  // namespace

TEST_CASE("a crossing begins and ends at the requested places in the image, with any lens and camera") {
  for_all_stages([](const FlightContext& context) {
    for (const FlightKind kind : {FlightKind::left_right, FlightKind::right_left}) {
      const double from = kind == FlightKind::left_right ? 25 : 75;
      const std::vector<ViewedFrame> frames = viewed_frames(
          context,
          planned(kind, {{"from_x_percent", from}, {"to_x_percent", 100 - from}, {"to_y_percent", 44}}, context));
      CHECK(glm::distance(frames.front().place_percent, {from, 40}) <
            rounding_percent(context, frames.front().from_camera_m));
      CHECK(glm::distance(frames.back().place_percent, {100 - from, 44}) <
            rounding_percent(context, frames.back().from_camera_m));
    }
  });
}

TEST_CASE("left to right goes right in every frame, right to left goes left") {
  for_all_stages([](const FlightContext& context) {
    const std::vector<ViewedFrame> right = viewed_frames(context, planned(FlightKind::left_right, {}, context));
    const std::vector<ViewedFrame> left = viewed_frames(context, planned(FlightKind::right_left, {}, context));
    for (std::size_t i = 1; i < right.size(); ++i) {
      CHECK(right[i].place_percent.x > right[i - 1].place_percent.x);
      CHECK(left[i].place_percent.x < left[i - 1].place_percent.x);
    }
  });
}

TEST_CASE("a crossing's minimum distance is the requested one") {
  for_all_stages([](const FlightContext& context) {
    const PlannedFlight flight = planned(FlightKind::left_right, {{"distance_m", 321}}, context);
    CHECK(flight.derived.at("nearest_m") == doctest::Approx(321).epsilon(1e-5));  // rounded points
    double nearest = 1e9;
    for (const ViewedFrame& frame : viewed_frames(context, flight))
      nearest = std::min(nearest, glm::length(frame.from_camera_m));
    CHECK(nearest == doctest::Approx(321).epsilon(2e-3));  // between two frames
  });
}

TEST_CASE("an approaching intruder's distance falls in every frame, a receding one's rises") {
  for_all_stages([](const FlightContext& context) {
    const std::vector<ViewedFrame> near = viewed_frames(context, planned(FlightKind::approaching, {}, context));
    const std::vector<ViewedFrame> away = viewed_frames(context, planned(FlightKind::moving_away, {}, context));
    CHECK(glm::length(near.front().from_camera_m) == doctest::Approx(400).epsilon(1e-5));
    CHECK(glm::length(near.back().from_camera_m) == doctest::Approx(60).epsilon(1e-4));
    CHECK(glm::length(away.front().from_camera_m) == doctest::Approx(60).epsilon(1e-4));
    CHECK(glm::length(away.back().from_camera_m) == doctest::Approx(400).epsilon(1e-5));
    for (std::size_t i = 1; i < near.size(); ++i) {
      CHECK(glm::length(near[i].from_camera_m) < glm::length(near[i - 1].from_camera_m));
      CHECK(glm::length(away[i].from_camera_m) > glm::length(away[i - 1].from_camera_m));
    }
  });
}

TEST_CASE("on a constant bearing an approaching intruder keeps its place in the image") {
  for_all_stages([](const FlightContext& context) {
    for (const ViewedFrame& frame :
         viewed_frames(context, planned(FlightKind::approaching, {{"from_distance_m", 900}}, context)))
      CHECK(glm::distance(frame.place_percent, {50, 40}) <
            rounding_percent(context, glm::normalize(frame.from_camera_m) * 60.0));
  });
}

TEST_CASE(
    "an intruder is at the place in the image, and as large, as asked at the stated frame, with any lens and camera") {
  for_all_stages([](FlightContext context) {
    // A ball of 12 m, whose size is its angle times the image's scale there: another map than that of the search.
    const auto size_px = [&](const glm::dvec3& from_camera_m) {
      return 12 / glm::length(from_camera_m) * context.lens.lens.pixels_per_radian(in_camera(context, from_camera_m));
    };
    const auto from_camera_m = [&](const std::vector<WaypointSettings>& waypoints, int frame) {
      const PlannedFlight flight{.waypoints = waypoints};
      return relative_position_m(context, trajectory_of(context, flight), time_of_frame_s(context.footage, frame));
    };
    context.size_px_on = [&](const std::vector<WaypointSettings>& waypoints, int frame) {
      return std::optional(size_px(from_camera_m(waypoints, frame)));
    };
    for (const double approach_deg : {0.0, 90.0}) {
      const PlannedFlight flight = planned(FlightKind::image_position,
                                           {{"x_percent", 40},
                                            {"y_percent", 45},
                                            {"size_px", 20},
                                            {"time_s", 1},
                                            {"direction_deg", 90},
                                            {"relative_speed_mps", 2},
                                            {"approach_angle_deg", approach_deg}},
                                           context);
      const std::vector<ViewedFrame> frames = viewed_frames(context, flight);
      const ViewedFrame& there = frames.at(25);  // 25 frames a second
      CHECK(glm::distance(there.place_percent, {40, 45}) < rounding_percent(context, there.from_camera_m));
      CHECK(size_px(there.from_camera_m) == doctest::Approx(20).epsilon(0.005));
      for (const ViewedFrame& frame : frames)
        if (approach_deg == 0)
          CHECK(glm::length(frame.from_camera_m) > glm::length(there.from_camera_m) - 0.01);
        else
          CHECK(glm::distance(frame.place_percent, {40, 45}) < 2 * rounding_percent(context, frame.from_camera_m));
      if (approach_deg > 0) CHECK(glm::length(frames.front().from_camera_m) > glm::length(there.from_camera_m) + 1);
      if (approach_deg == 0) {
        CHECK(frames.at(26).place_percent.y < there.place_percent.y);
        CHECK(frames.at(26).place_percent.x == doctest::Approx(there.place_percent.x).epsilon(0.001));
      }
    }
  });
}

TEST_CASE("a place without a ray, a time after the video and a size that no distance gives are refused by name") {
  const FootageShape footage = footage_of(80);
  const NamedLens lens = example_lenses().front();
  FlightContext context{.camera = {.speed_mps = 22}, .lens = lens.camera, .footage = footage, .frames = {0, 50}};
  double pixels = 0;
  context.size_px_on = [&](const std::vector<WaypointSettings>&, int) { return std::optional(pixels); };
  const auto why = [&](const std::map<std::string, double>& given) {
    return planned_flight(FlightKind::image_position, values_with(FlightKind::image_position, given), context).error();
  };
  CHECK(why({{"size_px", 20}}).starts_with("size_px: the intruder's model has no image"));
  pixels = 7;
  CHECK(why({{"size_px", 20}}).starts_with("size_px: the intruder cannot be 20 px large there; it comes to 7 px"));
  CHECK(why({{"size_px", 20}, {"time_s", 5}}).starts_with("time_s: 5 s is after the video's last frame, at 2 s"));
  CHECK(why({{"size_px", 20}, {"x_percent", 101}}).starts_with("x_percent: is 101"));
}

TEST_CASE("with the standard quantities an intruder is in the image in every frame") {
  for_all_stages([](const FlightContext& context) {
    for (const FlightKind kind :
         {FlightKind::left_right, FlightKind::right_left, FlightKind::approaching, FlightKind::moving_away}) {
      CAPTURE(name_of(kind));
      for (const ViewedFrame& frame : viewed_frames(context, planned(kind, {}, context)))
        CHECK(in_image(frame.place_percent));
    }
  });
}

TEST_CASE("places beyond a lens' field are replaced by the nearest ones within it") {
  for (const NamedLens& lens : example_lenses()) {
    CAPTURE(lens.name);
    for (const glm::dvec2 place : {glm::dvec2(-1000, 50), {1000, 1000}, {50, -800}, {103, 50}}) {
      const glm::dvec3 ray = ray_of_place(lens.camera, place);
      CHECK(glm::length(ray) == doctest::Approx(1).epsilon(1e-9));
      CHECK(std::acos(ray.x) <= 75.0001 / 57.29577951308232);
      const std::optional<glm::dvec2> pixel = lens.camera.lens.pixel(ray);
      REQUIRE(pixel);
      // On the line from the axis to the place.
      const glm::dvec2 axis = *lens.camera.lens.pixel({1, 0, 0});
      const glm::dvec2 wanted = place / 100.0 * glm::dvec2(1280, 960) - 0.5 - axis;
      const glm::dvec2 found = *pixel - axis;
      CHECK(glm::dot(wanted, found) > 0);
      CHECK(std::abs(wanted.x * found.y - wanted.y * found.x) / glm::length(wanted) < 1e-6);
    }
  }
}

TEST_CASE("an intruder with a speed of its own flies at it along the same line") {
  for_all_stages([](const FlightContext& context) {
    for (const FlightKind kind : {FlightKind::left_right, FlightKind::approaching, FlightKind::moving_away}) {
      CAPTURE(name_of(kind));
      const std::map<std::string, double> values{{"speed_mps", 95}, {"from_y_percent", 44}};
      const PlannedFlight timed = planned(kind, {{"from_y_percent", 44}}, context);
      const PlannedFlight flown = planned(kind, values, context);
      const Trajectory path = trajectory_of(context, flown);
      const double first_s = time_of_frame_s(context.footage, context.frames.first);
      const double last_s = time_of_frame_s(context.footage, context.frames.last);
      CHECK(glm::length(path.velocity_mps((first_s + last_s) / 2)) == doctest::Approx(95).epsilon(1e-9));
      CHECK(flown.derived.at("speed_mps") == doctest::Approx(95).epsilon(1e-12));
      const double held_s = kind == FlightKind::left_right    ? (first_s + last_s) / 2
                            : kind == FlightKind::approaching ? last_s
                                                              : first_s;
      const glm::dvec3 held_m = relative_position_m(context, trajectory_of(context, timed), held_s);
      CHECK(glm::distance(relative_position_m(context, path, held_s), held_m) < 1e-6);
      const glm::dvec3 way = relative_position_m(context, path, last_s) - relative_position_m(context, path, first_s);
      const glm::dvec3 timed_way = relative_position_m(context, trajectory_of(context, timed), last_s) -
                                   relative_position_m(context, trajectory_of(context, timed), first_s);
      CHECK(glm::dot(glm::normalize(way), glm::normalize(timed_way)) == doctest::Approx(1).epsilon(1e-9));
    }
  });
}

TEST_CASE("an intruder too slow to keep before a fast camera is impossible") {
  const Camera lens = example_lenses().front().camera;
  const FootageShape footage = footage_of(80);
  const FlightContext context{.camera = {.speed_mps = 60}, .lens = lens, .footage = footage, .frames = {0, 79}};
  const auto flight =
      planned_flight(FlightKind::moving_away, values_with(FlightKind::moving_away, {{"speed_mps", 59}}), context);
  REQUIRE(!flight);
  CHECK(flight.error() ==
        "speed_mps: at 59 m/s the intruder cannot fly along that line before a camera that flies 60 m/s itself");
}

TEST_CASE("a template that leads below the ground is impossible") {
  const Camera lens = example_lenses().front().camera;
  const FootageShape footage = footage_of(80);
  const FlightContext context{.camera = {.speed_mps = 22}, .lens = lens, .footage = footage, .frames = {0, 79}};
  const auto flight =
      planned_flight(FlightKind::approaching, values_with(FlightKind::approaching, {{"from_y_percent", 95}}), context);
  REQUIRE(!flight);
  CHECK(flight.error().starts_with("from_y_percent, to_y_percent: the intruder is underground in frame 0, "));
}
