// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// An exported rig of two cameras: the cube leaves the front one to the right, where the right one shows it.
struct ExportedRig {
  TinyProject tiny{60};

  ExportedRig() {
    nlohmann::json project = json_of(tiny.project());
    const nlohmann::json footage = project["footage"];
    project.erase("footage");
    project["camera"] = {{"speed_mps", 0}};
    project["cameras"] = {{{"name", "front"}, {"footage", footage}},
                          {{"name", "right"},
                           {"footage", footage},
                           {"mount", {{"attitude_deg", {{"yaw", 50}}}}},
                           {"clock", {{"offset_s", 0.02}}}}};
    project["intruders"][0]["trajectory"]["waypoints"] = {{{"frame", 0}, {"position_m", {60, -10, -150}}},
                                                          {{"frame", 59}, {"position_m", {60, 80, -150}}}};
    write_file(tiny.project(), project.dump());
    const Run run = run_sigs("export " + tiny.project() + " --set export.masks=none --out " + tiny.out());
    REQUIRE_MESSAGE(run.status == 0, run.err);
  }
  [[nodiscard]] std::string rig() const { return (fs::path(tiny.out()) / "tiny.rig.json").string(); }

  // All true boxes of a camera's labels, read as text; without them nothing is reported.
  std::string results(const std::string& camera, bool with_boxes = true) const {
    const std::string xml = text_of(fs::path(tiny.out()) / ("tiny." + camera + ".xml"));
    const std::regex frame_or_box(
        "<frame index=\"(\\d+)\"|<box x=\"(-?\\d+)\" y=\"(-?\\d+)\" width=\"(\\d+)\" height=\"(\\d+)\"");
    std::string csv = "frame,x,y,width,height\n";
    std::string frame;
    for (std::sregex_iterator it(xml.begin(), xml.end(), frame_or_box), end; with_boxes && it != end; ++it) {
      const std::smatch& found = *it;
      if (found[1].matched)
        frame = found[1];
      else
        csv += frame + "," + found[2].str() + "," + found[3].str() + "," + found[4].str() + "," + found[5].str() + "\n";
    }
    const fs::path file = tiny.file("found") / ("tiny." + camera + ".csv");
    write_file_and_folders(file, csv);
    return file.string();
  }
};

}  // namespace

TEST_CASE(
    "a perfect detector of a rig has all that is seen, from the first view on, and loses nothing at the handover") {
  const ExportedRig rig;
  rig.results("front");
  rig.results("right");
  const Run run = run_sigs("evaluate rig " + rig.rig() + " --results " + rig.tiny.file("found").string() + " --out " +
                           rig.tiny.file("report").string());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(run.out.find("front to right") != std::string::npos, run.out);
  const nlohmann::json truth = json_of(rig.rig())["intruders"][0];
  REQUIRE(truth["handovers"].size() == 1);
  const nlohmann::json intruder = json_of(rig.tiny.file("report/evaluation.json"))["detectors"][0]["intruders"][0];
  CHECK(intruder["detected_share"].get<double>() == doctest::Approx(1));
  CHECK(intruder["first_detection"]["camera"] == "front");
  CHECK(intruder["first_detection"]["time_s"].get<double>() ==
        doctest::Approx(truth["views"][0]["first_s"].get<double>()));
  CHECK(intruder["first_detection"]["range_m"].get<double>() == doctest::Approx(std::sqrt(60.0 * 60 + 10.0 * 10)));
  CHECK(intruder["handovers"][0]["loss_s"] == 0);
  CHECK(intruder["handovers"][0]["last_before"]["time_s"].get<double>() <=
        truth["handovers"][0]["time_s"].get<double>() + 1e-5);
  CHECK(intruder["handovers"][0]["to"] == "right");
}

TEST_CASE("a rig's detector of the right camera alone begins where that camera does") {
  const ExportedRig rig;
  const Run run = run_sigs("evaluate rig " + rig.rig() + " --results " + rig.results("front", false) + " " +
                           rig.results("right") + " --out " + rig.tiny.file("report").string());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const nlohmann::json truth = json_of(rig.rig())["intruders"][0];
  const nlohmann::json intruder = json_of(rig.tiny.file("report/evaluation.json"))["detectors"][0]["intruders"][0];
  double first_s = -1;
  for (const nlohmann::json& view : truth["views"])
    if (view["camera"] == "right" && first_s < 0) first_s = view["first_s"];
  CHECK(intruder["first_detection"]["time_s"].get<double>() == doctest::Approx(first_s));
  CHECK(intruder["cameras"][0]["first_detection"].is_null());
  CHECK(intruder["cameras"][1]["detected_share"].get<double>() == doctest::Approx(1));
  CHECK(intruder["detected_share"].get<double>() < 0.9);
}

TEST_CASE("what a rig's results lack is named in one line") {
  const ExportedRig rig;
  const std::string front = rig.results("front");
  Run run = run_sigs("evaluate rig " + rig.rig() + " --results " + front);
  CHECK(run.status == 64);
  CHECK_MESSAGE(run.err.find("2 clips") != std::string::npos, run.err);
  run = run_sigs("evaluate rig " + rig.rig() + " --results " + rig.tiny.file("found").string());
  CHECK(run.status == 66);
  CHECK_MESSAGE(run.err.find("tiny.right") != std::string::npos, run.err);
  fs::remove(fs::path(rig.tiny.out()) / "tiny.right.xml");
  run = run_sigs("evaluate rig " + rig.rig() + " --results " + front + " " + front);
  CHECK(run.status == 66);
  CHECK_MESSAGE(run.err.find("tiny.right.xml") != std::string::npos, run.err);
  run = run_sigs("evaluate rig " + rig.tiny.project() + " --results " + front);
  CHECK(run.status == 65);
  CHECK_MESSAGE(run.err.find("sigs_rig") != std::string::npos, run.err);
}

}  // namespace sigs::test
