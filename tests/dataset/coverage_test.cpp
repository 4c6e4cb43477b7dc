// SPDX-License-Identifier: MIT
#include "dataset/coverage.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>

#include "base/staged_outputs.h"
#include "dataset/footage_cache.h"
#include "dataset/recipe_folder.h"
#include "dataset/tiny_plan.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

long long sum_of_counts(const std::vector<long long>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0LL);
}

// Numbers of an attribute in a text, in order.
std::vector<double> numbers_in(const std::string& text, const std::string& pattern) {
  std::vector<double> numbers;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    numbers.push_back(std::stod((*it)[1]));
  return numbers;
}

}  // namespace

TEST_CASE("what a made dataset covers is what its labels say line by line, and what was predicted") {
  const TinyPlan tiny(4, 6);
  static_cast<void>(made(tiny.plan, {.folder = tiny.out(), .source = synthetic_source(), .jobs = 1}));
  const Result<Coverage> counted = counted_coverage(tiny.out());
  REQUIRE_MESSAGE(counted, counted.error().text());
  CHECK(counted->videos == 4);
  CHECK(counted->frames == 24);
  // Intruders with a box stand with their distance two elements before it.
  std::vector<long long> range(kRangeLimits_m.size() + 1);
  long long boxes = 0;
  for (const PlannedVideo& video : tiny.plan.videos) {
    const std::string text = read_text(tiny.out() / video.name / (video.name + ".xml")).value();
    for (const double range_m : numbers_in(text, "<distance m=\"([^\"]*)\" />\\s*<attitude[^>]*>\\s*<box")) {
      ++boxes;
      std::size_t bin = 0;
      while (bin < kRangeLimits_m.size() && range_m >= kRangeLimits_m[bin]) ++bin;
      ++range[bin];
    }
  }
  CHECK(boxes > 0);
  CHECK(counted->intruders.sights == boxes);
  CHECK(counted->intruders.range == range);
  for (const auto* const counts : {&counted->intruders.size, &counted->intruders.bearing})
    CHECK(sum_of_counts(*counts) == boxes);
  CHECK(counted->distractors.sights == 0);

  std::vector<const PlannedVideo*> videos;
  for (const PlannedVideo& video : tiny.plan.videos) videos.push_back(&video);
  const Result<Coverage> predicted = predicted_coverage(videos);
  REQUIRE_MESSAGE(predicted, predicted.error().text());
  CHECK(predicted->frames == 24);
  CHECK(predicted->intruders.range == counted->intruders.range);
  CHECK(predicted->intruders.bearing == counted->intruders.bearing);
  CHECK(predicted->intruders.cell == counted->intruders.cell);
  CHECK(sum_of_counts(counted->intruders.cell) == boxes);
  CHECK(predicted->intruders.horizon == counted->intruders.horizon);
}

TEST_CASE("intruders placed by image position and size fill all nine cells and all sizes alike, as planned") {
  nlohmann::ordered_json recipe = RecipeFolder::recipe();
  recipe["videos"] = nlohmann::ordered_json::array();
  recipe["videos"].push_back({{"videos", 180},
                              {"frames", 1},
                              {"flights",
                               {{{"kind", "image_position"},
                                 {"x_percent", {{"uniform", {0, 100}}}},
                                 {"y_percent", {{"uniform", {0, 100}}}},
                                 {"size_px", {{"log_uniform", {8, 128}}}},
                                 {"direction_deg", {{"uniform", {0, 360}}}}}}}});
  recipe["backgrounds"][0]["camera"]["position_m"] = {0, 0, -3000};
  const Plan plan = RecipeFolder().plan(recipe);
  REQUIRE(plan.videos.size() == 180);
  std::vector<const PlannedVideo*> videos;
  for (const PlannedVideo& video : plan.videos) videos.push_back(&video);
  const Result<Coverage> coverage = predicted_coverage(videos);
  REQUIRE(coverage);
  CHECK(coverage->intruders.sights == 180);
  for (const long long count : coverage->intruders.cell) CHECK(std::abs(double(count) - 20) < 17);  // four deviations
  for (std::size_t bin = 2; bin < 6; ++bin)  // 8 to 16, ... 64 to 128
    CHECK(std::abs(double(coverage->intruders.size[bin]) - 45) < 24);
  // Each by the scene, as an export renders it.
  VideoVisibility opener;
  for (const PlannedVideo& video : plan.videos) {
    const std::optional<VisibilityEstimate> seen =
        opener.last_intruder_at(video.project, *video.project.footage.last_frame);
    REQUIRE(seen);
    CHECK(seen->size_px == doctest::Approx(video.sampled.at("size_px")).epsilon(0.01));
  }
}

TEST_CASE("the cell of a box is the third of the image with its middle; outside, the nearest") {
  const cv::Size image(300, 90);
  CHECK(kCellNames[static_cast<std::size_t>(cell_of(150, 45, image))] == std::string("centre"));
  CHECK(cell_of(99, 0, image) == 0);
  CHECK(cell_of(100, 29, image) == 1);
  CHECK(cell_of(1000, -20, image) == 2);
  CHECK(cell_of(-9, 30, image) == 3);
  CHECK(cell_of(299, 89, image) == 8);
}

TEST_CASE("a video whose model cannot be read is left out of the prediction, and the table says so") {
  TinyPlan tiny(3, 6);
  write_file(tiny.inputs().file("broken.obj"), "no model");
  tiny.plan.videos[1].project.intruders[0].model.file = tiny.inputs().file("broken.obj").string();
  std::vector<const PlannedVideo*> videos;
  for (const PlannedVideo& video : tiny.plan.videos) videos.push_back(&video);
  const Result<Coverage> coverage = predicted_coverage(videos);
  REQUIRE(coverage);
  CHECK(coverage->videos == 2);
  CHECK(coverage->unopened == 1);
  CHECK(coverage_text(*coverage, "predicted").find("without 1 video whose files") != std::string::npos);
}

TEST_CASE("coverage counts known annotations in the right bins, as text, JSON and a plot") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "v");
  write_file(folder / "index.json", R"({"videos": [{"name": "v"}]})");
  write_file(folder / "v/v.json", R"({"intruders": [{"category": "airplane"}, {"category": "bird"}]})");
  const auto body = [](int id, const std::string& more, const std::string& position, double range_m, double width,
                       bool is_seen) {
    return "<intruder id=\"" + std::to_string(id) + "\" name=\"x\" " + more + "><position " + position +
           "/><distance m=\"" + std::to_string(range_m) + "\"/>" +
           (is_seen ? "<box x=\"1\" y=\"2\" width=\"3\" height=\"3\" pixels=\"4\"/>" : "") +
           "<silhouette x=\"0\" y=\"0\" width=\"" + std::to_string(width) + "\" height=\"1\"/></intruder>";
  };
  write_file(folder / "v/v.xml",
             "<sigs version=\"1\"><frame index=\"0\" time_s=\"0\">" +
                 body(0, "horizon=\"above\"", "x_m=\"100\" y_m=\"100\" z_m=\"0\"", 100, 8, true) +
                 body(1, "role=\"distractor\" horizon=\"below\"", "x_m=\"9\" y_m=\"-0.1\" z_m=\"0\"", 9, 300, true) +
                 "</frame><frame index=\"1\" time_s=\"1\">" +
                 body(0, "horizon=\"above\"", "x_m=\"100\" y_m=\"0\" z_m=\"0\"", 6000, 3.9, true) +
                 body(1, "role=\"distractor\" horizon=\"below\"", "x_m=\"9\" y_m=\"-0.1\" z_m=\"0\"", 9, 300, false) +
                 "</frame></sigs>");
  const Result<Coverage> coverage = counted_coverage(folder.path());
  REQUIRE_MESSAGE(coverage, coverage.error().text());
  CHECK(coverage->frames == 2);
  CHECK(coverage->intruders.range == std::vector<long long>{0, 0, 1, 0, 0, 0, 0, 1});
  CHECK(coverage->intruders.size == std::vector<long long>{1, 0, 1, 0, 0, 0, 0, 0});
  CHECK(coverage->intruders.bearing == std::vector<long long>{0, 0, 0, 0, 0, 1, 0, 0, 1, 0});
  CHECK(coverage->intruders.horizon == std::array<long long, 4>{0, 0, 2, 0});
  CHECK(coverage->distractors.sights == 1);
  CHECK(coverage->distractors.bearing == std::vector<long long>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
  CHECK(coverage->categories == std::map<std::string, long long>{{"airplane", 2}, {"bird", 1}});

  const nlohmann::json json = nlohmann::json::parse(coverage_json(*coverage, "counted"));
  CHECK(json["intruders"]["in_view"] == 2);
  CHECK(json["intruders"]["range_m"][2] == nlohmann::json{{"from", 100.0}, {"to", 200.0}, {"count", 1}});
  CHECK(json["distractors"]["horizon"][2] == nlohmann::json{{"side", "below"}, {"count", 1}});
  CHECK(coverage_text(*coverage, "counted").find("100 to 200") != std::string::npos);
  const cv::Mat plot = coverage_plot(*coverage, "counted");
  CHECK(plot.cols == 1440);
  CHECK(plot.type() == CV_8UC3);
}

TEST_CASE("what is no dataset with annotations is refused with the file") {
  const TemporaryFolder folder;
  CHECK(counted_coverage(folder.path()).error().text().find("index.json") != std::string::npos);
  write_file(folder / "index.json", R"({"videos": [{"name": "../v"}]})");
  CHECK(counted_coverage(folder.path()).error().text().find("videos[0].name") != std::string::npos);
  write_file(folder / "index.json", R"({"videos": [{"name": "v"}]})");
  CHECK(counted_coverage(folder.path()).error().text().find("export.labels") != std::string::npos);
  std::filesystem::create_directories(folder / "v");
  write_file(folder / "v/v.xml",
             "<sigs version=\"1\"><frame index=\"7\"><intruder id=\"0\"><box/></intruder></frame></sigs>");
  CHECK(counted_coverage(folder.path()).error().text().find("frame 7: intruder 0") != std::string::npos);
}
