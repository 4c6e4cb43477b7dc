// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// Encounters of 0.4 s count at any distance; one matched frame is a detection in time.
const std::string kPolicy =
    " --min-encounter 0 --max-closest-range 1000 --detect-range 1 --window 0.2 --window-share 0.5";
const std::string kNothing = "frame,x,y,width,height\n";

// Two exported clips, laid out as a dataset, and results.
struct Fixture {
  TinyProject tiny;
  std::string dataset = tiny.file("set").string();

  Fixture() {
    for (const std::string name : {"one", "two"})
      REQUIRE(
          run_sigs("export " + tiny.project() + " --set name=" + name + " --masks none --out " + dataset + "/" + name)
              .status == 0);
    put("set/index.json", R"({"sigs_dataset_index": 1, "videos": [{"name": "one", "split": "train"},
                                                                   {"name": "two", "split": "test"}]})");
  }
  [[nodiscard]] std::string labels(const std::string& name) const { return dataset + "/" + name + "/" + name + ".xml"; }
  std::string put(const std::string& name, const std::string& text) const {
    fs::create_directories(tiny.file(name).parent_path());
    write_file(tiny.file(name), text);
    return tiny.file(name).string();
  }
  // Every true box of a clip, with a false one beside it in the first frame where asked for.
  [[nodiscard]] std::string right(const std::string& name, bool with_false = false) const {
    std::string csv = kNothing;
    const std::string xml = read_text(labels(name)).value();
    int frame = 0;
    for (std::size_t at = xml.find("<box "); at != std::string::npos; at = xml.find("<box ", at + 1), ++frame) {
      int x = 0;
      int y = 0;
      int width = 0;
      int height = 0;
      REQUIRE(std::sscanf(xml.c_str() + at, "<box x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"", &x, &y, &width,
                          &height) == 4);
      csv += std::to_string(frame);
      for (const int value : {x, y, width, height}) csv.append(",").append(std::to_string(value));
      csv += "\n";
      if (frame == 0 && with_false) csv += "0,1,1,4,4\n";
    }
    REQUIRE(frame == 10);
    return csv;
  }
  [[nodiscard]] Run detect(const std::string& arguments) const {
    return run_sigs("evaluate detect " + arguments + kPolicy);
  }
  [[nodiscard]] nlohmann::json report() const { return json_of(tiny.file("report/evaluation.json")); }
  [[nodiscard]] std::string out() const { return " --force --out " + tiny.file("report").string(); }
};

}  // namespace

TEST_CASE("a perfect detector detects every encounter, one without detections none") {
  const Fixture fixture;
  const std::string good = fixture.put("good.csv", fixture.right("one"));
  const std::string blind = fixture.put("blind.csv", kNothing);
  const Run run = fixture.detect(fixture.labels("one") + " --results " + good + " " + blind + fixture.out());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(run.out.find("\ngood      1.000 (1/1)*") != std::string::npos, run.out);
  const nlohmann::json report = fixture.report();
  REQUIRE(report["detectors"].size() == 2);
  CHECK(report["detectors"][0]["frame_detection_rate"] == 1.0);
  CHECK(report["detectors"][0]["false_alarm_boxes"] == 0);
  CHECK(report["detectors"][1]["name"] == "blind");
  CHECK(report["detectors"][1]["frame_detection_rate"] == 0.0);
  CHECK(report["detectors"][1]["encounter_detection_rate"]["all"]["encounters"] == 1);
  CHECK(report["detectors"][1]["encounter_detection_rate"]["all"]["detected"] == 0);
}

TEST_CASE("files are matched to labels in order, folders by name, and a dataset's index lists the clips") {
  const Fixture fixture;
  const std::string one = fixture.put("runs/mine/one.csv", fixture.right("one", true));
  const std::string two = fixture.put("runs/mine/two.csv", fixture.right("two"));
  const std::string folder = fixture.tiny.file("runs/mine").string();
  const std::string both = fixture.labels("one") + " " + fixture.labels("two");
  for (const std::string& arguments : {both + " --results " + one + " " + two, both + " --results " + folder + "/",
                                       fixture.dataset + " --results " + folder}) {
    const Run run = fixture.detect(arguments + fixture.out());
    REQUIRE_MESSAGE(run.status == 0, arguments << run.err);
    const nlohmann::json report = fixture.report();
    CHECK(report["videos"] == nlohmann::json({"one", "two"}));
    REQUIRE(report["detectors"].size() == 1);
    CHECK(report["detectors"][0]["name"] == "mine");
    CHECK(report["detectors"][0]["frames"] == 20);
    CHECK(report["detectors"][0]["false_alarm_boxes"] == 1);
    CHECK(report["detectors"][0]["encounters"].size() == 2);
  }
  const Run classes = fixture.detect(fixture.dataset + " --classes airplane --results " + folder + fixture.out());
  CHECK(classes.status == 64);
  CHECK(classes.err.find("--classes") != std::string::npos);
  REQUIRE(fixture.detect(fixture.dataset + " --split test --results " + folder + fixture.out()).status == 0);
  CHECK(fixture.report()["videos"] == nlohmann::json({"two"}));
  CHECK(fixture.report()["detectors"][0]["false_alarm_boxes"] == 0);
  fs::remove(one);
  const Run missing = fixture.detect(fixture.dataset + " --results " + folder);
  CHECK(missing.status == 66);
  CHECK_MESSAGE(missing.err.find("runs/mine/one.csv: no results for this clip") != std::string::npos, missing.err);
  fs::rename(two, fixture.tiny.file("runs/mine/two.json"));
  const Run other = fixture.detect(fixture.dataset + " --results " + folder);
  CHECK_MESSAGE(other.err.find("runs/mine/one.json: no results for this clip") != std::string::npos, other.err);
  fs::remove(fixture.tiny.file("runs/mine/two.json"));
  const Run empty = fixture.detect(fixture.dataset + " --results " + folder);
  CHECK_MESSAGE(empty.err.find("runs/mine/one.csv, .json or .txt: no results") != std::string::npos, empty.err);
}

TEST_CASE("inputs that do not match are refused in one line") {
  const Fixture fixture;
  const std::string file = fixture.put("a.csv", kNothing);
  const std::string folder = fixture.tiny.file("folder").string();
  fs::create_directories(folder);
  const auto refused = [&](const std::string& arguments, int status, const std::string& message) {
    const Run run = fixture.detect(arguments);
    CHECK_MESSAGE(run.status == status, arguments << run.err);
    CHECK_MESSAGE(run.err.find(message) != std::string::npos, run.err);
    CHECK(run.out.empty());
  };
  const std::string one = fixture.labels("one");
  refused(one + " " + fixture.labels("two") + " --results " + file, 64, "there are 2 clips and 1 file of results");
  refused(one + " --results " + file + " " + folder, 64, "are folders and files");
  refused(one + " --results gone.csv", 66, "gone.csv: no such file or folder");
  refused("gone.xml --results " + file, 66, "gone.xml: no such file or folder");
  refused(folder + " --results " + file, 65, "folder: is no truth: it has neither gt/gt.txt (mot) nor labels/ (yolo)");
  refused(fixture.tiny.project() + " --results " + file, 64, "p.json: is not labels (.xml); of a project sigs export");
  refused(one + " " + one + " --results " + file + " " + file, 64, "one.xml: is named twice");
  fs::create_symlink(one, fixture.tiny.file("link.xml"));
  refused(one + " " + fixture.tiny.file("link.xml").string() + " --results " + file + " " + file, 64,
          "link.xml: is named");
  refused(one + " --split test --results " + file, 64, "--split: goes with a dataset's folder");
  refused(fixture.dataset + " --split none --results " + folder, 65, "has no video of split none");
  for (const std::string option : {"--window", "--min-score", "--match-overlap"})
    for (const std::string value : {"nan", "2e9", "fast"})
      refused(one + " " + option + " " + value + " --results " + file, 64, option);
  refused(one + " --false-overlap 0.5 --results " + file, 64, "--false-overlap: is more than --match-overlap");
  fixture.put("set/index.json", "{\"videos\": 3}");
  refused(fixture.dataset + " --results " + folder, 65, "index.json: is no index of a dataset");
}

TEST_CASE("a folder is taken for an unfinished dataset where it has what a run leaves, and else for a truth") {
  const Fixture fixture;
  const std::string file = fixture.put("a.csv", kNothing);
  const auto check_refused = [&](const std::string& folder, int status, const std::string& message) {
    const Run run = fixture.detect(folder + " --results " + file);
    CHECK_MESSAGE(run.status == status, folder << ": " << run.err);
    CHECK_MESSAGE(run.err.find(message) != std::string::npos, folder << ": " << run.err);
  };
  const std::string unfinished = "index.json: no such file; a dataset has it when it is whole";
  const std::string no_truth = "is no truth: it has neither gt/gt.txt (mot) nor labels/ (yolo)";
  fs::remove(fixture.tiny.file("set/index.json"));
  check_refused(fixture.dataset, 65, no_truth);
  fs::create_directories(fixture.tiny.file("set/.part"));  // of a run that was killed during its first video
  check_refused(fixture.dataset, 66, unfinished);
  fs::remove(fixture.tiny.file("set/.part"));
  fixture.put("set/one/entry.json", "{}");  // of a shard that has ended
  check_refused(fixture.dataset, 66, unfinished);
  fs::create_directories(fixture.tiny.file("set/labels"));
  check_refused(fixture.dataset, 66, unfinished);
  check_refused(fixture.dataset + " " + fixture.labels("two"), 64, "set: is a dataset; name label files, or one");
  check_refused(fixture.dataset + "/one", 65, no_truth);  // the folder of one video
  REQUIRE(
      run_sigs("export " + fixture.tiny.project() + " --masks none --labels voc,kitti,vot --out " + fixture.tiny.out())
          .status == 0);
  for (const char* const format : {"voc", "kitti", "vot"}) {
    check_refused(fixture.tiny.out() + "/tiny." + format, 65, no_truth);
    check_refused(fixture.tiny.out() + "/tiny." + format, 65, "of other labels of SIGS name the file .xml");
  }
}

TEST_CASE("results whose images are another clip's are scored with a warning") {
  const Fixture fixture;
  const auto text = [&](const std::string& folder) {
    const std::string image = folder + "frame_000003.png";
    const std::string file = fixture.put("a.json", "[{\"img_name\": \"" + image + "\", \"detections\": []}]");
    const Run run = fixture.detect(fixture.labels("one") + " --results " + file);
    CHECK(run.status == 0);
    return run.err;
  };
  CHECK(text("").empty());
  CHECK(text("set/one/").empty());
  CHECK(text("two/").find("a.json: its img_name is of two, the clip is one") != std::string::npos);
}

TEST_CASE("an encounter that is too short is not counted, and a warning says why") {
  const Fixture fixture;
  const std::string file = fixture.put("a.csv", kNothing);
  const Run run = run_sigs("evaluate detect " + fixture.labels("one") + " --results " + file);
  CHECK(run.status == 0);
  CHECK_MESSAGE(run.err.find("warning: 1 encounter is not counted: shorter than 3 s (--min-encounter)") == 0, run.err);
}

TEST_CASE("an encounter that stays beyond the maximum range is not counted, and a warning says why") {
  const Fixture fixture;
  const std::string file = fixture.put("a.csv", kNothing);
  const Run run = run_sigs("evaluate detect " + fixture.labels("one") +
                           " --min-encounter 0 --max-closest-range 5 --results " + file);
  CHECK(run.status == 0);
  CHECK_MESSAGE(run.err.find("warning: 1 encounter is not counted") != std::string::npos, run.err);
}

TEST_CASE("the labels of one export are the same truth in every layout that is read") {
  const Fixture fixture;
  const TinyProject& tiny = fixture.tiny;
  REQUIRE(run_sigs("export " + tiny.project() + " --masks none --labels xml,coco,mot,yolo,aot --codec png --out " +
                   tiny.out())
              .status == 0);
  const std::string stem = tiny.file("out/tiny").string();
  const std::string found = fixture.put("found.csv", fixture.right("one", true));
  std::map<std::string, nlohmann::json> scores;
  std::map<std::string, std::string> warnings;
  for (const std::string& truth :
       {stem + ".xml", stem + ".coco.json", stem + ".aot.json", stem + ".mot", stem + ".yolo"}) {
    const Run run = fixture.detect(truth + " --results " + found + fixture.out());
    REQUIRE_MESSAGE(run.status == 0, truth << run.err);
    const std::string layout = truth.substr(stem.size());
    scores[layout] = fixture.report()["detectors"][0];
    warnings[layout] = run.err;
    CHECK(scores[layout]["false_boxes_per_frame"] == 0.1);
    CHECK(scores[layout]["frames_by"]["all"][0]["frames"] == 10);
    CHECK(scores[layout]["frames_by"]["all"][0]["matched"] == 10);
    CHECK(scores[layout]["frames_by"]["size"] == scores[".xml"]["frames_by"]["size"]);
  }
  for (const std::string layout : {".coco.json", ".aot.json"}) {
    CHECK(scores[layout]["encounter_detection_rate"]["all"] == scores[".xml"]["encounter_detection_rate"]["all"]);
    CHECK(scores[layout]["frame_detection_rate"] == 1.0);
    CHECK(scores[layout]["mean_first_range_m"].get<double>() ==
          doctest::Approx(scores[".xml"]["mean_first_range_m"].get<double>()));
    CHECK_MESSAGE(warnings[layout].empty(), warnings[layout]);
  }
  for (const std::string layout : {".coco.json", ".aot.json", ".mot"})
    CHECK(scores[layout]["false_alarms_per_hour"].get<double>() ==
          doctest::Approx(scores[".xml"]["false_alarms_per_hour"].get<double>()).epsilon(1e-4));
  CHECK_MESSAGE(has(warnings[".mot"], "the truth has no ranges: EDR, AFDR"), warnings[".mot"]);
  CHECK_MESSAGE(has(warnings[".yolo"], "does not say which boxes are of one object"), warnings[".yolo"]);
  CHECK_MESSAGE(has(warnings[".yolo"], "no frame rate"), warnings[".yolo"]);
  CHECK(scores[".yolo"]["false_alarms_per_hour"].is_null());
  CHECK(scores[".mot"]["frame_detection_rate"].is_null());
  CHECK(fixture.detect(stem + ".xml --rate 10 --results " + found).status == 64);
  CHECK(has(fixture.detect(stem + ".yolo --size 10 --results " + found).err, "--size: 10 is no size"));
}

}  // namespace sigs::test
