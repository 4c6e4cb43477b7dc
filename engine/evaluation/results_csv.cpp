// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"
#include "evaluation/text_lines.h"

namespace sigs {

namespace {

enum Column { frame_column, x_column, y_column, width_column, height_column, score_column, track_column, kColumns };
constexpr std::array<std::string_view, kColumns> kNames = {"frame", "x", "y", "width", "height", "score", "track"};
constexpr std::size_t kNeeded = 5;
constexpr std::size_t kNone = std::string_view::npos;

struct Header {
  std::array<std::size_t, kColumns> place{};  // of each column in a line; kNone: there is none
  std::size_t columns = 0;
  int line = 0;
};

Result<Header> header_of(const ResultsFile& file, const TextLine& line) {
  std::vector<std::string_view> fields;
  split_values(line.text, fields);
  Header header{.columns = fields.size(), .line = line.number};
  header.place.fill(kNone);
  for (std::size_t i = 0; i < kColumns; ++i) {
    const auto found = std::ranges::find(fields, kNames[i]);
    if (found == fields.end() && i < kNeeded)
      return file.wrong(line.number, "has no column " + std::string(kNames[i]) +
                                         "; the first line names the columns: frame,x,y,width,height[,score][,track]");
    if (found == fields.end()) continue;
    if (std::find(found + 1, fields.end(), kNames[i]) != fields.end())
      return file.wrong(line.number, "has column " + std::string(kNames[i]) + " twice");
    header.place[i] = static_cast<std::size_t>(found - fields.begin());
  }
  return header;
}

Result<void> add_line(const ResultsFile& file, const Header& header, const TextLine& line,
                      const std::vector<std::string_view>& fields, ResultsBuilder& builder) {
  std::array<double, kColumns> values{};
  values[score_column] = 1;
  values[track_column] = kNoTrack;
  for (std::size_t i = 0; i < kColumns; ++i) {
    if (header.place[i] == kNone) continue;
    const std::string_view field = fields[header.place[i]];
    const std::optional<double> number = number_of(field);
    if (!number) return file.wrong(line.number, std::string(kNames[i]) + " " + in_quotes(field) + " is no number");
    values[i] = *number;
  }
  const std::optional<int> frame = integer_of(values[frame_column]);
  if (!frame)
    return file.wrong(line.number, "frame " + in_quotes(fields[header.place[frame_column]]) + " is no whole number");
  const std::optional<int> track = integer_of(values[track_column]);
  if (!track)
    return file.wrong(line.number, "track " + in_quotes(fields[header.place[track_column]]) + " is no whole number");
  return builder.add(*frame, {.box = {values[x_column] - kEdgeFrom0, values[y_column] - kEdgeFrom0,
                                      values[width_column], values[height_column]},
                              .score = values[score_column],
                              .track = *track < 0 ? kNoTrack : *track,
                              .line = line.number});
}

}  // namespace

Result<Results> read_csv(const ResultsFile& file) {
  ResultsBuilder builder(file);
  TextLines lines(file.text);
  std::optional<Header> header;
  std::vector<std::string_view> fields;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    if (!header) {
      const Result<Header> read = header_of(file, *line);
      if (!read) return fail(read.error());
      header = *read;
      continue;
    }
    split_values(line->text, fields);
    if (fields.size() == header->columns + 1 && fields.back().empty()) fields.pop_back();  // a comma at the end
    if (fields.size() != header->columns)
      return file.wrong(line->number, "has " + std::to_string(fields.size()) + " values, line " +
                                          std::to_string(header->line) + " names " + std::to_string(header->columns));
    if (const Result<void> taken = add_line(file, *header, *line, fields, builder); !taken) return fail(taken.error());
  }
  return builder.results();
}

}  // namespace sigs
