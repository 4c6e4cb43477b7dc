// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geo/recorded_examples.h"
#include "geo/recorded_path.h"

using namespace sigs;
using namespace sigs::test;

TEST_CASE("tracks of GPX are read with name, places, heights and times") {
  const auto paths = recorded_paths_of(kGpxExample, "a.gpx");
  REQUIRE_MESSAGE(paths.has_value(), paths.error().text());
  REQUIRE(paths->size() == 3);
  const RecordedPath& first = paths->at(0);
  CHECK(first.name == "Flight & home");
  REQUIRE(first.points.size() == 4);  // of both segments
  CHECK(first.points[0] == TimedPlace{1777636800, {47.1, 8.1, 500.5}});
  CHECK(first.points[1].time_s == 1777636801.5);
  CHECK(first.points[3].place.latitude_deg == 47.13);
  CHECK(first.has_times);
  CHECK(first.utc);
  CHECK(first.height == HeightReference::sea_level);
  CHECK(has_warning(first, "sea"));
  CHECK(paths->at(1).name == "second");
  CHECK(paths->at(1).points[0].time_s == 1777636800);  // with an offset of two hours
}

TEST_CASE("a route of GPX has no times, and its points are numbered") {
  const RecordedPath route = recorded_paths_of(kGpxExample, "a.gpx").value().at(2);
  CHECK(route.name == "plan");
  CHECK_FALSE(route.has_times);
  CHECK_FALSE(route.utc);
  REQUIRE(route.points.size() == 3);
  CHECK(route.points[2].time_s == 2);
  CHECK(route.height == HeightReference::unknown);
  CHECK(has_warning(route, "no times"));
  CHECK(has_warning(route, "no heights"));
}

TEST_CASE("GPX 1.0, a namespace with a prefix and Latin-1 are read") {
  const std::string prefixed =
      "<?xml version='1.0' encoding='ISO-8859-1'?><g:gpx version='1.0' "
      "xmlns:g='http://www.topografix.com/GPX/1/0'><g:trk>"
      "<g:name>Z\xFCrich</g:name><g:trkseg><g:trkpt lat='47' "
      "lon='8'><g:ele>1</g:ele></g:trkpt></g:trkseg></g:trk></g:gpx>";
  const auto paths = recorded_paths_of(prefixed, "a.gpx");
  REQUIRE_MESSAGE(paths.has_value(), paths.error().text());
  CHECK(paths->at(0).name == "Z\xC3\xBCrich");
  CHECK(paths->at(0).points.size() == 1);
}

TEST_CASE("points that cannot be are left out, and the warning says which") {
  const std::string nan_and_co = gpx_of(
      "<trkpt lat='47' lon='8'><time>2026-05-01T12:00:00Z</time></trkpt>"
      "<trkpt lat='nan' lon='8'><time>2026-05-01T12:00:01Z</time></trkpt>"
      "<trkpt lat='90.5' lon='8'><time>2026-05-01T12:00:02Z</time></trkpt>"
      "<trkpt lat='0' lon='0'><time>2026-05-01T12:00:03Z</time></trkpt>"
      "<trkpt lat='47.x' lon='8'><time>2026-05-01T12:00:04Z</time></trkpt>"
      "<trkpt lon='8'><time>2026-05-01T12:00:05Z</time></trkpt>"
      "<trkpt lat='47.1' lon='361'><time>2026-05-01T12:00:06Z</time></trkpt>"
      "<trkpt lat='47.1' lon='350'><time>2026-05-01T12:00:07Z</time></trkpt>");
  const RecordedPath path = recorded_paths_of(nan_and_co, "a.gpx").value().at(0);
  REQUIRE(path.points.size() == 2);
  CHECK(path.points[1].place.longitude_deg == -10);
  CHECK(has_warning(path, "6 points left out"));
  CHECK(has_warning(path, "number 2 "));
}

TEST_CASE("points are put in order of time, and of equal times the first counts") {
  const std::string mixed = gpx_of(
      "<trkpt lat='47.2' lon='8'><ele>1</ele><time>2026-05-01T12:00:02Z</time></trkpt>"
      "<trkpt lat='47.0' lon='8'><ele>1</ele><time>2026-05-01T12:00:00Z</time></trkpt>"
      "<trkpt lat='47.9' lon='8'><ele>1</ele><time>2026-05-01T12:00:02Z</time></trkpt>"
      "<trkpt lat='47.1' lon='8'><ele>1</ele><time>2026-05-01T12:00:01Z</time></trkpt>"
      "<trkpt lat='47.8' lon='8'><ele>1</ele></trkpt>");
  const RecordedPath path = recorded_paths_of(mixed, "a.gpx").value().at(0);
  REQUIRE(path.points.size() == 3);
  CHECK(path.points[0].place.latitude_deg == 47.0);
  CHECK(path.points[1].place.latitude_deg == 47.1);
  CHECK(path.points[2].place.latitude_deg == 47.2);
  CHECK(has_warning(path, "times go back at 2 points"));
  CHECK(has_warning(path, "1 point left out for the time of an earlier one"));
  CHECK(has_warning(path, "1 point left out for want of a time"));
}

TEST_CASE("a height that a point lacks lies between those of its neighbours, in proportion to time") {
  const std::string holes = gpx_of(
      "<trkpt lat='47' lon='8'><time>2026-05-01T12:00:00Z</time></trkpt>"
      "<trkpt lat='47' lon='8'><ele>100</ele><time>2026-05-01T12:00:01Z</time></trkpt>"
      "<trkpt lat='47' lon='8'><ele>nan</ele><time>2026-05-01T12:00:02Z</time></trkpt>"
      "<trkpt lat='47' lon='8'><ele>200</ele><time>2026-05-01T12:00:05Z</time></trkpt>"
      "<trkpt lat='47' lon='8'><ele>1e300</ele><time>2026-05-01T12:00:06Z</time></trkpt>");
  const RecordedPath path = recorded_paths_of(holes, "a.gpx").value().at(0);
  REQUIRE(path.points.size() == 5);
  CHECK(path.points[0].place.height_m == 100);
  CHECK(path.points[2].place.height_m == doctest::Approx(125));
  CHECK(path.points[4].place.height_m == 200);
  CHECK(has_warning(path, "3 points without a height"));
  CHECK(has_warning(path, "2 heights ignored"));
}

TEST_CASE("gaps and times without a zone are named") {
  const std::string text = gpx_of(
      "<trkpt lat='47' lon='8'><time>2026-05-01T12:00:00</time></trkpt>"
      "<trkpt lat='47' lon='8'><time>2026-05-01T12:02:00</time></trkpt>");
  const RecordedPath path = recorded_paths_of(text, "a.gpx").value().at(0);
  CHECK(has_warning(path, "1 gap longer than 30 s"));
  CHECK(has_warning(path, "2:00 after point 1"));
  CHECK(has_warning(path, "no zone"));
}

TEST_CASE("a file without a path is refused with what it is") {
  const auto says = [](const std::string& text, const std::string& part) {
    const auto paths = recorded_paths_of(text, "a.gpx");
    REQUIRE_FALSE(paths.has_value());
    CHECK_MESSAGE(paths.error().text().find(part) != std::string::npos, paths.error().text());
    CHECK(paths.error().text().find('\n') == std::string::npos);
    CHECK(paths.error().kind == ErrorKind::bad_data);
  };
  says("", "is empty");
  says("\xEF\xBB\xBF \n", "is empty");
  says("hello", "neither GPX");
  says("<gpx version='1.1'/>", "has no path");
  says("<html><body/></html>", "<html>");
  says("<gpx><trk><trkseg>", "line 1, column");
  says(gpx_of("<trkpt lat='0' lon='0'/>"), "no usable point");
  says("PK\x03\x04 and so on", "KMZ");
  says("\x1F\x8B\x08", "gzip");
  says(std::string("\xFF\xFE<\0g\0p\0x\0", 10), "UTF-8");
  says(
      "<gpx>" +
          [] {
            std::string deep;
            for (int i = 0; i < 200000; ++i) deep += "<a>";
            return deep;
          }(),
      "100 deep");
}

TEST_CASE("the extent of a path across the antimeridian is narrow") {
  const PathExtent extent = extent_of({{0, {10, 179.5, 5}}, {1, {11, -179.5, 7}}, {2, {9, 180, -3}}});
  CHECK(extent.west_deg == 179.5);
  CHECK(extent.east_deg == -179.5);
  CHECK(extent.south_deg == 9);
  CHECK(extent.north_deg == 11);
  CHECK(extent.low_m == -3);
  CHECK(extent.high_m == 7);
  const PathExtent plain = extent_of({{0, {0, -5, 0}}, {1, {0, 7, 0}}});
  CHECK(plain.west_deg == -5);
  CHECK(plain.east_deg == 7);
}

namespace {

RecordedPath kml_path(const std::string& name) {
  const auto paths = recorded_paths_of(kKmlExample, "a.kml");
  REQUIRE_MESSAGE(paths.has_value(), paths.error().text());
  CHECK(paths->size() == 5);
  for (const RecordedPath& path : *paths)
    if (path.name == name) return path;
  FAIL("no path " << name);
  return {};
}

}  // namespace

TEST_CASE("a track of KML has the time and place of each entry; an empty place is left out") {
  const RecordedPath track = kml_path("track");
  REQUIRE(track.points.size() == 2);
  CHECK(track.points[0] == TimedPlace{1777636800, {47.1, 8.1, 500}});
  CHECK(track.points[1] == TimedPlace{1777636802, {47.3, 8.3, 520}});
  CHECK(track.utc);
  CHECK(track.height == HeightReference::sea_level);
  CHECK(has_warning(track, "1 point left out"));
}

TEST_CASE("the tracks of a MultiTrack are one path, and heights above the ground are named so") {
  const RecordedPath path = kml_path("two parts");
  REQUIRE(path.points.size() == 2);
  CHECK(path.points[1] == TimedPlace{1777636809, {47, 8.1, 20}});
  CHECK(path.height == HeightReference::ground);
  CHECK(has_warning(path, "from the ground"));
}

TEST_CASE("a line of KML has no times") {
  const RecordedPath line = kml_path("line");
  CHECK_FALSE(line.has_times);
  REQUIRE(line.points.size() == 3);
  CHECK(line.points[2].place == GeodeticPosition{47.2, 8.2, 420});
  CHECK(kml_path("flat").height == HeightReference::unknown);
}

TEST_CASE("points with times in one folder of KML are a path of the folder's name") {
  const RecordedPath path = kml_path("inner");
  REQUIRE(path.points.size() == 2);
  CHECK(path.points[1] == TimedPlace{1777636804, {46.1, 7.1, 140}});
  CHECK(path.height == HeightReference::ground);
  CHECK(has_warning(path, "altitudeMode is not stated"));
}

TEST_CASE("times and places of a track that do not match in number are named") {
  const auto paths = recorded_paths_of(
      "<kml><Placemark><Track><when>2026-05-01T12:00:00Z</when><when>2026-05-01T12:00:01Z</when>"
      "<coord>8 47 1</coord></Track></Placemark></kml>",
      "a.kml");
  REQUIRE(paths.has_value());
  CHECK(paths->at(0).points.size() == 1);
  CHECK(has_warning(paths->at(0), "2 times and 1 places"));
}
