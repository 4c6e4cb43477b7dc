// SPDX-License-Identifier: MIT
#include "evaluation/readers/truth_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kMaxSequence_px = 1e9;

// The files of boxes, one for each target.
struct BoxFiles {
  std::vector<fs::path> files;
  bool is_vot = false;
};

BoxFiles box_files_in(const fs::path& folder) {
  BoxFiles found;
  std::error_code code;
  if (const fs::path rect = folder / "groundtruth_rect.txt"; fs::is_regular_file(rect, code)) return {{rect}, false};
  for (int i = 1; fs::is_regular_file(folder / fmt::format("groundtruth_rect.{}.txt", i), code); ++i)
    found.files.push_back(folder / fmt::format("groundtruth_rect.{}.txt", i));
  if (!found.files.empty()) return found;
  if (const fs::path vot = folder / "groundtruth.txt"; fs::is_regular_file(vot, code)) return {{vot}, true};
  return found;
}

Result<std::vector<double>> numbers_of(std::string_view line) {
  if (line.starts_with('m'))
    return fail("", "is a mask in VOT's encoding, which is not read; the toolkit converts masks to boxes");
  std::vector<double> numbers;
  for (const std::string_view field : number_fields(line)) {
    // MATLAB writes NaN.
    const std::optional<double> number = parsed_number(lower_case(field));
    if (!number) return fail("", fmt::format("{} is no number", in_quotes(field)));
    numbers.push_back(*number);
  }
  return numbers;
}

// nullopt: the target is absent.
Result<std::optional<Box>> box_of_text(std::string_view line, bool is_vot) {
  const Result<std::vector<double>> numbers = numbers_of(line);
  if (!numbers) return fail(numbers.error());
  const bool all_nan = std::ranges::all_of(*numbers, [](double number) { return std::isnan(number); });
  if (all_nan && !numbers->empty()) return std::optional<Box>();
  const bool is_polygon = is_vot && numbers->size() >= 6 && numbers->size() % 2 == 0;
  if (numbers->size() != 4 && !is_polygon)
    return fail("", fmt::format("has {}; a box has 4 (left, top, width, height){}",
                                count_text(std::ssize(*numbers), "number"), is_vot ? ", a polygon 6 or more" : ""));
  for (const double number : *numbers)
    if (!(std::abs(number) <= kMaxSequence_px)) return fail("", "has a number that is NaN or beyond a billion pixels");
  const double edge = is_vot ? kEdgeFrom0 : kEdgeFrom1;
  if (is_polygon) {
    const Box bounds = box_around(*numbers);
    return std::optional<Box>({bounds.x - edge, bounds.y - edge, bounds.width, bounds.height});
  }
  const std::vector<double>& n = *numbers;
  if (n[2] < 0 || n[3] < 0) return fail("", "width and height must not be negative");
  if (n[2] == 0 || n[3] == 0) return std::optional<Box>();
  return std::optional<Box>({n[0] - edge, n[1] - edge, n[2], n[3]});
}

Result<TargetTruth> read_target(const fs::path& path, bool is_vot) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  TargetTruth target{.name = "object"};
  TextLines lines(*text);
  while (const std::optional<TextLine> line = lines.next()) {
    const Result<std::optional<Box>> box = box_of_text(line->text, is_vot);
    if (!box) return fail(place_of(path, line->number), box.error().what);
    target.frames.push_back({.visible = *box, .visible_fraction = *box ? 1.0 : 0.0, .distance_m = kUnknown});
  }
  if (target.frames.empty()) return fail(path.string(), "has no line");
  return target;
}

// One number a line, as SIGS writes them beside groundtruth.txt; empty: there is no such file.
Result<std::vector<double>> read_values(const fs::path& path, std::size_t count) {
  std::vector<double> values;
  if (std::error_code code; !fs::exists(path, code)) return values;
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  TextLines lines(*text);
  while (const std::optional<TextLine> line = lines.next()) {
    const std::optional<double> value = parsed_number(line->text);
    if (!value) return fail(place_of(path, line->number), in_quotes(line->text) + " is no number");
    values.push_back(*value);
  }
  if (values.size() != count)
    return fail(path.string(), fmt::format("has {} lines, groundtruth.txt has {}", values.size(), count));
  return values;
}

Result<void> add_values(const fs::path& folder, TargetTruth& target) {
  const Result<std::vector<double>> shares = read_values(folder / "visible_fraction.value", target.frames.size());
  if (!shares) return fail(shares.error());
  const Result<std::vector<double>> distances = read_values(folder / "distance_m.value", target.frames.size());
  if (!distances) return fail(distances.error());
  for (std::size_t i = 0; i < target.frames.size(); ++i) {
    if (!shares->empty()) target.frames[i].visible_fraction = std::clamp((*shares)[i], 0.0, 1.0);
    if (!distances->empty() && (*distances)[i] >= 0) target.frames[i].distance_m = (*distances)[i];
  }
  return {};
}

// Size and rate of VOT's file `sequence`, where there is one.
Result<void> add_properties(const fs::path& path, ClipTruth& truth) {
  if (std::error_code code; !fs::exists(path, code)) return {};
  const Result<std::string> text = read_text(path, kProjectLimit_bytes);
  if (!text) return fail(text.error());
  TextLines lines(*text);
  while (const std::optional<TextLine> line = lines.next()) {
    const std::optional<KeyAndValue> entry = key_and_value(line->text);
    if (!entry || entry->key != "fps") continue;
    const std::optional<double> rate = parsed_number(entry->value);
    if (!rate || !(*rate > 0 && *rate <= 1e6)) return fail(place_of(path, line->number), "fps is no rate");
    truth.footage.frame_rate_num = std::max(1, static_cast<int>(std::lround(*rate * 1000)));
    truth.footage.frame_rate_den = 1000;
    truth.has_times = true;
  }
  return {};
}

bool has_images(const fs::path& folder) {
  const Result<std::vector<fs::path>> there = folder_contents(folder);
  return there && std::ranges::any_of(*there, [](const fs::path& path) {
           const std::string extension = lower_extension(path);
           return extension == ".jpg" || extension == ".png" || extension == ".jpeg" || extension == ".bmp";
         });
}

// img/ (otb), color/ (vot), the folder itself, or a video called as the folder, in it or beside it.
fs::path images_in(const fs::path& folder) {
  for (const char* const name : {"img", "color"})
    if (is_folder(folder / name)) return folder / name;
  if (has_images(folder)) return folder;
  std::error_code code;
  const fs::path place = canonical_path(folder);
  for (const fs::path& beside : {folder / place.filename(), place})
    for (const char* const extension : {".mp4", ".avi", ".mkv", ".mov"})
      if (fs::is_regular_file(fs::path(beside).concat(extension), code)) return fs::path(beside).concat(extension);
  return {};
}

}  // namespace

bool is_sequence_folder(const fs::path& folder) {
  return is_folder(folder) && !box_files_in(folder).files.empty();
}

std::vector<fs::path> sequences_in(const fs::path& folder) {
  const Result<std::vector<fs::path>> there = folder_contents(folder);
  std::vector<fs::path> sequences;
  if (!there) return sequences;
  std::ranges::copy_if(*there, std::back_inserter(sequences), is_sequence_folder);
  return sequences;
}

Result<SequenceTruth> read_sequence_truth(const fs::path& folder) {
  const BoxFiles files = box_files_in(folder);
  if (files.files.empty())
    return fail(folder.string(), "has neither groundtruth_rect.txt (otb) nor groundtruth.txt (vot)");
  SequenceTruth sequence{.name = canonical_path(folder).filename().string(), .images = images_in(folder)};
  ClipTruth& truth = sequence.truth;
  truth.footage.video = sequence.name;
  truth.has_times = false;
  truth.footage.frame_rate_num = 0;
  for (const fs::path& file : files.files) {
    Result<TargetTruth> target = read_target(file, files.is_vot);
    if (!target) return fail(target.error());
    if (!truth.targets.empty() && target->frames.size() != truth.targets.front().frames.size())
      return fail(file.string(),
                  fmt::format("has {} lines, {} has {}", target->frames.size(), files.files.front().filename().string(),
                              truth.targets.front().frames.size()));
    target->id = static_cast<int>(truth.targets.size());
    truth.targets.push_back(std::move(*target));
  }
  if (files.is_vot) {
    if (const Result<void> added = add_values(folder, truth.targets.front()); !added) return fail(added.error());
    if (const Result<void> added = add_properties(folder / "sequence", truth); !added) return fail(added.error());
  }
  const std::size_t frames = truth.targets.front().frames.size();
  truth.footage.last_frame = static_cast<int>(frames) - 1;
  const double rate = static_cast<double>(truth.footage.frame_rate_num) / truth.footage.frame_rate_den;
  for (std::size_t i = 0; i < frames; ++i)
    truth.times_s.push_back(truth.has_times ? static_cast<double>(i) / rate : kUnknown);
  return sequence;
}

}  // namespace sigs
