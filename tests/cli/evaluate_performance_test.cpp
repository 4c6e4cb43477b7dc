// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <cmath>
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

// Annotations of clips in which an intruder comes head-on at 60 m/s from 800 m, ten frames a second, 100 frames. Those
// with an odd number are below the horizon, where it is first detected at 300 m, not at 600 m.
class Approaches {
 public:
  explicit Approaches(int clips) {
    fs::create_directories(folder_ / "found");
    for (int i = 0; i < clips; ++i) {
      const bool is_below = i % 2 == 1;
      std::string xml =
          "<sigs version=\"1\">\n<footage video=\"clip.mp4\" width=\"640\" height=\"480\" first_frame=\"0\" "
          "last_frame=\"99\" frame_rate=\"10/1\"/>\n";
      std::string csv = "frame,x,y,width,height,score,track,distance_m\n";
      for (int frame = 0; frame < 100; ++frame) {
        const double range_m = 800 - i - 6 * frame;
        const double down_m = is_below ? 4 : -4;
        const long y_px = 235 + std::lround(500 * down_m / range_m);
        xml += fmt::format(
            "<frame index=\"{0}\" time_s=\"{1:.1f}\"><camera x_m=\"{2:.1f}\" y_m=\"0\" z_m=\"-100\" roll_deg=\"0\" "
            "pitch_deg=\"0\" yaw_deg=\"0\"/><intruder id=\"0\" name=\"jet\" in_picture=\"true\" "
            "visible_fraction=\"1\" horizon=\"{3}\"><position x_m=\"{4:.1f}\" y_m=\"0\" z_m=\"{5}\"/><distance "
            "m=\"{4:.1f}\"/><attitude roll_deg=\"0\" pitch_deg=\"0\" yaw_deg=\"180\"/><box x=\"310\" y=\"{6}\" "
            "width=\"20\" height=\"10\" pixels=\"150\"/></intruder></frame>\n",
            frame, frame / 10.0, 2.5 * frame, is_below ? "below" : "above", range_m, down_m, y_px);
        if (range_m < (is_below ? 300 : 600))
          csv += fmt::format("{},310,{},20,10,0.9,1,{:.1f}\n", frame, y_px, 1.1 * range_m);
        if (frame % 2 == 0) csv += fmt::format("{},10,10,20,10,0.2,-1,\n", frame);
      }
      write_file(folder_ / fmt::format("clip{}.xml", i), xml + "</sigs>\n");
      write_file(folder_ / fmt::format("found/clip{}.csv", i), csv);
      labels_ += " " + (folder_ / fmt::format("clip{}.xml", i)).string();
    }
    write_file(folder_ / "lens.xml", R"(<?xml version="1.0"?>
<opencv_storage><image_width>640</image_width><image_height>480</image_height>
<camera_matrix type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt><data>500. 0. 319.5 0. 500. 239.5 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix"><rows>4</rows><cols>1</cols><dt>d</dt><data>0. 0. 0. 0.</data></distortion_coefficients>
</opencv_storage>)");
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string command() const {
    return "evaluate performance" + labels_ + " --results " + file("found") + " --calibration " + file("lens.xml");
  }

 private:
  TemporaryFolder folder_;
  std::string labels_;
};

}  // namespace

TEST_CASE("from labels and results to the report, the sensor model and the risk ratio") {
  const Approaches clips(24);
  const Run run = run_sigs(clips.command() + " --out " + clips.file("report"));
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "24 encounters in view, 2400 frames, 10 frames/s"));
  const nlohmann::json json = json_of(clips.file("report/performance.json"));
  CHECK(json["encounters_declared"] == 24);
  for (const nlohmann::json& one : json["conditions"]) {
    if (one["by"] != "horizon") continue;
    const double range_m = one["ranges"][1]["range_m"];  // steps: the same for each probability, within a cell of 1 %
    CHECK(range_m == doctest::Approx(one["condition"] == "below" ? 300 : 600).epsilon(0.015));
    CHECK(one["encounters"] == 12);
    CHECK(one["too_few"] == false);
  }
  // The third match is two frames, 12 m, after the first; half of the encounters have it at 588 m or before.
  CHECK(json["declaration_range_m"]["greatest"] == doctest::Approx(586).epsilon(0.01));
  // Straight on, the range is least at the meeting: 588 / 60 s are left, of the last ones 288 / 60.
  CHECK(json["time_left_s"]["greatest"] == doctest::Approx(586 / 60.0).epsilon(0.01));
  CHECK(json["range_error"]["bias"] == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(std::abs(json["bearing_error_deg"]["bias"].get<double>()) < 1e-6);
  CHECK(json["elevation_error_deg"]["p95"].get<double>() < 0.06);  // half a pixel
  // Every second frame has a box where nothing is: 3 of 5 frames, without a track, at one place.
  CHECK(json["false_tracks"]["all"]["declared"] == 24);
  CHECK(json["needed"][0]["needed_m"] == doctest::Approx(609.6 + 700));
  CHECK(json["needed"][0]["suffices"] == false);
  for (const char* name : {"report.html", "sensor.json", "ranges.csv", "conditions.csv", "encounters.csv",
                           "detection_by_range.png", "detection_by_horizon.svg", "range_needed.png"})
    CHECK_MESSAGE(fs::exists(clips.file("report/") + name), name);

  const std::string risk = "risk " + clips.file("report/sensor.json") + " --count 4000 --jobs 2 --climb-rate 8";
  const Run flown = run_sigs(risk + " --json " + clips.file("risk.json") + " --plot " + clips.file("risk.png"));
  CHECK_MESSAGE(flown.status == 0, flown.err);
  const nlohmann::json result = json_of(clips.file("risk.json"));
  CHECK(result["classes"][0]["encounters"] == 4000);
  CHECK(result["classes"][0]["risk_ratio_nmac"]["value"].get<double>() < 0.9);
  CHECK(result["settings"]["sensor"] == "found");
  for (const char* part : {"1", "2"})
    REQUIRE(run_sigs(risk + " --shard " + part + "/2 --json " + clips.file(std::string("part") + part)).status == 0);
  REQUIRE(
      run_sigs("risk --merge " + clips.file("part2") + " " + clips.file("part1") + " --json " + clips.file("all.json"))
          .status == 0);
  CHECK(text_of(clips.file("all.json")) == text_of(clips.file("risk.json")));

  // The report takes it, and again with --force.
  const Run again =
      run_sigs(clips.command() + " --risk " + clips.file("risk.json") + " --force --out " + clips.file("report"));
  CHECK_MESSAGE(again.status == 0, again.err);
  const std::string page = text_of(clips.file("report/report.html"));
  CHECK(has(page, "Risk ratio of NMAC"));
  CHECK_FALSE(has(page, "src=\""));  // it needs no other file
  CHECK_FALSE(has(page, "href=\"http"));
}

TEST_CASE("the encounters of labels are flown by images and by the model") {
  const Approaches clips(12);
  REQUIRE(run_sigs(clips.command() + " --out " + clips.file("report")).status == 0);
  std::string labels;
  for (int i = 0; i < 12; ++i) labels += " " + clips.file(fmt::format("clip{}.xml", i));
  const Run run = run_sigs("risk " + clips.file("report/sensor.json") + " --labels" + labels + " --results " +
                           clips.file("found") + " --count 1200 --climb-rate 8 --json " + clips.file("loop.json"));
  CHECK_MESSAGE(run.status == 0, run.err);
  const nlohmann::json json = json_of(clips.file("loop.json"));
  CHECK(json["images"]["classes"][0]["encounters"] == 12);
  CHECK(json["images"]["classes"][0]["declared"]["value"] == 1);
  CHECK(json["classes"][0]["encounters"] == 1200);
  // 4 m apart in height all are NMACs. 26.5 m at 8 m/s take 1 s of delay, 3.2 s to reach that rate, in which 12.8 m are
  // flown, and 2.2 s: 6.4 s. From 588 m to the radius of 152 m there are 7.2 s, from 288 m 2.2 s.
  CHECK(json["images"]["classes"][0]["p_nmac_without"]["value"] == 1);
  CHECK(json["images"]["classes"][0]["risk_ratio_nmac"]["value"] == 0.5);
  CHECK(json["classes"][0]["risk_ratio_nmac"]["value"].get<double>() == doctest::Approx(0.5).epsilon(0.2));
}

TEST_CASE("a program decides on manoeuvres, and its mistakes are told") {
  const Approaches clips(12);
  REQUIRE(run_sigs(clips.command() + " --out " + clips.file("report")).status == 0);
  const std::string risk = "risk " + clips.file("report/sensor.json") + " --count 300 ";
  const Run climbs = run_sigs(risk + "--logic-command 'while read question; do echo climb; done'");
  CHECK_MESSAGE(climbs.status == 0, climbs.err);
  write_file(clips.file("rules.csv"), "bearing_min_deg,manoeuvre\n,climb\n");
  const Run table = run_sigs(risk + "--logic " + clips.file("rules.csv"));
  CHECK(table.out.substr(0, table.out.find('\n')) == climbs.out.substr(0, climbs.out.find('\n')));
  const Run none = run_sigs(risk + "--logic-command 'while read question; do echo none; done'");
  CHECK(has(none.out, "Risk ratio of NMAC (500 ft, 100 ft): 1.000"));
  const Run wrong = run_sigs(risk + "--logic-command 'while read question; do echo jump; done'");
  CHECK(wrong.status == 65);
  CHECK(has(wrong.err, "answered \"jump\"; there are none, turn-right"));
  const Run dead = run_sigs(risk + "--logic-command true");
  CHECK(dead.status == 65);
  CHECK(has(dead.err, "ended without an answer"));
}

TEST_CASE("what performance and risk cannot use is refused with the reason") {
  const Approaches clips(2);
  const auto refused = [](const std::string& arguments, int status, const char* part) {
    const Run run = run_sigs(arguments);
    CHECK_MESSAGE(run.status == status, arguments);
    CHECK_MESSAGE(has(run.err, part), run.err);
  };
  refused(clips.command() + " --declare 6/5", 64, "--declare 6/5: must be M/N");
  refused(clips.command() + " --declare x", 64, "must be M/N");
  refused("evaluate performance " + clips.file("clip0.xml"), 64, "--results");
  refused("evaluate performance " + clips.file("clip0.xml") + " --results " + clips.file("found") + " " +
              clips.file("found"),
          64, "one detector");
  refused(clips.command() + " --risk " + clips.file("lens.xml"), 65, "lens.xml");
  refused(clips.command() + " --coverage " + clips.file("none.json"), 66, "none.json");
  refused("risk", 64, "name a sensor model");
  refused("risk " + clips.file("lens.xml"), 65, "lens.xml");
  write_file(clips.file("sensor.json"),
             R"({"sigs_sensor_model": 1, "frame_rate_hz": 10, "detection": {"range_m": [500], "probability": [1]}})");
  refused("risk " + clips.file("sensor.json") + " --manoeuvre jump", 64, "vertical-away");
  refused("risk " + clips.file("sensor.json") + " --shard 3/2", 64, "--shard 3/2");
  refused("risk " + clips.file("sensor.json") + " --shard 1/2 --until 0.1", 64, "exclude each other");
  refused("risk " + clips.file("sensor.json") + " --intruder-speed 80,30", 64, "--intruder-speed");
  refused("risk " + clips.file("sensor.json") + " --labels " + clips.file("clip0.xml"), 64, "go together");
  refused("risk " + clips.file("sensor.json") + " --own-speed 22 --labels " + clips.file("clip0.xml") + " --results " +
              clips.file("found/clip0.csv"),
          64, "has its flights");
  refused("risk " + clips.file("sensor.json") + " --own-speed 22 --pairs " + clips.file("clip0.xml"), 64,
          "has its flights");
  refused("risk " + clips.file("sensor.json") + " --shard 1/2 --labels " + clips.file("clip0.xml") + " --results " +
              clips.file("found/clip0.csv"),
          64, "exclude each other");
  refused("risk --merge " + clips.file("sensor.json"), 65, "sensor.json");
  // Truth without ranges.
  write_file(clips.file("coco.json"),
             R"({"images": [{"id": 1, "file_name": "a_000001.png", "width": 640, "height": 480}],
    "annotations": [{"id": 1, "image_id": 1, "category_id": 1, "bbox": [10, 10, 20, 10]}], "categories": [{"id": 1, "name": "airplane"}]})");
  write_file(clips.file("results.json"), "[]");
  refused("evaluate performance " + clips.file("coco.json") + " --rate 10 --results " + clips.file("results.json"), 65,
          "performance");
}

}  // namespace sigs::test
