// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/staged_outputs.h"
#include "cli/tiny_recipe.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;
using Json = nlohmann::json;

namespace fs = std::filesystem;

namespace {

// Six random crossings, of which many are never in the image or too fast.
constexpr const char* kRandom = R"({
  "sigs_dataset": 1, "name": "random", "seed": 5,
  "settings": {"export.labels": ["xml", "csv"]},
  "backgrounds": [{"name": "sky", "footage": {"video": "clip.mkv", "calibration": "lens.xml"}},
                  {"name": "end", "footage": {"video": "clip.mkv", "calibration": "lens.xml", "first_frame": 2}}],
  "aircraft": [{"name": "red", "model": {"file": "cube.obj"}, "speed_limits_mps": [0, 150]},
               {"name": "large", "model": {"file": "cube.obj", "scale": 2}}],
  "videos": [{"name": "v{number}", "videos": 6, "frames": 6,
    "light": {"ambient": {"uniform": [0.2, 0.6]}},
    "flights": [{"kind": "left_right", "distance_m": {"uniform": [15, 40]},
                 "from_x_percent": {"uniform": [-250, 100]}, "to_x_percent": {"uniform": [-150, 200]}}]}]
})";

int sum_of(const Json& redraws) {
  int sum = 0;
  for (const auto& [what, count] : redraws.items()) sum += count.get<int>();
  return sum;
}

}  // namespace

TEST_CASE("a dry run predicts what a dataset covers, and its labels say the same once it is made") {
  const TinyRecipe recipe;
  write_file(recipe.file("recipe.json"), kRandom);
  const std::string files = " --json " + recipe.out("predicted.json") + " --plot " + recipe.out("predicted.png");
  const Run dry = recipe.run("out", "--dry-run" + files);
  CHECK_MESSAGE(dry.status == 0, dry.err);
  CHECK_MESSAGE(has(dry.out, "coverage, predicted: 6 videos, 36 frames; intruders in view "), dry.out);
  CHECK(fs::file_size(recipe.file("predicted.png")) > 1000);
  CHECK_FALSE(fs::exists(recipe.file("out")));
  CHECK(recipe.run("out", "--dry-run" + files).status == 73);  // the files are there

  CHECK(recipe.run("out", "--coverage").status == 66);  // no dataset
  CHECK(recipe.run("out", "--json " + recipe.out("x.json")).status == 64);
  CHECK(recipe.run("out", "--coverage --dry-run").status == 64);
  const Run made = recipe.run("out");
  REQUIRE_MESSAGE(made.status == 0, made.err);
  const Run counted = recipe.run("out", "--coverage --json " + recipe.out("counted.json"));
  CHECK_MESSAGE(counted.status == 0, counted.err);
  CHECK_MESSAGE(has(counted.out, "coverage, counted from the labels: 6 videos, 36 frames"), counted.out);
  const Json predicted = Json::parse(read_text(recipe.file("predicted.json")).value());
  const Json found = Json::parse(read_text(recipe.file("counted.json")).value());
  for (const char* const quantity : {"range_m", "horizon"})
    CHECK(predicted["intruders"][quantity] == found["intruders"][quantity]);
}

TEST_CASE("the requested number of random videos is made, and repeated samples are reported everywhere") {
  const TinyRecipe recipe;
  write_file(recipe.file("recipe.json"), kRandom);
  const Run dry = recipe.run("out", "--dry-run");
  CHECK_MESSAGE(dry.status == 0, dry.err);
  CHECK_MESSAGE(has(dry.out, "6 videos, 36 frames, about "), dry.out);
  CHECK_MESSAGE(has(dry.out, "sampled again: "), dry.out);
  CHECK_MESSAGE(has(dry.out, " redraws "), dry.out);
  CHECK_FALSE(has(dry.out.substr(0, dry.out.find("sampled again: ")), " never "));
  const Run run = recipe.run("out");
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(has(run.err, "sampled again: "), run.err);
  CHECK_FALSE(has(run.err, "never in the picture in "));
  const Json index = json_of(recipe.out("out") + "/index.json");
  CHECK(index.at("videos").size() == 6);
  int sum = 0;
  for (const Json& video : index.at("videos")) {
    sum += video.contains("redraws") ? sum_of(video.at("redraws")) : 0;
    const std::string name = video.at("name");
    CHECK(json_of(recipe.out("out") + "/" + name + "/entry.json").value("redraws", Json()) ==
          video.value("redraws", Json()));
  }
  CHECK(sum > 0);
  CHECK(sum_of(index.at("redraws")) == sum);
  CHECK(index.at("redraws").contains("never in the picture"));
}

TEST_CASE("random videos are the same to the byte with any jobs, shards, resumption and by name") {
  const TinyRecipe recipe;
  write_file(recipe.file("recipe.json"), kRandom);
  CHECK(recipe.run("one", "--jobs 1").status == 0);
  const auto whole = contents_of(recipe.out("one"));
  CHECK(recipe.run("jobs", "--jobs 3").status == 0);
  CHECK(contents_of(recipe.out("jobs")) == whole);
  for (const char* const part : {"2/3", "1/3", "3/3"})
    CHECK(recipe.run("shards", std::string("--shard ") + part).status == 0);
  CHECK(recipe.run("shards", "--merge").status == 0);
  CHECK(contents_of(recipe.out("shards")) == whole);
  CHECK(recipe.run("names", "--only v0004,v0002").status == 0);
  for (const auto& [file, content] : contents_of(recipe.out("names"))) {
    const std::string& path = file;
    REQUIRE(whole.contains(path));
    CHECK_MESSAGE(whole.at(path) == content, path);
  }
  CHECK(recipe.run("names", "--resume").status == 0);
  CHECK(contents_of(recipe.out("names")) == whole);
}

TEST_CASE("random videos without a usable sample exit with status 65 and name the reasons") {
  const TinyRecipe recipe;
  write_file(recipe.file("recipe.json"), kRandom);
  recipe.change("\"videos\": 6,", "\"videos\": 6, \"redraws\": 9,");
  recipe.change("[-150, 200]", "[-150, -140]");
  recipe.change("[-250, 100]", "[-250, -140]");
  const Run run = recipe.run("out");
  CHECK(run.status == 65);
  CHECK_MESSAGE(has(run.err, "v0001: none of 10 samples can be used: "), run.err);
  CHECK_MESSAGE(has(run.err, "never in the picture 10 times"), run.err);
  CHECK_FALSE(fs::exists(recipe.out("out")));
}
