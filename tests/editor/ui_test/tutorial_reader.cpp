// SPDX-License-Identifier: MIT
#include "editor/ui_test/tutorial_reader.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "support/files.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// `sigs COMMAND PROJECT ARGUMENTS` of the project as it is saved.
void run_sigs(const std::string& command, const fs::path& project, const std::string& arguments) {
  std::ostringstream line;  // paths come quoted
  line << build_dir() / "sigs"
       << " " << command << " " << project << " " << arguments;
  run_well(line.str());
}

glm::dvec2 shown_place(const ScreenPlace& image, const glm::dvec3& at_m) {
  const double focal_px = 640 / std::tan(35 * std::numbers::pi / 180);
  const glm::dvec3 from_camera_m = at_m - kStandingCamera_m;
  const glm::dvec2 pixel{640 + focal_px * from_camera_m.y / from_camera_m.x,
                         480 + focal_px * from_camera_m.z / from_camera_m.x};
  return glm::dvec2(image.x, image.y) + pixel * (image.width / 1280);
}

}  // namespace

std::string quoted(const fs::path& path) {
  std::ostringstream text;
  text << path;
  return text.str();
}

Truth truth_at(Reader& reader, int frame) {
  (void)reader.saved();
  const fs::path search = reader.ui_test.folder() / "encounter.json";
  fs::remove(search);
  run_sigs("encounter", reader.project, "--json " + quoted(search));
  const Json step = json_of(search)["encounters"][0]["steps"][static_cast<std::size_t>(frame)];
  const Json at = step["intruder"]["position_m"];
  const fs::path labels = reader.ui_test.folder() / "labels";
  fs::remove_all(labels);
  const std::string number = std::to_string(frame);
  run_sigs("export", reader.project,
           "--progress none --labels jsonl --frames " + number + "-" + number + " --out " + quoted(labels));
  const Json label = json_of(labels / "sample.jsonl")["intruders"][0];
  CHECK(label["distance_m"].get<double>() == doctest::Approx(step["range_m"].get<double>()).epsilon(1e-6));
  return {{at[0], at[1], at[2]}, step["range_m"], label["in_picture"]};
}

void check_shown_at(Reader& reader, const glm::dvec3& at_m, double x, double y) {
  const glm::dvec2 there = shown_place(reader.editor.place("viewport/image"), at_m);
  CHECK(std::abs(there.x - x) < kMouse_px + 1);
  CHECK(std::abs(there.y - y) < kMouse_px + 1);
}

std::set<std::string> guesses_shown(const Json& state) {
  const std::string head = "inspector/guessed setting/";
  std::set<std::string> keys;
  for (const auto& [name, rect] : state["places"].items())
    if (name.starts_with(head)) keys.insert(name.substr(head.size()));
  return keys;
}

std::set<std::string> guesses_noted(const fs::path& notes) {
  const std::string mark = " (guessed)";
  std::set<std::string> keys;
  std::ifstream in(notes);
  for (std::string line; std::getline(in, line);)
    if (line.ends_with(mark)) keys.insert(line.substr(0, line.size() - mark.size()));
  return keys;
}

int red_pixels_of_timeline(Reader& reader, const std::string& image) {
  reader.image(image);
  const cv::Mat screen = cv::imread((build_dir() / "screenshots" / ("tutorial-" + image + ".png")).string());
  REQUIRE_FALSE(screen.empty());
  const ScreenPlace row = reader.editor.place("timeline/row/0");
  const cv::Rect where =
      cv::Rect(int(row.x), int(row.y), int(row.width), int(row.height)) & cv::Rect(0, 0, screen.cols, screen.rows);
  int count = 0;
  for (int y = where.y; y < where.br().y; ++y)
    for (int x = where.x; x < where.br().x; ++x) {
      const cv::Vec3b bgr = screen.at<cv::Vec3b>(y, x);
      if (bgr[2] > 90 && bgr[2] > 2 * bgr[1] - 20 && bgr[2] > 2 * bgr[0] - 20) ++count;
    }
  return count;
}

Halves brightness_of(Reader& reader, int frame) {
  const fs::path folder = reader.ui_test.folder() / "frame";
  fs::remove_all(folder);
  run_sigs("frame", reader.project, "--stages --frame " + std::to_string(frame) + " --out " + quoted(folder));
  cv::Mat image, mask;
  for (const std::string& name : files_below(folder)) {
    if (name == "frame_" + std::to_string(frame) + ".png") image = cv::imread(folder / name, cv::IMREAD_GRAYSCALE);
    if (name.ends_with("_mask.png")) mask = cv::imread(folder / name, cv::IMREAD_GRAYSCALE);
  }
  REQUIRE_FALSE(image.empty());
  REQUIRE(mask.size() == image.size());
  const cv::Mat inside = mask > 128;
  const cv::Rect box = cv::boundingRect(inside);
  const cv::Rect left(box.x, box.y, box.width / 2, box.height);
  const cv::Rect right(box.x + box.width - box.width / 2, box.y, box.width / 2, box.height);
  return {cv::mean(image(left), inside(left))[0], cv::mean(image(right), inside(right))[0]};
}

}  // namespace sigs::test
