// SPDX-License-Identifier: MIT
#include "dataset/matched_look.h"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "appearance/appearance.h"
#include "base/staged_outputs.h"
#include "cli/tiny_project.h"
#include "dataset/entry.h"
#include "dataset/plan.h"
#include "dataset/recipe.h"
#include "dataset/run.h"
#include "project/json.h"
#include "support/files.h"
#include "support/test_data.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

const cv::Size kSize_px{160, 120};

// A clip of blue sky over land, with noise of about 3 codes.
void write_noisy_clip(const fs::path& path, int frames) {
  const VideoFormat format{.codec = VideoCodec::ffv1, .container = Container::mkv, .size_px = kSize_px};
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  REQUIRE(writer);
  cv::RNG random(7);
  for (int n = 0; n < frames; ++n) {
    cv::Mat luma(kSize_px, CV_32F, cv::Scalar(70)), noise(kSize_px, CV_32F);
    luma.rowRange(0, 72).setTo(150);
    random.fill(noise, cv::RNG::NORMAL, 0, 3);
    luma += noise;
    Frame frame{.layout = format.layout, .color = format.color};
    luma.convertTo(frame.planes[0], CV_8U);
    for (int plane = 1; plane < 3; ++plane) {
      frame.planes[plane] = cv::Mat(kSize_px / 2, CV_8U, cv::Scalar(128));
      frame.planes[plane].rowRange(0, 36).setTo(plane == 1 ? 150 : 110);
    }
    frame.time_s = n * 0.04;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
}

// A recipe of four images of a matched background, in a folder with its files.
class MatchedRecipe {
 public:
  MatchedRecipe() : tiny_(10, kSize_px) {
    write_noisy_clip(tiny_.file("noisy.mkv"), 10);
    json = Json::parse(R"({
      "sigs_dataset": 1, "name": "set", "seed": 3,
      "backgrounds": [{"name": "day", "footage": {"video": "noisy.mkv", "calibration": "lens.xml", "last_frame": 8},
                       "camera": {"attitude_deg": {"roll": 0, "pitch": 0}}, "appearance": "matched"}],
      "aircraft": [{"name": "cube", "model": {"file": "cube.obj"}}],
      "videos": [{"name": "i{number}", "images": 4, "flights": [{"kind": "image_position", "x_percent": {"uniform": [20, 80]},
                  "y_percent": 30, "size_px": 24, "relative_speed_mps": 10}]}]
    })");
  }

  [[nodiscard]] fs::path file(const std::string& name) const { return tiny_.file(name); }
  [[nodiscard]] Result<ReadRecipe> read(const std::vector<std::string>& settings = {}) const {
    return parse_recipe(json.dump(), tiny_.file("set.json"), settings);
  }
  [[nodiscard]] Plan plan(const std::vector<std::string>& settings = {}) const {
    const Result<ReadRecipe> read_one = read(settings);
    REQUIRE_MESSAGE(read_one, read_one.error().text());
    Result<Plan> plan = plan_of(read_one->recipe);
    REQUIRE_MESSAGE(plan, plan.error().text());
    return *std::move(plan);
  }
  [[nodiscard]] Json& background() { return json["backgrounds"][0]; }

  Json json;

 private:
  TinyProject tiny_;
};

struct MatchedRun {
  DatasetReport report;
  int measured = 0;  // calls of `measuring` that end a clip
  std::vector<std::string> warnings;
};

MatchedRun run_of(const Plan& plan, DatasetRequest request) {
  request.source = {.program = "test 1", .seed = 3, .recipe = "{}"};
  MatchedRun run;
  const DatasetControl control{
      .measuring = [&](int done, int total, const std::string&) { run.measured += done == total ? 1 : 0; },
      .warn = [&](const Warning& warning) { run.warnings.push_back(warning.text()); }};
  Result<DatasetReport> report = make_dataset(plan, request, control);
  if (!report) FAIL(report.error().text());
  run.report = *std::move(report);
  return run;
}

Project project_in(const fs::path& dataset, const std::string& video) {
  Result<ReadProject> read = read_project(dataset / video / (video + ".json"));
  REQUIRE_MESSAGE(read, read.error().text());
  return read->project;
}

// What `sigs appearance P --into P` makes of a project with the background's footage and camera.
Project written_into(const MatchedRecipe& recipe) {
  Project project;
  project.file = recipe.file("p.json");
  project.footage.video = "noisy.mkv";
  project.footage.calibration = "lens.xml";
  project.footage.last_frame = 8;
  project.camera.roll_deg = project.camera.pitch_deg = 0;
  const Result<Appearance> found = appearance_of_footage(project, {.first = 0, .last = 8}, false, {});
  REQUIRE_MESSAGE(found, found.error().text());
  apply(*found, project);
  return project;
}

bool has_part(const std::vector<std::string>& texts, const std::string& part) {
  return std::ranges::any_of(texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("each video of a matched background has the settings that are measured in its clip, once in a run") {
  const MatchedRecipe recipe;
  const Project truth = written_into(recipe);
  CHECK(truth.appearance.grain.sd_dark > 1);  // the clip's noise, so the comparison is not of defaults
  CHECK(truth.light.kind == LightKind::sun);
  const MatchedRun run = run_of(recipe.plan(), {.folder = recipe.file("out"), .jobs = 1});
  CHECK(run.report.exported == 4);
  CHECK(run.measured == 1);
  for (const char* const video : {"i0001", "i0002", "i0003", "i0004"}) {
    const Project project = project_in(recipe.file("out"), video);
    CHECK(project.appearance == truth.appearance);
    CHECK(project.light == truth.light);
    CHECK(project.compositing.blur_px_per_m == truth.compositing.blur_px_per_m);
  }
  // What the clip does not show is said once, and in the index.
  const Json index = Json::parse(read_text(recipe.file("out") / "index.json").value());
  const Json& measured = index["measured"]["day"];
  CHECK(measured["settings"]["appearance"]["grain"]["sd_dark"] == truth.appearance.grain.sd_dark);
  REQUIRE_FALSE(measured["not_shown"].empty());
  CHECK(std::ranges::count_if(run.warnings, [](const std::string& text) {
          return text.find("noisy.mkv: does not show: ") != std::string::npos;
        }) == 1);
  CHECK(has_part(run.warnings, measured["not_shown"][0].get<std::string>()));
}

TEST_CASE("a matched dataset is the same with any number of jobs, resumed, and made in parts; what is known stays") {
  const MatchedRecipe recipe;
  const Plan plan = recipe.plan();
  const auto into = [&](const char* folder) { return DatasetRequest{.folder = recipe.file(folder), .jobs = 1}; };
  const std::string whole = run_of(plan, into("out")).report.checksum;
  DatasetRequest request = into("jobs");
  request.jobs = 3;
  CHECK(run_of(plan, request).report.checksum == whole);

  fs::remove_all(recipe.file("out") / "i0003");
  request = into("out");
  request.resume = true;
  const MatchedRun resumed = run_of(plan, request);
  CHECK(resumed.report.kept == 3);
  CHECK(resumed.report.exported == 1);
  CHECK(resumed.measured == 0);
  CHECK(resumed.report.checksum == whole);

  request = into("parts");
  for (const int part : {1, 2}) {
    request.shard = Shard{part, 2};
    CHECK(run_of(plan, request).measured == 1);
  }
  request.shard.reset();
  request.merge_only = true;
  const MatchedRun merged = run_of(plan, request);
  CHECK(merged.measured == 0);
  CHECK(merged.report.checksum == whole);
}

TEST_CASE("a video is made anew where another clip or range of frames is measured, or a look of its own") {
  MatchedRecipe recipe;
  static_cast<void>(run_of(recipe.plan(), {.folder = recipe.file("out"), .jobs = 1}));
  const DatasetRequest again{.folder = recipe.file("out"), .jobs = 1, .resume = true};
  CHECK(run_of(recipe.plan(), again).report.kept == 4);
  const fs::path entry = recipe.file("out") / "i0002" / "entry.json";
  Json changed = Json::parse(read_text(entry).value());
  changed["measured"]["settings"]["appearance"]["grain"]["sd_dark"] = 9;
  write_file(entry, changed.dump());
  MatchedRun run = run_of(recipe.plan(), again);
  CHECK(run.report.exported == 1);
  CHECK(has_part(run.warnings, "i0002: is made anew"));
  recipe.background()["camera"]["position_m"] = {0, 0, -900};  // by which the haze is found
  run = run_of(recipe.plan(), again);
  CHECK(run.report.exported == 4);
  CHECK(run.measured == 1);
  recipe.background().erase("appearance");
  run = run_of(recipe.plan(), again);
  CHECK(run.report.exported == 4);
  CHECK(run.measured == 0);
  CHECK_FALSE(Json::parse(read_text(recipe.file("out") / "index.json").value()).contains("measured"));
}

TEST_CASE("what the recipe states wins over what is measured") {
  MatchedRecipe recipe;
  const Project truth = written_into(recipe);
  recipe.json["settings"] = {{"appearance.grain.sd_dark", 0.25}, {"compositing.blur_px_per_m", 0.5}};
  recipe.background()["light"] = {{"exposure", 0.75}};
  recipe.json["videos"][0]["appearance"] = {{"sharpening", 1.5}};
  recipe.json["videos"][0]["light"] = {{"sun.elevation_deg", 33}};
  Plan plan = recipe.plan({"appearance.grain.sd_bright=0.125"});
  static_cast<void>(run_of(plan, {.folder = recipe.file("out"), .jobs = 1}));
  Project project = project_in(recipe.file("out"), "i0001");
  CHECK(project.appearance.grain.sd_dark == 0.25);
  CHECK(project.appearance.grain.sd_bright == 0.125);
  CHECK(project.appearance.sharpening == 1.5);
  CHECK(project.compositing.blur_px_per_m == 0.5);
  CHECK(project.light.exposure == 0.75);
  CHECK(project.light.sun.elevation_deg == 33);
  CHECK(project.light.kind == LightKind::sun);
  CHECK(project.light.sky_color == truth.light.sky_color);
  CHECK(project.appearance.grain.sd_chroma == truth.appearance.grain.sd_chroma);

  // A lamp that is stated is not made the sun.
  recipe.json["videos"][0]["light"] = {{"position_m", {10, 20, -3000}}};
  recipe.background().erase("light");
  plan = recipe.plan();
  static_cast<void>(run_of(plan, {.folder = recipe.file("lamp"), .jobs = 1}));
  project = project_in(recipe.file("lamp"), "i0001");
  CHECK(project.light.kind == LightKind::point);
  CHECK(project.light.position_m.x == 10);
  CHECK(project.light.color == LightSettings{}.color);
  CHECK(project.appearance.grain.sd_bright == truth.appearance.grain.sd_bright);
}

TEST_CASE("of a background's project the look is replaced by the measured one, but for what the recipe states") {
  MatchedRecipe recipe;
  const Project truth = written_into(recipe);
  Project own = truth;
  own.name = "own";
  own.appearance.grain.sd_dark = own.appearance.grain.sd_bright = 7;
  own.light.exposure = 3;
  write_file(recipe.file("own.json"), text_of(own));
  recipe.background() = {{"name", "day"}, {"project", "own.json"}, {"appearance", "matched"}};
  recipe.json["settings"] = {{"appearance.grain.sd_bright", 0.5}};
  static_cast<void>(run_of(recipe.plan(), {.folder = recipe.file("out"), .jobs = 1}));
  const Project project = project_in(recipe.file("out"), "i0001");
  CHECK(project.appearance.grain.sd_dark == truth.appearance.grain.sd_dark);
  CHECK(project.appearance.grain.sd_bright == 0.5);
  CHECK(project.light.exposure == truth.light.exposure);
}

TEST_CASE("an appearance that is neither a word that is known nor settings is refused, with what is allowed") {
  MatchedRecipe recipe;
  const auto error = [&](const Json& appearance) {
    recipe.background()["appearance"] = appearance;
    const Result<ReadRecipe> read = recipe.read();
    return read ? std::string() : read.error().text();
  };
  CHECK(error("mached").find("set.json: backgrounds[0].appearance: is \"mached\"; there are \"matched\"") !=
        std::string::npos);
  CHECK(error(3).find("backgrounds[0].appearance: expected { ... }") != std::string::npos);
  CHECK(error({{"grain", {{"sd_dark", -1}}}}).find("backgrounds[0].appearance.grain.sd_dark") != std::string::npos);
  CHECK(error({{"grain", {{"sd_dark", 2}}}}).empty());
  CHECK(recipe.plan().videos[0].project.appearance.grain.sd_dark == 2);
  CHECK(error("matched").empty());
  Project rig;
  rig.name = "rig";
  for (const char* const name : {"front", "left"}) {
    rig.cameras.push_back({.name = name});
    rig.cameras.back().footage.video = "noisy.mkv";
    rig.cameras.back().footage.calibration = "lens.xml";
  }
  write_file(recipe.file("rig.json"), text_of(rig));
  recipe.background() = {{"name", "day"}, {"project", "rig.json"}};
  CHECK(error("matched").find("backgrounds[0].appearance: is \"matched\", which is of one camera") !=
        std::string::npos);
}

TEST_CASE("a run stops while it measures, and a clip that is gone fails its videos alone") {
  MatchedRecipe recipe;
  std::atomic<bool> stop = false;
  const DatasetControl control{.measuring = [&](int, int, const std::string&) { stop = true; }, .cancel = &stop};
  const Result<DatasetReport> stopped = make_dataset(recipe.plan(), {.folder = recipe.file("out"), .jobs = 1}, control);
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().kind == ErrorKind::interrupted);
  CHECK_FALSE(fs::exists(recipe.file("out") / "i0001"));

  recipe.json["backgrounds"].push_back(
      {{"name", "plain"}, {"footage", {{"video", "clip.mkv"}, {"calibration", "lens.xml"}}}});
  recipe.json["videos"][0]["images"] = 8;
  const Plan plan = recipe.plan();
  fs::remove(recipe.file("noisy.mkv"));
  const MatchedRun run = run_of(plan, {.folder = recipe.file("out"), .jobs = 1});
  CHECK(run.report.exported > 0);
  CHECK(run.report.exported + static_cast<int>(run.report.failures.size()) == 8);
  for (const VideoFailure& failure : run.report.failures)
    CHECK_MESSAGE(failure.error.text().find("noisy.mkv") != std::string::npos, failure.error.text());
}
