// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

const std::string kTwoAircraft =
    R"({"now":1777636800,"aircraft":[{"hex":"3c6444","flight":"DLH400  ","lat":47.5,"lon":179.9,"alt_geom":10000},
{"hex":"4b1814","lat":47.4,"lon":8.4,"alt_baro":1000}]})";
const std::string kLater =
    R"({"now":1777636810,"aircraft":[{"hex":"3c6444","flight":"DLH400  ","lat":47.6,"lon":-179.9,"alt_geom":10100}]})";

struct PathFolder {
  TemporaryFolder folder;
  PathFolder() { write_file(folder / "a.json", "[" + kTwoAircraft + "," + kLater + "]"); }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] Run path(const std::string& arguments) const {
    return run_sigs("path " + file("a.json") + " " + arguments);
  }
};

// Puts the project's world on the Earth.
void tiny_on_earth(const std::string& file) {
  Result<ReadProject> read = read_project(file);
  REQUIRE(read);
  read->project.geo = {.latitude_deg = 50, .longitude_deg = 8, .height_m = 100, .heading_deg = 0};
  REQUIRE(write_project(read->project, file, true));
}

}  // namespace

TEST_CASE("path prints a line for each recorded path, and what is doubtful on stderr") {
  const PathFolder folder;
  const Run run = folder.path("");
  CHECK(run.status == 0);
  CHECK(run.out ==
        "\"DLH400\" (3c6444): 2 points, 2026-05-01T12:00:00Z to 2026-05-01T12:00:10Z (0:10), height 3048 to 3078.5 m "
        "above the ellipsoid, latitude 47.5 to 47.6, longitude 179.9 to -179.9\n"
        "\"4b1814\": 1 point, 2026-05-01T12:00:00Z to 2026-05-01T12:00:00Z (0:00), height 304.8 to 304.8 m by "
        "pressure, latitude 47.4 to 47.4, longitude 8.4 to 8.4\n");
  CHECK(has(run.err, "QNH"));
}

TEST_CASE("path converts to KML that it reads as the same paths, to CZML and to a table") {
  const PathFolder folder;
  for (const std::string name : {"a.kml", "b.CZML", "c.csv"}) {
    const Run run = folder.path("--out " + folder.file(name));
    CHECK_MESSAGE(run.status == 0, run.err);
    CHECK(has(run.out, folder.file(name) + "\n"));
    CHECK(std::filesystem::file_size(folder.file(name)) > 100);
  }
  const Run again = run_sigs("path " + folder.file("a.kml"));
  CHECK(again.status == 0);
  CHECK(has(again.out, "\"DLH400\": 2 points, 2026-05-01T12:00:00Z to 2026-05-01T12:00:10Z"));
  CHECK(has(read_text(folder.file("c.csv")).value(),
            "DLH400,3c6444,1777636810,2026-05-01T12:00:10Z,47.6,-179.9,3078.48\n"));
}

TEST_CASE("path takes the paths of one name or address alone") {
  const PathFolder folder;
  CHECK(has(folder.path("--name dlh400").out, "DLH400"));
  CHECK_FALSE(has(folder.path("--name 4B1814").out, "DLH400"));
  const Run none = folder.path("--name SWR1");
  CHECK(none.status == 64);
  CHECK(has(none.err, "4b1814"));
}

TEST_CASE("path overwrites nothing without --force, and never what it reads") {
  const PathFolder folder;
  write_file(folder.folder / "a.kml", "mine");
  CHECK(folder.path("--out " + folder.file("a.kml")).status == 73);
  CHECK(read_text(folder.file("a.kml")).value() == "mine");
  CHECK(folder.path("--force --out " + folder.file("a.kml")).status == 0);
  const Run itself = run_sigs("path " + folder.file("a.kml") + " --force --out " + folder.file("a.kml"));
  CHECK(itself.status == 73);
  CHECK(run_sigs("path " + folder.file("a.kml")).status == 0);
}

TEST_CASE("path refuses unknown kinds of output and inputs that are none") {
  const PathFolder folder;
  CHECK(folder.path("--out " + folder.file("a.txt")).status == 64);
  CHECK(folder.path("--out -").status == 64);
  CHECK(run_sigs("path " + folder.file("none.gpx")).status == 66);
  write_file(folder.folder / "bad.gpx", "<gpx><trk>");
  const Run bad = run_sigs("path " + folder.file("bad.gpx") + " --out " + folder.file("bad.kml"));
  CHECK(bad.status == 65);
  CHECK(has(bad.err, "bad.gpx: line 1"));
  CHECK_FALSE(std::filesystem::exists(folder.file("bad.kml")));
  CHECK(run_sigs("path").status == 64);
}

TEST_CASE("path makes a recorded path the flight of a project's intruder, and writes the encounter for a globe") {
  const TinyProject tiny;
  tiny_on_earth(tiny.project());
  const std::string gpx = tiny.file("t.gpx").string();
  write_file(gpx, R"(<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><trk><name>N1</name><trkseg>
<trkpt lat="50.001" lon="8"><ele>200</ele><time>2026-05-01T12:00:00Z</time></trkpt>
<trkpt lat="50.001" lon="8.001"><ele>210</ele><time>2026-05-01T12:00:05Z</time></trkpt></trkseg></trk></gpx>)");
  const Run without_utc = run_sigs("path " + gpx + " --into " + tiny.project());
  CHECK(without_utc.status == 64);
  CHECK(has(without_utc.err, "say at which frame it begins"));
  const Run wrong = run_sigs("path " + gpx + " --at-frame 0 --intruder 7 --into " + tiny.project());
  CHECK(wrong.status == 64);
  CHECK(has(wrong.err, "--intruder 7"));
  const Run run = run_sigs("path " + gpx + " --at-frame 0 --into " + tiny.project());
  CHECK_MESSAGE(run.status == 0, run.err);
  const auto json = nlohmann::json::parse(read_text(tiny.project()).value());
  const auto& waypoints = json.at("intruders").at(0).at("trajectory").at("waypoints");
  REQUIRE(waypoints.size() == 2);
  CHECK(waypoints.at(0).at("latitude_deg").get<double>() == doctest::Approx(50.001).epsilon(1e-10));
  CHECK(waypoints.at(1).at("height_m").get<double>() == doctest::Approx(210).epsilon(1e-9));
  CHECK(waypoints.at(1).at("frame").get<double>() == doctest::Approx(125));  // 25 frames a second

  const Run kml = run_sigs("path " + tiny.project() + " --out " + tiny.file("e.kml").string());
  CHECK_MESSAGE(kml.status == 0, kml.err);
  const Run again = run_sigs("path " + tiny.file("e.kml").string());
  CHECK(has(again.out, "\"camera\": 10 points"));
  CHECK(run_sigs("path " + tiny.project() + " --out " + tiny.file("e.csv").string()).status == 64);
}

TEST_CASE("a project without a place on the Earth has no path on a globe") {
  const TinyProject tiny;
  const Run run = run_sigs("path " + tiny.project() + " --out " + tiny.file("e.kml").string());
  CHECK(run.status == 78);
  CHECK(has(run.err, "geo"));
  CHECK_FALSE(std::filesystem::exists(tiny.file("e.kml")));
}

TEST_CASE("path says what is wrong with a broken project, be it a field, its version or its brackets") {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& text) {
    write_file(folder / "p.json", text);
    const Run run = run_sigs("path " + (folder / "p.json").string());
    CHECK(run.status == 78);
    CHECK(has(run.err, "p.json: "));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    return run.err;
  };
  CHECK(has(error_of(R"({"sigs": 1, "footage": {"video": 3}})"), "footage.video: "));
  CHECK(has(error_of(R"({"sigs": 1, "intruders": 5})"), "intruders: "));
  CHECK(has(error_of(R"({"sigs": 7})"), "sigs: "));
  CHECK(has(error_of(R"({"footage": {"video": "a.mp4"}})"), "sigs: missing"));
  CHECK(has(error_of("{\"sigs\": 1,\n \"footage\": {\"video\" \"a.mp4\"}}"), "line 2, column "));
  CHECK(has(error_of(R"({"sigs_dataset": 1})"), "recipe"));
}

TEST_CASE("JSON that is no project and no recorded path is told to be none of the known kinds") {
  const TemporaryFolder folder;
  write_file(folder / "a.json", R"({"temperature": 12})");
  const Run run = run_sigs("path " + (folder / "a.json").string());
  CHECK(run.status == 65);
  CHECK(has(run.err, "of no known kind"));
}
