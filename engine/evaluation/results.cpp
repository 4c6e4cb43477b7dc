// SPDX-License-Identifier: MIT
#include "evaluation/results.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/staged_outputs.h"
#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"
#include "evaluation/text_lines.h"

namespace sigs {

namespace {

constexpr std::array<std::string_view, 7> kFormatNames = {"auto", "otb", "vot", "mot", "csv", "aot", "coco"};

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

// First line that is not empty.
std::optional<TextLine> first_line(const std::string& text) {
  TextLines lines(text);
  std::optional<TextLine> line = lines.next();
  while (line && line->text.empty()) line = lines.next();
  return line;
}

// A text that no reader could make anything of.
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
  const TextLine first = *first_line(file.text);  // check_text has seen that there is one
  if (lower_case(file.path.extension().string()) == ".json" || first.text.starts_with('[') ||
      first.text.starts_with('{'))
    return json_format(file);
  std::vector<std::string_view> fields;
  split_values(first.text, fields);
  if (std::ranges::find(fields, "frame") != fields.end()) return ResultsFormat::csv;
  split_numbers(first.text, fields);
  const auto is_number = [](std::string_view field) { return number_of(field).has_value(); };
  const auto wrong = std::ranges::find_if_not(fields, is_number);
  if (wrong != fields.end())
    return file.wrong(first.number, "is of no known layout: " + in_quotes(*wrong) +
                                        " is neither a number nor the name of a csv column (frame,x,y,width,height)");
  if (number_of(fields.front()) != number_of(fields.front())) return ResultsFormat::vot;  // nan
  if (fields.size() == 1 || fields.size() == 8) return ResultsFormat::vot;
  if (fields.size() == 4)
    return lower_case(file.path.filename().string()) == "groundtruth.txt" ? ResultsFormat::vot : ResultsFormat::otb;
  if (fields.size() >= 6) return ResultsFormat::mot;
  return file.wrong(first.number, "is of no known layout: " + std::to_string(fields.size()) +
                                      " numbers; 4 are otb or vot, 1 or 8 vot, 6, 7 and more mot; "
                                      "csv begins with the line frame,x,y,width,height, aot and coco with [");
}

Result<Results> read_as(ResultsFormat format, const ResultsFile& file) {
  switch (format) {
    case ResultsFormat::otb:
      return read_otb(file);
    case ResultsFormat::vot:
      return read_vot(file);
    case ResultsFormat::mot:
      return read_mot(file);
    case ResultsFormat::csv:
      return read_csv(file);
    case ResultsFormat::coco:
      return read_coco(file);
    default:
      return read_aot(file);
  }
}

}  // namespace

const ReportedBox* Results::best_at(int frame) const {
  const auto found = frames.find(frame);
  if (found == frames.end() || found->second.empty()) return nullptr;
  return &*std::ranges::max_element(found->second, {}, &ReportedBox::score);  // the first of equals
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
  if (options.last_image_id && format != ResultsFormat::coco)
    return fail(path.string(), "tells of several clips and is not in the layout coco; name a file for each clip");
  Result<Results> results = read_as(format, file);
  if (results) results->name = results_name(path);
  return results;
}

std::string results_name(const std::filesystem::path& path) {
  return path.stem().string();
}

}  // namespace sigs
