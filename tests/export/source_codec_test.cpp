// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLength = 40;
const cv::Size kSmall(160, 120);

// Two aircraft that cross the view for some frames, one after the other; one with a trail, lights and a shadow, which
// come into view at other times than itself.
void prepare_crossing(Scenario& scenario) {
  write_calibration(scenario.path("lens.xml"), {160, 0, 81, 0, 161, 58, 0, 0, 1}, {-0.15, 0.03, 0.001, 0, 0}, kSmall);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.footage.calibration = "lens.xml";
  scenario.project.camera.speed_mps = 20;
  scenario.project.camera.pitch_deg = -5;
  scenario.project.light.ground_shadow = true;
  scenario.project.output.labels = {"xml", "jsonl", "csv"};
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {60, -150, -151}},
                                                           {.frame = 39, .position_m = {95, 90, -147}}};
  IntruderSettings& second = scenario.add("aircraft.obj", {});
  second.trajectory.waypoints = {{.frame = 0, .position_m = {300, 900, -170}},
                                 {.frame = 39, .position_m = {330, -60, -170}}};
  second.contrail.strands = 2;
  second.contrail.length_m = 60;
  second.lights.strobe_cd = 4000;
}

// Frames that have all their samples as in another video.
std::vector<bool> same_frames(const fs::path& a, const fs::path& b) {
  const RawVideo of_a = raw_video(a, kLength + 1);
  const RawVideo of_b = raw_video(b, kLength + 1);
  REQUIRE(of_a.images.size() == of_b.images.size());
  std::vector<bool> same;
  for (std::size_t i = 0; i < of_a.images.size(); ++i) {
    bool is_same = true;
    for (std::size_t plane = 0; plane < of_a.images[i].planes.size(); ++plane)
      is_same = is_same && same_bytes(of_a.images[i].planes[plane], of_b.images[i].planes[plane]);
    same.push_back(is_same);
    CHECK(of_a.images[i].time_s == doctest::Approx(of_b.images[i].time_s).epsilon(1e-9).scale(0.0011));
  }
  return same;
}

ExportReport exported_as(Scenario& scenario, VideoCodec codec, const std::string& folder) {
  scenario.project.output.codec = codec;
  const Result<ExportReport> report =
      export_project({.project = scenario.project, .folder = scenario.path(folder), .jobs = 2}, {});
  if (!report) FAIL(report.error().text());
  return *report;
}

}  // namespace

TEST_CASE("of lossless footage the codec source gives the very frames, masks and labels of a whole export") {
  Scenario scenario(kSmall, kLength);
  prepare_crossing(scenario);
  write_footage(scenario.path("footage.mkv"), kSmall, kLength, PixelLayout::yuv420);
  exported_as(scenario, VideoCodec::ffv1, "whole");
  const ExportReport report = exported_as(scenario, VideoCodec::source, "spliced");
  CHECK(report.frames == kLength);
  CHECK(report.copied_frames > 5);
  CHECK(report.copied_frames < kLength - 5);
  const std::string name = scenario.project.name;
  const std::vector<bool> same =
      same_frames(scenario.path("whole") / (name + ".mkv"), scenario.path("spliced") / (name + ".mkv"));
  CHECK(std::count(same.begin(), same.end(), false) == 0);
  auto whole = contents_of(scenario.path("whole"));
  auto spliced = contents_of(scenario.path("spliced"));
  whole.erase(name + ".mkv");
  spliced.erase(name + ".mkv");
  CHECK(whole.size() == 4);
  CHECK(whole == spliced);
  // Frames without an intruder are the footage's packets.
  const std::vector<bool> untouched =
      same_frames(scenario.path("footage.mkv"), scenario.path("spliced") / (name + ".mkv"));
  CHECK(std::count(untouched.begin(), untouched.end(), true) == report.copied_frames);
}

TEST_CASE("the codec source sees what footage of 10 bits still shows of a faint intruder") {
  Scenario scenario(kSmall, kLength);
  const auto ffmpeg = [](const std::string& arguments) {
    return std::system(("ffmpeg -nostdin -v error -y " + arguments).c_str()) == 0;
  };
  const auto checksums = [&](const fs::path& video) {
    const std::string list = video.string() + ".md5";
    REQUIRE(ffmpeg("-i \"" + video.string() + "\" -f framemd5 \"" + list + "\""));
    return text_of(list);
  };
  if (!ffmpeg("-f lavfi -i testsrc2=size=160x120:rate=25,gblur=sigma=6 -frames:v 40 -pix_fmt yuv420p10le -c:v ffv1 "
              "-level 3 -g 1 -color_range tv -colorspace bt709 \"" +
              scenario.path("footage.mkv").string() + "\""))
    return say_skipped("no ffmpeg with ffv1 of 10 bits");
  // Blurred so widely that the program judges by its light whether it can change a sample.
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.appearance.psf_sigma_px = 18;
  scenario.project.output.labels = {"jsonl"};
  scenario.add("aircraft.obj", {}).trajectory.waypoints = {{.frame = 0, .position_m = {60, 0, -150}},
                                                           {.frame = 39, .position_m = {3000, 0, -150}}};
  exported_as(scenario, VideoCodec::ffv1, "whole");
  const ExportReport report = exported_as(scenario, VideoCodec::source, "spliced");
  CHECK(report.copied_frames > 3);
  CHECK(report.copied_frames < kLength - 3);
  const std::string name = scenario.project.name;
  for (const char* const end : {".mkv", ".masks.mkv"})
    CHECK(checksums(scenario.path("whole") / (name + end)) == checksums(scenario.path("spliced") / (name + end)));
  CHECK(text_of(scenario.path("whole") / (name + ".jsonl")) == text_of(scenario.path("spliced") / (name + ".jsonl")));
}

TEST_CASE("of H.264 footage the codec source keeps groups without an intruder, and jobs change nothing") {
  Scenario scenario(kSmall, kLength);
  prepare_crossing(scenario);
  const std::string clip = scenario.path("clip.mp4").string();
  write_footage(scenario.path("footage.mkv"), kSmall, kLength, PixelLayout::yuv420);
  const std::string make = "ffmpeg -v error -y -i \"" + scenario.path("footage.mkv").string() +
                           "\" -c:v libx264 -g 8 -bf 2 -sc_threshold 0 \"" + clip + "\"";
  if (std::system(make.c_str()) != 0) return say_skipped("no ffmpeg with libx264");
  scenario.project.footage.video = "clip.mp4";
  const ExportReport report = exported_as(scenario, VideoCodec::source, "once");
  exported_as(scenario, VideoCodec::source, "twice");
  CHECK(contents_of(scenario.path("once")) == contents_of(scenario.path("twice")));
  const std::string name = scenario.project.name;
  const std::vector<bool> same = same_frames(clip, scenario.path("once") / (name + ".mp4"));
  CHECK(report.copied_frames % 8 == 0);
  CHECK(report.copied_frames >= 8);
  CHECK(std::count(same.begin(), same.end(), true) >= report.copied_frames);
}

TEST_CASE("the codec source is refused before any work where the footage does not allow it") {
  Scenario scenario(kSmall, 4);
  prepare_crossing(scenario);
  const std::string make = "ffmpeg -v error -y -f lavfi -i testsrc2=size=160x120:rate=25:duration=0.2 -c:v mpeg4 \"" +
                           scenario.path("clip.avi").string() + "\"";
  if (std::system(make.c_str()) != 0) return say_skipped("no ffmpeg with mpeg4");
  scenario.project.footage.video = "clip.avi";
  scenario.project.output.codec = VideoCodec::source;
  const Result<ExportReport> report = export_project({.project = scenario.project, .folder = scenario.path("out")}, {});
  REQUIRE_FALSE(report);
  CAPTURE(report.error().text());
  CHECK(report.error().where.find("export.video.codec") != std::string::npos);
  CHECK(report.error().what.find("use h264") != std::string::npos);
  CHECK_FALSE(fs::exists(scenario.path("out")));
}

}  // namespace sigs::test
