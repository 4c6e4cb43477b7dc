// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// Head-on at 100 m/s, 100 m beside, one height: 2000 m apart at the beginning.
const std::string kHeadOnPair =
    "name, sx, sy, sz, vx, vy, vz, time\n[none], [m], [m], [m], [m/s], [m/s], [m/s], [s]\n"
    "own, 0, 0, 500, 0, 50, 0, 0\nN1, 100, 2000, 500, 0, -50, 0, 0\n"
    "own, 0, 2000, 500, 0, 50, 0, 40\nN1, 100, 0, 500, 0, -50, 0, 40\n";

}  // namespace

TEST_CASE("flights in a file: a table on stdout, JSON with the closed form's numbers, a plot, and the flights again") {
  const TemporaryFolder folder;
  const std::string daa = (folder / "pair.daa").string();
  write_file(daa, kHeadOnPair);
  const std::string out = (folder / "out").string();
  const Run run = run_sigs("encounter " + daa + " --volume nmac --dmod-ft 1000 --zthr-ft 200 --json " + out +
                           ".json --plot " + out + ".png --daa " + out + ".daa");
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.empty());
  CHECK_MESSAGE(has(run.out, "HMD 100.0000 m"), run.out);
  const nlohmann::json json = nlohmann::json::parse(read_text(out + ".json").value());
  const nlohmann::json& one = json.at("encounters").at(0);
  CHECK(one.at("nearest").at("time_s").get<double>() == doctest::Approx(20).epsilon(1e-9));
  CHECK(one.at("volumes").size() == 2);
  CHECK(one.at("volumes").at(1).at("name") == "own");
  const nlohmann::json& loss = one.at("volumes").at(0).at("losses").at(0);
  const double half_s = std::sqrt(152.4 * 152.4 - 100 * 100) / 100;
  CHECK(loss.at("begin_s").get<double>() == doctest::Approx(20 - half_s).epsilon(1e-9));
  CHECK(loss.at("end_s").get<double>() == doctest::Approx(20 + half_s).epsilon(1e-9));
  CHECK(one.at("steps").size() == 2);
  const nlohmann::json& step = one.at("steps").at(0);
  CHECK(step.at("bearing_deg").get<double>() == doctest::Approx(std::atan2(100, 2000) * 180 / std::acos(-1.0)));
  CHECK(step.at("hmd_m").get<double>() == doctest::Approx(100));
  CHECK(step.at("volumes").at("nmac").at("time_to_entry_s").get<double>() == doctest::Approx(20 - half_s));
  CHECK(one.at("steps").at(1).at("volumes").at("nmac").at("time_to_entry_s").is_null());
  CHECK(cv::imread(out + ".png").cols == 1440);
  const Run again = run_sigs("encounter " + out + ".daa --volume nmac --dmod-ft 1000 --zthr-ft 200");
  CHECK(again.out == run.out);
  CHECK(run_sigs("encounter " + daa + " --json " + out + ".json").status == 73);
  CHECK(run_sigs("encounter " + daa + " --json " + out + ".json --force").status == 0);
}

TEST_CASE("a project: the camera's path against each intruder, a step for each frame") {
  TinyProject tiny;
  tiny.change("\"name\": \"tiny\",",
              "\"name\": \"tiny\", \"camera\": {\"position_m\": [0, 0, -150], \"speed_mps\": 10},");
  const std::string json_file = tiny.file("e.json.out").string();
  const Run run = run_sigs("encounter " + tiny.project() + " --volume small-uas --json " + json_file);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const nlohmann::json json = nlohmann::json::parse(read_text(json_file).value());
  const nlohmann::json& one = json.at("encounters").at(0);
  CHECK(one.at("ownship") == "camera");
  CHECK(one.at("intruder") == "cube");
  REQUIRE(one.at("steps").size() == 10);
  // From (20, -3) to (20, 3) in 9 frames of 0.04 s, the camera from (0, 0) at 10 m/s along X.
  for (int i = 0; i < 10; ++i) {
    const double t = i * 0.04;
    CHECK(one.at("steps").at(i).at("range_m").get<double>() ==
          doctest::Approx(std::hypot(20 - 10 * t, -3 + t * 6 / 0.36)).epsilon(1e-9));
  }
  CHECK(one.at("volumes").at(0).at("steps_lost") == 10);
  // What the project is read from is never replaced.
  const std::string model = read_text(tiny.file("cube.obj")).value();
  CHECK(run_sigs("encounter " + tiny.project() + " --force --json " + tiny.file("cube.obj").string()).status == 73);
  CHECK(read_text(tiny.file("cube.obj")).value() == model);
}

TEST_CASE(
    "an export with export.encounter writes the summary that the program prints, and its list of outputs names it") {
  const TinyProject tiny(3);
  const std::string summary = tiny.file("program.json").string();
  REQUIRE(run_sigs("encounter " + tiny.project() + " --volume small-uas --volume nmac --json " + summary).status == 0);
  const std::string command = "export " + tiny.project() + " --out " + tiny.file("out").string() +
                              " --set 'export.encounter=[\"small-uas\",\"nmac\"]'";
  const Run run = run_sigs(command);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(has(run.out, ".encounter.json"), run.out);
  std::string exported;
  for (const auto& entry : std::filesystem::directory_iterator(tiny.file("out")))
    if (entry.path().string().ends_with(".encounter.json")) exported = entry.path().string();
  nlohmann::json expected = nlohmann::json::parse(read_text(summary).value());
  nlohmann::json found = nlohmann::json::parse(read_text(exported).value());
  // The program names the file, the export the project.
  expected.erase("source");
  found.erase("source");
  CHECK(found == expected);
  CHECK(run_sigs(command).status == 73);
  const Run unknown = run_sigs("export " + tiny.project() + " --out " + tiny.file("other").string() +
                               " --set 'export.encounter=[\"nmac\",\"well\"]'");
  CHECK(unknown.status == 78);
  CHECK_MESSAGE(has(unknown.err, "export.encounter: knows no volume \"well\""), unknown.err);
  CHECK_MESSAGE(has(unknown.err, "dwc-en-route"), unknown.err);
  CHECK_FALSE(std::filesystem::exists(tiny.file("other")));
}

TEST_CASE("mistakes end with the status that says so, name what is wrong, and write nothing") {
  const TemporaryFolder folder;
  const std::string daa = (folder / "pair.daa").string();
  const std::string out = (folder / "out.json").string();
  write_file(daa, kHeadOnPair);
  const Run volume = run_sigs("encounter " + daa + " --volume dwc --json " + out);
  CHECK(volume.status == 64);
  CHECK(has(volume.err, "small-uas"));
  CHECK(run_sigs("encounter " + daa + " --zthr-ft -1").status == 64);
  CHECK(run_sigs("encounter " + daa + " --zthr-ft nan").status == 64);
  CHECK(run_sigs("encounter " + daa + " --plot x.svg").status == 64);
  CHECK(run_sigs("encounter " + daa + " --json " + out + " --daa " + out).status == 64);
  CHECK(run_sigs("encounter " + daa + " --daa " + daa + " --force").status == 73);
  const Run other = run_sigs("encounter " + daa + " --intruder N2");
  CHECK(other.status == 64);
  CHECK(has(other.err, "N1"));
  CHECK(run_sigs("encounter " + (folder / "none.daa").string()).status == 66);
  write_file(daa, kHeadOnPair + "N1, 100, x, 500, 0, -50, 0, 41\n");
  const Run broken = run_sigs("encounter " + daa + " --json " + out);
  CHECK(broken.status == 65);
  CHECK(has(broken.err, "line 7, column sy"));
  write_file(daa, "name time sx sy sz vx vy vz\nA 0 1 1 1 1 1 1\nA 1 1 1 1 1 1 1\nB 2 1 1 1 1 1 1\n");
  const Run apart = run_sigs("encounter " + daa + " --json " + out);
  CHECK(apart.status == 65);
  CHECK_MESSAGE(has(apart.err, "no time that both share"), apart.err);
  CHECK_FALSE(std::filesystem::exists(out));
}
