// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/tiny_recipe.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a dry run lists the videos and writes nothing") {
  const TinyRecipe recipe;
  const Run run = recipe.run("out", "--dry-run");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(run.out.starts_with("name "));
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream fields(line);
  std::vector<std::string> row;
  for (std::string field; fields >> field;) row.push_back(field);
  CHECK(std::vector<std::string>(row.begin(), row.begin() + 2) == std::vector<std::string>{"red", "LR"});
  CHECK(has(run.out, "6 videos, 48 frames, about "));
  CHECK_FALSE(fs::exists(recipe.out("out")));
  CHECK(has(recipe.run("out", "--dry-run --shard 2/4").out, "2 videos, 16 frames, about "));
}

TEST_CASE("a dataset's checksums are what sha256sum finds") {
  const TinyRecipe recipe;
  const Run run = recipe.run("out");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, recipe.out("out") + "/index.json\n"));
  CHECK(has(run.err, "6 videos made, 0 kept; 48 frames in "));
  const std::string in_folder = "cd " + recipe.out("out") + " && ";
  CHECK(std::system((in_folder + "sha256sum --check --strict --quiet SHA256SUMS >/dev/null").c_str()) == 0);
  CHECK(std::system((in_folder + "grep -q $(sha256sum SHA256SUMS | cut -d' ' -f1) index.json").c_str()) == 0);
  for (const char* const video : {"red LR", "red RL", "red FN", "large LR", "large RL", "large FN"})
    CHECK(run_sigs("check '" + recipe.out("out") + "/" + video + "/" + video + ".json'").status == 0);
}

TEST_CASE("parallel jobs and merged shards give the dataset of a single run") {
  const TinyRecipe recipe;
  CHECK(recipe.run("one", "--jobs 1").status == 0);
  CHECK(recipe.run("two", "--jobs 2").status == 0);
  const auto truth = contents_of(recipe.out("one"));
  CHECK(contents_of(recipe.out("two")) == truth);
  fs::create_directory(recipe.out("sum"));
  for (const std::string part : {"3", "1", "2"}) {
    CHECK(recipe.run("part" + part, "--shard " + part + "/3").status == 0);
    for (const fs::directory_entry& entry : fs::directory_iterator(recipe.out("part" + part)))
      fs::rename(entry.path(), recipe.out("sum") / entry.path().filename());
  }
  const Run merged = recipe.run("sum", "--merge");
  CHECK_MESSAGE(merged.status == 0, merged.err);
  CHECK(contents_of(recipe.out("sum")) == truth);
}

TEST_CASE("shards of several machines may share a folder while they run") {
  const TinyRecipe recipe;
  std::vector<std::thread> machines;
  for (const std::string part : {"1", "2"})
    machines.emplace_back([&recipe, part] { static_cast<void>(recipe.run("out", "--resume --shard " + part + "/2")); });
  for (std::thread& machine : machines) machine.join();
  CHECK(recipe.run("out", "--merge").status == 0);
  CHECK(recipe.run("whole").status == 0);
  CHECK(contents_of(recipe.out("out")) == contents_of(recipe.out("whole")));
}

TEST_CASE("a merge names what is missing") {
  const TinyRecipe recipe;
  CHECK(recipe.run("out", "--shard 1/2").status == 0);
  const Run run = recipe.run("out", "--merge");
  CHECK(run.status == 65);
  CHECK_MESSAGE(
      has(run.err,
          "of 6 videos 3 cannot go into the index; --resume makes them: red RL, large LR, large FN: missing\n"),
      run.err);
  CHECK_FALSE(fs::exists(recipe.out("out") + "/index.json"));
}

TEST_CASE("--set overrides a background's values, which override the recipe's settings") {
  const TinyRecipe recipe;
  recipe.change("\"settings\": {", "\"settings\": {\"camera.speed_mps\": 5, ");
  recipe.change("\"footage\":", "\"camera\": {\"speed_mps\": 7}, \"footage\":");
  const Run own = recipe.run("own", "--only 'red LR'");
  CHECK_MESSAGE(has(own.err, "settings.camera.speed_mps: has no effect: every background says its own"), own.err);
  CHECK(has(read_text(recipe.out("own") + "/red LR/red LR.json").value(), "\"speed_mps\": 7"));
  CHECK(recipe.run("set", "--only 'red LR' --set camera.speed_mps=9").status == 0);
  CHECK(has(read_text(recipe.out("set") + "/red LR/red LR.json").value(), "\"speed_mps\": 9"));
}

TEST_CASE("an intruder that is never in the image is reported, before a run and in a dry run") {
  const TinyRecipe recipe;
  CHECK_FALSE(has(recipe.run("out", "--dry-run").err, "never"));
  recipe.change("\"distance_m\": 20", "\"distance_m\": 20, \"from_x_percent\": 150, \"to_x_percent\": 140");
  const std::string told = "warning: the intruder is never in the image in 2 videos: red RL, large RL\n";
  const Run dry = recipe.run("out", "--dry-run");
  CHECK(count_of(dry.out, " never ") == 2);
  CHECK_MESSAGE(has(dry.err, told), dry.err);
  CHECK(has(recipe.run("out", "--only 'red RL,large RL'").err, told));
}

TEST_CASE("a clip that cannot be opened makes only its own videos fail") {
  const TinyRecipe recipe;
  write_file(recipe.file("cut.mkv"), "no clip");
  recipe.change("\"backgrounds\": [",
                "\"backgrounds\": [{\"name\": \"cut\", \"footage\": {\"video\": \"cut.mkv\", "
                "\"calibration\": \"lens.xml\"}}, ");
  recipe.change("{aircraft} {flight}", "{background} {aircraft} {flight}");
  for (const char* const more : {"--dry-run", ""}) {
    const Run run = recipe.run("out", more);
    CHECK_MESSAGE((run.status == 65 || run.status == 66), run.err);
    CHECK_MESSAGE(count_of(run.err, "backgrounds[0].footage.video: ") == 6, run.err);
  }
  CHECK(fs::exists(recipe.out("out") + "/sky red LR/entry.json"));
  CHECK_FALSE(fs::exists(recipe.out("out") + "/index.json"));
}

TEST_CASE("a mask of another size than the clip is one error of the recipe, before anything starts") {
  const TinyRecipe recipe;
  write_file(recipe.file("mask.pgm"), "P5\n3 2\n255\naaaaaa");
  recipe.change("\"calibration\": \"lens.xml\"", "\"calibration\": \"lens.xml\", \"own_body_mask\": \"mask.pgm\"");
  for (const char* const more : {"--dry-run", ""}) {
    const Run run = recipe.run("out", more);
    CHECK(run.status == 65);
    CHECK_MESSAGE(count_of(run.err, "recipe.json: backgrounds[0].footage.own_body_mask: ") == 1, run.err);
    CHECK(count_of(run.err, "\n") == 1);
  }
  CHECK_FALSE(fs::exists(recipe.out("out")));
}

TEST_CASE("a dry run that cannot be printed is an error, also with impossible videos") {
  const TinyRecipe recipe;
  recipe.change("\"name\": \"red\",", "\"name\": \"red\", \"speed_limits_mps\": [900, 901],");
  const std::string command =
      (build_dir() / "sigs").string() + " " + recipe.arguments("out") + " --dry-run >/dev/full 2>/dev/null";
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 74);
}

TEST_CASE("a recipe of impossible videos alone creates nothing") {
  const TinyRecipe recipe;
  recipe.change("\"name\": \"red\",", "\"name\": \"red\", \"speed_limits_mps\": [900, 901],");
  recipe.change("\"name\": \"large\",", "\"name\": \"large\", \"speed_limits_mps\": [900, 901],");
  const Run run = recipe.run("out");
  CHECK(run.status == 65);
  CHECK_MESSAGE(has(run.err, "none of its videos can be; nothing is made"), run.err);
  CHECK_MESSAGE(has(run.err, "; change distance_m or frames, or the aircraft's speed_limits_mps"), run.err);
  CHECK_FALSE(fs::exists(recipe.out("out")));
}

TEST_CASE("a misspelt key is reported with the most similar key") {
  const TinyRecipe recipe;
  recipe.change("\"seed\"", "\"sede\"");
  const Run run = recipe.run("out", "--dry-run");
  CHECK_MESSAGE(has(run.err, "sede: unknown key, not used; did you mean seed?"), run.err);
}

TEST_CASE("after a change of the recipe only the changed videos are made again") {
  const TinyRecipe recipe;
  CHECK(recipe.run("out").status == 0);
  CHECK(recipe.run("out").status == 73);
  recipe.change("\"distance_m\": 20", "\"distance_m\": 21");
  const Run run = recipe.run("out", "--resume");
  CHECK(run.status == 0);
  CHECK_MESSAGE(has(run.err, "2 videos made, 4 kept; 16 frames"), run.err);
  CHECK_MESSAGE(count_of(run.err, "is made anew: was made from other settings") == 1, run.err);  // said once
}

TEST_CASE("impossible videos are named, the others are made, and the exit status shows it") {
  const TinyRecipe recipe;
  recipe.change("\"from_distance_m\": 60, \"to_distance_m\": 15",
                "\"from_distance_m\": 60, \"to_distance_m\": 15, \"to_y_percent\": 90, \"from_y_percent\": 90");
  recipe.change("\"footage\":", "\"camera\": {\"position_m\": [0, 0, -1]}, \"footage\":");
  const Run run = recipe.run("out");
  CHECK_MESSAGE(run.status == 65, run.err);
  CHECK_MESSAGE(has(run.err, "error: red FN: "), run.err);
  CHECK(fs::exists(recipe.out("out") + "/index.json"));
  CHECK_FALSE(fs::exists(recipe.out("out") + "/red FN"));
}

TEST_CASE("a video that fails is listed with its reason, the others are made") {
  const TinyRecipe recipe;
  write_file(recipe.file("other.obj"), "v 0 0 0\nf 1 2 3\n");
  recipe.change("\"cube.obj\", \"scale\"", "\"other.obj\", \"scale\"");
  const Run run = recipe.run("out");
  CHECK(run.status == 65);
  CHECK_MESSAGE(count_of(run.err, "error: large ") == 3, run.err);
  CHECK_MESSAGE(has(run.err, "other.obj"), run.err);
  CHECK_MESSAGE(has(run.err, "error: 3 videos failed, so there is no index; --resume tries again\n"), run.err);
  CHECK(fs::exists(recipe.out("out") + "/red LR/entry.json"));
  CHECK_FALSE(fs::exists(recipe.out("out") + "/.part"));
}

TEST_CASE("a full disk and a folder that cannot be created are reported as such") {
  const TinyRecipe recipe(40);
  const std::string command = "export GCOV_PREFIX=/dev/null; ulimit -f 4; " + (build_dir() / "sigs").string() + " " +
                              recipe.arguments("out") + " >/dev/null 2>" + recipe.out("err");
  const int status = std::system(("bash -c '" + command + "'").c_str());
  CHECK(WEXITSTATUS(status) == 74);
  CHECK_MESSAGE(has(read_text(recipe.out("err")).value(), "6 videos failed"), read_text(recipe.out("err")).value());
  CHECK_FALSE(fs::exists(recipe.out("out") + "/.part"));
  write_file(recipe.file("file"), "");
  CHECK(recipe.run("file").status == 73);
  CHECK(recipe.run("file/deeper").status == 73);
  CHECK(run_sigs("dataset " + recipe.out("recipe.json") + " --out /proc/none").status == 73);
}

TEST_CASE("an invalid command line exits with status 64") {
  const TinyRecipe recipe;
  for (const char* const more :
       {"--shard 0/3", "--shard 4/3", "--shard 1", "--shard 1/3x", "--shard /", "--jobs -1", "--merge --resume",
        "--merge --shard 1/2", "--merge --dry-run --json x.json", "--plot x.png", "--dry-run --force", "--out ''"})
    CHECK_MESSAGE(recipe.run("out", more).status == 64, more);
  CHECK_FALSE(fs::exists(recipe.out("out")));
  CHECK(run_sigs("dataset").status == 64);
  CHECK(run_sigs("dataset " + recipe.out("none.json")).status == 66);
}

TEST_CASE("files of a coverage are replaced when that is asked for, and not otherwise") {
  const TinyRecipe recipe;
  const std::string json = recipe.out("c.json"), plot = recipe.out("c.png");
  const std::string files = "--dry-run --json " + json + " --plot " + plot;
  write_file(plot, "mine");
  CHECK(recipe.run("out", files).status == 73);
  CHECK(read_text(plot).value() == "mine");
  CHECK_FALSE(fs::exists(json));
  CHECK(recipe.run("out", files + " --force").status == 0);
  CHECK(read_text(plot).value().starts_with("\x89PNG"));
  CHECK(fs::exists(json));
  CHECK_FALSE(fs::exists(recipe.out("out")));
}

TEST_CASE("one file of COCO results, numbered as a split's coco labels, is scored against all its clips") {
  const TinyRecipe recipe;
  REQUIRE(recipe.run("out").status == 0);
  // The labels themselves as results: every box is correct, so every frame with a label is matched and there is no
  // false alarm.
  const auto labels = json_of(recipe.file("out/labels/coco/test.json"));
  nlohmann::json results = nlohmann::json::array();
  for (const nlohmann::json& box : labels["annotations"])
    results.push_back({{"image_id", box["image_id"]}, {"category_id", 1}, {"bbox", box["bbox"]}, {"score", 0.5}});
  write_file(recipe.file("found.json"), results.dump());
  const std::string report = recipe.out("report");
  const std::string detect = "evaluate detect " + recipe.out("out") + " --results " + recipe.out("found.json");
  const Run run = run_sigs(detect + " --split test --max-range 1e6 --out " + report);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const auto scores = json_of(fs::path(report) / "evaluation.json")["detectors"][0];
  CHECK(scores["name"] == "found");
  CHECK(scores["frames"] == labels["images"].size());
  CHECK(scores["frame_detection_rate"] == 1.0);
  CHECK(scores["false_alarm_boxes"] == 0);

  const Run whole = run_sigs(detect);
  CHECK(whole.status == 64);
  CHECK_MESSAGE(has(whole.err, "--split"), whole.err);
}
