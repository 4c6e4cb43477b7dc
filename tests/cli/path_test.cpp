// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>

#include "base/staged_outputs.h"
#include "cli/program.h"
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
