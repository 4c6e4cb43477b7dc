// SPDX-License-Identifier: MIT
#include "cli/dataset_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "base/text.h"
#include "scene/opened_project.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

using Row = std::vector<std::string>;

// Bytes a pixel of the sample footage with mask video and XML (crossing, 1280x960; h264 and source: of 1LRB737), in the
// order of VideoCodec. Other footage may take half or twice as much.
constexpr std::array kBytesAPixel{0.38, 0.017, 0.012, 0.012, 0.13, 1.2, 1.2, 0.15, 1.5, 0.017};
static_assert(kBytesAPixel.size() == static_cast<std::size_t>(VideoCodec::source) + 1);

std::string size_text(double bytes) {
  const char* const units[] = {"kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  double size = bytes / 1e3;
  for (; size >= 1000 && unit + 1 < std::size(units); ++unit) size /= 1000;
  char text[48];
  std::snprintf(text, sizeof text, "%.*f %s", size < 10 ? 1 : 0, size, units[unit]);
  return text;
}

struct Column {
  std::string title;
  bool is_number = false;
  Row cells;
};

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::string blanks(width - std::min(width, columns_of(text)), ' ');
  return to_the_right ? blanks + text : text + blanks;
}

std::string aligned(const std::vector<Column>& columns) {
  std::vector<std::string> lines(columns.front().cells.size() + 1);
  for (const Column& column : columns) {
    std::size_t width = columns_of(column.title);
    for (const std::string& cell : column.cells) width = std::max(width, columns_of(cell));
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] += padded(i == 0 ? column.title : column.cells[i - 1], width, column.is_number) + "  ";
  }
  std::string text;
  for (std::string& line : lines) text += line.erase(line.find_last_not_of(' ') + 1) + "\n";
  return text;
}

// Columns whose values differ between videos, and a line of what all have in common.
std::string table_text(const std::vector<Column>& columns) {
  std::vector<Column> varying;
  std::string shared;
  for (const Column& column : columns) {
    const bool is_constant = std::ranges::count(column.cells, column.cells.front()) == std::ssize(column.cells);
    if (&column == &columns.front() || !is_constant)
      varying.push_back(column);
    else if (column.cells.front() != "-")
      shared += fmt::format("{}{} {}", shared.empty() ? "all: " : ", ", column.title, column.cells.front());
  }
  return aligned(varying) + (shared.empty() ? "" : shared + "\n") + "\n";
}

// Four significant digits, and all digits before the decimal point.
std::string rounded_text(double value) {
  if (value == 0 || !std::isfinite(value)) return short_number_text(value);
  const double step = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  const double rounded = step < 1 ? std::round(value / step) * step : std::round(value);
  return short_number_text(rounded);
}

std::string or_dash(const std::map<std::string, std::string>& tags, const char* key) {
  const auto found = tags.find(key);
  return found == tags.end() || found->second.empty() ? "-" : found->second;
}

std::string view_text(const std::optional<Visibility>& view) {
  if (!view) return "?";
  const std::string share = fmt::format("{}/{}", view->visible, view->frames_checked);
  return view->visible > 0 ? share : "never";
}

std::string size_range_text(const std::optional<Visibility>& view) {
  if (!view || view->visible == 0) return "-";
  const std::string low = rounded_text(std::round(view->smallest_px * 10) / 10);
  const std::string high = rounded_text(std::round(view->largest_px * 10) / 10);
  return low == high ? low : low + ".." + high;
}

std::string resamples_count(const PlannedVideo& video) {
  int count = 0;
  for (const auto& [condition, times] : video.resamples) count += times;
  return count > 0 ? std::to_string(count) : "-";
}

// Quantities of further bodies ("other2.bearing_deg") would make the table too wide; entry.json has them.
bool is_shown(const std::string& quantity) {
  return !quantity.starts_with("other");
}

// One table's videos: those of the same quantities.
struct Block {
  std::set<std::string> quantities;
  std::vector<std::size_t> videos;
};

std::vector<Block> blocks_of(const std::vector<const PlannedVideo*>& videos) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < videos.size(); ++i) {
    std::set<std::string> quantities;
    for (const auto& [quantity, value] : videos[i]->sampled)
      if (is_shown(quantity)) quantities.insert(quantity);
    auto block =
        std::find_if(blocks.begin(), blocks.end(), [&](const Block& one) { return one.quantities == quantities; });
    if (block == blocks.end()) block = blocks.insert(block, {quantities, {}});
    block->videos.push_back(i);
  }
  return blocks;
}

struct Measured {
  const std::vector<const PlannedVideo*>& videos;
  const std::vector<std::optional<Visibility>>& visibilities;
  std::vector<int> frames;
};

std::vector<Column> columns_of(const Block& block, const Measured& all) {
  std::vector<Column> columns{{.title = "name"},
                              {.title = "split"},
                              {.title = "background"},
                              {.title = "aircraft"},
                              {.title = "flight"},
                              {.title = "frames", .is_number = true},
                              {.title = "in_view", .is_number = true},
                              {.title = "size_px", .is_number = true},
                              {.title = "redraws", .is_number = true}};
  const std::size_t fixed = columns.size();
  for (const std::string& quantity : block.quantities) columns.push_back({.title = quantity, .is_number = true});
  for (const std::size_t i : block.videos) {
    const PlannedVideo& video = *all.videos[i];
    Row row{video.name, video.split.empty() ? "-" : video.split};
    for (const char* const tag : {"background", "aircraft", "flight"}) row.push_back(or_dash(video.tags, tag));
    row.insert(row.end(), {std::to_string(all.frames[i]), view_text(all.visibilities[i]),
                           size_range_text(all.visibilities[i]), resamples_count(video)});
    for (std::size_t c = 0; c < fixed; ++c) columns[c].cells.push_back(row[c]);
    std::size_t c = fixed;
    for (const auto& [quantity, value] : video.sampled)
      if (is_shown(quantity)) columns[c++].cells.push_back(rounded_text(value));
  }
  return columns;
}

}  // namespace

std::vector<const PlannedVideo*> videos_of(const Plan& plan, const Shard& shard) {
  std::vector<const PlannedVideo*> videos;
  for (int i = 0; i < static_cast<int>(plan.videos.size()); ++i)
    if (shard.has(i)) videos.push_back(&plan.videos[static_cast<std::size_t>(i)]);
  return videos;
}

std::string resamples_line(const std::vector<const PlannedVideo*>& videos) {
  const std::string text = resamples_text(resamples_of(videos));
  return text.empty() ? text : fmt::format("sampled again: {}\n", text);
}

Result<std::string> table_of(const std::vector<const PlannedVideo*>& videos,
                             const std::vector<std::optional<Visibility>>& visibilities) {
  Measured all{.videos = videos, .visibilities = visibilities, .frames = {}};
  std::map<std::string, VideoInfo> footages;  // by file: each is opened once
  long long frames = 0;
  double bytes = 0;
  for (const PlannedVideo* const video : videos) {
    const std::string file = resolved(video->project, video->project.footage.video).string();
    if (!footages.contains(file)) {
      const Result<FrameSource> source = open_footage(video->project);
      if (!source) return fail(video->name, source.error().text(), source.error().kind);
      footages.emplace(file, source->info());
    }
    const VideoInfo& footage = footages.at(file);
    const Result<int> count = frames_of(video->project, shape_of(footage));
    if (!count) return fail(video->name, count.error().text(), count.error().kind);
    all.frames.push_back(*count);
    frames += *count;
    bytes +=
        double(footage.size_px.area()) * *count * kBytesAPixel[static_cast<std::size_t>(video->project.output.codec)];
  }
  std::string text;
  for (const Block& block : blocks_of(videos)) text += table_text(columns_of(block, all));
  return fmt::format("{}{}{}, {}, about {}\n", text, resamples_line(videos), count_text(std::ssize(videos), "video"),
                     count_text(frames, "frame"), size_text(bytes));
}

}  // namespace sigs::cli
