// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

std::string sample() {
  return (source_dir() / "assets/footage/sample.mp4").string();
}

}  // namespace

TEST_CASE("how footage looks is printed as a table, written as settings and drawn as a PNG") {
  const TemporaryFolder folder;
  const std::string out = (folder / "settings.json").string();
  const std::string plot = (folder / "page.png").string();
  const Run run = run_sigs("appearance " + sample() + " --frames 0-40 --every 10 --out " + out + " --plot " + plot);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(has(run.out, "5 frames used"), run.out);
  for (const char* const name : {"point spread", "noise at black", "airlight", "exposure", "settings:"})
    CHECK_MESSAGE(has(run.out, name), run.out);
  const nlohmann::json settings = json_of(out);
  CHECK(settings["appearance"]["codec"]["match"] == "footage");
  CHECK(settings["appearance"]["grain"]["sd_dark"].is_number());
  CHECK(settings["compositing"]["blur_px_per_m"] == 0);
  CHECK(settings["light"]["kind"] == "sun");
  CHECK_FALSE(settings.contains("footage"));
  const cv::Mat page = cv::imread(plot);
  CHECK(page.cols == 1440);
  CHECK(page.rows >= 720);
  const Run again = run_sigs("appearance " + sample() + " --frames 0-1 --out " + out);
  CHECK(again.status == 73);
  CHECK(json_of(out) == settings);
}

TEST_CASE("the same as JSON says of each quantity whether it is known, and why not") {
  const Run run = run_sigs("appearance " + sample() + " --frames 3 --json");
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const nlohmann::json report = nlohmann::json::parse(run.out);
  CHECK(report["frames_used"] == 1);
  CHECK(report["codec"] == "h264");
  REQUIRE(report["quantities"].size() > 10);
  for (const nlohmann::json& quantity : report["quantities"]) {
    CAPTURE(quantity.dump());
    CHECK(quantity["is_known"].get<bool>() == quantity["why"].get<std::string>().empty());
    CHECK(quantity["is_known"].get<bool>() == quantity["sd"].is_number());
  }
  CHECK(report["settings"].contains("appearance"));
}

TEST_CASE("what is found goes into a project whose other settings stay") {
  const TinyProject tiny;
  nlohmann::json before = json_of(tiny.project());
  before["my_note"] = "keep this";
  write_file(tiny.project(), before.dump(2));
  const Run run = run_sigs("appearance " + sample() + " --frames 0-10 --into " + tiny.project());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const nlohmann::json after = json_of(tiny.project());
  CHECK(after["my_note"] == "keep this");
  CHECK(after["appearance"]["codec"]["match"] == "footage");
  CHECK(after["light"]["kind"] == "sun");
  CHECK(after["intruders"].size() == before["intruders"].size());
  CHECK(after["footage"]["video"] == before["footage"]["video"]);
  CHECK(run_sigs("appearance " + tiny.project()).status == 0);  // its own footage: 64x48
}

TEST_CASE("a height that init guessed tells no visibility, the same height stated by the user does") {
  const TemporaryFolder folder;
  const std::string project = (folder / "p.json").string(), stated = (folder / "stated.json").string();
  REQUIRE(run_sigs("init " + sample() + " --plain --out " + project).status == 0);
  const nlohmann::json first = json_of(project);
  write_file(stated, first.dump(2));  // without the list of guesses that is beside the other one
  const Run guessed = run_sigs("appearance " + project + " --frames 0-40 --into " + project);
  REQUIRE_MESSAGE(guessed.status == 0, guessed.err);
  CHECK_MESSAGE(has(guessed.out, "not known: the camera's height is not known; clear air is taken"), guessed.out);
  CHECK(json_of(project)["appearance"]["haze"]["visibility_m"].is_null());
  const Run known = run_sigs("appearance " + stated + " --frames 0-40 --into " + stated);
  REQUIRE_MESSAGE(known.status == 0, known.err);
  CHECK(json_of(stated)["appearance"]["haze"]["visibility_m"].is_number());
  nlohmann::json changed = first;
  changed["camera"]["position_m"] = {0, 0, -151};
  write_file(project, changed.dump(2));
  REQUIRE(run_sigs("appearance " + project + " --frames 0-40 --into " + project).status == 0);
  CHECK(json_of(project)["appearance"]["haze"]["visibility_m"].is_number());
}

TEST_CASE("--lit-like finds the exposure that an aircraft in the footage was drawn with, and --into sets it") {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  // An airliner in a plain part of the sky, in light that is weak.
  const auto at = [&](const char* path) { return (source_dir() / path).string(); };
  nlohmann::json json = json_of(at("projects/crossing/crossing.json"));
  json["name"] = "drawn";
  json["footage"] = {{"video", at("assets/footage/sample.mp4")}, {"calibration", at("assets/calibrations/sample.xml")}};
  json["light"] = {{"kind", "sun"}, {"exposure", 0.5}, {"sun", {{"azimuth_deg", 150}, {"elevation_deg", 30}}}};
  json["intruders"][0]["model"]["file"] = at("assets/models/airliner/airliner.obj");
  json["intruders"][0]["trajectory"]["waypoints"] = {{{"frame", 0}, {"position_m", {500, -200, -330}}},
                                                     {{"frame", 199}, {"position_m", {640, 300, -330}}}};
  write_file(folder / "drawn.json", json.dump());
  const Run drawn = run_sigs("export " + (folder / "drawn.json").string() + " --out " + out +
                             " --frames 136-138 --masks none --labels coco");
  if (drawn.status == 69) return say_skipped(drawn.err);
  REQUIRE_MESSAGE(drawn.status == 0, drawn.err);
  const nlohmann::json drawn_box = json_of(folder / "drawn.coco.json")["annotations"][0]["bbox"];
  // A project over that footage, in which the airliner is now real, with another aircraft and twice the light.
  const std::string project = (folder / "over.json").string();
  json["footage"] = {{"video", "drawn.mkv"}, {"calibration", at("assets/calibrations/sample.xml")}};
  json["intruders"][0]["model"]["file"] = at("assets/models/light-aircraft/light-aircraft.obj");
  json["light"]["exposure"] = 1;
  write_file(project, json.dump());
  const std::string box =
      fmt::format(" --lit-like {},{},{},{} --frame 0", drawn_box[0].get<double>() - 6, drawn_box[1].get<double>() - 6,
                  drawn_box[2].get<double>() + 12, drawn_box[3].get<double>() + 12);
  const Run lit = run_sigs("appearance " + project + box + " --json --into " + project);
  REQUIRE_MESSAGE(lit.status == 0, lit.err);
  const nlohmann::json report = nlohmann::json::parse(lit.out);
  const double exposure = json_of(project)["light"]["exposure"].get<double>();
  CHECK(report["settings"]["light"]["exposure"] == exposure);
  CHECK(exposure < 0.8);  // from 1 to about 0.5; paint and view are not known
  CHECK(exposure > 0.3);

  CHECK(run_sigs("appearance " + sample() + box).status == 64);
  CHECK(run_sigs("appearance " + project + " --lit-like 760,362,60,34").status == 64);
  CHECK(run_sigs("appearance " + project + " --frame 0").status == 64);
  CHECK(run_sigs("appearance " + project + " --lit-like 760,362,60 --frame 0").status == 64);
  CHECK(run_sigs("appearance " + project + " --lit-like 760,362,60,34 --frame 99").status == 64);
  CHECK(run_sigs("appearance " + project + box + " --every 2").status == 64);
  const Run empty = run_sigs("appearance " + project + " --lit-like 100,40,40,30 --frame 0");
  CHECK(empty.status == 65);
  CHECK_MESSAGE(has(empty.err, "nothing in the box"), empty.err);
}

TEST_CASE("a wrong request of appearance is refused and nothing is written") {
  const TemporaryFolder folder;
  const std::string png = (folder / "a.png").string();
  CHECK(run_sigs("appearance " + sample() + " --plot " + (folder / "a.svg").string()).status == 64);
  CHECK(run_sigs("appearance " + sample() + " --out " + png + " --plot " + png).status == 64);
  CHECK(run_sigs("appearance " + sample() + " --frames 500 --plot " + png).status == 64);
  CHECK(run_sigs("appearance " + sample() + " --frames 3-x --plot " + png).status == 64);
  CHECK(run_sigs("appearance " + sample() + " --out " + sample() + " --force").status == 73);
  CHECK(run_sigs("appearance missing.mp4 --plot " + png).status == 66);
  CHECK(run_sigs("appearance " + sample() + " --into missing.json --plot " + png).status == 66);
  write_file(folder / "text.mp4", "no video");
  CHECK(run_sigs("appearance " + (folder / "text.mp4").string() + " --plot " + png).status != 0);
  CHECK_FALSE(std::filesystem::exists(png));
}

TEST_CASE("init writes the appearance and light that appearance --into writes; --plain leaves them out") {
  if (!has_real_data()) return;
  // Nothing but sky, so that neither takes a height or an attitude from the project.
  const std::string video = (real_data() / "track/V_AIRPLANE_044.mp4").string();
  const TemporaryFolder folder;
  const std::string project = (folder / "p.json").string();
  const Run made = run_sigs("init " + video + " --progress plain --out " + project);
  REQUIRE_MESSAGE(made.status == 0, made.err);
  CHECK_MESSAGE(has(made.err, "%: matching the footage's appearance"), made.err);
  nlohmann::json first = json_of(project);
  CHECK(first["compositing"]["quality"] == "auto");
  first["compositing"]["quality"] = "exact";  // is no appearance: --into leaves it
  CHECK(first["appearance"]["codec"]["match"] == "footage");
  const std::string plain = (folder / "plain.json").string();
  REQUIRE(run_sigs("init " + video + " --plain --out " + plain).status == 0);
  CHECK(json_of(plain)["appearance"]["codec"]["match"] == "none");
  REQUIRE(run_sigs("appearance " + plain + " --into " + plain).status == 0);
  const nlohmann::json later = json_of(plain);
  CHECK(first["appearance"] == later["appearance"]);
  CHECK(first["compositing"] == later["compositing"]);
  CHECK(first["light"] == later["light"]);
}
