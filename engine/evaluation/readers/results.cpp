// SPDX-License-Identifier: MIT
#include "evaluation/readers/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"

namespace sigs {

namespace {

// In the order of ResultsFormat, the readers from otb on.
constexpr std::array<std::string_view, 7> kFormatNames = {"auto", "otb", "vot", "mot", "csv", "aot", "coco"};
constexpr std::array kReaders{read_otb, read_vot, read_mot, read_csv, read_aot, read_coco};

// First line that is not empty.
std::optional<TextLine> first_line(const std::string& text) {
  TextLines lines(text);
  std::optional<TextLine> line = lines.next();
  while (line && line->text.empty()) line = lines.next();
  return line;
}

// Refuses a file that is not text, or has no line.
Result<void> check_text(const ResultsFile& file) {
  const std::string& text = file.text;
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return file.wrong(1, "is UTF-16; save the file as UTF-8");
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
    return file.wrong(line_at(text, zero), "is not text");
  if (!first_line(text))
    return fail(file.path.string(),
                "is empty; a detector that saw nothing writes the header alone (csv) or an empty list [] (aot, coco)");
  return {};
}

Result<ResultsFormat> detected_format(const ResultsFile& file) {
  const TextLine first = *first_line(file.text);  // check_text() has found that there is one
  if (lower_extension(file.path) == ".json" || first.text.starts_with('[') || first.text.starts_with('{'))
    return json_format(file);
  const std::vector<std::string_view> columns = csv_fields(first.text);
  if (std::ranges::find(columns, "frame") != columns.end()) return ResultsFormat::csv;
  const std::vector<std::string_view> fields = number_fields(first.text);
  const auto is_number = [](std::string_view field) { return parsed_number(field).has_value(); };
  const auto wrong = std::ranges::find_if_not(fields, is_number);
  if (wrong != fields.end())
    return file.wrong(
        first.number,
        fmt::format(
            "is of no known layout: {} is neither a number nor the name of a csv column (frame,x,y,width,height)",
            in_quotes(*wrong)));
  if (parsed_number(fields.front()) != parsed_number(fields.front())) return ResultsFormat::vot;  // nan
  if (fields.size() == 1 || fields.size() == 8) return ResultsFormat::vot;
  if (fields.size() == 4)
    return lower_case(file.path.filename().string()) == "groundtruth.txt" ? ResultsFormat::vot : ResultsFormat::otb;
  if (fields.size() >= 6) return ResultsFormat::mot;
  return file.wrong(first.number,
                    fmt::format("is of no known layout: {} numbers; 4 are otb or vot, 1 or 8 vot, 6, 7 and more mot; "
                                "csv begins with the line frame,x,y,width,height, aot and coco with [",
                                fields.size()));
}

}  // namespace

const ReportedBox* Results::best_at(int frame) const {
  const auto found = frames.find(frame);
  if (found == frames.end() || found->second.empty()) return nullptr;
  return &*std::ranges::max_element(found->second, {}, &ReportedBox::score);  // the first of equal ones
}

std::span<const std::string_view> results_format_names() {
  return kFormatNames;
}

Result<Results> read_results(const std::filesystem::path& path, const FootageTruth& clip,
                             const ResultsOptions& options) {
  Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  const ResultsFile file{path, std::move(*text), clip, options};
  if (const Result<void> good = check_text(file); !good) return fail(good.error());
  ResultsFormat format = options.format;
  if (format == ResultsFormat::automatic) {
    const Result<ResultsFormat> detected = detected_format(file);
    if (!detected) return fail(detected.error());
    format = *detected;
  }
  const bool names_images = options.images != nullptr && format == ResultsFormat::aot;
  if (options.last_image_id && format != ResultsFormat::coco && !names_images)
    return fail(
        path.string(),
        "tells of several clips and is not in the layout coco, nor aot with a truth that names images; name a file "
        "for each clip");
  Result<Results> results = kReaders.at(static_cast<std::size_t>(format) - 1)(file);
  if (results) results->name = results_name(path);
  return results;
}

std::string results_name(const std::filesystem::path& path) {
  return path.stem().string();
}

namespace {

constexpr double kMaxReported_px = 1e9;  // larger numbers make areas inexact

Result<void> wrong_number(const ResultsFile& file, int line, const char* name, double number) {
  if (std::isnan(number))
    return file.wrong(line, std::string(name) +
                                " is NaN: leave out a frame without a box (mot, csv, aot, coco), or write nan "
                                "alone on its line (vot)");
  if (std::isinf(number)) return file.wrong(line, std::string(name) + " is infinite");
  return file.wrong(line, std::string(name) + " is beyond a billion pixels");
}

}  // namespace

tl::unexpected<Error> ResultsFile::wrong(int line, const std::string& what) const {
  return fail(place_of(path, line), what);
}

std::string frames_text(const FootageTruth& clip) {
  return fmt::format("frames {} to {}", clip.first_frame, clip.last_frame);
}

Result<void> ResultsBuilder::add(int frame, const ReportedBox& reported) {
  if (const Result<void> good = check_box(reported); !good) return good;
  if (const Result<void> good = check_place(frame, reported); !good) return good;
  results_.frames[frame].push_back(reported);
  return {};
}

std::string ResultsBuilder::frame_text(int frame) const {
  if (first_number_ == file_.clip.first_frame) return std::to_string(frame);
  return fmt::format("{} ({} of the footage)", frame - file_.clip.first_frame + first_number_, frame);
}

Result<void> ResultsBuilder::check_box(const ReportedBox& reported) const {
  const Box& box = reported.box;
  const std::pair<const char*, double> numbers[] = {
      {"x", box.x}, {"y", box.y}, {"width", box.width}, {"height", box.height}};
  for (const auto& [name, number] : numbers)
    if (!(std::abs(number) <= kMaxReported_px)) return wrong_number(file_, reported.line, name, number);
  if (!std::isfinite(reported.score)) return wrong_number(file_, reported.line, "score", reported.score);
  if (box.width > 0 && box.height > 0) return {};
  return file_.wrong(
      reported.line,
      fmt::format("the box is {} wide and {} high: both must be more than 0; where nothing is reported, leave out the "
                  "frame (mot, csv, aot, coco) or write nan alone on its line (vot)",
                  number_text(box.width, 6), number_text(box.height, 6)));
}

Result<void> ResultsBuilder::check_place(int frame, const ReportedBox& reported) const {
  const FootageTruth& clip = file_.clip;
  if (frame < clip.first_frame || frame > clip.last_frame)
    return file_.wrong(reported.line, fmt::format("frame {} of the footage is not of this clip, which is {}", frame,
                                                  frames_text(clip)));
  const auto found = results_.frames.find(frame);
  if (found == results_.frames.end()) return {};
  const std::vector<ReportedBox>& there = found->second;
  if (!file_.options.multiple_per_frame)
    return file_.wrong(reported.line,
                       fmt::format("a second box for frame {}, first in line {}: a tracker reports one a frame",
                                   frame_text(frame), there.front().line));
  const auto duplicate = std::ranges::find(there, reported.track, &ReportedBox::track);
  if (reported.track == kNoTrack || duplicate == there.end()) return {};
  return file_.wrong(reported.line, fmt::format("id {} a second time in frame {}, first in line {}", reported.track,
                                                frame_text(frame), duplicate->line));
}

std::string csv_text(const Results& results) {
  std::string text = "frame,x,y,width,height,score,track\n";
  for (const auto& [frame, boxes] : results.frames)
    for (const ReportedBox& reported : boxes) {
      text += std::to_string(frame);
      // The file counts pixels: x is the first column covered.
      for (const double number :
           {reported.box.x + 0.5, reported.box.y + 0.5, reported.box.width, reported.box.height, reported.score})
        text.append(",").append(exact_text(number));
      text.append(",").append(std::to_string(reported.track)).append("\n");
    }
  return text;
}

}  // namespace sigs
