// SPDX-License-Identifier: MIT
#include "labels/label_writing.h"
#include "base/pose.h"
#include "support/files.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <fstream>
#include <limits>

namespace sigs::test::labels {

namespace fs = std::filesystem;

LabelSequence synthetic_sequence(int first, int last, const std::vector<std::string>& categories) {
  LabelSequence clip{
      .name = "clip",
      .footage = {.video = "flight.mp4", .size_px = {640, 480}, .first_frame = first, .last_frame = last},
      .video = "clip.mkv",
      .images = "clip"};
  for (std::size_t i = 0; i < categories.size(); ++i) {
    clip.intruders.push_back({.id = static_cast<int>(i),
                              .name = "intruder " + std::to_string(i),
                              .category = categories[i],
                              .low_m = {-4, -5, -1},
                              .high_m = {4, 5, 1}});
    if (std::find(clip.categories.begin(), clip.categories.end(), categories[i]) == clip.categories.end())
      clip.categories.push_back(categories[i]);
  }
  return clip;
}

IntruderTruth visible_intruder(int id, const cv::Rect& box) {
  return {.id = id,
          .name = "intruder " + std::to_string(id),
          .position_m = {100, 0, 0},
          .in_image = true,
          .visible_fraction = 1,
          .visible_box = box,
          .visible = cv::Mat(box.size(), CV_8UC1, cv::Scalar(255)),
          .visible_pixels = box.area(),
          .amodal_box = Box{box.x - 0.5, box.y - 0.5, double(box.width), double(box.height)},
          .horizon = HorizonSide::above,
          .inside_fraction = 1};
}

IntruderTruth full_truth(int id) {
  IntruderTruth truth = visible_intruder(id, {301, 0, 41, 13});
  truth.position_m = {899.2345678, -250.1, -20.00000049};
  truth.world_from_body = rotation_of({rad_of_deg(-3.123456789), rad_of_deg(0.4), rad_of_deg(-179.9999996)});
  truth.visible_fraction = 2.0 / 3;
  truth.amodal_box = Box{300.62341, -1.8833333, 41.375, 13.02};
  truth.horizon = HorizonSide::above;
  truth.place = GeodeticPosition{48.123456789012, 11.5, 612.25};
  truth.detectability = Detectability{-0.4123456789, 0.447, 7.25};
  truth.image_formation = {.blur_px = 0.45, .motion_blur_px = 1.5, .visibility_m = 20000};
  truth.encounter = EncounterTruth{.range_rate_mps = -61.23456789,
                                   .closing_speed_mps = 61.23456789,
                                   .bearing_rad = rad_of_deg(-12.5),
                                   .elevation_rad = rad_of_deg(0.3333333333),
                                   .hmd_m = 12.0000004,
                                   .vmd_m = -1e8,
                                   .time_to_closest_approach_s = 1e15,
                                   .time_to_coaltitude_s = std::numeric_limits<double>::infinity(),
                                   .of_volumes = {{"dwc-en-route", true, 17.25, 42.123456789},
                                                  {"nmac", false, std::numeric_limits<double>::infinity(), 0}}};
  return truth;
}

IntruderTruth invisible_intruder(int id) {
  return {.id = id, .name = "intruder " + std::to_string(id), .position_m = {-100, 0, 0}};
}

FrameTruth frame_of(int index, std::vector<IntruderTruth> intruders) {
  return {.index = index, .time_s = index / 25.0, .intruders = std::move(intruders)};
}

void write_labels(const std::string& format, const fs::path& path, const LabelSequence& clip,
                  const std::vector<FrameTruth>& frames, const fs::path& images) {
  const LabelFormat* chosen = label_format(format);
  REQUIRE(chosen != nullptr);
  if (chosen->is_folder)
    REQUIRE(fs::create_directory(path));
  else
    std::ofstream(path).close();
  Result<std::unique_ptr<LabelWriter>> writer = chosen->open(path, clip);
  REQUIRE_MESSAGE(writer.has_value(), (writer ? "" : writer.error().text()));
  for (const FrameTruth& frame : frames) REQUIRE((*writer)->write(frame).has_value());
  const Result<void> finished = (*writer)->finish(images);
  REQUIRE_MESSAGE(finished.has_value(), (finished ? "" : finished.error().text()));
}

void write_synthetic_images(const fs::path& folder, const LabelSequence& clip) {
  REQUIRE(fs::create_directory(folder));
  for (int frame = clip.footage.first_frame; frame <= clip.footage.last_frame; ++frame)
    std::ofstream(folder / image_name(frame, clip.image_extension)) << frame;
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::vector<std::string> lines = parts_of(text_of(path), '\n');
  REQUIRE_MESSAGE(lines.back().empty(), path.string());
  lines.pop_back();
  return lines;
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

LabelSequence label_sequence(int last) {
  return {.name = "crossing",
          .footage = {.video = "flight.mp4",
                      .size_px = {64, 48},
                      .first_frame = 100,
                      .last_frame = last,
                      .frame_rate_num = 30000,
                      .frame_rate_den = 1001},
          .intruders = {{.id = 0, .name = "airliner", .category = "airplane"},
                        {.id = 1, .name = "sailplane", .category = "glider"}},
          .categories = {"airplane", "glider"},
          .images = "crossing"};
}

std::vector<FrameTruth> frames_of(const std::vector<std::vector<IntruderTruth>>& intruders) {
  std::vector<FrameTruth> frames;
  for (const std::vector<IntruderTruth>& there : intruders) {
    const int index = 100 + static_cast<int>(frames.size());
    frames.push_back({.index = index, .time_s = index * 1001.0 / 30000, .intruders = there});
  }
  return frames;
}

std::vector<std::string> special_names() {
  return {"a & b <c> \"d\" 'e'",
          "light aircraft",
          "Flugzeug \xC3\xBC",
          "\xE9\xA3\x9B\xE8\xA1\x8C\xE6\xA9\x9F",
          ": - #",
          "back\\slash",
          "%s{}"};
}

}  // namespace sigs::test::labels
