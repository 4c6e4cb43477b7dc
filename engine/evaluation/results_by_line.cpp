// SPDX-License-Identifier: MIT
// Layouts with a line a frame: otb, vot.
#include <algorithm>
#include <cmath>

#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"
#include "evaluation/text_lines.h"

namespace sigs {

namespace {

int frames_of(const FootageTruth& clip) {
  return clip.last_frame - clip.first_frame + 1;
}

struct LineCount {
  int lines = 0;
  int last = 0;  // number of the last line
  int past = 0;  // number of the first line past the clip's end; 0: there is none
};

LineCount count_lines(const ResultsFile& file) {
  LineCount count;
  TextLines lines(file.text);
  while (const std::optional<TextLine> line = lines.next()) {
    count.last = line->number;
    if (++count.lines == frames_of(file.clip) + 1) count.past = line->number;
  }
  return count;
}

// The footage's number of the frame that the first line is about.
Result<int> first_frame_of(const ResultsFile& file) {
  const LineCount count = count_lines(file);
  const FootageTruth& clip = file.clip;
  const int all = frames_of(clip);
  if (count.lines == all) return clip.first_frame;
  const int start = file.options.start_frame.value_or(clip.first_frame);
  const int from_start = clip.last_frame - start + 1;
  if (count.lines == from_start) return start;
  const std::string needed = std::to_string(all) + " (" + frames_text(clip) + ")" +
                             (start == clip.first_frame ? ""
                                                        : ", or " + std::to_string(from_start) + " (from frame " +
                                                              std::to_string(start) + " on)");
  if (count.past > 0)
    return file.wrong(count.past, "past the clip's end: the file has " + std::to_string(count.lines) +
                                      " lines, one a frame; it must have " + needed);
  return file.wrong(count.last,
                    "ends here with " + std::to_string(count.lines) + " lines, one a frame; it must have " + needed);
}

Result<void> read_numbers(const ResultsFile& file, const TextLine& line, const std::vector<std::string_view>& fields,
                          std::vector<double>& numbers) {
  numbers.clear();
  for (const std::string_view field : fields) {
    const std::optional<double> number = number_of(field);
    if (!number) return file.wrong(line.number, in_quotes(field) + " is no number");
    numbers.push_back(*number);
  }
  return {};
}

// What stands in a line of VOT: https://www.votchallenge.net, regions. A rectangle, a polygon, or one number.
Result<void> add_vot_line(const ResultsFile& file, const TextLine& line, const std::vector<double>& numbers, int frame,
                          ResultsBuilder& builder) {
  const std::size_t count = numbers.size();
  if (std::ranges::all_of(numbers, [](double number) { return std::isnan(number); })) return {};
  if (count == 1) {
    // 1: the tracker was given the truth; 2: it failed; 0: between a failure and the next start.
    if (numbers[0] == 1) builder.mark_initialization(frame);
    if (numbers[0] == 0 || numbers[0] == 1 || numbers[0] == 2) return {};
    return file.wrong(line.number, "a number alone is 0, 1 or 2 in layout vot, not " + in_quotes(line.text));
  }
  if (count == 4)
    return builder.add(frame, {.box = {numbers[0] - kEdgeFrom0, numbers[1] - kEdgeFrom0, numbers[2], numbers[3]},
                               .line = line.number});
  if (count < 6 || count % 2 != 0)
    return file.wrong(line.number,
                      "expected 4 numbers (rectangle), 8 (polygon) or one (0, 1, 2), found " + std::to_string(count));
  double low[2] = {numbers[0], numbers[1]};
  double high[2] = {numbers[0], numbers[1]};
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(numbers[i])) low[i % 2] = high[i % 2] = numbers[i];  // stays, and is found
    low[i % 2] = std::min(low[i % 2], numbers[i]);
    high[i % 2] = std::max(high[i % 2], numbers[i]);
  }
  return builder.add(frame, {.box = {low[0] - kEdgeFrom0, low[1] - kEdgeFrom0, high[0] - low[0], high[1] - low[1]},
                             .line = line.number});
}

Result<void> add_otb_line(const ResultsFile& file, const TextLine& line, const std::vector<double>& numbers, int frame,
                          ResultsBuilder& builder) {
  if (numbers.size() != 4)
    return file.wrong(line.number, "expected 4 numbers x, y, width, height, found " + std::to_string(numbers.size()));
  return builder.add(
      frame, {.box = {numbers[0] - kEdgeFrom1, numbers[1] - kEdgeFrom1, numbers[2], numbers[3]}, .line = line.number});
}

template <class AddLine>
Result<Results> read_line_a_frame(const ResultsFile& file, AddLine&& add) {
  const Result<int> first = first_frame_of(file);
  ResultsBuilder builder(file);
  TextLines lines(file.text);
  std::vector<std::string_view> fields;
  std::vector<double> numbers;
  int taken = 0;
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) return file.wrong(line->number, "is empty amid lines that each stand for a frame");
    split_numbers(line->text, fields);
    if (const Result<void> read = read_numbers(file, *line, fields, numbers); !read) return fail(read.error());
    // What is wrong with a line says more than that there are too many or too few; so each is looked at first.
    const int frame = first ? *first + taken : std::min(file.clip.first_frame + taken, file.clip.last_frame);
    if (!first && taken >= frames_of(file.clip)) break;
    if (const Result<void> added = add(file, *line, numbers, frame, builder); !added) return fail(added.error());
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

}  // namespace sigs
