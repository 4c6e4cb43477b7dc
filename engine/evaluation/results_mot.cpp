// SPDX-License-Identifier: MIT
#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"
#include "evaluation/text_lines.h"

namespace sigs {

namespace {

constexpr std::size_t kMinFields = 6;  // frame, id, left, top, width, height; then conf and what is not read
constexpr double kUnspecified = -1;    // MOTChallenge's filler

Result<double> number_in(const ResultsFile& file, int line, std::string_view field) {
  const std::optional<double> number = number_of(field);
  if (!number) return file.wrong(line, in_quotes(field) + " is no number");
  return *number;
}

Result<void> add_line(const ResultsFile& file, const TextLine& line, const std::vector<std::string_view>& fields,
                      ResultsBuilder& builder) {
  double numbers[7] = {0, 0, 0, 0, 0, 0, kUnspecified};
  for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 7); ++i) {
    const Result<double> number = number_in(file, line.number, fields[i]);
    if (!number) return fail(number.error());
    numbers[i] = *number;
  }
  const std::optional<int> frame = integer_of(numbers[0]);
  const std::optional<int> id = integer_of(numbers[1]);
  if (!frame || *frame < 1)
    return file.wrong(line.number, "frame " + in_quotes(fields[0]) + " is no whole number from 1");
  if (!id) return file.wrong(line.number, "id " + in_quotes(fields[1]) + " is no whole number");
  const FootageTruth& clip = file.clip;
  if (*frame > clip.last_frame - clip.first_frame + 1)
    return file.wrong(line.number, "frame " + std::to_string(*frame) + " is past the clip's end: it has " +
                                       std::to_string(clip.last_frame - clip.first_frame + 1) +
                                       " frames, counted from 1 in layout mot");
  return builder.add(clip.first_frame + *frame - 1,
                     {.box = {numbers[2] - kEdgeFrom1, numbers[3] - kEdgeFrom1, numbers[4], numbers[5]},
                      .score = numbers[6] == kUnspecified ? 1 : numbers[6],
                      .track = *id < 0 ? kNoTrack : *id,
                      .line = line.number});
}

}  // namespace

Result<Results> read_mot(const ResultsFile& file) {
  ResultsBuilder builder(file, 1);
  TextLines lines(file.text);
  std::vector<std::string_view> fields;
  std::size_t expected = 0;  // fields in each line
  int first_line = 0;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    split_numbers(line->text, fields);
    if (expected == 0) {
      expected = fields.size();
      first_line = line->number;
    }
    if (fields.size() < kMinFields)
      return file.wrong(line->number, "expected frame, id, left, top, width, height and on, found " +
                                          std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields"));
    if (fields.size() != expected)
      return file.wrong(line->number, "has " + std::to_string(fields.size()) + " fields, line " +
                                          std::to_string(first_line) + " has " + std::to_string(expected));
    if (const Result<void> taken = add_line(file, *line, fields, builder); !taken) return fail(taken.error());
  }
  return builder.results();
}

}  // namespace sigs
