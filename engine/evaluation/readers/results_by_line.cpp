// SPDX-License-Identifier: MIT
// Layouts of results in lines: otb and vot have a line for each frame, mot and csv a line for each box.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

struct LineCount {
  int lines = 0;  // without comments
  int last = 0;   // number of the last line
  int past = 0;   // number of the first line after the clip's end; 0: there is none
};

LineCount count_lines(const ResultsFile& file) {
  LineCount count;
  TextLines lines(file.text);
  while (const std::optional<TextLine> line = lines.next()) {
    count.last = line->number;
    if (++count.lines == frame_count(file.clip) + 1) count.past = line->number;
  }
  return count;
}

// The footage's number of the frame of the first line.
Result<int> first_frame_of(const ResultsFile& file) {
  const LineCount count = count_lines(file);
  const FootageTruth& clip = file.clip;
  const int all = frame_count(clip);
  if (count.lines == all) return clip.first_frame;
  const int start = file.options.start_frame.value_or(clip.first_frame);
  const int from_start = clip.last_frame - start + 1;
  if (count.lines == from_start) return start;
  std::string needed = fmt::format("{} ({})", all, frames_text(clip));
  if (start != clip.first_frame) needed += fmt::format(", or {} (from frame {} on)", from_start, start);
  if (count.past > 0)
    return file.wrong(
        count.past,
        fmt::format("past the clip's end: the file has {} lines, one a frame; it must have {}", count.lines, needed));
  return file.wrong(count.last,
                    fmt::format("ends here with {} lines, one a frame; it must have {}", count.lines, needed));
}

Result<std::vector<double>> numbers_in(const ResultsFile& file, const TextLine& line,
                                       std::span<const std::string_view> fields) {
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    const std::optional<double> number = parsed_number(field);
    if (!number) return file.wrong(line.number, in_quotes(field) + " is no number");
    numbers.push_back(*number);
  }
  return numbers;
}

// A line of VOT (https://www.votchallenge.net, regions): a rectangle, a polygon whose bounds are taken, or one number.
Result<void> add_vot_line(const ResultsFile& file, const TextLine& line, const std::vector<double>& numbers, int frame,
                          ResultsBuilder& builder) {
  const std::size_t count = numbers.size();
  if (std::ranges::all_of(numbers, [](double number) { return std::isnan(number); })) return {};
  if (count == 1) {
    // 1: the tracker was initialized with the truth; 2: it failed; 0: between a failure and the next initialization.
    if (numbers[0] == 1) builder.mark_initialization(frame);
    if (numbers[0] == 0 || numbers[0] == 1 || numbers[0] == 2) return {};
    return file.wrong(line.number, "a number alone is 0, 1 or 2 in layout vot, not " + in_quotes(line.text));
  }
  if (count == 4)
    return builder.add(frame, {.box = {numbers[0] - kEdgeFrom0, numbers[1] - kEdgeFrom0, numbers[2], numbers[3]},
                               .line = line.number});
  if (count < 6 || count % 2 != 0)
    return file.wrong(line.number,
                      fmt::format("expected 4 numbers (rectangle), 8 (polygon) or one (0, 1, 2), found {}", count));
  const Box box = box_around(numbers);  // of NaN where a corner is, which the builder refuses
  return builder.add(frame,
                     {.box = {box.x - kEdgeFrom0, box.y - kEdgeFrom0, box.width, box.height}, .line = line.number});
}

Result<void> add_otb_line(const ResultsFile& file, const TextLine& line, const std::vector<double>& numbers, int frame,
                          ResultsBuilder& builder) {
  if (numbers.size() != 4)
    return file.wrong(line.number, fmt::format("expected 4 numbers x, y, width, height, found {}", numbers.size()));
  return builder.add(
      frame, {.box = {numbers[0] - kEdgeFrom1, numbers[1] - kEdgeFrom1, numbers[2], numbers[3]}, .line = line.number});
}

// add: add_otb_line or add_vot_line.
template <class AddLine>
Result<Results> read_line_a_frame(const ResultsFile& file, AddLine&& add) {
  const Result<int> first = first_frame_of(file);
  ResultsBuilder builder(file);
  TextLines lines(file.text);
  int taken = 0;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) return file.wrong(line->number, "is empty amid lines that each stand for a frame");
    const Result<std::vector<double>> numbers = numbers_in(file, *line, number_fields(line->text));
    if (!numbers) return fail(numbers.error());
    // An error in a line explains more than a wrong number of lines, so the lines are read first.
    const int frame = first ? *first + taken : std::min(file.clip.first_frame + taken, file.clip.last_frame);
    if (!first && taken >= frame_count(file.clip)) break;
    if (const Result<void> added = add(file, *line, *numbers, frame, builder); !added) return fail(added.error());
    ++taken;
  }
  if (!first) return fail(first.error());
  return builder.results();
}

}  // namespace

Result<Results> read_otb(const ResultsFile& file) {
  return read_line_a_frame(file, add_otb_line);
}

Result<Results> read_vot(const ResultsFile& file) {
  return read_line_a_frame(file, add_vot_line);
}

namespace {

constexpr std::size_t kMinFields = 6;  // frame, id, left, top, width, height; then the score and fields not read
constexpr double kUnspecified = -1;    // MOTChallenge's placeholder

Result<void> add_mot_line(const ResultsFile& file, const TextLine& line, std::span<const std::string_view> fields,
                          ResultsBuilder& builder) {
  Result<std::vector<double>> read = numbers_in(file, line, fields.first(std::min<std::size_t>(fields.size(), 7)));
  if (!read) return fail(read.error());
  std::vector<double>& numbers = *read;
  if (numbers.size() < 7) numbers.push_back(kUnspecified);
  const std::optional<int> frame = integer_of(numbers[0]);
  const std::optional<int> id = integer_of(numbers[1]);
  if (!frame || *frame < 1)
    return file.wrong(line.number, fmt::format("frame {} is no whole number from 1", in_quotes(fields[0])));
  if (!id) return file.wrong(line.number, fmt::format("id {} is no whole number", in_quotes(fields[1])));
  const FootageTruth& clip = file.clip;
  if (*frame > frame_count(clip))
    return file.wrong(line.number,
                      fmt::format("frame {} is past the clip's end: it has {} frames, counted from 1 in layout mot",
                                  *frame, frame_count(clip)));
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
  std::size_t expected = 0;  // fields in each line
  int first_line = 0;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    const std::vector<std::string_view> fields = number_fields(line->text);
    if (expected == 0) {
      expected = fields.size();
      first_line = line->number;
    }
    if (fields.size() < kMinFields)
      return file.wrong(line->number, fmt::format("expected frame, id, left, top, width, height and on, found {}",
                                                  count_text(std::ssize(fields), "field")));
    if (fields.size() != expected)
      return file.wrong(line->number,
                        fmt::format("has {} fields, line {} has {}", fields.size(), first_line, expected));
    if (const Result<void> taken = add_mot_line(file, *line, fields, builder); !taken) return fail(taken.error());
  }
  return builder.results();
}

namespace {

// Columns of layout csv, the last three optional.
enum Column {
  frame_column,
  x_column,
  y_column,
  width_column,
  height_column,
  score_column,
  track_column,
  distance_column,
  kColumns
};
constexpr std::array<std::string_view, kColumns> kColumnNames = {"frame",  "x",     "y",     "width",
                                                                 "height", "score", "track", "distance_m"};
constexpr std::size_t kRequiredColumns = 5;
constexpr std::size_t kNoColumn = std::string_view::npos;

struct CsvHeader {
  std::array<std::size_t, kColumns> place{};  // of each column in a line, from 0; kNoColumn: there is none
  std::size_t columns = 0;
  int line = 0;
};

Result<CsvHeader> header_of(const ResultsFile& file, const TextLine& line) {
  const std::vector<std::string_view> fields = csv_fields(line.text);
  CsvHeader header{.columns = fields.size(), .line = line.number};
  header.place.fill(kNoColumn);
  for (std::size_t i = 0; i < kColumns; ++i) {
    const auto found = std::ranges::find(fields, kColumnNames[i]);
    if (found == fields.end() && i < kRequiredColumns)
      return file.wrong(
          line.number,
          fmt::format("has no column {}; the first line names the columns: frame,x,y,width,height[,score][,track]"
                      "[,distance_m]",
                      kColumnNames[i]));
    if (found == fields.end()) continue;
    if (std::find(found + 1, fields.end(), kColumnNames[i]) != fields.end())
      return file.wrong(line.number, fmt::format("has column {} twice", kColumnNames[i]));
    header.place[i] = static_cast<std::size_t>(found - fields.begin());
  }
  return header;
}

Result<void> add_csv_line(const ResultsFile& file, const CsvHeader& header, const TextLine& line,
                          const std::vector<std::string_view>& fields, ResultsBuilder& builder) {
  std::array<double, kColumns> values{};
  values[score_column] = 1;
  values[track_column] = kNoTrack;
  for (std::size_t i = 0; i < kColumns; ++i) {
    if (header.place[i] == kNoColumn) continue;
    const std::string_view field = fields[header.place[i]];
    if (i == distance_column && field.empty()) continue;  // of a box whose range is not known
    const std::optional<double> number = parsed_number(field);
    if (!number) return file.wrong(line.number, fmt::format("{} {} is no number", kColumnNames[i], in_quotes(field)));
    values[i] = *number;
  }
  std::optional<double> distance_m;
  if (header.place[distance_column] != kNoColumn && !fields[header.place[distance_column]].empty())
    distance_m = values[distance_column];
  if (distance_m && !(*distance_m > 0 && *distance_m < 1e9))
    return file.wrong(line.number, fmt::format("distance_m {} is no distance in metres above 0",
                                               in_quotes(fields[header.place[distance_column]])));
  const std::optional<int> frame = integer_of(values[frame_column]);
  if (!frame)
    return file.wrong(line.number,
                      fmt::format("frame {} is no whole number", in_quotes(fields[header.place[frame_column]])));
  const std::optional<int> track = integer_of(values[track_column]);
  if (!track)
    return file.wrong(line.number,
                      fmt::format("track {} is no whole number", in_quotes(fields[header.place[track_column]])));
  return builder.add(*frame, {.box = {values[x_column] - kEdgeFrom0, values[y_column] - kEdgeFrom0,
                                      values[width_column], values[height_column]},
                              .score = values[score_column],
                              .track = *track < 0 ? kNoTrack : *track,
                              .line = line.number,
                              .distance_m = distance_m});
}

}  // namespace

Result<Results> read_csv(const ResultsFile& file) {
  ResultsBuilder builder(file);
  TextLines lines(file.text);
  std::optional<CsvHeader> header;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    if (!header) {
      const Result<CsvHeader> read = header_of(file, *line);
      if (!read) return fail(read.error());
      header = *read;
      continue;
    }
    std::vector<std::string_view> fields = csv_fields(line->text);
    if (fields.size() == header->columns + 1 && fields.back().empty()) fields.pop_back();  // a comma at the end
    if (fields.size() != header->columns)
      return file.wrong(line->number,
                        fmt::format("has {} values, line {} names {}", fields.size(), header->line, header->columns));
    if (const Result<void> taken = add_csv_line(file, *header, *line, fields, builder); !taken)
      return fail(taken.error());
  }
  return builder.results();
}

}  // namespace sigs
