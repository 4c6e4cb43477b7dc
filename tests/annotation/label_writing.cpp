// SPDX-License-Identifier: MIT
#include "annotation/label_writing.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace sigs::test::labels {

namespace fs = std::filesystem;

LabelSequence label_film(int first, int last, const std::vector<std::string>& categories) {
  LabelSequence film{
      .name = "film",
      .footage = {.video = "flight.mp4", .size_px = {640, 480}, .first_frame = first, .last_frame = last},
      .video = "film.mkv",
      .pictures = "film"};
  for (std::size_t i = 0; i < categories.size(); ++i) {
    film.intruders.push_back({.id = static_cast<int>(i),
                              .name = "intruder " + std::to_string(i),
                              .category = categories[i],
                              .low_m = {-4, -5, -1},
                              .high_m = {4, 5, 1}});
    if (std::find(film.categories.begin(), film.categories.end(), categories[i]) == film.categories.end())
      film.categories.push_back(categories[i]);
  }
  return film;
}

IntruderTruth seen(int id, const cv::Rect& box) {
  return {.id = id,
          .name = "intruder " + std::to_string(id),
          .position_m = {100, 0, 0},
          .in_picture = true,
          .visible_fraction = 1,
          .box = box,
          .visible = cv::Mat(box.size(), CV_8UC1, cv::Scalar(255)),
          .visible_pixels = box.area(),
          .silhouette = Box{box.x - 0.5, box.y - 0.5, double(box.width), double(box.height)},
          .horizon = HorizonSide::above,
          .inside_fraction = 1};
}

IntruderTruth unseen(int id) {
  return {.id = id, .name = "intruder " + std::to_string(id), .position_m = {-100, 0, 0}};
}

FrameTruth frame_of(int index, std::vector<IntruderTruth> intruders) {
  return {.index = index, .time_s = index / 25.0, .intruders = std::move(intruders)};
}

void write_labels(const std::string& format, const fs::path& path, const LabelSequence& film,
                  const std::vector<FrameTruth>& frames, const fs::path& pictures) {
  const LabelFormat* chosen = label_format(format);
  REQUIRE(chosen != nullptr);
  if (chosen->is_folder)
    REQUIRE(fs::create_directory(path));
  else
    std::ofstream(path).close();
  Result<std::unique_ptr<LabelWriter>> writer = chosen->open(path, film);
  REQUIRE_MESSAGE(writer.has_value(), (writer ? "" : writer.error().text()));
  for (const FrameTruth& frame : frames) REQUIRE((*writer)->write(frame).has_value());
  const Result<void> finished = (*writer)->finish(pictures);
  REQUIRE_MESSAGE(finished.has_value(), (finished ? "" : finished.error().text()));
}

void make_pictures(const fs::path& folder, const LabelSequence& film) {
  REQUIRE(fs::create_directory(folder));
  for (int frame = film.footage.first_frame; frame <= film.footage.last_frame; ++frame)
    std::ofstream(folder / picture_name(frame)) << frame;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  REQUIRE_MESSAGE(in.good(), path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
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

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace sigs::test::labels
