// SPDX-License-Identifier: MIT
// How often a horizon is found where there is one, and where there is none, in frames whose level was read by eye
// (horizons.csv): the row of the level at the image's left and right border.
//   straight  sea, a plain or far hills: a line is to be found
//   skyline   near woods, hills or houses hide the level, whose row is known to some 20 px: a line may be found
//   none      nothing but sky, or a level that nothing shows: no line is to be found
// The clips' field of view is not known; 70 degrees are taken. Two further rows of the table are made of these frames:
// those with a straight horizon, and those without any, turned by 15 to 45 degrees about the image's centre; and one of
// the landscapes of tests/attitude_flights, seen from 150 m straight down and 45 degrees down. Prints a table.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "attitude_flights/flight.h"
#include "base/pose.h"
#include "ego_motion/measures.h"
#include "horizon/horizon.h"
#include "video/frame_source.h"

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

// The level's row at the left and right border.
struct Level {
  double left_row = 0, right_row = 0;
};

void judge(const cv::Mat& luma, const std::string& kind, const Level& level, const std::string& where, Tally& tally) {
  const Camera camera = usual_camera(luma.size());
  const ReducedLuma reduced = reduced_luma(luma);
  const auto line = horizon_in(reduced.luma, reduced.scale, camera, {}, 0);
  const auto pitch_rad = skyline_pitch_rad(sky_map_of(reduced.luma), reduced.scale, camera);
  ++(kind == "straight" ? tally.straight : kind == "skyline" ? tally.skyline : tally.none);
  if (kind == "none") {
    if (line) ++tally.wrong, fmt::print(stderr, "{}: a line where there is none\n", where);
    return;
  }
  const glm::dvec3 up = up_of(camera, level.left_row, level.right_row);
  if (line) {
    const double off_deg = degrees_between(line->up, up);
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

// The middle of an image that is turned clockwise, as large as can be without corners that nothing fills, and its
// level, which half of its columns have to show.
void judge_turned(const cv::Mat& luma, const std::string& kind, const Level& level, double angle_rad,
                  const std::string& where, Tally& tally) {
  const double sine = std::abs(std::sin(angle_rad)), cosine = std::cos(angle_rad);
  const cv::Size from = luma.size();
  const double share = std::min(from.width / (from.width * cosine + from.height * sine),
                                from.height / (from.width * sine + from.height * cosine));
  const cv::Size size(static_cast<int>(share * from.width) - 1, static_cast<int>(share * from.height) - 1);
  const double from_x = 0.5 * (from.width - 1), from_y = 0.5 * (from.height - 1);
  const double x = 0.5 * (size.width - 1), y = 0.5 * (size.height - 1);
  cv::Mat turn = cv::getRotationMatrix2D(cv::Point2d(from_x, from_y), -angle_rad * 180 / std::numbers::pi, 1);
  turn.at<double>(0, 2) += x - from_x;
  turn.at<double>(1, 2) += y - from_y;
  cv::Mat turned;
  cv::warpAffine(luma, turned, turn, size, cv::INTER_LINEAR);
  const auto place = [&](double at_x, double at_y) {
    const auto of = [&](int i) {
      return turn.at<double>(i, 0) * at_x + turn.at<double>(i, 1) * at_y + turn.at<double>(i, 2);
    };
    return glm::dvec2(of(0), of(1));
  };
  const glm::dvec2 left = place(0, level.left_row), right = place(from.width - 1.0, level.right_row);
  const double slope = (right.y - left.y) / (right.x - left.x);
  const Level now{.left_row = left.y - slope * left.x, .right_row = left.y + slope * (size.width - 1 - left.x)};
  int in_view = 0;
  for (int column = 0; column < size.width; ++column) {
    const double row = now.left_row + (now.right_row - now.left_row) * column / (size.width - 1);
    in_view += row >= 0 && row < size.height ? 1 : 0;
  }
  if (kind != "none" && 2 * in_view < size.width) return;
  judge(turned, kind, now, fmt::format("{}, turned by {:.0f} degrees", where, angle_rad * 180 / std::numbers::pi),
        tally);
}

// Fields and water from above: nowhere is a horizon.
void judge_ground(Tally& tally) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U})
    for (const double pitch_deg : {-90.0, -60.0, -45.0})
      for (const bool has_water : {false, true}) {
        made::FlightSettings settings{.seed = seed, .frames = 2};
        settings.motion.pitch_rad = rad_of_deg(pitch_deg);
        settings.landscape.moving_water = has_water;
        const made::Flight flight(settings, usual_camera({640, 480}));
        judge(luma_of(flight.frame(1)), "none", {},
              fmt::format("landscape {}, {:.0f} degrees{}", seed, pitch_deg, has_water ? ", water" : ""), tally);
      }
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
      const std::string where = row[1] + " frame " + number;
      const Level level = row[4].empty() ? Level{} : Level{std::stod(row[4]), std::stod(row[5])};
      judge(luma_of(*frame), row[3], level, where, halves[row[0]]);
      if (row[3] != "skyline")
        for (const double angle_deg : {-45.0, -30.0, -15.0, 15.0, 30.0, 45.0})
          judge_turned(luma_of(*frame), row[3], level, rad_of_deg(angle_deg), where, halves[row[0] + ", turned"]);
    }
  }
  judge_ground(halves["ground from above"]);
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
