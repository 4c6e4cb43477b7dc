// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
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

// Three exported clips as a dataset of two splits.
struct SetFixture {
  TinyProject tiny;
  std::string dataset = tiny.file("set").string();

  SetFixture() {
    for (const std::string name : {"one", "two", "three"})
      REQUIRE(run_sigs("export " + tiny.project() + " --set name=" + name + " --frames " +
                       (name == "two" ? "2-7" : "0-9") + " --masks none --out " + dataset + "/" + name)
                  .status == 0);
    write_file(tiny.file("set/index.json"), R"({"sigs_dataset_index": 1, "videos": [
      {"name": "one", "split": "train"}, {"name": "two", "split": "test"}, {"name": "three", "split": "test"}]})");
  }
  [[nodiscard]] Run track(const std::string& arguments) const { return run_sigs("evaluate track " + arguments); }
  [[nodiscard]] std::string text(const std::string& name) const { return read_text(tiny.file(name)).value(); }
  [[nodiscard]] nlohmann::json trackers(const std::string& folder) const {
    nlohmann::json json = json_of(tiny.file(folder + "/evaluation.json"));
    for (nlohmann::json& tracker : json["trackers"]) tracker.erase("measured_frames_per_s");
    return json["trackers"];
  }
};

}  // namespace

TEST_CASE("a dataset is followed in one call, with the same bytes for each number of jobs") {
  const SetFixture fixture;
  const std::string trackers = " --tracker mosse,medianflow,boosting --out ";
  for (const std::string jobs : {"1", "3"}) {
    const Run run =
        fixture.track(fixture.dataset + trackers + fixture.tiny.file("r" + jobs).string() + " --jobs " + jobs);
    REQUIRE_MESSAGE(run.status == 0, run.err);
    CHECK_MESSAGE(has(run.out, "3 clips: over all frames, and the mean over clips"), run.out);
  }
  CHECK(fixture.trackers("r1") == fixture.trackers("r3"));
  CHECK(fixture.text("r1/slices.csv") == fixture.text("r3/slices.csv"));
  for (const std::string clip : {"one", "two", "three"})
    for (const std::string tracker : {"mosse", "medianflow", "boosting"})
      CHECK(fixture.text("r1/results/" + tracker + "/" + clip + ".csv") ==
            fixture.text("r3/results/" + tracker + "/" + clip + ".csv"));
  CHECK(fixture.trackers("r1")[0]["scored_frames"] == 26);

  // Each clip by itself has the figures of its row.
  REQUIRE(fixture.track(fixture.dataset + "/two/two.xml --tracker mosse --out " + fixture.tiny.file("two").string())
              .status == 0);
  const std::string row = fixture.text("two/summary.csv");
  const std::string figures = row.substr(row.find("\nmosse,") + 1);
  const std::string without_speed = figures.substr(0, figures.find_last_of(','));
  CHECK_MESSAGE(has(fixture.text("r1/clips.csv"), "two,intruder 0 (cube),2," + without_speed), without_speed);

  // What was written is read again, as the results of trackers that ran elsewhere; an evaluation is replaced.
  const std::string results = fixture.tiny.file("r1/results").string();
  REQUIRE(fixture
              .track(fixture.dataset + " --results " + results + "/mosse " + results + "/medianflow --out " +
                     fixture.tiny.file("again").string())
              .status == 0);
  CHECK(fixture.trackers("again")[0]["success_auc"] == fixture.trackers("r1")[0]["success_auc"]);
  CHECK(fixture.trackers("again")[1]["over_clips"] == fixture.trackers("r1")[1]["over_clips"]);
  CHECK(fixture.track(fixture.dataset + " --force" + trackers + fixture.tiny.file("r1").string()).status == 0);

  REQUIRE(fixture.track(fixture.dataset + " --split test --tracker mosse --out " + fixture.tiny.file("test").string())
              .status == 0);
  CHECK(fixture.trackers("test")[0]["scored_frames"] == 16);
}

TEST_CASE("inputs of many clips that do not fit are refused in one line, and nothing is written") {
  const SetFixture fixture;
  const std::string out = fixture.tiny.file("report").string();
  const auto refused = [&](const std::string& arguments, int status, const std::string& message) {
    const Run run = fixture.track(arguments + " --out " + out);
    CHECK_MESSAGE(run.status == status, arguments << run.err);
    CHECK_MESSAGE(has(run.err, message), run.err);
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(out));
  };
  refused(fixture.dataset + " --tracker mosse --split none", 65, "has no video of split none");
  refused(fixture.dataset + " --tracker mosse --intruder 1", 64, "--intruder 1: ");
  refused(fixture.dataset + " --tracker mosse --frames 1-2", 64, "--frames: goes with a project");
  refused(fixture.dataset + " --tracker mosse --video " + fixture.dataset, 64, "--video: goes with one clip");
  refused(fixture.dataset + " --tracker none", 64, "--tracker none: no such tracker");
  refused(fixture.dataset + "/one/one.xml --tracker mosse --split test", 64, "--split: goes with a dataset's folder");
  write_file(fixture.tiny.file("a.csv"), "frame,x,y,width,height\n");
  refused(fixture.dataset + " --results " + fixture.tiny.file("a.csv").string(), 64, "a.csv: is no folder");
  fs::create_directories(fixture.tiny.file("mine"));
  refused(fixture.dataset + " --results " + fixture.tiny.file("mine").string(), 66,
          "one.csv, .json or .txt: no results");
  // The first clip in order whose images are missing is named, whatever the jobs.
  fs::remove(fixture.dataset + "/two/two.mkv");
  fs::remove(fixture.dataset + "/three/three.mkv");
  for (const std::string jobs : {"1", "3"})
    refused(fixture.dataset + " --tracker mosse --jobs " + jobs, 66, "two.xml: has neither two.mkv");
}

TEST_CASE("an export in VOT's layout is followed as the labels of the same export are") {
  const SetFixture fixture;
  const TinyProject& tiny = fixture.tiny;
  REQUIRE(
      run_sigs("export " + tiny.project() + " --masks none --labels xml,vot --codec png --out " + tiny.out()).status ==
      0);
  const std::string sequence = tiny.file("out/tiny.vot/tiny").string();
  REQUIRE(fixture.track(tiny.file("out/tiny.xml").string() + " --tracker mosse,kcf --out " + tiny.file("xml").string())
              .status == 0);
  const Run run = fixture.track(sequence + " --tracker mosse,kcf --out " + tiny.file("vot").string());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(fixture.trackers("vot") == fixture.trackers("xml"));
  // The same as OTB's: a line for each frame, pixels from 1, images that are only numbered.
  const std::string otb = tiny.file("otb/tiny").string();
  fs::create_directories(otb + "/img");
  std::string lines;
  const std::string xml = fixture.text("out/tiny.xml");
  for (std::size_t at = xml.find("<box "); at != std::string::npos; at = xml.find("<box ", at + 1)) {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    REQUIRE(std::sscanf(xml.c_str() + at, "<box x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"", &x, &y, &width,
                        &height) == 4);
    for (const int value : {x + 1, y + 1, width, height}) lines += std::to_string(value) + "\t";
    lines += "\n";
  }
  write_file(otb + "/groundtruth_rect.txt", lines);
  for (int i = 0; i < 10; ++i)
    fs::copy_file(tiny.file("out/tiny/frame_00000" + std::to_string(i) + ".png"),
                  otb + "/img/" + std::to_string(i + 1) + ".png");  // 10 stands before 2 by name
  for (const std::string& input : {otb, tiny.file("otb").string()}) {
    REQUIRE(fixture.track(input + " --tracker mosse,kcf --force --out " + tiny.file("otb-report").string()).status ==
            0);
    for (std::size_t i = 0; i < 2; ++i)
      for (const std::string figure : {"mean_center_error_px", "success_auc", "precision_at_20_px", "mean_overlap"})
        CHECK(fixture.trackers("otb-report")[i][figure] == fixture.trackers("xml")[i][figure]);
  }
  CHECK(fixture.track(otb + " --tracker mosse --truth silhouette").status == 64);
  fs::remove(otb + "/img/10.png");
  const Run missing = fixture.track(otb + " --tracker mosse");
  CHECK(missing.status == 65);
  CHECK_MESSAGE(has(missing.err, "img: has 9 frames, the labels have 10"), missing.err);
  fs::remove_all(otb + "/img");
  CHECK(has(fixture.track(otb + " --tracker mosse").err, "has neither images (img/, color/ or its own) nor a video"));
}

}  // namespace sigs::test
