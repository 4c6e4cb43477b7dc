// SPDX-License-Identifier: MIT
#include "evaluation/metrics/rig_score.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "evaluation/clips.h"
#include "evaluation/reports/report.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

const Box kShown{100, 100, 40, 20};
const double kDegree_rad = std::acos(-1.0) / 180;

// A camera whose frame n is taken at offset_s + n / rate_hz and shows the target where `shows` says so.
DetectedClip camera_of(int frames, double rate_hz, double offset_s, const std::function<bool(int)>& shows) {
  DetectedClip clip{.truth = clip_of(frames, rate_hz, [&](int n) {
                      return shows(n) ? visible_at(kShown) : TargetFrame{.amodal_box = kShown, .distance_m = 500};
                    })};
  for (double& time_s : clip.truth.times_s) time_s += offset_s;
  return clip;
}

void detect(DetectedClip& clip, const std::function<bool(int)>& detects) {
  for (int n = 0; n < clip.truth.frames(); ++n)
    if (detects(n)) report(clip.results, n, kShown, kNoTrack);
}

// The target flies past on a straight line: 300 m ahead, from 200 m left to the right at 100 m/s, 30 m below.
glm::dvec3 place_of(double time_s) {
  return {300, -200 + 100 * time_s, 30};
}

RigClip rig_of(std::vector<std::string> cameras, std::vector<RigHandover> handovers = {}) {
  RigClip rig{.name = "rig", .cameras = std::move(cameras)};
  rig.targets.push_back({.id = 0, .name = "glider", .handovers = std::move(handovers)});
  for (int n = -10; n <= 60; ++n) rig.targets[0].places.push_back({n / 10.0, place_of(n / 10.0)});
  return rig;
}

const auto kAlways = [](int) { return true; };
const auto kNever = [](int) { return false; };

// Front at 25 Hz shows it in frames 0 to 24, left at 20 Hz, 0.2 s later, from its frame 20 on: the handover is at
// 0.96 s, with 0.24 s to the first frame of left at 1.2 s.
std::vector<DetectedClip> front_and_left() {
  return {camera_of(50, 25, 0, [](int n) { return n < 25; }), camera_of(40, 20, 0.2, [](int n) { return n >= 20; })};
}
const RigHandover kHandover{.from = 0, .to = 1, .time_s = 0.96, .gap_s = 0.24};

RigTargetScore rig_score_of(const RigClip& rig, const std::vector<DetectedClip>& clips) {
  const RigScore score = score_rig("mine", rig, clips, {});
  REQUIRE(score.targets.size() == 1);
  REQUIRE(score.targets[0].cameras.size() == clips.size());
  return score.targets[0];
}

TEST_CASE("a perfect detector has an intruder at once, all the time and through a handover") {
  std::vector<DetectedClip> clips = front_and_left();
  for (DetectedClip& clip : clips) detect(clip, kAlways);
  const RigTargetScore score = rig_score_of(rig_of({"front", "left"}, {kHandover}), clips);
  CHECK(score.any.seen_s == doctest::Approx(25 / 25.0 + 20 / 20.0));
  CHECK(score.any.detected_s == doctest::Approx(score.any.seen_s));
  CHECK(score.any.share() == doctest::Approx(1));
  CHECK(score.any.first_seen_s == 0.0);
  REQUIRE(score.any.first);
  CHECK(score.any.first->camera == 0);
  CHECK(score.any.first->time_s == 0);
  CHECK(score.any.first->range_m == doctest::Approx(std::sqrt(300.0 * 300 + 200.0 * 200 + 30.0 * 30)));
  CHECK(score.any.first->bearing_rad / kDegree_rad == doctest::Approx(-33.690068));   // atan(200 / 300)
  CHECK(score.any.first->elevation_rad / kDegree_rad == doctest::Approx(-4.756341));  // asin(30 / 361.80)
  REQUIRE(score.cameras[1].first);
  CHECK(score.cameras[1].first->time_s == doctest::Approx(1.2));
  CHECK(score.cameras[1].first->range_m == doctest::Approx(std::sqrt(300.0 * 300 + 80.0 * 80 + 30.0 * 30)));
  REQUIRE(score.handovers.size() == 1);
  CHECK(score.handovers[0].loss_s == 0);
  CHECK(score.handovers[0].last_before->time_s == doctest::Approx(0.96));
  CHECK(score.handovers[0].first_after->time_s == doctest::Approx(1.2));
  CHECK(score.handovers[0].first_after->camera == 1);
}

TEST_CASE("a detector that reports nothing loses all that is seen") {
  const RigTargetScore score = rig_score_of(rig_of({"front", "left"}, {kHandover}), front_and_left());
  CHECK(score.any.share() == 0);
  CHECK(score.any.detected_s == 0);
  CHECK_FALSE(score.any.first);
  CHECK_FALSE(score.cameras[0].first);
  CHECK_FALSE(score.handovers[0].last_before);
  CHECK_FALSE(score.handovers[0].first_after);
  CHECK(score.handovers[0].loss_s == doctest::Approx(2));
}

TEST_CASE("a detector of one camera alone loses the other camera's time") {
  std::vector<DetectedClip> clips = front_and_left();
  detect(clips[0], [](int n) { return n >= 5; });
  const RigTargetScore score = rig_score_of(rig_of({"front", "left"}, {kHandover}), clips);
  CHECK(score.any.detected_s == doctest::Approx(20 / 25.0));
  CHECK(score.any.share() == doctest::Approx(0.8 / 2));
  CHECK(score.cameras[0].share() == doctest::Approx(0.8));
  CHECK(score.cameras[1].share() == 0);
  CHECK(score.any.first->time_s == doctest::Approx(0.2));
  CHECK(score.any.first_seen_s == 0.0);
  CHECK_FALSE(score.handovers[0].first_after);
  CHECK(score.handovers[0].loss_s == doctest::Approx(1));  // all of what left shows
}

TEST_CASE("the loss of a handover counts the time shown without a match, not the gap between the cameras") {
  std::vector<DetectedClip> clips = front_and_left();
  detect(clips[0], [](int n) { return n < 20; });   // the last 5 of 25 Hz are missed
  detect(clips[1], [](int n) { return n >= 24; });  // the first 4 of 20 Hz
  const RigTargetScore score = rig_score_of(rig_of({"front", "left"}, {kHandover}), clips);
  CHECK(score.handovers[0].loss_s == doctest::Approx(5 / 25.0 + 4 / 20.0));
  CHECK(score.handovers[0].last_before->time_s == doctest::Approx(19 / 25.0));
  CHECK(score.handovers[0].first_after->time_s == doctest::Approx(0.2 + 24 / 20.0));
}

TEST_CASE("what two cameras show at once counts once, and of equal times the first camera has the detection") {
  std::vector<DetectedClip> clips{camera_of(50, 25, 0, kAlways), camera_of(50, 25, 0, kAlways)};
  for (DetectedClip& clip : clips) detect(clip, [](int n) { return n >= 10; });
  const RigTargetScore score = rig_score_of(rig_of({"a", "b"}), clips);
  CHECK(score.any.seen_s == doctest::Approx(2));
  CHECK(score.any.detected_s == doctest::Approx(40 / 25.0));
  CHECK(score.any.first->camera == 0);
  CHECK(score.cameras[1].first->camera == 1);
  CHECK(score.cameras[1].first->time_s == score.any.first->time_s);
}

TEST_CASE("cameras that film at different times add up") {
  std::vector<DetectedClip> clips{camera_of(25, 25, 0, kAlways), camera_of(25, 25, 3, kAlways)};
  detect(clips[1], kAlways);
  const RigTargetScore score = rig_score_of(rig_of({"a", "b"}, {{0, 1, 0.96, 2.04}}), clips);
  CHECK(score.any.seen_s == doctest::Approx(2));
  CHECK(score.any.first->time_s == doctest::Approx(3));
  CHECK(score.handovers[0].loss_s == doctest::Approx(1));
  CHECK_FALSE(score.handovers[0].last_before);
}

TEST_CASE("an intruder that no camera shows has no share, and one frame has the length of its nominal rate") {
  std::vector<DetectedClip> clips{camera_of(1, 25, 0, kAlways), camera_of(10, 25, 0, kNever)};
  RigTargetScore score = rig_score_of(rig_of({"a", "b"}), clips);
  CHECK(score.any.seen_s == doctest::Approx(0.04));
  clips.erase(clips.begin());
  score = rig_score_of(rig_of({"b"}), clips);
  CHECK(score.any.seen_s == 0);
  CHECK(std::isnan(score.any.share()));
  CHECK_FALSE(score.any.first_seen_s);
}

TEST_CASE("distractors are left out, and boxes elsewhere are false alarms of their camera") {
  RigClip rig = rig_of({"front", "left"});
  rig.targets.push_back(rig.targets[0]);
  rig.targets[1].id = 1;  // no label file has it among its targets
  std::vector<DetectedClip> clips = front_and_left();
  report(clips[1].results, 3, moved(kShown, 500, 300));
  report(clips[1].results, 4, moved(kShown, 500, 300));
  const RigScore score = score_rig("mine", rig, clips, {});
  CHECK(score.targets.size() == 1);
  CHECK(score.false_alarm_boxes == std::vector{0, 2});
}

TEST_CASE("durations are those that a walk through time in small steps finds") {
  constexpr double kStep_s = 1e-4;
  std::mt19937 random(7);
  for (int run = 0; run < 20; ++run) {
    std::vector<DetectedClip> clips;
    for (const double rate_hz : {25.0, 20.0, 10.0})
      clips.push_back(camera_of(static_cast<int>(2 * rate_hz), rate_hz, 0.0137 * static_cast<double>(random() % 40),
                                [&](int) { return random() % 3 == 0; }));
    for (DetectedClip& clip : clips) detect(clip, [&](int) { return random() % 2 == 0; });
    const double handover_s = 0.3 + 0.05 * static_cast<double>(random() % 30);
    const RigTargetScore score = rig_score_of(rig_of({"a", "b", "c"}, {{0, 1, handover_s, 0}}), clips);

    // The frame of a camera nearest to a time; none: it is before or after all of its frames by half an interval.
    const auto state_at = [&](const DetectedClip& clip, double time_s) {
      const double first_s = clip.truth.times_s.front();
      const int n = static_cast<int>(std::floor((time_s - first_s) * rate_hz_of(clip.truth) + 0.5));
      if (n < 0 || n >= clip.truth.frames() || !clip.truth.targets[0].frames[static_cast<std::size_t>(n)].visible)
        return 0;
      return clip.results.frames.contains(n) ? 2 : 1;
    };
    double before_s = -1;
    double after_s = 99;
    for (const DetectedClip& clip : clips)
      for (int n = 0; n < clip.truth.frames(); ++n) {
        const double time_s = clip.truth.times_s[static_cast<std::size_t>(n)];
        if (state_at(clip, time_s) < 2) continue;
        if (time_s <= handover_s + 1e-5) before_s = std::max(before_s, time_s);
        if (time_s > handover_s + 1e-5) after_s = std::min(after_s, time_s);
      }
    double seen_s = 0;
    double detected_s = 0;
    double loss_s = 0;
    for (double time_s = -0.2; time_s < 3; time_s += kStep_s) {
      int best = 0;
      for (const DetectedClip& clip : clips) best = std::max(best, state_at(clip, time_s));
      seen_s += best > 0 ? kStep_s : 0;
      detected_s += best > 1 ? kStep_s : 0;
      loss_s += best == 1 && time_s > before_s && time_s < after_s ? kStep_s : 0;
    }
    CAPTURE(run);
    const double tolerance_s = 200 * kStep_s / 2;  // each end of some 100 spans is off by up to a step, at random
    CHECK(std::abs(score.any.seen_s - seen_s) < tolerance_s);
    CHECK(std::abs(score.any.detected_s - detected_s) < tolerance_s);
    CHECK(std::abs(score.handovers[0].loss_s - loss_s) < tolerance_s);
    CHECK(seen_s > detected_s);
    CHECK(detected_s > 0);
  }
}

// A rig of two cameras and an intruder, as an export writes it.
struct RigFiles {
  TemporaryFolder folder;
  nlohmann::json document = nlohmann::json::parse(R"({"sigs_rig": 1, "name": "ring",
    "cameras": [{"name": "front"}, {"name": "left"}],
    "intruders": [{"id": 0, "name": "glider", "views": [],
                   "handovers": [{"time_s": 0.5, "from": "front", "to": "left", "gap_s": -0.1}]}]})");
  std::string table =
      "frame,time_s,intruder,name,range_m,bearing_deg,elevation_deg,seen_by\n"
      "7,0.280000,0,\"a, b\",100,90,0,front+left\n"
      "8,0.320000,0,\"a, b\",200,0,90,\n";

  [[nodiscard]] Result<RigClip> read() const {
    write_file(folder / "ring.rig.json", document.dump());
    write_file(folder / "ring.rig.csv", table);
    return read_rig(folder / "ring.rig.json");
  }
};

TEST_CASE("the files of a rig are read: cameras, their labels, handovers, and places between the rows") {
  const RigFiles files;
  const Result<RigClip> rig = files.read();
  REQUIRE_MESSAGE(rig, rig.error().text());
  CHECK(rig->cameras == std::vector<std::string>{"front", "left"});
  CHECK(rig->labels[1] == files.folder / "ring.left.xml");
  REQUIRE(rig->targets.size() == 1);
  REQUIRE(rig->targets[0].handovers.size() == 1);
  CHECK(rig->targets[0].handovers[0].to == 1);
  CHECK(rig->targets[0].handovers[0].gap_s == -0.1);
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-9; };
  CHECK(near(place_at(rig->targets[0], 0.28), {0, 100, 0}));
  CHECK(near(place_at(rig->targets[0], 0.30), {0, 50, -100}));
  CHECK(near(place_at(rig->targets[0], 0.32), {0, 0, -200}));
  CHECK(near(place_at(rig->targets[0], 0.27), {0, 125, 50}));  // the line goes on, for as long as the rows are apart
  CHECK(near(place_at(rig->targets[0], -5), {0, 200, 200}));
  CHECK(near(place_at(rig->targets[0], 5), {0, -100, -400}));
}

TEST_CASE("files that are no rig's are errors that name file and field or line") {
  const auto error_of = [](const std::function<void(RigFiles&)>& spoil) {
    RigFiles files;
    spoil(files);
    const Result<RigClip> rig = files.read();
    REQUIRE_FALSE(rig);
    CHECK(rig.error().text().find('\n') == std::string::npos);
    return rig.error().text();
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(error_of([](RigFiles& f) { f.document["sigs_rig"] = 2; }), "sigs_rig"));
  CHECK(has(error_of([](RigFiles& f) { f.document = nlohmann::json::array(); }), "ring.rig.json"));
  CHECK(has(error_of([](RigFiles& f) { f.document["cameras"] = nlohmann::json::array(); }), "no camera"));
  CHECK(has(error_of([](RigFiles& f) { f.document["intruders"][0]["handovers"][0]["to"] = "up"; }),
            "intruders[0].handovers[0].to"));
  CHECK(has(error_of([](RigFiles& f) { f.document["intruders"][0].erase("handovers"); }), "intruders[0].handovers"));
  CHECK(has(error_of([](RigFiles& f) { f.table = "frame,time_s\n"; }), "range_m"));
  CHECK(has(error_of([](RigFiles& f) { f.table += "9,nan,0,x,1,1,1,\n"; }), "line 4"));
  CHECK(has(error_of([](RigFiles& f) { f.table += "9,0.32,0,x,1,1,1,\n"; }), "line 4"));
  CHECK(has(error_of([](RigFiles& f) { f.table += "9,0.4,3,x,1,1,1,\n"; }), "intruder '3'"));
  CHECK(has(error_of([](RigFiles& f) { f.table += "9,0.4\n"; }), "line 4"));
  CHECK(has(error_of([](RigFiles& f) { f.table.erase(f.table.find('\n') + 1); }), "no line of intruder 0"));
}

TEST_CASE("the report of a rig has a row for all cameras together and one for each") {
  std::vector<DetectedClip> clips = front_and_left();
  detect(clips[1], kAlways);
  const RigClip rig = rig_of({"front", "left"}, {kHandover});
  const RigDetectionReport report{.rig = "ring", .cameras = rig.cameras, .scores = {score_rig("a, b", rig, clips, {})}};
  const std::string table = table_text(report);
  CHECK_MESSAGE(table.find("1.20 left") != std::string::npos, table);
  CHECK_MESSAGE(table.find("front to left") != std::string::npos, table);
  const TemporaryFolder folder;
  const Result<WrittenReport> written = write_report(folder.path(), report);
  REQUIRE_MESSAGE(written, written.error().text());
  for (const std::filesystem::path& file : written->files) CHECK(is_report_file(file.filename().string()));
  const nlohmann::json json = nlohmann::json::parse(text_of(folder / "evaluation.json"));
  const nlohmann::json& intruder = json["detectors"][0]["intruders"][0];
  CHECK(intruder["detected_share"].get<double>() == doctest::Approx(0.5));
  CHECK(intruder["first_detection"]["camera"] == "left");
  CHECK(intruder["cameras"][0]["first_detection"].is_null());
  CHECK(intruder["handovers"][0]["loss_s"].get<double>() == doctest::Approx(1));
  CHECK(json["detectors"][0]["false_alarm_boxes"]["left"] == 0);
  const std::string csv = text_of(folder / "handovers.csv");
  CHECK(csv.find("\"a, b\",0,glider,0.96,front,left,0.24,,,,,,1.2,left,") != std::string::npos);
}

}  // namespace
}  // namespace sigs::test
