// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>

#include "geo/recorded_examples.h"
#include "geo/recorded_path.h"

using namespace sigs;
using namespace sigs::test;

namespace {

constexpr double kFoot_m = 0.3048;  // by definition

std::vector<RecordedPath> adsb_paths(const std::string& text) {
  auto paths = recorded_paths_of(text, "a.json");
  REQUIRE_MESSAGE(paths.has_value(), paths.error().text());
  return std::move(*paths);
}

// aircraft.json with one aircraft.
std::string snapshot(const std::string& now, const std::string& latitude, const std::string& seen_pos) {
  return R"({"now":)" + now + R"(,"aircraft":[{"hex":"3c6444","lat":)" + latitude +
         R"(,"lon":8.5,"alt_geom":1000,"seen_pos":)" + seen_pos + "}]}";
}

}  // namespace

TEST_CASE("aircraft.json is a path for each aircraft that has a place") {
  const std::vector<RecordedPath> paths = adsb_paths(kAircraftExample);
  REQUIRE(paths.size() == 3);
  CHECK(paths[0].name == "DLH400");
  CHECK(paths[0].icao24 == "3c6444");
  CHECK(paths[0].utc);
  CHECK(paths[0].points[0].time_s == doctest::Approx(1777636799.6).epsilon(1e-15));
  CHECK(paths[0].points[0].place.height_m == doctest::Approx(10500 * kFoot_m));
  CHECK(paths[0].height == HeightReference::ellipsoid);
  CHECK(paths[0].warnings.empty());
  CHECK(paths[1].name == "4b1814");
  CHECK(paths[1].height == HeightReference::unknown);
  CHECK(paths[2].icao24 == "~2a1b3c");
  CHECK(paths[2].height == HeightReference::pressure);
  CHECK(has_warning(paths[2], "QNH"));
}

TEST_CASE("a position that is repeated in later snapshots is one point, at its own time") {
  const std::string three = snapshot("1777636800.0", "47.5", "0.0") + "\n" + snapshot("1777636801.0", "47.5", "1.1") +
                            "\n" + snapshot("1777636802.0", "47.6", "0.1") + "\n";
  const std::vector<RecordedPath> paths = adsb_paths(three);
  REQUIRE(paths.size() == 1);
  REQUIRE(paths[0].points.size() == 2);
  CHECK(paths[0].points[0].time_s == 1777636800);
  CHECK(paths[0].points[1].time_s == doctest::Approx(1777636801.9).epsilon(1e-15));
  CHECK(paths[0].warnings.empty());
}

TEST_CASE("snapshots are read from lines, from a list, and one aircraft on each line") {
  const std::string a = snapshot("1777636800.0", "47.5", "0.0");
  const std::string b = snapshot("1777636805.0", "47.6", "0.0");
  for (const std::string& text : {a + "\n" + b, a + "\r\n\r\n" + b + "\n", "[" + a + "," + b + "]",
                                  std::string(R"({"now":1777636800,"hex":"3c6444","lat":47.5,"lon":8.5}
{"now":1777636805,"hex":"3C6444","lat":47.6,"lon":8.5})"),
                                  std::string(R"({"now":1777636800000,"ac":[{"hex":"3c6444","lat":47.5,"lon":8.5}]}
{"now":1777636805000,"ac":[{"hex":"3c6444","lat":47.6,"lon":8.5}]})")}) {
    const std::vector<RecordedPath> paths = adsb_paths(text);
    REQUIRE(paths.size() == 1);
    REQUIRE(paths[0].points.size() == 2);
    CHECK(paths[0].points[0].time_s == 1777636800);
    CHECK(paths[0].points[1].time_s == 1777636805);
  }
}

TEST_CASE("a line that is cut off is left out with its number") {
  const std::string a = snapshot("1777636800.0", "47.5", "0.0");
  const std::vector<RecordedPath> paths = adsb_paths(a + "\n" + a.substr(0, 40));
  CHECK(paths.at(0).points.size() == 1);
  CHECK(has_warning(paths[0], "line 2"));
}

TEST_CASE("a trace has geometric heights; where it has pressure alone, the difference is taken from beside") {
  const std::vector<RecordedPath> paths = adsb_paths(kTraceExample);
  REQUIRE(paths.size() == 1);
  const RecordedPath& path = paths[0];
  CHECK(path.name == "DLH400");
  REQUIRE(path.points.size() == 5);
  CHECK(path.points[0].time_s == 1777636800.5);
  CHECK(path.height == HeightReference::ellipsoid);
  // 500 ft above pressure at 0 s and 520 ft at 8 s: 510 ft at 4 s.
  CHECK(path.points[1].place.height_m == doctest::Approx((10050 + 510) * kFoot_m));
  CHECK(path.points[3].place.height_m == doctest::Approx(11000 * kFoot_m));  // flag 8: geometric itself
  CHECK(path.points[4].place.height_m == doctest::Approx(11000 * kFoot_m));  // on the ground: no height
  CHECK(has_warning(path, "1 height of the pressure alone"));
  CHECK(has_warning(path, "1 gap"));
}

TEST_CASE("a height that would follow from a wrong difference to the pressure's is not taken") {
  // 10,000 ft less 70,000 ft of pressure; with 0 ft of pressure that would be 18 km below the ground.
  const RecordedPath path =
      adsb_paths(R"({"icao":"a","timestamp":1,"trace":[[0,47,8,70000,0,0,0,0,{"alt_geom":10000}],[5,47,8.1,0]]})")
          .at(0);
  REQUIRE(path.points.size() == 2);
  CHECK(path.points[1].place.height_m == doctest::Approx(10000 * kFoot_m));
}

TEST_CASE("a trace without its instant has times that count from none") {
  const RecordedPath path = adsb_paths(R"({"icao":"3c6444","trace":[[0,47,8,1000],[5,47.1,8,1000]]})").at(0);
  CHECK(path.has_times);
  CHECK_FALSE(path.utc);
  CHECK(path.points[1].time_s == 5);
  CHECK(has_warning(path, "known instant"));
}

TEST_CASE("states of the OpenSky Network are read by the order of their fields") {
  const std::vector<RecordedPath> paths = adsb_paths(kStatesExample);
  REQUIRE(paths.size() == 2);
  CHECK(paths[0].name == "DLH400");
  CHECK(paths[0].points[0] == TimedPlace{1777636800, {47.5, 8.5, 3200.4}});
  CHECK(paths[0].height == HeightReference::ellipsoid);
  CHECK(paths[1].points[0] == TimedPlace{1777636801, {47.45, 8.55, 1000.5}});
  CHECK(paths[1].height == HeightReference::pressure);
}

TEST_CASE("a track of the OpenSky Network has heights of the pressure") {
  const RecordedPath path = adsb_paths(kTrackExample).at(0);
  CHECK(path.name == "DLH400");
  CHECK(path.icao24 == "3c6444");
  REQUIRE(path.points.size() == 3);
  CHECK(path.points[2] == TimedPlace{1777636860, {47.5, 8.65, 3200}});
  CHECK(path.height == HeightReference::pressure);
}

TEST_CASE("state vectors in CSV have the time of the position, each once") {
  const std::vector<RecordedPath> paths = adsb_paths(kOpenskyCsvExample);
  REQUIRE(paths.size() == 2);
  REQUIRE(paths[0].points.size() == 2);
  CHECK(paths[0].name == "DLH400");
  CHECK(paths[0].points[0] == TimedPlace{1777636799.5, {47.5, 8.5, 3200.4}});
  CHECK(paths[0].points[1].time_s == 1777636801.5);
  CHECK(paths[1].name == "4b1814");
  CHECK(paths[1].height == HeightReference::pressure);
}

TEST_CASE("columns of CSV are found by name, in any order, quoted or not") {
  const std::vector<RecordedPath> paths =
      adsb_paths("\"lon\",\"lat\",\"icao24\",\"time\"\r\n8.5,47.5,\"3c6444\",1777636800\r\n");
  CHECK(paths.at(0).points.at(0) == TimedPlace{1777636800, {47.5, 8.5, 0}});
  CHECK_FALSE(recorded_paths_of("time,icao24,lat\n1,2,3\n", "a.csv").has_value());
}

TEST_CASE("values of wrong types are not read as numbers, and nothing else happens") {
  for (const std::string text :
       {R"({"now":"x","aircraft":[{"hex":"a","lat":"47","lon":[8]}]})", R"({"now":1,"aircraft":[1,"a",null,[],{}]})",
        R"({"icao":5,"timestamp":{},"trace":[1,"x",null,[],[[],[],[]],[1,"a","b","c"]]})",
        R"({"time":1,"states":[1,[],["a"],[1,2,3,4,5,6,7,8],["a","b",0,"c",0,"d","e"]]})",
        R"({"icao24":7,"path":[1,[],["a","b","c"],{"a":1}]})", R"({"states":null})", R"({"states":"x"})",
        R"({"aircraft":"x"})", "[]", "{}", "[[[]]]", "[1,2]", R"({"a":1})", R"({"now":1e999})"}) {
    const auto paths = recorded_paths_of(text, "a.json");
    CHECK_MESSAGE(!paths.has_value(), text);
  }
}

TEST_CASE("broken JSON is refused with the place, and deep nesting before it is parsed") {
  const auto broken = recorded_paths_of("{\"now\": 1,\n \"aircraft\": [,]}", "a.json");
  REQUIRE_FALSE(broken.has_value());
  CHECK(broken.error().text().find("line 2") != std::string::npos);
  const auto deep = recorded_paths_of(std::string(1000000, '['), "a.json");
  REQUIRE_FALSE(deep.has_value());
  CHECK(deep.error().text().find("100 deep") != std::string::npos);
}
