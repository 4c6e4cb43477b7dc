// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "evaluation/readers/results_formats.h"
#include "evaluation/readers/text_parsing.h"
#include "evaluation/readers/truth_builder.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// What seqinfo.ini states; 0: it does not.
struct SequenceInfo {
  int frames = 0;
  double rate_hz = 0;
  cv::Size size_px;
};

// "25" or "30000/1001"; 0: neither.
double rate_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  const double num = parsed_number(trimmed(text.substr(0, slash))).value_or(0);
  const double den = slash == std::string_view::npos ? 1 : parsed_number(trimmed(text.substr(slash + 1))).value_or(0);
  const double rate_hz = den > 0 ? num / den : 0;
  return rate_hz > 0 && rate_hz <= 1e6 ? rate_hz : 0;
}

Result<SequenceInfo> read_seqinfo(const fs::path& path) {
  SequenceInfo info;
  if (std::error_code code; !fs::exists(path, code)) return info;
  const Result<std::string> text = read_text(path, kProjectLimit_bytes);
  if (!text) return fail(text.error());
  TextLines lines(*text);
  bool has_exact_rate = false;
  while (const std::optional<TextLine> line = lines.next()) {
    const std::optional<KeyAndValue> entry = key_and_value(line->text);
    if (!entry) continue;
    const std::string key = lower_case(entry->key);
    const std::string_view value = entry->value;
    if (key == "framerate" || key == "exactframerate") {
      const double rate_hz = rate_of(value);
      if (rate_hz == 0)
        return fail(place_of(path, line->number), fmt::format("{}: {} is no rate", key, in_quotes(value)));
      if (key == "exactframerate" || !has_exact_rate) info.rate_hz = rate_hz;
      has_exact_rate |= key == "exactframerate";
    } else if (key == "seqlength" || key == "imwidth" || key == "imheight") {
      const std::optional<int> number = integer_of(value);
      if (!number || *number < 1 || *number > kMaxClipFrames)
        return fail(place_of(path, line->number),
                    fmt::format("{}: {} is no whole number from 1 to {}", key, in_quotes(value), kMaxClipFrames));
      (key == "seqlength" ? info.frames : key == "imwidth" ? info.size_px.width : info.size_px.height) = *number;
    }
  }
  return info;
}

// frame, id, left, top, width, height, 1 to count or 0 to ignore, class, visible share.
struct MotRow {
  int line = 0;
  TrueBox box;
};

Result<MotRow> row_of(const fs::path& path, const TextLine& line) {
  const std::vector<std::string_view> fields = number_fields(line.text);
  if (fields.size() < 6 || fields.size() > 10)
    return fail(
        place_of(path, line.number),
        fmt::format("has {} columns; frame,id,left,top,width,height,flag,class,visibility are 6 to 10", fields.size()));
  std::array<double, 10> numbers{0, 0, 0, 0, 0, 0, 1, -1, -1, -1};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> number = finite_number(fields[i]);
    if (!number)
      return fail(place_of(path, line.number), fmt::format("column {}: {} is no number", i + 1, in_quotes(fields[i])));
    numbers[i] = *number;
  }
  const std::optional<int> frame = integer_of(numbers[0]);
  const std::optional<int> id = integer_of(numbers[1]);
  const std::optional<int> category = integer_of(numbers[7]);
  if (!frame || *frame < 1 || *frame > kMaxClipFrames)
    return fail(place_of(path, line.number),
                fmt::format("frame {} is no whole number from 1 on", in_quotes(fields[0])));
  if (!id) return fail(place_of(path, line.number), fmt::format("id {} is no whole number", in_quotes(fields[1])));
  MotRow row{.line = line.number};
  row.box = {.frame = *frame - 1,
             .box = {numbers[2] - kEdgeFrom1, numbers[3] - kEdgeFrom1, numbers[4], numbers[5]},
             .is_ignored = numbers[6] == 0};
  if (*id >= 0) row.box.id = *id;
  // The 2015 challenge has a position in metres in columns 8 to 10, or -1.
  const bool has_class = fields.size() < 10 && category && *category >= 0;
  if (has_class) row.box.category = std::to_string(*category);
  if (fields.size() == 9 && numbers[8] >= 0) row.box.visible_fraction = numbers[8];
  if (*id >= 0) row.box.name = fmt::format("object {}", *id);
  return row;
}

Result<std::vector<MotRow>> read_rows(const fs::path& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  std::vector<MotRow> rows;
  TextLines lines(*text);
  while (const std::optional<TextLine> line = lines.next()) {
    if (line->text.empty()) continue;
    Result<MotRow> row = row_of(path, *line);
    if (!row) return fail(row.error());
    rows.push_back(std::move(*row));
  }
  return rows;
}

Result<TruthClip> clip_of_sequence(const fs::path& folder, const TruthOptions& options) {
  const Result<SequenceInfo> info = read_seqinfo(folder / "seqinfo.ini");
  if (!info) return fail(info.error());
  const fs::path file = folder / "gt" / "gt.txt";
  const Result<std::vector<MotRow>> rows = read_rows(file);
  if (!rows) return fail(rows.error());
  int last = info->frames - 1;
  for (const MotRow& row : *rows) {
    if (info->frames > 0 && row.box.frame >= info->frames)
      return fail(place_of(file, row.line),
                  fmt::format("frame {} is past seqLength of seqinfo.ini, {}", row.box.frame + 1, info->frames));
    last = std::max(last, row.box.frame);
  }
  if (last < 0)
    return fail(file.string(), "has no row, and no seqinfo.ini with seqLength says how many frames there are");
  if (info->frames > 0)
    if (const Result<void> good = check_length(info->frames, rows->size(), "seqLength"); !good)
      return fail((folder / "seqinfo.ini").string(), good.error().what);
  const std::string name = canonical_path(folder).filename().string();
  TruthBuilder builder({.video = name, .size_px = info->size_px, .first_frame = 0, .last_frame = last}, info->rate_hz,
                       {}, options);
  for (const MotRow& row : *rows)
    if (const Result<void> added = builder.add(row.box); !added)
      return fail(place_of(file, row.line), added.error().what);
  FramesOfImages images;
  for (int frame = 0; frame <= last; ++frame) images.by_name[fmt::format("{:06}", frame + 1)] = frame;
  Result<TruthClip> clip = builder.clip(name, std::move(images));
  return clip ? std::move(clip) : fail(file.string(), clip.error().what);
}

}  // namespace

std::vector<fs::path> mot_sequences_in(const fs::path& path) {
  const auto is_sequence = [](const fs::path& folder) {
    std::error_code code;
    return fs::exists(folder / "gt" / "gt.txt", code);
  };
  if (is_sequence(path)) return {path};
  std::vector<fs::path> sequences;
  if (const Result<std::vector<fs::path>> there = folder_contents(path))
    std::ranges::copy_if(*there, std::back_inserter(sequences), is_sequence);
  return sequences;
}

Result<std::vector<TruthClip>> read_mot_clips(const fs::path& path, const TruthOptions& options) {
  std::vector<TruthClip> clips;
  for (const fs::path& folder : mot_sequences_in(path)) {
    Result<TruthClip> clip = clip_of_sequence(folder, options);
    if (!clip) return fail(clip.error());
    clips.push_back(std::move(*clip));
  }
  return clips;
}

}  // namespace sigs
