// SPDX-License-Identifier: MIT
// How often a horizon is found where there is one, and where there is none, in frames whose level was read by eye
// (horizons.csv): the row of the level at the image's left and right border.
//   straight  sea, a plain or far hills: a line is to be found
//   skyline   near woods, hills or houses hide the level, whose row is known to some 20 px: a line may be found
//   none      nothing but sky, or a level that nothing shows: no line is to be found
// The clips' field of view is not known; 70 degrees are taken. Prints a table.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "ego_motion/measures.h"
#include "horizon/horizon.h"
#include "video/frame_source.h"
#include "video/luma_stream.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

constexpr double kWrong_deg = 4;  // a line that lies farther from the level is none of it

// Counts of one half.
struct Tally {
  int straight = 0, straight_found = 0, skyline = 0, skyline_found = 0, none = 0, wrong = 0, pitched = 0;
  std::vector<double> line_deg, pitch_deg;  // errors
};

Camera usual_camera(cv::Size size_px) {
  const double focal_px = 0.5 * size_px.width / std::tan(35 * std::numbers::pi / 180);
  const LensParameters lens{
      .fx = focal_px, .fy = focal_px, .cx = 0.5 * (size_px.width - 1), .cy = 0.5 * (size_px.height - 1)};
  return {.lens = Lens::make(lens).value(), .size_px = size_px};
}

glm::dvec3 up_of(const Camera& camera, double left_row, double right_row) {
  const glm::dvec3 left = camera.lens.ray({0, left_row}).value();
  const glm::dvec3 right = camera.lens.ray({camera.size_px.width - 1.0, right_row}).value();
  return glm::normalize(glm::cross(left, right)) * -1.0;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

std::optional<fs::path> clip_of(const std::string& name) {
  for (const char* const place : {"track/{}.mp4", "video/{}.mp4", "video/{}.avi"}) {
    const fs::path path = fs::path(SIGS_TEST_DATA) / fmt::format(fmt::runtime(place), name);
    if (fs::exists(path)) return path;
  }
  return std::nullopt;
}

void judge(const cv::Mat& luma, const std::vector<std::string>& row, const std::string& where, Tally& tally) {
  const Camera camera = usual_camera(luma.size());
  const ReducedLuma reduced = reduced_luma(luma);
  const auto line = horizon_in(reduced.luma, reduced.scale, camera, {}, 0);
  const auto pitch_rad = skyline_pitch_rad(sky_map_of(reduced.luma), reduced.scale, camera);
  const std::string& kind = row[3];
  ++(kind == "straight" ? tally.straight : kind == "skyline" ? tally.skyline : tally.none);
  if (kind == "none") {
    if (line) ++tally.wrong, fmt::print(stderr, "{}: a line where there is none\n", where);
    return;
  }
  const glm::dvec3 up = up_of(camera, std::stod(row[4]), std::stod(row[5]));
  if (line) {
    const double off_deg = degrees_between({line->up.x(), line->up.y(), line->up.z()}, up);
    if (off_deg > kWrong_deg) {
      ++tally.wrong;
      fmt::print(stderr, "{}: a line {:.1f} degrees off\n", where, off_deg);
    } else {
      ++(kind == "straight" ? tally.straight_found : tally.skyline_found);
      tally.line_deg.push_back(off_deg);
    }
  }
  if (!pitch_rad) return;
  ++tally.pitched;
  tally.pitch_deg.push_back(std::abs(*pitch_rad - std::asin(up.x)) * 180 / std::numbers::pi);
}

std::string quantile(std::vector<double> values, double share) {
  if (values.empty()) return "";
  std::sort(values.begin(), values.end());
  return fmt::format("{:.1f}", values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]);
}

}  // namespace

void measure_horizons(const fs::path& truth) {
  std::ifstream in(truth);
  if (!in) accuracy::stop(truth.string() + ": cannot be read");
  std::map<std::string, Tally> halves;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> row;
    std::istringstream cells(line + ',');
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.size() != 6) accuracy::stop(truth.string() + ": " + line + ": 6 columns are expected");
    const auto clip = clip_of(row[1]);
    if (!clip) continue;
    Result<FrameSource> footage = FrameSource::open(*clip);
    if (!footage) accuracy::stop(footage.error().text());
    std::istringstream numbers(row[2]);
    for (std::string number; std::getline(numbers, number, '+');) {
      const Result<Frame> frame = footage->read(std::stoi(number));
      if (!frame) accuracy::stop(frame.error().text());
      judge(luma_of(*frame), row, row[1] + " frame " + number, halves[row[0]]);
    }
  }
  fmt::print(
      "| half | straight: found | skyline: line within 4 degrees | none | wrong lines | line, median error, degrees | "
      "largest | pitch by skyline, frames | median error, degrees | 0.9 "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [half, t] : halves)
    fmt::print("| {} | {} of {} | {} of {} | {} | {} | {} | {} | {} of {} | {} | {} |\n", half, t.straight_found,
               t.straight, t.skyline_found, t.skyline, t.none, t.wrong, quantile(t.line_deg, 0.5),
               quantile(t.line_deg, 1), t.pitched, t.straight + t.skyline, quantile(t.pitch_deg, 0.5),
               quantile(t.pitch_deg, 0.9));
}

}  // namespace sigs::bench
