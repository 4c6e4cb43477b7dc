// SPDX-License-Identifier: MIT
#include "faults/jobs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "../encounter_model/small_model.h"
#include "cli/program.h"
#include "cli/tiny_recipe.h"
#include "made_boards/board_cases.h"
#include "occlusion/synthetic_clip.h"
#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

// Head-on at 100 m/s, 100 m beside.
constexpr const char* kPair =
    "name, sx, sy, sz, vx, vy, vz, time\n[none], [m], [m], [m], [m/s], [m/s], [m/s], [s]\n"
    "own, 0, 0, 500, 0, 50, 0, 0\nN1, 100, 2000, 500, 0, -50, 0, 0\n"
    "own, 0, 2000, 500, 0, 50, 0, 40\nN1, 100, 0, 500, 0, -50, 0, 40\n";

constexpr const char* kAircraft =
    R"([{"now":1777636800,"aircraft":[{"hex":"3c6444","flight":"DLH400  ","lat":47.5,"lon":8.25,"alt_geom":10000}]},
{"now":1777636810,"aircraft":[{"hex":"3c6444","flight":"DLH400  ","lat":47.625,"lon":8.5,"alt_geom":10100}]}])";

constexpr const char* kPinhole =
    "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   "
    "dt: d\n   data: [ 280.5, 0., 159.5, 0., 280.5, 119.5, 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   "
    "rows: 5\n   cols: 1\n   dt: d\n   data: [ 0., 0., 0., 0., 0. ]\n";

// A dark blurred rectangle before a gray sky.
cv::Mat rectangle_luma(int) {
  cv::Mat luma(240, 320, CV_8UC1, cv::Scalar(150));
  luma(cv::Rect(60, 50, 30, 20)).setTo(70);
  cv::GaussianBlur(luma, luma, {}, 1.5);
  return luma;
}

void write_boards(const fs::path& folder) {
  fs::create_directory(folder);
  const made::BoardCase one = made::board_case("pinhole-charuco");
  const made::BoardRenderer renderer(one.camera, one.board, 2);
  int number = 10;
  for (const cv::Mat& image : made::case_images(one, renderer, 6, 8))
    REQUIRE(cv::imwrite((folder / (std::to_string(number++) + ".png")).string(), image));
}

std::string flight_log() {
  std::string text = "time_s,roll_deg,pitch_deg,yaw_deg,lat,lon,alt\n";
  for (int i = 0; i < 400; ++i) {
    std::ostringstream row;
    row << i * 0.125 << ',' << i % 7 << ".5," << -i % 5 << ".25," << i << ",47." << 1000 + i << ",8.5," << 400 + i;
    text += row.str() + "\n";
  }
  return text;
}

std::string boxes(const char* head, const char* label, int frames) {
  std::string text = head;
  for (int n = 0; n < frames; ++n) text += std::to_string(n) + "," + label + "\n";
  return text;
}

bool is_staging(const fs::path& name) {
  return name.string().starts_with(".sigs-") || name == ".part";
}

bool is_below_staging(const fs::path& path) {
  return std::any_of(path.begin(), path.end(), is_staging);
}

// With OUT as the folder.
std::vector<std::string> split(const std::string& arguments, const std::string& out) {
  std::istringstream stream(arguments);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    if (word.starts_with("OUT")) word.replace(0, 3, out);
    words.push_back(word);
  }
  return words;
}

bool is_error_line(const std::string& line) {
  return line.starts_with("error: ");
}

// Every line but the last one a warning, the last one the error. libpng prints a line of its own where an image is cut.
bool is_one_error_after_warnings(const std::string& said) {
  std::istringstream stream(said);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("warning: ") && !line.starts_with("libpng ")) lines.push_back(line);
  return lines.size() == 1 && is_error_line(lines[0]) && said.ends_with(lines[0] + "\n");
}

// The same with a line for each video that failed, and one that counts videos.
bool are_errors_of_videos(const std::string& said) {
  std::istringstream stream(said);
  int errors = 0;
  for (std::string line; std::getline(stream, line);) {
    errors += is_error_line(line) ? 1 : 0;
    const bool counts = line.find(" videos made, ") != std::string::npos || line.starts_with("1 video made, ");
    if (!is_error_line(line) && !line.starts_with("warning: ") && !counts) return false;
  }
  return errors > 0 && said.find("/.part/") == std::string::npos;
}

}  // namespace

Workplace::Workplace() : tiny_(30) {
  make_inputs();
  const auto in = [&](const std::string& name) { return " " + input(name).string() + " "; };
  const std::string project = in("p.json");
  const std::string truth = in("truth/tiny.xml");
  const std::vector<std::string> read = {"p.json", "clip.mkv", "lens.xml", "cube.obj", "cube.mtl"};
  jobs_ = {
      {.name = "export, videos",
       .arguments = "export" + project + "--masks video --labels xml,coco,kitti,csv --progress none --out OUT",
       .inputs = read,
       .draws = true},
      {.name = "export, images",
       .arguments =
           "export" + project + "--codec png --masks png --labels xml,yolo --frames 0-11 --progress none --out OUT",
       .inputs = read,
       .draws = true},
      {.name = "frame", .arguments = "frame" + project + "--frame 5 --stages --out OUT", .inputs = read, .draws = true},
      {.name = "mask",
       .arguments = "mask" + in("flight.mkv") +
                    "--method paper --progress none --out OUT/m.png --confidence OUT/c.png --stages OUT/steps",
       .inputs = {"flight.mkv"}},
      {.name = "occluder",
       .arguments = "occluder" + project +
                    "--set footage.video=flight.mkv --set footage.calibration=flight.xml --frame 10 --span 6 "
                    "--progress none --out OUT/o.png --overlay OUT/look.png",
       .inputs = {"p.json", "flight.mkv", "flight.xml"}},
      {.name = "ego-motion",
       .arguments = "ego-motion" + in("flight.mkv") + "--calibration" + in("flight.xml") +
                    "--max-unknown 100 --progress none --out OUT/a.csv --plot OUT/a.png",
       .inputs = {"flight.mkv", "flight.xml"}},
      {.name = "appearance",
       .arguments =
           "appearance" + in("flight.mkv") + "--every 8 --progress none --out OUT/settings.json --plot OUT/page.png",
       .inputs = {"flight.mkv"}},
      {.name = "calibrate",
       .arguments = "calibrate" + in("boards") +
                    "--board charuco --corners 8x6 --square-m 0.03 --marker-m 0.021 --dictionary DICT_4X4_50 "
                    "--progress none --out OUT/c.xml --plot OUT/c.png --json OUT/c.json",
       .inputs = {"boards/12.png"}},
      {.name = "init",
       .arguments = "init" + in("clip.mkv") + "--calibration" + in("lens.xml") + "--model" + in("cube.obj") +
                    "--out OUT/first/first.json",
       .inputs = {"clip.mkv", "lens.xml", "cube.obj"}},
      {.name = "telemetry",
       .arguments = "telemetry" + in("log.csv") + "--out OUT/log.csv --plot OUT/log.png",
       .inputs = {"log.csv"}},
      {.name = "path", .arguments = "path" + in("aircraft.json") + "--out OUT/a.kml", .inputs = {"aircraft.json"}},
      {.name = "encounter",
       .arguments = "encounter" + in("pair.daa") +
                    "--volume nmac --dmod-ft 1000 --zthr-ft 200.5 --json OUT/e.json --plot OUT/e.png --daa OUT/e.daa",
       .inputs = {"pair.daa"}},
      {.name = "encounter-model",
       .arguments =
           "encounter-model" + in("model.txt") + "--samples 40 --duration 60 --seed 3 --out OUT/f.csv --plot OUT/f.png",
       .inputs = {"model.txt"}},
      {.name = "compare",
       .arguments = "compare" + in("rectangle.mkv") + "--boxes" + in("boxes.csv") + "--project" + project +
                    "--calibration" + in("pinhole.yml") + "--out OUT/beside.png --csv OUT/table.csv",
       .inputs = {"rectangle.mkv", "boxes.csv", "p.json", "pinhole.yml", "cube.obj"},
       .draws = true},
      {.name = "evaluate track",
       .arguments = "evaluate track" + truth + "--results" + in("results.csv") + "--out OUT/report",
       .inputs = {"truth/tiny.xml", "results.csv"}},
      {.name = "evaluate detect",
       .arguments = "evaluate detect" + truth + "--results" + in("results.csv") + "--out OUT/report",
       .inputs = {"truth/tiny.xml", "results.csv"}},
      {.name = "dataset",
       .arguments = "dataset" + in("recipe.json") + "--progress none --out OUT",
       .inputs = {"recipe.json", "clip.mkv", "lens.xml", "cube.obj"},
       .again = "--resume",
       .draws = true},
  };
}

void Workplace::make_inputs() const {
  write_tiny_recipe(input("recipe.json"));
  write_flight(input("flight.mkv"), 40);
  std::string lens = text_of(input("lens.xml"));
  lens.replace(lens.find("<image_width>64"), 15, "<image_width>96");
  lens.replace(lens.find("<image_height>48"), 16, "<image_height>72");
  write_file(input("flight.xml"), lens);
  write_luma_clip(input("rectangle.mkv"), 9, rectangle_luma);
  write_file(input("boxes.csv"), boxes("frame,label,x,y,w,h\n", "AIRPLANE,55,46,42,30", 9));
  write_file(input("pinhole.yml"), kPinhole);
  write_boards(input("boards"));
  write_file(input("log.csv"), flight_log());
  write_file(input("aircraft.json"), kAircraft);
  write_file(input("pair.daa"), kPair);
  write_file(input("model.txt"), text_of(small_model()));
  write_file(input("results.csv"), boxes("frame,x,y,width,height\n", "24.5,18,6.25,7", 30));
  const Run made = RunningProgram({(build_dir() / "sigs").string(), "export", tiny_.project(), "--masks", "none",
                                   "--out", input("truth").string()})
                       .ended();
  REQUIRE_MESSAGE(made.status == 0, made.err);
}

std::vector<std::string> Workplace::words(const Job& job, const std::string& more) const {
  std::vector<std::string> words = split(job.arguments + " " + more, out().string());
  words.insert(words.begin(), (build_dir() / "sigs").string());
  return words;
}

void Workplace::clear_out() const {
  if (fs::exists(out())) fs::permissions(out(), fs::perms::owner_all);
  fs::remove_all(out());
  fs::create_directory(out());
}

Contents Workplace::files_out() const {
  Contents files;
  if (!fs::exists(out())) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out())) {
    const std::string name = entry.path().lexically_relative(out()).string();
    if (entry.is_regular_file()) files[name] = text_of(entry.path());
    if (is_staging(entry.path().filename())) files[name + "/"] = "";
  }
  return files;
}

const Workplace::Whole& Workplace::whole(const Job& job) {
  if (const auto known = wholes_.find(job.name); known != wholes_.end()) return known->second;
  const auto begin = std::chrono::steady_clock::now();
  const Run done = run(job, {});
  const double lasts_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  REQUIRE_MESSAGE(done.status == 0, job.name << ": " << done.err);
  return wholes_[job.name] = {.files = files_out(), .printed = done.out, .lasts_s = lasts_s};
}

Run Workplace::run(const Job& job, const Conditions& conditions) const {
  clear_out();
  return RunningProgram(words(job), conditions).ended();
}

void Workplace::check_all_or_nothing(const Job& job, const Run& run) {
  CAPTURE(job.name);
  CAPTURE(run.status);
  CAPTURE(run.err);
  if (run.status == 0) {
    CHECK(files_out() == whole(job).files);
    CHECK(run.out == whole(job).printed);
    return;
  }
  const bool is_stopped = run.status == 129 || run.status == 130 || run.status == 143;
  CHECK((is_stopped || (run.status >= 64 && run.status <= 78)));
  CHECK((job.name == "dataset" ? are_errors_of_videos(run.err) : is_one_error_after_warnings(run.err)));
  const Contents left = files_out();
  if (job.name != "dataset") {
    for (const auto& file : left) FAIL_CHECK("left behind: ", file.first);
    return;
  }
  for (const auto& file : left) CHECK_MESSAGE(!is_below_staging(file.first), "left behind: ", file.first);
  CHECK_FALSE(left.contains("index.json"));
  check_final_names(job);
}

void Workplace::check_final_names(const Job& job) {
  CAPTURE(job.name);
  const Contents& expected = whole(job).files;
  for (const auto& file : files_out()) {
    if (is_below_staging(file.first)) continue;
    const auto it = expected.find(file.first);
    CHECK_MESSAGE(it != expected.end(), "not an output: ", file.first);
    if (it != expected.end()) CHECK_MESSAGE(it->second == file.second, "not as it should be: ", file.first);
  }
}

void Workplace::check_next_run(const Job& job) {
  CAPTURE(job.name);
  const Run next = RunningProgram(words(job, job.again)).ended();
  CHECK_MESSAGE(next.status == 0, next.err);
  const Contents files = files_out();
  for (const auto& file : files) CHECK_MESSAGE(!is_below_staging(file.first), "left behind: ", file.first);
  CHECK(files == whole(job).files);
}

Workplace& workplace() {
  static Workplace shared;
  return shared;
}

int tries(int usual) {
  const char* const asked = std::getenv("SIGS_TEST_FAULTS");
  return asked == nullptr ? usual : std::max(1, std::atoi(asked));
}

double share(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0;
}

}  // namespace sigs::test
