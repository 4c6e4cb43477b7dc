// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "geo/recorded_examples.h"
#include "geo/recorded_path.h"

using namespace sigs;
using namespace sigs::test;

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
