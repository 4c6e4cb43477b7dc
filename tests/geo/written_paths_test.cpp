// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <random>

#include "geo/geo_path.h"
#include "geo/geodetic.h"
#include "geo/recorded_examples.h"
#include "geo/utc_time.h"
#include "support/comma_locale.h"
#include "support/process.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

using CzmlJson = nlohmann::json;

GeoPath geo_path_of(const RecordedPath& path) {
  return {.name = path.name, .points = path.points, .has_times = path.has_times, .utc = path.utc};
}

std::vector<GeoPath> geo_paths_of(const std::vector<RecordedPath>& paths) {
  std::vector<GeoPath> all;
  for (const RecordedPath& path : paths) all.push_back(geo_path_of(path));
  return all;
}

// Random places with as many digits as a double has, times to the microsecond.
GeoPath random_path(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  GeoPath path{.name = "random"};
  double time_s = 1777636800.25;
  for (int i = 0; i < 200; ++i) {
    time_s += 0.001 + std::abs(unit(random));
    path.points.push_back({time_s, {90 * unit(random), 180 * unit(random), 5000 + 5000 * unit(random)}});
    path.attitudes.push_back(i % 5 == 0 ? std::optional<Attitude>()
                                        : Attitude{3 * unit(random), 1.5 * unit(random), 3.1 * unit(random)});
  }
  return path;
}

// Closed form (any textbook of geodesy), WGS-84.
glm::dvec3 earth_fixed(const GeodeticPosition& place) {
  constexpr double kAxis_m = 6378137;
  constexpr double kFlattening = 1 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double latitude_rad = rad_of_deg(place.latitude_deg);
  const double longitude_rad = rad_of_deg(place.longitude_deg);
  const double normal_m = kAxis_m / std::sqrt(1 - kEccentricity2 * std::sin(latitude_rad) * std::sin(latitude_rad));
  const double to_axis_m = (normal_m + place.height_m) * std::cos(latitude_rad);
  return {to_axis_m * std::cos(longitude_rad), to_axis_m * std::sin(longitude_rad),
          (normal_m * (1 - kEccentricity2) + place.height_m) * std::sin(latitude_rad)};
}

double largest_distance_m(const std::vector<TimedPlace>& a, const std::vector<TimedPlace>& b) {
  REQUIRE(a.size() == b.size());
  double largest_m = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(std::abs(a[i].time_s - b[i].time_s) < 1e-6);
    largest_m = std::max(largest_m, glm::distance(earth_fixed(a[i].place), earth_fixed(b[i].place)));
  }
  return largest_m;
}

// The samples of a CZML packet's position, with times in UTC.
std::vector<TimedPlace> points_of_packet(const CzmlJson& packet) {
  const double epoch_s = utc_instant_of(packet.at("position").at("epoch").get<std::string>()).value().time_s;
  const CzmlJson& list = packet.at("position").at("cartographicDegrees");
  REQUIRE(list.size() % 4 == 0);
  std::vector<TimedPlace> points;
  for (std::size_t i = 0; i < list.size(); i += 4)
    points.push_back({epoch_s + list[i].get<double>(), {list[i + 2], list[i + 1], list[i + 3]}});
  return points;
}

constexpr double kMillimetre_m = 1e-3;

}  // namespace

TEST_CASE("paths of GPX written as KML and read again are the same within 1 mm") {
  const std::vector<RecordedPath> paths = recorded_paths_of(kGpxExample, "a.gpx").value();
  const auto again = recorded_paths_of(kml_text(geo_paths_of(paths), "a"), "a.kml");
  REQUIRE_MESSAGE(again.has_value(), again.error().text());
  REQUIRE(again->size() == paths.size());  // the lines beside the tracks are not paths of their own
  for (std::size_t i = 0; i < paths.size(); ++i) {
    CHECK(again->at(i).name == paths[i].name);
    CHECK(again->at(i).has_times == paths[i].has_times);
    CHECK(again->at(i).utc == paths[i].utc);
    CHECK(largest_distance_m(again->at(i).points, paths[i].points) < kMillimetre_m);
  }
}

TEST_CASE("paths of ADS-B written as KML and CZML and read again are the same within 1 mm") {
  for (const std::string& text : {kAircraftExample, kTraceExample, kStatesExample, kTrackExample, kOpenskyCsvExample}) {
    const std::vector<RecordedPath> paths = recorded_paths_of(text, "a").value();
    const std::vector<RecordedPath> again = recorded_paths_of(kml_text(geo_paths_of(paths), "a"), "a.kml").value();
    const CzmlJson czml = CzmlJson::parse(czml_text(geo_paths_of(paths), "a"));
    REQUIRE(again.size() == paths.size());
    REQUIRE(czml.size() == paths.size() + 1);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      CHECK(largest_distance_m(again[i].points, paths[i].points) < kMillimetre_m);
      CHECK(largest_distance_m(points_of_packet(czml[i + 1]), paths[i].points) < kMillimetre_m);
    }
  }
}

TEST_CASE("any digits survive KML and CZML to 1 mm, all over the Earth") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const GeoPath path = random_path(seed);
    const std::vector<RecordedPath> again = recorded_paths_of(kml_text({path}, "a"), "a.kml").value();
    REQUIRE(again.size() == 1);
    CHECK(largest_distance_m(again[0].points, path.points) < kMillimetre_m);
    const CzmlJson czml = CzmlJson::parse(czml_text({path}, "a"));
    CHECK(largest_distance_m(points_of_packet(czml[1]), path.points) < kMillimetre_m);
  }
}

TEST_CASE("KML is well-formed for xmllint, whatever the names are") {
  if (run_command("command -v xmllint").status != 0) return say_skipped("needs xmllint (package libxml2-utils)");
  GeoPath path = random_path(1);
  path.description = "<b>\x01 \xFF & ]]>";
  path.utc = false;
  std::string every_byte;
  for (int byte = 1; byte < 256; ++byte) every_byte += static_cast<char>(byte);
  path.name = every_byte + "<&>\"'";
  const TemporaryFolder folder;
  write_file(folder / "a.kml", kml_text({path, path}, every_byte));
  const Run run = run_command("xmllint --noout '" + (folder / "a.kml").string() + "'");
  CHECK_MESSAGE(run.status == 0, run.err);
}

TEST_CASE("a track of KML has as many times as places and angles, and angles as KML counts them") {
  GeoPath path = random_path(2);
  path.attitudes[1] = Attitude{rad_of_deg(20), rad_of_deg(5), rad_of_deg(-10)};
  pugi::xml_document xml;
  const std::string text = kml_text({path}, "a");
  REQUIRE(xml.load_buffer(text.data(), text.size()));
  const pugi::xml_node track = xml.select_node("//gx:Track").node();
  const auto count = [&](const char* name) {
    return static_cast<std::size_t>(std::distance(track.children(name).begin(), track.children(name).end()));
  };
  CHECK(count("when") == path.points.size());
  CHECK(count("gx:coord") == path.points.size());
  CHECK(count("gx:angles") == path.points.size());
  CHECK(std::string(track.child("gx:angles").child_value()).empty());  // not known
  // Nose 5 degrees up and right wing 20 down are both against the clock, seen from the tips of x (east) and y (north).
  CHECK(std::string(track.child("gx:angles").next_sibling("gx:angles").child_value()) == "350 -5 -20");
  CHECK(std::string(track.child("altitudeMode").child_value()) == "absolute");
  CHECK(std::string(xml.select_node("//LineStyle/color").node().child_value()) == "ff00ffff");  // yellow, as aabbggrr
}

TEST_CASE("attitudes in CZML take nose, left wing and roof to their directions on the Earth") {
  GeoPath known{.name = "level", .points = {{0, {0, 0, 0}}}, .attitudes = {Attitude{}}};
  const CzmlJson at_origin = CzmlJson::parse(czml_text({known}, "a"))[1]["orientation"]["unitQuaternion"];
  const glm::dquat level(at_origin[4], at_origin[1], at_origin[2], at_origin[3]);
  CHECK(glm::distance(level * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)) < 1e-8);   // north
  CHECK(glm::distance(level * glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)) < 1e-8);  // west
  CHECK(glm::distance(level * glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)) < 1e-8);   // up

  const GeoPath path = random_path(3);
  const CzmlJson list = CzmlJson::parse(czml_text({path}, "a"))[1]["orientation"]["unitQuaternion"];
  std::size_t at = 0;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    if (!path.attitudes[i]) continue;
    const glm::dquat turn(list[at + 4], list[at + 1], list[at + 2], list[at + 3]);
    at += 5;
    // Where the tips of axes of 1 km lie, through the local frame.
    const LocalFrame frame(path.points[i].place, 0);
    const glm::dquat ned_from_body = rotation_of(*path.attitudes[i]);
    const auto direction = [&](const glm::dvec3& in_body) {
      return (earth_fixed(frame.place_of(1000.0 * (ned_from_body * in_body))) - earth_fixed(path.points[i].place)) /
             1000.0;
    };
    CHECK(glm::distance(turn * glm::dvec3(1, 0, 0), direction({1, 0, 0})) < 1e-7);  // nine decimals were written
    CHECK(glm::distance(turn * glm::dvec3(0, 1, 0), direction({0, -1, 0})) < 1e-7);
    CHECK(glm::distance(turn * glm::dvec3(0, 0, 1), direction({0, 0, -1})) < 1e-7);
  }
  CHECK(at == list.size());
}

TEST_CASE("a path whose instant is not known begins in the year 2000, and its description says so") {
  GeoPath path{.name = "x", .points = {{5, {47, 8, 1}}, {7.5, {47.1, 8, 1}}}, .utc = false};
  const std::string kml = kml_text({path}, "a");
  CHECK(kml.find("2000-01-01T00:00:05Z") != std::string::npos);
  CHECK(kml.find("not known") != std::string::npos);
  const CzmlJson czml = CzmlJson::parse(czml_text({path}, "a"));
  CHECK(czml[1]["availability"] == "2000-01-01T00:00:05Z/2000-01-01T00:00:07.5Z");
  CHECK(czml[1]["description"].get<std::string>().find("not known") != std::string::npos);
  CHECK(czml[0]["clock"]["interval"] == czml[1]["availability"]);
}

TEST_CASE("CZML begins with the document, has identifiers of its own, and any bytes as names") {
  GeoPath path = random_path(4);
  path.name = "\xFF<\"\n\x01";
  GeoPath line = path;
  line.has_times = false;
  const CzmlJson czml = CzmlJson::parse(czml_text({path, line, GeoPath{}, path}, "\xFE title"));
  REQUIRE(czml.size() == 4);
  CHECK(czml[0]["id"] == "document");
  CHECK(czml[0]["version"] == "1.0");
  CHECK(czml[1]["id"] != czml[3]["id"]);
  CHECK_FALSE(czml[2].contains("position"));
  CHECK(czml[2]["polyline"]["positions"]["cartographicDegrees"].size() == 3 * line.points.size());
}

TEST_CASE("where the system writes 1.234,5 the same texts are written and read") {
  const GeoPath path = random_path(5);
  const std::string kml = kml_text({path}, "a");
  const std::string czml = czml_text({path}, "a");
  const CommaLocale comma;
  CHECK(kml_text({path}, "a") == kml);
  CHECK(czml_text({path}, "a") == czml);
  CHECK(largest_distance_m(recorded_paths_of(kml, "a.kml").value().at(0).points, path.points) < kMillimetre_m);
}
