// SPDX-License-Identifier: MIT
#include "evaluation/numbers.h"
#include "evaluation/results_layouts.h"
#include "evaluation/text_lines.h"

namespace sigs {

namespace {

constexpr std::size_t kLeastFields = 6;  // frame, id, left, top, width, height; then conf and what is not read
constexpr double kNotSaid = -1;          // MOTChallenge's filler

Result<double> number_in(const ResultsFile& file, int line, std::string_view field) {
  const std::optional<double> number = number_of(field);
  if (!number) return file.wrong(line, in_quotes(field) + " is no number");
  return *number;
}

Result<void> take_line(const ResultsFile& file, const TextLine& line, const std::vector<std::string_view>& fields,
                       ResultsIntake& intake) {
  double numbers[7] = {0, 0, 0, 0, 0, 0, kNotSaid};
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
  const FootageTruth& film = file.film;
  if (*frame > film.last_frame - film.first_frame + 1)
    return file.wrong(line.number, "frame " + std::to_string(*frame) + " is past the film's end: it has " +
                                       std::to_string(film.last_frame - film.first_frame + 1) +
                                       " frames, counted from 1 in layout mot");
  return intake.add(film.first_frame + *frame - 1,
                    {.box = {numbers[2] - kEdgeFrom1, numbers[3] - kEdgeFrom1, numbers[4], numbers[5]},
                     .score = numbers[6] == kNotSaid ? 1 : numbers[6],
                     .track = *id < 0 ? kNoTrack : *id,
                     .line = line.number});
}

}  // namespace

Result<Results> read_mot(const ResultsFile& file) {
  ResultsIntake intake(file, 1);
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
    if (fields.size() < kLeastFields)
      return file.wrong(line->number, "expected frame, id, left, top, width, height and on, found " +
                                          std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields"));
    if (fields.size() != expected)
      return file.wrong(line->number, "has " + std::to_string(fields.size()) + " fields, line " +
                                          std::to_string(first_line) + " has " + std::to_string(expected));
    if (const Result<void> taken = take_line(file, *line, fields, intake); !taken) return fail(taken.error());
  }
  return intake.taken();
}

}  // namespace sigs
