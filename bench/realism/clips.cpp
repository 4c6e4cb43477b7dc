// SPDX-License-Identifier: MIT
#include "realism/clips.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "accuracy/csv.h"
#include "comparison/target_boxes.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTuning[] = {"V_AIRPLANE_001",   "V_AIRPLANE_004",   "V_AIRPLANE_010",  "V_AIRPLANE_013",
                                        "V_AIRPLANE_016",   "V_AIRPLANE_017",   "V_AIRPLANE_020",  "V_AIRPLANE_026",
                                        "V_AIRPLANE_027",   "V_AIRPLANE_034",   "V_AIRPLANE_037",  "V_HELICOPTER_008",
                                        "V_HELICOPTER_013", "V_HELICOPTER_024", "V_HELICOPTER_025"};

}  // namespace

std::vector<RealClip> real_clips() {
  std::vector<RealClip> clips;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(SIGS_TEST_DATA) / "track", ignored)) {
    if (entry.path().extension() != ".mp4") continue;
    const std::string name = entry.path().stem().string();
    const fs::path csv = entry.path().parent_path() / (name + "_gt.csv");
    if (!fs::exists(csv)) continue;
    const auto boxes = read_target_boxes(csv);
    if (!boxes) accuracy::stop(boxes.error().text());
    clips.push_back({.name = name,
                     .path = entry.path(),
                     .is_helicopter = name.find("HELICOPTER") != std::string::npos,
                     .is_tuning = std::find(std::begin(kTuning), std::end(kTuning), name) != std::end(kTuning),
                     .boxes = *boxes});
  }
  std::sort(clips.begin(), clips.end(), [](const RealClip& a, const RealClip& b) { return a.name < b.name; });
  return clips;
}

FrameSource opened(const fs::path& path) {
  Result<FrameSource> source = FrameSource::open(path);
  if (!source) accuracy::stop(source.error().text());
  return *std::move(source);
}

fs::path written_pinhole(cv::Size size_px, double field_rad, const fs::path& file) {
  const fs::path path = fs::absolute(file);
  const double focal_px = 0.5 * size_px.width / std::tan(0.5 * field_rad);
  std::ofstream out(path);
  out << "%YAML:1.0\n---\nimage_width: " << size_px.width << "\nimage_height: " << size_px.height
      << "\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ " << focal_px << ", 0., "
      << 0.5 * (size_px.width - 1) << ", 0., " << focal_px << ", " << 0.5 * (size_px.height - 1)
      << ", 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n   data: [ 0., "
         "0., "
         "0., 0., 0. ]\n";
  if (!out) accuracy::stop(path.string() + ": cannot be written");
  return path;
}

}  // namespace sigs::bench
