// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/input_file.h"
#include "base/parsing.h"
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

tl::unexpected<Error> wrong_at(const fs::path& path, int line, const std::string& what) {
  return fail(fmt::format("{}: line {}", path.string(), line), what);
}

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
    const std::size_t equals = line->text.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string key = lower_case(trimmed(line->text.substr(0, equals)));
    const std::string_view value = trimmed(line->text.substr(equals + 1));
    if (key == "framerate" || key == "exactframerate") {
      const double rate_hz = rate_of(value);
      if (rate_hz == 0) return wrong_at(path, line->number, fmt::format("{}: {} is no rate", key, in_quotes(value)));
      if (key == "exactframerate" || !has_exact_rate) info.rate_hz = rate_hz;
      has_exact_rate |= key == "exactframerate";
    } else if (key == "seqlength" || key == "imwidth" || key == "imheight") {
      const std::optional<int> number = integer_of(value);
      if (!number || *number < 1 || *number > kMaxClipFrames)
        return wrong_at(path, line->number,
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
    return wrong_at(
        path, line.number,
        fmt::format("has {} columns; frame,id,left,top,width,height,flag,class,visibility are 6 to 10", fields.size()));
  std::array<double, 10> numbers{0, 0, 0, 0, 0, 0, 1, -1, -1, -1};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> number = parsed_number(fields[i]);
    if (!number || !std::isfinite(*number))
      return wrong_at(path, line.number, fmt::format("column {}: {} is no number", i + 1, in_quotes(fields[i])));
    numbers[i] = *number;
  }
  const std::optional<int> frame = integer_of(numbers[0]);
  const std::optional<int> id = integer_of(numbers[1]);
  const std::optional<int> category = integer_of(numbers[7]);
  if (!frame || *frame < 1 || *frame > kMaxClipFrames)
    return wrong_at(path, line.number, fmt::format("frame {} is no whole number from 1 on", in_quotes(fields[0])));
  if (!id) return wrong_at(path, line.number, fmt::format("id {} is no whole number", in_quotes(fields[1])));
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

Result<TruthClip> clip_of_sequence(const fs::path& folder, const TruthOptions& options,
                                   std::set<std::string>& categories) {
  const Result<SequenceInfo> info = read_seqinfo(folder / "seqinfo.ini");
  if (!info) return fail(info.error());
  const fs::path file = folder / "gt" / "gt.txt";
  const Result<std::vector<MotRow>> rows = read_rows(file);
  if (!rows) return fail(rows.error());
  int last = info->frames - 1;
  for (const MotRow& row : *rows) {
    if (info->frames > 0 && row.box.frame >= info->frames)
      return wrong_at(file, row.line,
                      fmt::format("frame {} is past seqLength of seqinfo.ini, {}", row.box.frame + 1, info->frames));
    last = std::max(last, row.box.frame);
  }
  if (last < 0)
    return fail(file.string(), "has no row, and no seqinfo.ini with seqLength says how many frames there are");
  if (info->frames > 0)
    if (const Result<void> good = check_length(info->frames, rows->size(), "seqLength"); !good)
      return fail((folder / "seqinfo.ini").string(), good.error().what);
  TruthClip clip{.name = canonical_path(folder).filename().string()};
  TruthBuilder builder({.video = clip.name, .size_px = info->size_px, .first_frame = 0, .last_frame = last},
                       info->rate_hz, {}, options);
  for (const MotRow& row : *rows)
    if (const Result<void> added = builder.add(row.box); !added) return wrong_at(file, row.line, added.error().what);
  Result<ClipTruth> truth = builder.clip();
  if (!truth) return fail(file.string(), truth.error().what);
  clip.truth = std::move(*truth);
  for (int frame = 0; frame <= last; ++frame) clip.images.by_name[fmt::format("{:06}", frame + 1)] = frame;
  categories.insert(builder.categories().begin(), builder.categories().end());
  return clip;
}

}  // namespace

Result<std::vector<TruthClip>> read_mot_clips(const fs::path& path, const TruthOptions& options,
                                              std::set<std::string>& categories) {
  std::vector<fs::path> folders;
  std::error_code code;
  if (fs::exists(path / "gt" / "gt.txt", code)) {
    folders.push_back(path);
  } else {
    const Result<std::vector<fs::path>> there = folder_contents(path);
    if (!there) return fail(there.error());
    for (const fs::path& folder : *there)
      if (fs::exists(folder / "gt" / "gt.txt", code)) folders.push_back(folder);
  }
  std::vector<TruthClip> clips;
  for (const fs::path& folder : folders) {
    Result<TruthClip> clip = clip_of_sequence(folder, options, categories);
    if (!clip) return fail(clip.error());
    clips.push_back(std::move(*clip));
  }
  return clips;
}

}  // namespace sigs
