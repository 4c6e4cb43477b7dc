// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/input_file.h"
#include "cli/program.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

// A clip of a dark rectangle, 30x20 from pixel (60, 50) on, before a gray sky, and a box around it in nine frames.
struct RectangleClip {
  TemporaryFolder folder;
  std::string video = (folder / "clip.mkv").string();
  std::string boxes = (folder / "boxes.csv").string();
  std::string calibration = (folder / "pinhole.yml").string();

  RectangleClip() {
    const std::string make =
        "ffmpeg -v error -f lavfi -i color=0xa0a0a0:s=320x240:r=25:d=0.36 "
        "-vf drawbox=60:50:30:20:0x404040:fill,gblur=1.5:steps=6 -pix_fmt yuv420p -c:v ffv1 '" +
        video + "'";
    REQUIRE(std::system(make.c_str()) == 0);
    std::string csv = "frame,label,x,y,w,h\n";
    for (int n = 0; n < 9; ++n) csv += std::to_string(n) + ",AIRPLANE,55,46,42,30\n";
    write_file(boxes, csv);
    write_file(calibration,
               "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   "
               "cols: 3\n   dt: d\n   data: [ 280., 0., 159.5, 0., 280., 119.5, 0., 0., 1. "
               "]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n   data: [ 0., 0., 0., "
               "0., 0. ]\n");
  }
};

const std::string kHeadOn = (source_dir() / "projects/head-on/head-on.json").string();

// The cell of a CSV table: row by its second field.
double cell(const std::string& csv, const std::string& measure, int column) {
  std::size_t at = csv.find("," + measure + ",") + 1;
  REQUIRE(at != std::string::npos + 1);
  for (int i = 1; i < column; ++i) at = csv.find(',', at) + 1;
  return std::stod(csv.substr(at));
}

}  // namespace

TEST_CASE("a rectangle in a clip is measured as what it is, by one box and by boxes") {
  const RectangleClip clip;
  const std::string csv = (clip.folder / "table.csv").string();
  const Run by_box = run_sigs("compare " + clip.video + " --box 54,45,42,30 --frame 4 --csv " + csv);
  REQUIRE_MESSAGE(by_box.status == 0, by_box.err);
  CHECK(has(by_box.out, "edge_width_px"));
  const std::string table = read_text(csv).value();
  // Codes of 0x40 and 0xa0 in limited range: 16 + 219 / 255 * gray.
  CHECK(cell(table, "darkest_5", 3) == doctest::Approx(-219 / 255.0 * 96).epsilon(0.03));
  CHECK(cell(table, "edge_width_px", 3) == doctest::Approx(2.563 * 1.5).epsilon(0.1));  // of a Gaussian
  const Run by_boxes = run_sigs("compare " + clip.video + " --boxes " + clip.boxes + " --csv " + csv + " --force");
  REQUIRE_MESSAGE(by_boxes.status == 0, by_boxes.err);
  CHECK(cell(read_text(csv).value(), "shake_px", 3) < 1e-6);  // it stands still
}

TEST_CASE("a project's intruder is put beside, as wide as the real target, and drawn side by side") {
  const RectangleClip clip;
  const std::string csv = (clip.folder / "table.csv").string(), png = (clip.folder / "beside.png").string();
  const std::string arguments = "compare " + clip.video + " --boxes " + clip.boxes + " --project " + kHeadOn +
                                " --calibration " + clip.calibration + " --set compositing.blur_px_per_m=0 --out " +
                                png + " --csv " + csv;
  const Run run = run_sigs(arguments);
  if (run.status == 69) return say_skipped("no OpenGL");
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(has(run.out, "head-on"));
  const cv::Mat image = cv::imread(png);
  // Each piece has the silhouette's width and a margin of 12 px and a quarter of it on both sides, 8 times.
  CHECK(image.cols >= 2 * 8 * (30 + 2 * 12));
  CHECK(image.cols <= 2 * 8 * (34 + 2 * (12 + 12)) + 8);
  CHECK(cell(read_text(csv).value(), "weber_rms", 4) > 0);
  CHECK(run_sigs(arguments).status == 73);
  const std::string before = read_text(csv).value();
  CHECK(run_sigs(arguments + " --force").status == 0);
  CHECK(read_text(csv).value() == before);  // the same seed, the same figures
}

TEST_CASE("what cannot be compared is refused with the reason") {
  const RectangleClip clip;
  const auto status = [&](const std::string& options) { return run_sigs("compare " + clip.video + " " + options); };
  CHECK(status("").status == 64);
  CHECK(status("--box 54,45,42,30").status == 64);  // in which frame?
  CHECK(status("--box 54,45,42 --frame 4").status == 64);
  CHECK(status("--box 54,45,0,30 --frame 4").status == 64);
  CHECK(status("--box 54,45,42,nan --frame 4").status == 64);
  CHECK(status("--box 54,45,42,30 --frame 400").status == 64);
  CHECK(status("--box 54,45,42,30 --frame 4 --boxes " + clip.boxes).status == 64);
  CHECK(status("--boxes " + clip.boxes + " --out beside.jpg").status == 64);
  CHECK(status("--boxes " + clip.boxes + " --set camera.speed_mps=3").status == 64);
  const Run blank = status("--box 200,150,40,40 --frame 4");
  CHECK(blank.status == 65);
  CHECK(has(blank.err, "surroundings"));
  const std::string broken = (clip.folder / "broken.csv").string();
  for (const char* text :
       {"", "frame,label,x,y,w,h\n", "frame,label,x,y,w,h\n0,A,1,2,3\n", "frame,label,x,y,w,h\n0,A,1,nan,3,4\n",
        "frame,label,x,y,w,h\n1e300,A,1,2,3,4\n", "frame,label,x,y,w,h\n-1,A,1,2,3,4\n"}) {
    write_file(broken, text);
    CHECK(status("--boxes " + broken).status == 65);
  }
  CHECK(status("--boxes " + (clip.folder / "none.csv").string()).status == 66);
  CHECK(run_sigs("compare " + (clip.folder / "none.mp4").string() + " --boxes " + clip.boxes).status == 66);
  const Run over = status("--boxes " + clip.boxes + " --csv " + clip.boxes + " --force");
  CHECK(over.status == 73);
}
