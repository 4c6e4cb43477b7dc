// SPDX-License-Identifier: MIT
#include "cli/dataset_table.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "base/text_pieces.h"
#include "dataset/run.h"
#include "dataset/short_text.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

using Row = std::vector<std::string>;

// Bytes a pixel of the sample footage with mask video and XML (crossing, 1280x960; h264: of 1LRB737). Other footage may
// take half or twice as much.
double bytes_a_pixel(const ExportSettings& output) {
  switch (output.codec) {
    case CodecChoice::ffv1:
      return 0.38;
    case CodecChoice::h264:
      return 0.017;
    case CodecChoice::mjpeg:
      return 0.13;
    case CodecChoice::png:
      return 1.2;
  }
  return 1;
}

std::string size_text(double bytes) {
  const char* const units[] = {"kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  double size = bytes / 1e3;
  for (; size >= 1000 && unit + 1 < std::size(units); ++unit) size /= 1000;
  char text[48];
  std::snprintf(text, sizeof text, "%.*f %s", size < 10 ? 1 : 0, size, units[unit]);
  return text;
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += row[i];
      if (i + 1 < row.size()) text += std::string(widths[i] - columns_of(row[i]) + 2, ' ');
    }
    text += "\n";
  }
  return text;
}

// Sizes of pictures, each footage opened once.
class PictureSizes {
 public:
  Result<double> pixels_of(const Project& project) {
    const std::string path = resolved(project, project.footage.video).string();
    if (const auto known = pixels_.find(path); known != pixels_.end()) return known->second;
    const Result<FrameSource> source = FrameSource::open(path);
    if (!source) return fail(source.error());
    const cv::Size size = source->info().size_px;
    return pixels_[path] = double(size.width) * size.height;
  }

 private:
  std::map<std::string, double> pixels_;
};

std::string or_dash(const std::map<std::string, std::string>& tags, const char* key) {
  const auto found = tags.find(key);
  return found == tags.end() || found->second.empty() ? "-" : found->second;
}

Row row_of(const PlannedVideo& video, int frames, const std::set<std::string>& drawn) {
  Row row{video.name, video.split.empty() ? "-" : video.split};
  for (const char* const tag : {"background", "aircraft", "flight"}) row.push_back(or_dash(video.tags, tag));
  row.push_back(std::to_string(frames));
  for (const std::string& quantity : drawn) {
    const auto found = video.drawn.find(quantity);
    row.push_back(found == video.drawn.end() ? "-" : short_text(found->second));
  }
  return row;
}

std::vector<const PlannedVideo*> videos_of(const Plan& plan, const Shard& shard) {
  std::vector<const PlannedVideo*> videos;
  for (int i = 0; i < static_cast<int>(plan.videos.size()); ++i)
    if (shard.has(i)) videos.push_back(&plan.videos[static_cast<std::size_t>(i)]);
  return videos;
}

}  // namespace

Result<std::string> table_of(const Plan& plan, const Shard& shard) {
  const std::vector<const PlannedVideo*> videos = videos_of(plan, shard);
  std::set<std::string> drawn;
  for (const PlannedVideo* const video : videos)
    for (const auto& [quantity, value] : video->drawn) drawn.insert(quantity);
  std::vector<Row> rows{{"name", "split", "background", "aircraft", "flight", "frames"}};
  rows.front().insert(rows.front().end(), drawn.begin(), drawn.end());
  PictureSizes sizes;
  long long frames = 0;
  double bytes = 0;
  for (const PlannedVideo* const video : videos) {
    const Result<int> count = frames_of(video->project);
    if (!count) return fail(video->name, count.error().text(), count.error().kind);
    const Result<double> pixels = sizes.pixels_of(video->project);
    if (!pixels) return fail(video->name, pixels.error().text(), pixels.error().kind);
    rows.push_back(row_of(*video, *count, drawn));
    frames += *count;
    bytes += *pixels * *count * bytes_a_pixel(video->project.output);
  }
  return aligned(rows) + std::to_string(videos.size()) + " videos, " + std::to_string(frames) + " frames, about " +
         size_text(bytes) + "\n";
}

}  // namespace sigs::cli
