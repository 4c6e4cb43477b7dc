// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "export/frame_stream.h"
#include "labels/formats.h"
#include "project/json.h"
#include "support/test_data.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

struct TrackFixture {
  TinyProject tiny;
  std::string report = tiny.file("report").string();
  std::string labels = tiny.file("out/tiny.xml").string();

  // Exported too, so that labels and their video are there.
  TrackFixture() {
    REQUIRE(run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --masks none").status == 0);
  }
  [[nodiscard]] Run track(const std::string& input, const std::string& options) const {
    return run_sigs("evaluate track " + input + " " + options);
  }
  [[nodiscard]] std::string text(const std::string& name) const { return read_text(tiny.file(name)).value(); }
  [[nodiscard]] std::string put(const std::string& name, const std::string& text) const {
    write_file(tiny.file(name), text);
    return tiny.file(name).string();
  }
  void check_refused(const std::string& input, const std::string& options, int status,
                     const std::string& message) const {
    const Run run = track(input, options + " --out " + report);
    CHECK_MESSAGE(run.status == status, options << ": " << run.err);
    CHECK_MESSAGE(run.err.find(message) != std::string::npos, options << ": " << run.err);
    CHECK(run.out.empty());
    CHECK_FALSE(fs::exists(report));
    CHECK_FALSE(fs::exists(report + ".part"));
  }
};

// Without the measured speed, which differs from run to run.
nlohmann::json scores_in(const TrackFixture& fixture, const std::string& folder) {
  nlohmann::json json = nlohmann::json::parse(fixture.text(folder + "/evaluation.json"));
  for (nlohmann::json& tracker : json["trackers"]) {
    tracker.erase("measured_frames_per_s");
    tracker.erase("name");
  }
  return json["trackers"];
}

}  // namespace

TEST_CASE("trackers score the same on a project and on its export, and from results read again") {
  const TrackFixture fixture;
  const std::string other = fixture.tiny.file("other").string();
  const std::string again = fixture.tiny.file("again").string();
  const Run project =
      fixture.track(fixture.tiny.project(), "--tracker medianflow,mosse --tracker kcf --out " + fixture.report);
  REQUIRE_MESSAGE(project.status == 0, project.err);
  CHECK(project.out.starts_with("tiny: intruder 0 (cube), box of what can be seen, frames 0 to 9\ntracker "));
  REQUIRE(fixture.track(fixture.labels, "--tracker medianflow,mosse,kcf --out " + other).status == 0);
  std::string results;
  for (const std::string name : {"medianflow", "mosse", "kcf"}) {
    const std::string file = "/results/" + name + ".csv";
    CHECK(fixture.text("report" + file) == fixture.text("other" + file));
    results += " --results " + other + file;
  }
  REQUIRE(fixture.track(fixture.labels, results + " --out " + again).status == 0);
  CHECK(scores_in(fixture, "report") == scores_in(fixture, "other"));
  CHECK(scores_in(fixture, "report") == scores_in(fixture, "again"));
  CHECK(scores_in(fixture, "report").size() == 3);
}

TEST_CASE("trackers run on the images of every format that an export writes") {
  const TrackFixture fixture;
  for (const std::string codec : {"jpeg", "tiff"}) {
    const std::string out = fixture.tiny.file(codec).string();
    REQUIRE(run_sigs("export " + fixture.tiny.project() + " --masks none --codec " + codec + " --out " + out).status ==
            0);
    const Run run =
        fixture.track(out + "/tiny.xml", "--tracker mosse --out " + fixture.tiny.file("r." + codec).string());
    CHECK_MESSAGE(run.status == 0, run.err);
  }
}

TEST_CASE("a clip has the images that an export writes, and its ground truth") {
  const TrackFixture fixture;
  const Project project = read_project(fixture.tiny.project()).value().project;
  FrameStream clip = FrameStream::open(project, FrameRange{2, 8}).value();
  CHECK(clip.footage().first_frame == 2);
  CHECK(clip.footage().last_frame == 8);
  FrameSource video = FrameSource::open(fixture.tiny.file("out/tiny.mkv")).value();
  const std::string xml = fixture.text("out/tiny.xml");
  int next = 2;
  const Result<int> damaged = clip.show(3, [&](const StreamFrame& frame) -> Result<void> {
    CHECK(frame.truth.index == next);
    CHECK(cv::norm(frame.image, bgr_of(video.read(next).value()), cv::NORM_INF) == 0);
    CHECK(xml.find(xml_of(frame.truth)) != std::string::npos);
    ++next;
    return {};
  });
  CHECK(damaged.value() == 0);
  CHECK(next == 9);
  int seen = 0;
  const Result<int> stopped = clip.show(2, [&](const StreamFrame&) -> Result<void> {
    ++seen;
    return fail("here", "enough");
  });
  REQUIRE_FALSE(stopped.has_value());
  CHECK(stopped.error().text() == "here: enough");
  CHECK(seen == 1);
}

TEST_CASE("results off by (3, 4) px have a centre error of 5 on the terminal") {
  const TrackFixture fixture;
  std::string csv = fixture.text("out/tiny.xml");
  std::string results = "frame,x,y,width,height\n";
  for (int frame = 0; frame < 10; ++frame) {
    const auto number = [&csv](const char* name) {
      csv.erase(0, csv.find(std::string(name) + "=\""));
      return std::stoi(csv.substr(std::string(name).size() + 2));
    };
    csv.erase(0, csv.find("<box "));
    const int x = number("x");
    const int y = number("y");
    const int width = number("width");
    const int height = number("height");
    results += std::to_string(frame);
    for (const int value : {x + 3, y + 4, width, height}) results.append(",").append(std::to_string(value));
    results += "\n";
  }
  const std::string file = fixture.put("off.csv", results);
  for (const std::string& input : {fixture.labels, fixture.tiny.project()}) {
    const Run run = fixture.track(input, "--results " + file);
    CHECK_MESSAGE(run.status == 0, run.err);
    CHECK_MESSAGE(run.out.find("\noff         5.00    5.00  5.00     3.00     4.00") != std::string::npos, run.out);
  }
  const Run twice = fixture.track(fixture.labels, "--results " + file + " --results " + file);
  CHECK(twice.out.find("\noff (2) ") != std::string::npos);
  const Run listed = fixture.track(fixture.labels, "--results " + file + " " + file + " " + file);
  CHECK_MESSAGE(listed.out.find("\noff (3) ") != std::string::npos, listed.err);
}

TEST_CASE("an evaluation is written whole or not at all, and replaces only an earlier evaluation") {
  const TrackFixture fixture;
  const std::string options = "--tracker mosse --out " + fixture.report;
  REQUIRE(fixture.track(fixture.labels, options).status == 0);
  const Run refused = fixture.track(fixture.labels, options);
  CHECK(refused.status == 73);
  CHECK(refused.err == "error: " + fixture.report + ": exists already; --force overwrites it\n");
  CHECK(fixture.track(fixture.labels, options + "/ --force").status == 0);
  write_file(fixture.report + "/thesis.txt", "mine");
  const Run strange = fixture.track(fixture.labels, options + " --force");
  CHECK(strange.status == 73);
  CHECK(strange.err ==
        "error: " + fixture.report + ": holds thesis.txt, which no evaluation wrote; choose another folder\n");
  CHECK(read_text(fixture.report + "/thesis.txt").value() == "mine");
  fs::remove(fixture.report + "/thesis.txt");
  const Run own = fixture.track(fixture.labels,
                                "--results " + fixture.report + "/results/mosse.csv --force --out " + fixture.report);
  CHECK(own.status == 73);
  CHECK_MESSAGE(own.err.find("which is read by this command") != std::string::npos, own.err);
  fs::create_directories(fixture.tiny.file("empty"));
  CHECK(fixture.track(fixture.labels, "--tracker mosse --out " + fixture.tiny.file("empty").string()).status == 0);
  CHECK(fixture.track(fixture.labels, "--tracker mosse --out " + fixture.tiny.file("deep/er").string()).status == 0);
  CHECK(fs::exists(fixture.tiny.file("deep/er/report.html")));
  CHECK(fixture.track(fixture.labels, "--tracker mosse --out " + fixture.labels).status == 73);
}

TEST_CASE("invalid options are refused in one line, and no file is left behind") {
  const TrackFixture fixture;
  const std::string project = fixture.tiny.project();
  fixture.check_refused(project, "", 64, "name what is to be measured: --tracker or --results");
  fixture.check_refused(project, "--tracker goturn", 64, "--tracker goturn: no such tracker; there are csrt, kcf");
  fixture.check_refused(project, "--tracker kcf,kcf", 64, "--tracker kcf: is named twice");
  fixture.check_refused(project, "--tracker kcf --intruder 1", 64, "--intruder 1: there is none of that number");
  fixture.check_refused(project, "--tracker kcf --frames 5-90", 64, "the project has frames 0 to 9");
  fixture.check_refused(project, "--tracker kcf --video x.mkv", 64, "--video: goes with labels");
  fixture.check_refused(fixture.labels, "--tracker kcf --frames 0-3", 64, "--frames: goes with a project");
  fixture.check_refused(fixture.labels, "--tracker kcf --set camera.speed_mps=3", 64, "--set: goes with a project");
  fixture.check_refused("clip.mkv", "--tracker kcf", 64, "is neither a project (.json) nor labels (.xml)");
  fixture.check_refused("gone.xml", "--tracker kcf", 66, "gone.xml: no such file");
  fixture.check_refused(project, "--results gone.csv", 66, "gone.csv: no such file");
  fixture.check_refused(project, "--tracker kcf --min-side 40", 65, "is in no frame seen with sides of at least 40 px");
  fixture.check_refused(project, "--tracker kcf --min-visible 2", 64, "min-visible");
  fixture.check_refused(project, "--tracker kcf --min-visible nan", 64, "min-visible");
  fixture.check_refused(project, "--tracker kcf --min-side nan", 64, "min-side");
}

TEST_CASE("invalid results are refused before a project's clip is composited") {
  const TrackFixture fixture;
  const std::string nan = fixture.put("nan.csv", "frame,x,y,width,height\n0,1,2,3,4\n1,nan,2,3,4\n");
  const std::string late = fixture.put("late.csv", "frame,x,y,width,height\n0,1,2,3,4\n10,1,2,3,4\n");
  const std::string many = fixture.put("many.txt",
                                       "1,2,3,4\n1,2,3,4\n1,2,3,4\n1,2,3,4\n1,2,3,4\n1,2,3,4\n1,2,3,4\n1,2,3,4\n"
                                       "1,2,3,4\n1,2,3,4\n1,2,3,4\n");
  for (const std::string& input : {fixture.labels, fixture.tiny.project()}) {
    fixture.check_refused(input, "--tracker kcf --results " + nan, 65, "nan.csv: line 3: ");
    fixture.check_refused(input, "--tracker kcf --results " + late, 65, "late.csv: line 3: ");
    fixture.check_refused(input, "--tracker kcf --format otb --results " + many, 65, "many.txt: ");
  }
  const Run early = fixture.track(fixture.tiny.project(), "--tracker kcf --progress plain --results " + nan);
  CHECK(early.err.find("frame 1 of") == std::string::npos);
}

TEST_CASE("images that are not those of the labels are refused with both numbers") {
  const TrackFixture fixture;
  TinyProject longer(12);
  TinyProject larger(10, {80, 48});
  fixture.check_refused(fixture.labels, "--tracker kcf --video " + longer.file("clip.mkv").string(), 65,
                        "clip.mkv: has 12 frames, the labels have 10");
  fixture.check_refused(fixture.labels, "--tracker kcf --video " + larger.file("clip.mkv").string(), 65,
                        "clip.mkv: is 80x48, the labels are of 64x48");
  write_file(fixture.tiny.file("out/tiny.avi"), "");
  fixture.check_refused(fixture.labels, "--tracker kcf", 66,
                        "has both tiny.mkv and tiny.avi beside it; choose with --video");
  fs::remove(fixture.tiny.file("out/tiny.avi"));
  fs::remove(fixture.tiny.file("out/tiny.mkv"));
  fixture.check_refused(fixture.labels, "--tracker kcf", 66, "name its images with --video");
}

TEST_CASE("trackers also run on numbered images beside the labels") {
  const TrackFixture fixture;
  const std::string composed = fixture.tiny.file("composed").string();
  REQUIRE(fixture.track(fixture.tiny.project(), "--tracker medianflow --frames 3-9 --out " + composed).status == 0);
  const std::string pngs = fixture.tiny.file("pngs").string();
  REQUIRE(
      run_sigs("export " + fixture.tiny.project() + " --codec png --masks none --frames 3-9 --out " + pngs).status ==
      0);
  const std::string from_png = fixture.tiny.file("from_png").string();
  const Run run = fixture.track(pngs + "/tiny.xml", "--tracker medianflow --out " + from_png);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.out.find("frames 3 to 9\n") != std::string::npos);
  CHECK(fixture.text("from_png/results/medianflow.csv") == fixture.text("composed/results/medianflow.csv"));
  fs::remove(pngs + "/tiny/frame_000005.png");
  fixture.check_refused(pngs + "/tiny.xml", "--tracker kcf --force", 65, "has 6 frames, the labels have 7");
}

TEST_CASE("of several intruders one must be chosen") {
  TinyProject tiny;
  const std::string one = R"({"name": "cube", "model": {"file": "cube.obj"},
    "trajectory": {"waypoints": [{"frame": 0, "position_m": [20, -3, -150]}, {"frame": 9, "position_m": [20, 3, -150]}]}})";
  std::string other = one;
  other.replace(other.find("cube"), 4, "box2");
  tiny.change(one, one + "," + other);
  const Run run = run_sigs("evaluate track " + tiny.project() + " --tracker mosse");
  CHECK(run.status == 64);
  CHECK_MESSAGE(run.err.find("has 2 intruders; choose with --intruder: 0 cube, 1 box2") != std::string::npos, run.err);
  CHECK(run_sigs("evaluate track " + tiny.project() + " --tracker mosse --intruder 1")
            .out.starts_with("tiny: intruder 1 (box2)"));
}

}  // namespace sigs::test
