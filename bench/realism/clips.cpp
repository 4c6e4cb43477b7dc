// SPDX-License-Identifier: MIT
#include "realism/clips.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "accuracy/csv.h"
#include "comparison/inserted_target.h"

namespace sigs::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTuning[] = {"V_AIRPLANE_001",   "V_AIRPLANE_004",   "V_AIRPLANE_010",  "V_AIRPLANE_013",
                                        "V_AIRPLANE_016",   "V_AIRPLANE_017",   "V_AIRPLANE_020",  "V_AIRPLANE_026",
                                        "V_AIRPLANE_027",   "V_AIRPLANE_034",   "V_AIRPLANE_037",  "V_HELICOPTER_008",
                                        "V_HELICOPTER_013", "V_HELICOPTER_024", "V_HELICOPTER_025"};

// Clips of a kind in a run of five numbers (001 to 005, 006 to 010, ...) often show the same sky on the same day:
// "V_AIRPLANE_004" and "V_AIRPLANE_001" are "V_AIRPLANE_ 0".
std::string run_of(std::string_view name) {
  const std::size_t digits = name.rfind('_') + 1;
  return std::string(name.substr(0, digits)) + " " +
         std::to_string((std::stoi(std::string(name.substr(digits))) - 1) / 5);
}

bool is_like_tuning(std::string_view name) {
  return std::any_of(std::begin(kTuning), std::end(kTuning),
                     [&](std::string_view tuning) { return run_of(tuning) == run_of(name); });
}

}  // namespace

namespace {

// The clips of airplanes and helicopters in a folder, by name; of others there is no model.
std::vector<RealClip> clips_in(const fs::path& folder, std::string_view prefix) {
  std::vector<RealClip> clips;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != ".mp4") continue;
    const std::string name = entry.path().stem().string();
    const bool is_helicopter = name.starts_with(std::string(prefix) + "HELICOPTER_");
    const fs::path csv = folder / (name + "_gt.csv");
    if ((!is_helicopter && !name.starts_with(std::string(prefix) + "AIRPLANE_")) || !fs::exists(csv)) continue;
    const auto boxes = read_target_boxes(csv);
    if (!boxes) accuracy::stop(boxes.error().text());
    clips.push_back({.name = name, .path = entry.path(), .is_helicopter = is_helicopter, .boxes = *boxes});
  }
  std::sort(clips.begin(), clips.end(), [](const RealClip& a, const RealClip& b) { return a.name < b.name; });
  return clips;
}

}  // namespace

std::vector<RealClip> real_clips() {
  std::vector<RealClip> clips = clips_in(fs::path(SIGS_TEST_DATA) / "track", "V_");
  for (RealClip& clip : clips)
    clip.is_tuning = std::find(std::begin(kTuning), std::end(kTuning), clip.name) != std::end(kTuning);
  std::erase_if(clips, [](const RealClip& clip) { return !clip.is_tuning && is_like_tuning(clip.name); });
  return clips;
}

std::vector<RealClip> thermal_clips() {
  std::vector<RealClip> clips = clips_in(fs::path(SIGS_TEST_DATA) / "thermal", "IR_");
  for (std::size_t i = 0; i < clips.size(); ++i) clips[i].is_tuning = i % 2 == 1;
  return clips;
}

std::vector<RealClip> real_stills() {
  struct Still {
    const char* file;
    bool is_helicopter;
    Box box;
  };
  const Still stills[] = {{"aot/15381490281703842112e5011ded15a4222a04ffa4dcb685ed6.png", true, {1050, 895, 170, 98}},
                          {"aot/154167201745887282662af6af3d53d4167b1c5c19a7f14da64.png", true, {1218, 510, 175, 105}},
                          {"aot/1550850461146820501055830f864484ca784d21ddee8f8f1de.png", true, {1795, 295, 130, 130}},
                          {"aot/156276748080089747525d827e4ddb446d3add626c8e2a76b62.png", false, {1005, 1092, 145, 92}},
                          {"skylink/skylink_0.jpeg", false, {662, 340, 100, 52}},
                          {"skylink/skylink_2.jpeg", false, {528, 478, 92, 66}},
                          {"skylink/skylink_3.jpeg", false, {618, 525, 112, 52}},
                          {"skylink/skylink_5.jpeg", false, {634, 248, 100, 72}}};
  std::vector<RealClip> clips;
  for (const Still& still : stills) {
    const fs::path path = fs::path(SIGS_TEST_DATA) / "stills" / still.file;
    if (!fs::exists(path)) continue;
    const std::string folder = path.parent_path().filename().string();
    clips.push_back({.name = folder + "_" + std::to_string(clips.size()),
                     .path = path,
                     .is_helicopter = still.is_helicopter,
                     .is_still = true,
                     .boxes = {still.box}});
  }
  return clips;
}

FrameSource opened(const fs::path& path) {
  Result<FrameSource> source = FrameSource::open(path, nullptr, Quantisers::read);
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
