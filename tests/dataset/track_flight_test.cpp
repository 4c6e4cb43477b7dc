// SPDX-License-Identifier: MIT
#include "dataset/flight_plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/pose.h"
#include "dataset/flight_contexts.h"
#include "dataset/recipe_folder.h"
#include "encounter_model/small_model.h"
#include "support/files.h"

using namespace sigs;
using namespace sigs::test;

namespace {

struct Sky {
  Camera lens = example_lenses().front().camera;
  FootageShape footage = footage_of(300, 0.01);

  [[nodiscard]] FlightContext context(const FlightSource& source, std::uint64_t bits, FrameRange frames) const {
    return {.camera = {.position_m = {40, -9, -3000}, .yaw_deg = 20, .speed_mps = 31},
            .lens = lens,
            .footage = footage,
            .frames = frames,
            .source = &source,
            .random_bits = bits};
  }
};

FlightSource drawn_from_small_model(bool with_ownship) {
  const Result<EncounterModel> model = encounter_model_of(text_of(small_model()), "small");
  REQUIRE(model);
  FlightSource source{.model = *model};
  if (with_ownship) source.own_model = *model;
  return source;
}

// A circle to the right of radius 400 m at 40 m/s, climbing 2 m/s, ten points a second for two minutes.
constexpr double kRadius_m = 400, kSpeed_mps = 40, kClimb_mps = 2;

FlownTrack circling() {
  FlownTrack track{.name = "circle"};
  for (int i = 0; i <= 1200; ++i) {
    const double t_s = 0.1 * i;
    const double angle = kSpeed_mps / kRadius_m * t_s;
    track.times_s.push_back(t_s);
    track.places_ned_m.emplace_back(kRadius_m * std::sin(angle), kRadius_m * (1 - std::cos(angle)), -kClimb_mps * t_s);
  }
  return track;
}

// The closest approach as the positions show it, by differences over 2 ms.
void check_approach(const FlightContext& context, const PlannedFlight& flight,
                    const std::map<std::string, double>& given) {
  const Trajectory trajectory = trajectory_of(context, flight);
  const double first_s = time_of_frame_s(context.footage, context.frames.first);
  const double closest_s = first_s + given.at("time_of_closest_approach_s");
  const auto apart_m = [&](double time_s) { return relative_position_m(context, trajectory, time_s); };
  const glm::dvec3 here_m = apart_m(closest_s);
  const glm::dvec2 velocity_mps((apart_m(closest_s + 1e-3) - apart_m(closest_s - 1e-3)) / 2e-3);
  // Waypoints are rounded to 1e-6 m.
  CHECK(std::abs(std::hypot(here_m.x, here_m.y) - std::abs(given.at("hmd_m"))) < 1e-5);
  CHECK(std::abs(-here_m.z - given.at("vmd_m")) < 1e-5);
  // The time at which the straight continuation is nearest: differs by rounding over speeds of more than 1 m/s.
  CHECK(std::abs(glm::dot(glm::dvec2(here_m), velocity_mps) / glm::dot(velocity_mps, velocity_mps)) < 1e-3);
  const double bearing_rad = std::atan2(-velocity_mps.y, -velocity_mps.x);
  CHECK(std::abs(std::remainder(bearing_rad - rad_of_deg(given.at("bearing_deg")), 2 * std::numbers::pi)) < 1e-5);
  // Right of who looks where it comes from.
  const double right_m = -std::sin(bearing_rad) * here_m.x + std::cos(bearing_rad) * here_m.y;
  CHECK(std::abs(right_m - given.at("hmd_m")) < 1e-2);
  for (const double before_s : {-0.3, -0.1, 0.1, 0.3}) {
    const glm::dvec3 other_m = apart_m(closest_s + before_s);
    CHECK(std::hypot(other_m.x, other_m.y) > std::abs(given.at("hmd_m")) - 1e-5);
  }
}

std::string why(FlightKind kind, const std::map<std::string, double>& given, const FlightContext& context) {
  const auto flight = planned_flight(kind, values_with(kind, given), context);
  return flight ? "" : flight.error();
}

}  // namespace

TEST_CASE("a flight drawn from a model comes closest when, where and from where it was asked to") {
  const Sky sky;
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  for (const bool with_ownship : {false, true}) {
    const FlightSource source = drawn_from_small_model(with_ownship);
    int planned_flights = 0;
    for (int i = 0; i < 150; ++i) {
      const FlightContext context = sky.context(source, random(), {7 * (i % 9), 100 + i});
      const std::map<std::string, double> given{{"hmd_m", i % 7 == 0 ? 0 : between(-900, 900)},
                                                {"vmd_m", between(-300, 300)},
                                                {"bearing_deg", between(-60, 60)},
                                                {"time_of_closest_approach_s", between(0.5, 1.4)}};
      const auto flight =
          planned_flight(FlightKind::encounter_model, values_with(FlightKind::encounter_model, given), context);
      if (!flight) continue;  // too slow for its bearing
      ++planned_flights;
      check_approach(context, *flight, given);
    }
    CHECK(planned_flights > 75);
  }
}

TEST_CASE("a recorded flight is turned and moved as a whole, and comes closest as it was asked to") {
  const Sky sky;
  const FlightSource source{.tracks = {circling()}};
  for (int i = 0; i < 40; ++i) {
    const FlightContext context = sky.context(source, 977 * i, {10, 160 + i});
    const std::map<std::string, double> given{{"hmd_m", 20.0 * i - 300},
                                              {"vmd_m", 5.0 * i - 90},
                                              {"bearing_deg", 1.5 * i - 30},
                                              {"smoothing_s", 0.0},
                                              {"time_of_closest_approach_s", 3.0}};
    const auto flight = planned_flight(FlightKind::recorded, values_with(FlightKind::recorded, given), context);
    REQUIRE_MESSAGE(flight, flight.error());
    check_approach(context, *flight, given);
    const Trajectory flown = trajectory_of(context, *flight);
    for (const double from_s : {0.9, 2.3, 4.4}) {
      const glm::dvec3 way_m = flown.position_m(from_s + 1.5) - flown.position_m(from_s);
      const double chord_m = 2 * kRadius_m * std::sin(1.5 * kSpeed_mps / kRadius_m / 2);
      // Straight lines between recorded points leave the circle by 5 mm; the spline by as much.
      CHECK(std::abs(std::hypot(way_m.x, way_m.y) - chord_m) < 0.05);
      CHECK(std::abs(-way_m.z - 1.5 * kClimb_mps) < 1e-3);
    }
  }
}

TEST_CASE("the mean over some seconds takes the steps out of a recording and leaves straight flight as it is") {
  FlownTrack track{.name = "steps"};
  for (int i = 0; i <= 100; ++i) {
    track.times_s.push_back(i);
    track.places_ned_m.emplace_back(50.0 * i, 0, -1000 - (i % 2) * 7.62);  // altitudes to 25 ft, flickering
  }
  for (const double time_s : {20.3, 47.0, 80.9}) {
    const glm::dvec3 place_m = place_at(track, time_s, 10);
    CHECK(std::abs(place_m.x - 50 * time_s) < 1e-9);
    CHECK(std::abs(place_m.z + 1003.81) < 0.2);
  }
  CHECK(place_at(track, -5, 10) == track.places_ned_m.front());
  CHECK(place_at(track, 200, 10) == track.places_ned_m.back());
}

TEST_CASE("a drawn or recorded flight that cannot be is refused with the quantity") {
  const Sky sky;
  const FlightSource drawn = drawn_from_small_model(false);
  FlightSource recorded{.tracks = {circling()}};
  const FlightContext context = sky.context(drawn, 4, {0, 120});
  CHECK(why(FlightKind::encounter_model, {{"hmd_m", 10}, {"time_of_closest_approach_s", 50}}, context)
            .starts_with("time_of_closest_approach_s: is 50 s"));
  FlightContext fast = context;
  fast.camera.speed_mps = 300;
  CHECK(why(FlightKind::encounter_model, {{"hmd_m", 10}, {"bearing_deg", 90}}, fast).starts_with("bearing_deg: "));
  CHECK(why(FlightKind::encounter_model, {{"hmd_m", 10}, {"vmd_m", -5000}}, context).starts_with("vmd_m: "));
  FlightContext limited = context;
  limited.speed_limits_mps = Span{200, 300};
  CHECK(why(FlightKind::encounter_model, {{"hmd_m", 10}}, limited).starts_with("speed_mps: "));

  const FlightContext along = sky.context(recorded, 4, {0, 120});
  CHECK(why(FlightKind::recorded, {{"hmd_m", 10}, {"recorded_time_s", 119}, {"time_of_closest_approach_s", 0}}, along)
            .starts_with("recorded_time_s: at 119 s"));
  recorded.tracks[0].times_s.resize(20);
  recorded.tracks[0].places_ned_m.resize(20);
  CHECK(why(FlightKind::recorded, {{"hmd_m", 10}}, along).starts_with("frames: the video has"));
  recorded.tracks[0] = {.name = "gap", .times_s = {0, 31, 32}, .places_ned_m = {{0, 0, 0}, {900, 0, 0}, {950, 0, 0}}};
  CHECK(why(FlightKind::recorded, {{"hmd_m", 10}}, along).find("no points for 31 s") != std::string::npos);
}

TEST_CASE("recordings of all kinds are read as flights, and what is none is named") {
  const TemporaryFolder folder;
  write_file(folder / "a.csv", "time_s,north_m,east_m,down_m\n5,0,0,-100\n6,40,1,-101\n7,80,4,-102\n");
  const Result<ReadFlights> log = read_flown_tracks(folder / "a.csv");
  REQUIRE_MESSAGE(log, log.error().text());
  REQUIRE(log->tracks.size() == 1);
  CHECK(log->tracks[0].times_s == std::vector<double>{0, 1, 2});
  CHECK(log->tracks[0].places_ned_m[2] == glm::dvec3(80, 4, -102));
  write_file(folder / "b.gpx",
             "<gpx version=\"1.1\"><trk><name>N1</name><trkseg>"
             "<trkpt lat=\"47\" lon=\"8\"><ele>500</ele><time>2026-05-01T12:00:00Z</time></trkpt>"
             "<trkpt lat=\"47.001\" lon=\"8\"><ele>520</ele><time>2026-05-01T12:00:02Z</time></trkpt>"
             "</trkseg></trk></gpx>");
  const Result<ReadFlights> gpx = read_flown_tracks(folder / "b.gpx");
  REQUIRE_MESSAGE(gpx, gpx.error().text());
  REQUIRE(gpx->tracks.size() == 1);
  CHECK(gpx->tracks[0].name == "N1");
  CHECK(gpx->tracks[0].length_s() == doctest::Approx(2));
  CHECK(gpx->tracks[0].places_ned_m[1].x == doctest::Approx(111.17).epsilon(0.001));  // a thousandth of a degree
  CHECK(gpx->tracks[0].places_ned_m[1].z == doctest::Approx(-20).epsilon(0.001));
  write_file(folder / "c.csv",
             "t_s,own_east_m,int_east_m,own_north_m,int_north_m,own_alt_m,int_alt_m\n0,0,900,0,0,300,310\n1,0,800,50,0,"
             "300,310\n");
  const Result<ReadFlights> pair = read_flown_tracks(folder / "c.csv");
  REQUIRE_MESSAGE(pair, pair.error().text());
  REQUIRE(pair->tracks.size() == 2);
  CHECK(pair->tracks[1].places_ned_m[0] == glm::dvec3(0, 900, -310));
  write_file(folder / "d.gpx",
             "<gpx version=\"1.1\"><trk><trkseg><trkpt lat=\"47\" lon=\"8\"/><trkpt lat=\"48\" lon=\"8\"/>"
             "</trkseg></trk></gpx>");
  const Result<ReadFlights> timeless = read_flown_tracks(folder / "d.gpx");
  REQUIRE(!timeless);
  CHECK(timeless.error().text().find("times") != std::string::npos);
  write_file(folder / "e.txt", "nothing of the kind");
  CHECK(!read_flown_tracks(folder / "e.txt"));
  CHECK(read_flown_tracks(folder / "none").error().kind == ErrorKind::cannot_read);
}

TEST_CASE("a recipe names the flight whose file is missing, wrong or has no such path") {
  const RecipeFolder folder;
  const std::filesystem::path place = folder.file().parent_path();
  write_file(place / "model.txt", text_of(small_model()));
  write_file(place / "cut.txt", with_section("N_initial", "3 1 10 30 0 0 1 2 3 4 5 \n"));
  write_file(place / "flight.csv", "time_s,north_m,east_m,down_m\n0,0,0,-100\n20,900,0,-101\n40,1800,4,-102\n");
  const auto error_of = [&](const nlohmann::ordered_json& flight) {
    nlohmann::ordered_json recipe = RecipeFolder::recipe();
    recipe["backgrounds"][0]["camera"]["position_m"] = {0, 0, -800};
    recipe["videos"][0]["flights"] = {flight};
    recipe["videos"][0]["frames"] = 50;
    return folder.error(recipe);
  };
  CHECK(error_of({{"kind", "encounter_model"}, {"hmd_m", 50}, {"file", "model.txt"}}).empty());
  CHECK(error_of({{"kind", "recorded"}, {"hmd_m", 50}, {"file", "flight.csv"}}).empty());
  CHECK(error_of({{"kind", "encounter_model"}, {"hmd_m", 50}}).starts_with("videos[0].flights[0].file: is missing"));
  CHECK(error_of({{"kind", "encounter_model"}, {"hmd_m", 50}, {"file", "none.txt"}})
            .starts_with("videos[0].flights[0].file: "));
  const std::string cut = error_of({{"kind", "encounter_model"}, {"hmd_m", 50}, {"file", "cut.txt"}});
  CHECK_MESSAGE(cut.find("N_initial") != std::string::npos, cut);
  CHECK(error_of({{"kind", "encounter_model"}, {"file", "model.txt"}}).starts_with("videos[0].flights[0].hmd_m: "));
  const std::string path = error_of({{"kind", "recorded"}, {"hmd_m", 50}, {"file", "flight.csv"}, {"path", "N9"}});
  CHECK_MESSAGE(path.starts_with("videos[0].flights[0].path: no such flight"), path);
}
