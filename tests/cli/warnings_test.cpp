// SPDX-License-Identifier: MIT
// Settings that are valid but implausible: check, export and frame give the same warnings, and do their work.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

// The lines of stderr that hold a text.
std::string lines_with(const std::string& text, const std::string& part) {
  std::string found;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (has(line, part)) found += line + "\n";
    begin = end + 1;
  }
  return found;
}

// All three give the same warnings, for that field and with those words, and exit with status 0.
void check_warned(const TinyProject& tiny, const std::string& field, const std::vector<std::string>& words) {
  const Run checked = run_sigs("check " + tiny.project());
  CHECK_MESSAGE(checked.status == 0, checked.err);
  CHECK_MESSAGE(!has(checked.out, "nothing is wrong"), checked.out);
  const std::string warnings = lines_with(checked.err, "warning: ");
  const std::string of_field = lines_with(warnings, "p.json: " + field + ": ");
  for (const std::string& word : words) CHECK_MESSAGE(has(of_field, word), word << " in: " << checked.err);
  const Run framed = run_sigs("frame " + tiny.project() + " --frame 3 --force --out " + tiny.out());
  CHECK_MESSAGE(framed.status == 0, framed.err);
  CHECK(lines_with(framed.err, "warning: ") == warnings);
  const Run exported = run_sigs("export " + tiny.project() + " --force --out " + tiny.out());
  CHECK_MESSAGE(exported.status == 0, exported.err);
  CHECK(lines_with(exported.err, "warning: ") == warnings);
}

std::vector<std::string> all_three(const TinyProject& tiny) {
  return {"check " + tiny.project(), "export " + tiny.project() + " --out " + tiny.out(),
          "frame " + tiny.project() + " --frame 0 --out " + tiny.out()};
}

void change_lens(const TinyProject& tiny, const std::string& from, const std::string& to) {
  std::string text = read_text(tiny.file("lens.xml")).value();
  REQUIRE(has(text, from));
  write_file(tiny.file("lens.xml"), text.replace(text.find(from), from.size(), to));
}

void put_at(TinyProject& tiny, const std::string& first_m, const std::string& last_m) {
  tiny.change("[20, -3, -150]", first_m);
  tiny.change("[20, 3, -150]", last_m);
}

void put_mask(TinyProject& tiny, const cv::Mat& mask) {
  cv::imwrite(tiny.file("mask.png").string(), mask);
  tiny.change(R"("calibration": "lens.xml")", R"("calibration": "lens.xml", "own_body_mask": "mask.png")");
}

const std::string kSize = "<image_width>64</image_width><image_height>48</image_height>";
const std::string kFive = "<rows>1</rows><cols>5</cols><dt>d</dt>\n<data>-0.1 0.01 0. 0. 0.</data>";

std::string four(const std::string& numbers) {
  return "<rows>1</rows><cols>4</cols><dt>d</dt>\n<data>" + numbers + "</data>";
}

struct VisibilityLine {
  int visible = 0;
  int frames = 0;
  double low_px = 0;
  double high_px = 0;
};

// Of a line "visible in (about) 10 of 10 frames, 6 to 6.2 px".
VisibilityLine visibility_in(const std::string& text) {
  const std::regex line(R"(visible in (?:about )?(\d+) of (\d+) frames, ([0-9.]+)(?: to ([0-9.]+))? px)");
  std::smatch match;
  REQUIRE_MESSAGE(std::regex_search(text, match, line), text);
  const double low_px = std::stod(match[3]);
  return {std::stoi(match[1]), std::stoi(match[2]), low_px, match[4].matched ? std::stod(match[4]) : low_px};
}

}  // namespace

TEST_CASE("an intruder that is behind the camera for the whole clip is named") {
  TinyProject tiny;
  put_at(tiny, "[-20, -3, -150]", "[-20, 3, -150]");
  check_warned(tiny, "intruders[0].trajectory",
               {"cube", "never visible", "behind the camera in 10", "the camera looks along world X"});
  const Run level = run_sigs("check " + tiny.project() + " --set camera.attitude_deg.pitch=-5");
  CHECK(has(level.err, "behind the camera in 10"));
  CHECK_FALSE(has(level.err, "world X"));
}

TEST_CASE("an intruder that is never in the image, and one behind a mask, are named with the reason") {
  TinyProject aside;
  put_at(aside, "[20, 300, -150]", "[20, 303, -150]");
  check_warned(aside, "intruders[0].trajectory", {"never visible", "outside the image"});
  TinyProject hidden;
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8UC1);
  mask.colRange(8, 60).setTo(255);
  put_mask(hidden, mask);
  check_warned(hidden, "intruders[0].trajectory", {"never visible", "behind the own body in 10"});
}

TEST_CASE("a principal point outside another image size is refused, one far from its centre gives a warning") {
  TinyProject tiny;
  change_lens(tiny, kSize, "");
  CHECK(run_sigs("check " + tiny.project()).err.empty());  // the middle is where it belongs
  change_lens(tiny, "31.5 0. 60. 23.5", "41.5 0. 60. 31.5");
  check_warned(tiny, "footage.calibration", {"principal point (41.5, 31.5)", "84x64", "image_width"});
  change_lens(tiny, "41.5 0. 60. 31.5", "1919 0. 60. 1079");
  for (const std::string& run_as : all_three(tiny)) {
    const Run run = run_sigs(run_as);
    CHECK_MESSAGE(run.status == 65, run.err);
    CHECK_MESSAGE(has(run.err, "footage.calibration: lens.xml: camera_matrix: "), run.err);
    CHECK_MESSAGE(has(run.err, "3839x2159"), run.err);
    CHECK_MESSAGE(has(run.err, "image_width"), run.err);
  }
}

TEST_CASE("an implausible focal length is reported with its field of view") {
  TinyProject wide;
  change_lens(wide, "60. 0. 31.5 0. 60.", "1.77 0. 31.5 0. 1.77");
  change_lens(wide, kFive, four("0. 0. 0. 0."));
  check_warned(wide, "footage.calibration", {"fx is 1.77 px", "173.7 degrees", "pixels"});
  TinyProject narrow;
  change_lens(narrow, "60. 0. 31.5 0. 60.", "60000. 0. 31.5 0. 60000.");
  check_warned(narrow, "footage.calibration", {"fx is 60000 px", "0.06112 degrees"});
}

TEST_CASE("four coefficients without a model are reported, with the assumption and the remedy") {
  TinyProject tiny;
  change_lens(tiny, kFive, four("-0.1 0.01 0.001 -0.002"));
  check_warned(tiny, "footage.calibration", {"fisheye", "read as brown_conrady", "footage.lens_model"});
  CHECK(has(run_sigs("info " + tiny.file("lens.xml").string()).err, "read as brown_conrady"));
  for (const char* const model : {"brown_conrady", "fisheye"})
    CHECK(run_sigs("check " + tiny.project() + " --set footage.lens_model=" + model).err.empty());
  // No real lens is tilted so much against its sensor.
  change_lens(tiny, "-0.1 0.01 0.001 -0.002", "0.2 0.01 0.15 -0.3");
  check_warned(tiny, "footage.calibration", {"read as fisheye", "too large", "footage.lens_model"});
  const Run info = run_sigs("info " + tiny.file("lens.xml").string());
  CHECK(has(info.out, "Kannala-Brandt"));
  change_lens(tiny, kSize, kSize + "<fisheye_model>1</fisheye_model>");
  CHECK(run_sigs("check " + tiny.project()).err.empty());
  const Run against = run_sigs("check " + tiny.project() + " --set footage.lens_model=brown_conrady");
  CHECK(has(against.err, "read as brown_conrady, as asked for"));
}

TEST_CASE("a model of implausible size is reported, with the unit that it may be in") {
  TinyProject tiny;
  write_file(tiny.file("cube.obj"), "v -1450 -100 -100\nv 1450 100 -100\nv 0 0 100\nf 1 2 3\nf 3 2 1\n");
  check_warned(tiny, "intruders[0].model.scale", {"2.9 km long", "millimetres (scale 0.001: 2.9 m"});
  TinyProject small_model;
  small_model.change(R"("file": "cube.obj")", R"("file": "cube.obj", "scale": 0.01)");
  check_warned(small_model, "intruders[0].model.scale", {"0.02 m long", "length_m"});
  TinyProject long_model;
  long_model.change(R"("file": "cube.obj")", R"("file": "cube.obj", "length_m": 3000)");
  check_warned(long_model, "intruders[0].model.length_m", {"3 km long"});
}

TEST_CASE("a mask that occludes everything or nothing is reported") {
  TinyProject white;
  put_mask(white, cv::Mat(48, 64, CV_8UC1, cv::Scalar(255)));
  check_warned(white, "footage.own_body_mask", {"white in 100 %", "hides every intruder"});
  TinyProject black;
  put_mask(black, cv::Mat::zeros(48, 64, CV_8UC1));
  check_warned(black, "footage.own_body_mask", {"black", "hides nothing"});
}

TEST_CASE("an intruder faster than any aircraft, or below the ground, is reported with the frame") {
  TinyProject fast;
  put_at(fast, "[20, -3, -150]", "[10820, 3, -150]");
  check_warned(fast, "intruders[0].trajectory", {"cube", "30000 m/s", "faster than any aircraft"});
  TinyProject low;
  put_at(low, "[20, -3, -150]", "[20, 3, 12]");
  check_warned(low, "intruders[0].trajectory", {"12 m below the ground at frame 9", "z = 0"});
}

TEST_CASE("a waypoint without a position is an error that names it") {
  TinyProject tiny;
  tiny.change(R"(, "position_m": [20, 3, -150])", "");
  for (const std::string& run_as : all_three(tiny)) {
    const Run run = run_sigs(run_as);
    CHECK(run.status == 78);
    CHECK_MESSAGE(has(run.err, "p.json: intruders[0].trajectory.waypoints[1].position_m: is missing"), run.err);
  }
}

TEST_CASE("check and export end with the number of frames with a visible intruder and its sizes, and agree") {
  TinyProject tiny(40);
  tiny.change(R"("frame": 9, "position_m": [20, 3, -150])", R"("frame": 39, "position_m": [60, 45, -150])");
  const VisibilityLine predicted = visibility_in(run_sigs("check " + tiny.project()).out);
  const Run exported = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK(has(exported.err, "cube: visible in "));
  CHECK_FALSE(has(exported.err, "about"));
  const VisibilityLine found = visibility_in(exported.err);
  CHECK(found.frames == 40);
  CHECK(predicted.frames == 40);
  CHECK(found.visible > 10);
  CHECK(found.visible < 30);                                // it leaves the image
  CHECK(std::abs(found.visible - predicted.visible) <= 1);  // touching the edge
  CHECK(std::abs(found.low_px - predicted.low_px) < 0.05 * found.low_px);
  CHECK(std::abs(found.high_px - predicted.high_px) < 0.05 * found.high_px);
  CHECK(has(run_sigs("export " + tiny.project() + " --frames 39 --force --out " + tiny.out()).err,
            "cube: never visible in 1 frame"));
}

TEST_CASE("the sample projects give no warning") {
  for (const char* const name : {"crossing", "head-on", "two-intruders"}) {
    const Run run = run_sigs("check " + (source_dir() / "projects" / name / (std::string(name) + ".json")).string());
    CHECK(run.status == 0);
    CHECK_MESSAGE(run.err.empty(), run.err);
    CHECK(has(run.out, "nothing is wrong"));
  }
}

TEST_CASE("real calibrations with images of their size give no warning") {
  if (!has_real_data()) return;
  struct Real {
    const char* file;
    cv::Size size_px;
  };
  const std::vector<Real> files{{"ar_drone_RIGHTBLACKBOX_oldkeys.xml", {640, 480}},
                                {"gopro_hero3plus_fisheye4_1280x960_derived.xml", {1280, 960}},
                                {"gyroflow_gopro_hero3plus_1440_4by3_fisheye4.json", {640, 480}},
                                {"hpfily_out_camera_data_oldkeys.xml", {640, 480}},
                                {"ntu_mecatron_out_camera_data.xml", {640, 480}},
                                {"opencv_doc_left_intrinsics.yml", {320, 240}},
                                {"opencv_doc_stereo_intrinsics_M1D1.yml", {640, 480}},
                                {"opencv_doc_tutorial_camera_params.yml", {640, 480}},
                                {"opencv_left_plus_12coef_derived.yml", {640, 480}},
                                {"opencv_left_plus_14coef_derived.yml", {640, 480}},
                                {"rational8_oakd_250_derived.yml", {250, 250}},
                                {"ros_camera_info_plumb_bob.yaml", {640, 480}},
                                {"uav_skyeye_out_camera_data.xml", {640, 480}},
                                {"video2calibration_gopro_plain.yaml", {1280, 720}}};
  for (const Real& real : files) {
    const TinyProject tiny(2, real.size_px);
    const fs::path file = real_data() / "calibrations" / real.file;
    const Run run = run_sigs("check " + tiny.project() + " --set footage.calibration=" + file.string() +
                             " --set intruders[0].trajectory.waypoints[1].frame=1");
    CHECK_MESSAGE(run.status == 0, real.file << ": " << run.err);
    CHECK_MESSAGE(run.err.empty(), real.file << ": " << run.err);
  }
}

TEST_CASE("real models at their size give no warning") {
  if (!has_real_data()) return;
  for (const char* const file :
       {"boeing737-300/boeing737-300.obj", "cessna172p-hires/cessna172p-hires.obj",
        "glider-centrair101/glider-centrair101.obj", "helicopter-dauphin/helicopter-dauphin.obj"}) {
    TinyProject tiny;
    put_at(tiny, "[60, -3, -150]", "[60, 3, -150]");
    const Run run = run_sigs("check " + tiny.project() +
                             " --set intruders[0].model.file=" + (real_data() / "models" / file).string() +
                             " --set intruders[0].model.forward=-x --set intruders[0].model.up=+y");
    CHECK_MESSAGE(run.status == 0, run.err);
    CHECK_MESSAGE(!has(run.err, "p.json"), run.err);
  }
}

}  // namespace sigs::test
