// SPDX-License-Identifier: MIT
#include "encounter/daa_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "encounter/well_clear.h"
#include "geo/geodetic.h"

using namespace sigs;

namespace {

constexpr double kKnot_mps = 1852.0 / 3600;

const std::string kPlain =
    "# made by hand\n"
    "NAME, sx, sy, sz, vx, vy, vz, time\n"
    "[none], [nmi], [NMI], [ft], [knot], [kts], [fpm], [s]\n"
    "Own 1, 1, 2, 1000, 10, 20, 300, 0\n"
    "AC1, 2, 3, 2000, -10, -20, -300, 0\n"
    "\n"
    "Own 1, 1.5, 2.5, 1005, 10, 20, 300, 1\n"
    "AC1, 2.5, 3.5, 1995, -10, -20, -300, 1\n";

Result<EncounterFile> parsed(const std::string& text) {
  return parse_daa(text, "pair.daa");
}

std::string error_of(const std::string& text) {
  const Result<EncounterFile> file = parsed(text);
  return file ? "no error" : file.error().text();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Whether what was read keeps its promises.
bool is_in_order(const Result<EncounterFile>& file) {
  if (!file) return !file.error().what.empty();
  for (const SampledTrack& track : file->tracks)
    if (!check_track(track)) return false;
  return file->tracks.size() >= 2;
}

}  // namespace

TEST_CASE("places and velocities along axes, in the units of the second line") {
  const Result<EncounterFile> file = parsed(kPlain);
  REQUIRE_MESSAGE(file, file.error().text());
  REQUIRE(file->tracks.size() == 2);
  CHECK(file->tracks[0].name == "Own 1");
  CHECK(file->tracks[1].name == "AC1");
  CHECK_FALSE(file->origin);
  const TrackSample& sample = file->tracks[1].samples.at(1);
  CHECK(sample.time_s == 1);
  CHECK(sample.state.position_m.y == doctest::Approx(2.5 * 1852));  // sx is east
  CHECK(sample.state.position_m.x == doctest::Approx(3.5 * 1852));
  CHECK(sample.state.position_m.z == doctest::Approx(-1995 * kFoot_m));
  CHECK(sample.state.velocity_mps.y == doctest::Approx(-10 * kKnot_mps));
  CHECK(sample.state.velocity_mps.x == doctest::Approx(-20 * kKnot_mps));
  CHECK(sample.state.velocity_mps.z == doctest::Approx(300 * kFoot_m / 60));
}

TEST_CASE("without a line of units DAIDALUS's own hold; white space separates where there are no commas") {
  const Result<EncounterFile> file =
      parsed("name time sx sy sz trk gs vs\nA 0:01:02 1 2 100 90 60 -60\nB 0 1 2 100 90 60 -60\n");
  REQUIRE_MESSAGE(file, file.error().text());
  const TrackSample& sample = file->tracks[0].samples.at(0);
  CHECK(sample.time_s == 62);
  CHECK(sample.state.position_m.y == doctest::Approx(1852));
  CHECK(sample.state.velocity_mps.y == doctest::Approx(60 * kKnot_mps));  // course 90: east
  CHECK(std::abs(sample.state.velocity_mps.x) < 1e-12);
  CHECK(sample.state.velocity_mps.z == doctest::Approx(kFoot_m));
}

TEST_CASE("latitude and longitude: distances and courses are those of the ellipsoid near the ownship") {
  // Near 60 degrees north, across the antimeridian: a degree of longitude is 55.8 km of WGS-84 there.
  const Result<EncounterFile> file = parsed(
      "NAME lat lon alt trk gs vs time\nnone deg deg m deg m/s m/s s\n"
      "own 60 179.95 1000 0 50 0 0\nother 60 -179.95 1200 0 50 3 0\n");
  REQUIRE_MESSAGE(file, file.error().text());
  REQUIRE(file->origin);
  CHECK(file->origin->longitude_deg == 179.95);
  const AircraftState own = file->tracks[0].samples[0].state;
  const AircraftState other = file->tracks[1].samples[0].state;
  CHECK(std::abs(own.position_m.x) < 1e-6);
  CHECK(own.position_m.z == -1000);
  CHECK(other.position_m.z == -1200);  // heights are kept
  const double n_m = 6378137 / std::sqrt(1 - 0.00669437999014 * 0.75) + 1000;
  const double width_m = n_m * 0.5 * std::sin(0.1 * 3.14159265358979 / 180);
  CHECK(other.position_m.y - own.position_m.y == doctest::Approx(width_m).epsilon(1e-9));
  // North there is turned by the meridians' convergence, 0.1 deg * sin 60 deg, to the left.
  CHECK(std::atan2(other.velocity_mps.y, other.velocity_mps.x) ==
        doctest::Approx(-0.1 * 3.14159265358979 / 180 * std::sin(3.14159265358979 / 3)).epsilon(1e-3));
  CHECK(std::hypot(other.velocity_mps.x, other.velocity_mps.y) == doctest::Approx(50).epsilon(1e-12));
}

TEST_CASE("what is written reads back as the same numbers, whatever the tracks") {
  std::mt19937 random(5);
  const auto number = [&](double size) { return size * (static_cast<double>(random()) / 2147483648.0 - 1); };
  std::vector<SampledTrack> tracks;
  for (int i = 0; i < 3; ++i) {
    SampledTrack track{.name = i == 0 ? "ownship" : "N" + std::to_string(i), .has_velocities = true};
    for (int k = 0; k < 30; ++k)
      track.samples.push_back(
          {k * 0.1 + i * 0.03, {{number(1e5), number(1e5), number(1e4)}, {number(100), number(100), number(10)}}});
    tracks.push_back(track);
  }
  const Result<EncounterFile> back = parsed(daa_text(tracks));
  REQUIRE_MESSAGE(back, back.error().text());
  CHECK(back->warnings.empty());
  REQUIRE(back->tracks.size() == tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    CHECK(back->tracks[i].name == tracks[i].name);
    REQUIRE(back->tracks[i].samples.size() == tracks[i].samples.size());
    for (std::size_t k = 0; k < tracks[i].samples.size(); ++k) {
      CHECK(back->tracks[i].samples[k].time_s == tracks[i].samples[k].time_s);
      CHECK(back->tracks[i].samples[k].state.position_m == tracks[i].samples[k].state.position_m);
      CHECK(back->tracks[i].samples[k].state.velocity_mps == tracks[i].samples[k].state.velocity_mps);
    }
  }
  tracks[0].name = "a, b #1";
  CHECK(parsed(daa_text(tracks))->tracks[0].name == "a__b__1");
}

TEST_CASE("a mistake in a file is named with its line and column") {
  CHECK(contains(error_of(replaced(kPlain, "2.5, 3.5", "x, 3.5")), "line 8, column sx"));
  CHECK(contains(error_of(replaced(kPlain, "1995", "nan")), "line 8, column sz"));
  CHECK(contains(error_of(replaced(kPlain, "1995", "1e300")), "line 8, column sz"));
  CHECK(contains(error_of(replaced(kPlain, "1005, 10", "1005, , 10")), "line 7"));
  CHECK(contains(error_of(replaced(kPlain, "300, 1\nAC1", "300, 0\nAC1")), "line 7, column time"));
  CHECK(contains(error_of(replaced(kPlain, "[knot]", "[ft]")), "line 3, column vx"));
  CHECK(contains(error_of(replaced(kPlain, "[knot], ", "")), "line 3"));
  CHECK(contains(error_of(replaced(kPlain, "vz, time", "vx, time")), "line 2, column vx"));
  CHECK(contains(error_of(replaced(kPlain, "sx, sy", "sx, wind")), "sx, sy, sz or lat, lon, alt"));
  CHECK(contains(error_of(replaced(kPlain, "NAME", "title")), "name and time"));
  CHECK(contains(error_of("NAME, sx, sy, sz, vx, vy, vz, time\nA, 1, 2, 3, 4, 5, 6, 7\n"), "an intruder"));
  CHECK(contains(error_of("name lat lon alt trk gs vs time\nA 95 0 0 0 0 0 0\n"), "line 2, column lat"));
  CHECK(contains(error_of(""), "empty"));
  CHECK(contains(error_of("\n\n# only this\n"), "empty"));
  const Result<EncounterFile> more =
      parsed("name time sx sy sz trk gs vs wind\nA 0 1 2 1 9 6 6 5\nB 0 1 2 1 9 6 6 5\n");
  REQUIRE(more);
  CHECK(contains(more->warnings.at(0).text(), "wind"));
}

TEST_CASE("a table of a pair: units of each column, velocities or none, mistakes with their place") {
  const std::string text =
      "t_s,own_east_ft,int_east_m,own_north_km,int_north_nmi,own_alt_ft,int_up_m,own_veast_kt,int_veast_mps,"
      "own_vnorth_ftps,int_vnorth_mps,own_vup_fpm,int_vup_mps\n"
      "0,1,2,3,4,5,6,7,8,9,10,600,12\n1,1,2,3,4,5,6,7,8,9,10,600,12\n";
  const Result<EncounterFile> file = parse_pair_csv(text, "pair.csv");
  REQUIRE_MESSAGE(file, file.error().text());
  const AircraftState own = file->tracks[0].samples[0].state;
  CHECK(own.position_m.x == 3000);
  CHECK(own.position_m.y == doctest::Approx(kFoot_m));
  CHECK(own.position_m.z == doctest::Approx(-5 * kFoot_m));
  CHECK(own.velocity_mps.y == doctest::Approx(7 * kKnot_mps));
  CHECK(own.velocity_mps.z == doctest::Approx(-10 * kFoot_m));
  CHECK(file->tracks[1].samples[0].state.position_m.x == doctest::Approx(4 * 1852));
  const auto said = [&](const std::string& broken) {
    const Result<EncounterFile> read = parse_pair_csv(broken, "pair.csv");
    return read ? "no error" : read.error().text();
  };
  CHECK(contains(said(replaced(text, "0,1,2,3", "0,1,inf,3")), "line 2, column int_east_m"));
  CHECK(contains(said(replaced(text, "\n1,", "\n0,")), "line 3, column t_s"));
  CHECK(contains(said(replaced(text, "own_vup_fpm", "own_vup_ft")), "some of the columns"));
  CHECK(contains(said(replaced(text, "own_alt_ft", "own_alt_kt")), "own_alt"));
  CHECK(contains(said(replaced(text, "t_s", "x")), "t_s"));
  CHECK(contains(said("t_s,own_east_m,own_north_m,own_alt_m,int_east_m,int_north_m,int_alt_m\n"), "no line"));
  const Result<EncounterFile> places = parse_pair_csv(
      "time_s,own_east_m,own_north_m,own_alt_m,int_east_m,int_north_m,int_alt_m\n0,0,0,0,1,1,1\n", "pair.csv");
  REQUIRE(places);
  CHECK_FALSE(places->tracks[0].has_velocities);
}

TEST_CASE("files cut anywhere or with wrong bytes give flights in order or an error that says something") {
  std::mt19937 random(11);
  for (const std::string& whole :
       {kPlain, std::string("t_s,own_east_m,own_north_m,own_alt_m,int_east_m,int_north_m,int_alt_m\n0,0,0,0,1,1,1\n"
                            "1,0,0,0,1,1,1\n2,5,5,5,6,6,6\n")}) {
    const auto read = [&](const std::string& text) {
      return &whole == &kPlain || text.find("own_") == std::string::npos ? parsed(text)
                                                                         : parse_pair_csv(text, "pair.csv");
    };
    for (std::size_t size = 0; size < whole.size(); ++size) CHECK(is_in_order(read(whole.substr(0, size))));
    for (int i = 0; i < 3000; ++i) {
      std::string broken = whole;
      for (int flip = 0; flip < 1 + i % 5; ++flip)
        broken[random() % broken.size()] =
            static_cast<char>(i % 2 == 0 ? random() % 256 : "0,.\n-e[]9#"[random() % 10]);
      CHECK(is_in_order(read(broken)));
    }
  }
}
