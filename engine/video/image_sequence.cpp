// SPDX-License-Identifier: MIT
#include "video/image_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

extern "C" {
#include <libavutil/rational.h>
}

#include "base/input_file.h"
#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/statistics.h"
#include "base/text.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kNanosecondDigits = 18;  // of seconds since 1970 in nanoseconds there are 19

struct TimeLine {
  int line = 0;
  double time_s = 0;       // for seconds
  std::int64_t whole = 0;  // for nanoseconds
  std::string_view name{};
};

bool is_long_whole(std::string_view text) {
  return text.size() >= kNanosecondDigits && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// The first field of a line, up to a comma or a blank, and the rest as the name of an image.
std::pair<std::string_view, std::string_view> time_and_name(std::string_view line) {
  const std::size_t end = std::min(line.find_first_of(", \t"), line.size());
  std::string_view name = line.substr(end);
  name.remove_prefix(std::min(name.find_first_not_of(", \t"), name.size()));
  if (const std::size_t slash = name.rfind('/'); slash != std::string_view::npos) name.remove_prefix(slash + 1);
  return {line.substr(0, end), name};
}

// The lines of a file of times, with the unit that its heading or its numbers have.
class TimeLines {
 public:
  explicit TimeLines(const fs::path& file) : file_(file) {}

  [[nodiscard]] Result<std::vector<TimeLine>> read(std::string_view text) {
    std::vector<TimeLine> lines;
    text = without_bom(text);
    for (int number = 1; !text.empty(); ++number) {
      const std::string_view line = trimmed(next_line(text));
      if (line.empty()) continue;
      const auto [time, name] = time_and_name(line);
      const std::optional<double> seconds = parsed_number<double>(time);
      const bool is_heading = line.front() == '#' || (lines.empty() && !seconds && !std::exchange(has_heading_, true));
      if (is_heading) {
        in_nanoseconds_ |= line.find("[ns]") != std::string_view::npos;
        continue;
      }
      if (lines.empty()) in_nanoseconds_ |= is_long_whole(time);
      const std::optional<std::int64_t> whole =
          in_nanoseconds_ ? parsed_number<std::int64_t>(time) : std::optional<std::int64_t>(0);
      if (!seconds || !std::isfinite(*seconds) || !whole)
        return fail(place_of(number), fmt::format("expected a time in {}, found \"{}\"",
                                                  in_nanoseconds_ ? "whole nanoseconds" : "seconds", time));
      lines.push_back({.line = number, .time_s = *seconds, .whole = *whole, .name = name});
    }
    return lines;
  }

  [[nodiscard]] std::string place_of(int line) const { return fmt::format("{}: line {}", file_.string(), line); }

  // From the time of one line to that of another. Differences of nanoseconds are taken before they are rounded.
  [[nodiscard]] double between_s(const TimeLine& from, const TimeLine& to) const {
    if (!in_nanoseconds_) return to.time_s - from.time_s;
    std::int64_t difference = 0;
    if (__builtin_sub_overflow(to.whole, from.whole, &difference)) return std::nan("");
    return static_cast<double>(difference) * 1e-9;
  }

 private:
  fs::path file_;
  bool in_nanoseconds_ = false;
  bool has_heading_ = false;
};

// The line of each image, by its name.
Result<std::vector<TimeLine>> by_name(const fs::path& file, const std::vector<TimeLine>& lines,
                                      const std::vector<fs::path>& images) {
  std::map<std::string_view, const TimeLine*> line_of;
  for (const TimeLine& line : lines) line_of.emplace(line.name, &line);
  std::vector<TimeLine> ordered;
  for (const fs::path& image : images) {
    const std::string name = image.filename().string();
    const auto found = line_of.find(name);
    if (found == line_of.end()) return fail(file.string(), fmt::format("has no line for the image {}", name));
    ordered.push_back(*found->second);
  }
  return ordered;
}

// The kind of an image by its name; empty: not one that is read.
std::string kind_of_image(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return "PNG";
  if (extension == ".tif" || extension == ".tiff") return "TIFF";
  if (extension == ".jpg" || extension == ".jpeg") return "JPEG";
  return {};
}

Result<std::vector<fs::path>> images_in(const fs::path& folder) {
  const Result<std::vector<fs::path>> there = folder_contents(folder);
  if (!there) return fail(there.error());
  std::vector<fs::path> images;
  for (const fs::path& path : *there) {
    const std::string kind = kind_of_image(path);
    if (kind.empty() || path.filename().string().starts_with('.')) continue;
    if (!images.empty() && kind_of_image(images.front()) != kind)
      return fail(folder.string(), fmt::format("holds images of several kinds, {} and {}; name a pattern such as "
                                               "FOLDER/frame_%06d.png",
                                               images.front().filename().string(), path.filename().string()));
    images.push_back(path);
  }
  if (images.empty())
    return fail(folder.string(), "is a folder without images (PNG, TIFF or JPEG), not a video", ErrorKind::cannot_read);
  std::stable_sort(images.begin(), images.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().native(), b.filename().native());
  });
  return images;
}

// The pattern that the first image's name follows with the last run of digits in it as its number.
std::optional<NumberPattern> pattern_of_first(const std::vector<fs::path>& images) {
  const std::string name = images.front().filename().string();
  const std::size_t end = name.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const bool has_zeros = name[begin] == '0' && end > begin;
  return NumberPattern{.prefix = name.substr(0, begin),
                       .suffix = name.substr(end + 1),
                       .digits = has_zeros ? static_cast<int>(end - begin) + 1 : 0};
}

// A folder of which most numbers are there, and some in between are not, has lost some images. Names with larger gaps
// are times or chosen images.
void warn_of_gaps(const fs::path& folder, const std::vector<fs::path>& images, std::vector<Warning>& warnings) {
  const std::optional<NumberPattern> pattern = pattern_of_first(images);
  if (!pattern) return;
  std::optional<long long> first_missing;
  std::optional<long long> before;
  long long missing = 0;
  for (const fs::path& image : images) {
    const std::optional<long long> number = pattern->number_in(image.filename().native());
    if (!number) return;
    if (before && *number > *before + 1) {
      if (!first_missing) first_missing = *before + 1;
      missing += *number - *before - 1;
    }
    before = number;
  }
  if (missing == 0 || missing > static_cast<long long>(images.size())) return;
  warnings.push_back({folder.string(), fmt::format("numbers are missing in it, {} in all, the first {}; the images "
                                                   "that are there are taken as successive frames",
                                                   missing, pattern->name_of(*first_missing))});
}

AVRational rational_of(double rate_hz) {
  constexpr int kMaxDenominator = 1001000;
  const AVRational rate = av_d2q(rate_hz, kMaxDenominator);
  return rate.num > 0 && rate.den > 0 ? rate : AVRational{25, 1};
}

void space_evenly(ImageSequence& sequence, double rate_hz) {
  const AVRational rate = rational_of(rate_hz);
  sequence.frame_rate_num = rate.num;
  sequence.frame_rate_den = rate.den;
  for (std::size_t n = 0; n < sequence.files.size(); ++n)
    sequence.times_s.push_back(static_cast<double>(n) * rate.den / rate.num);
}

// The nominal rate is that of the median interval, to a thousandth; one image has the default one.
void set_stated_times(ImageSequence& sequence, std::vector<double> times_s) {
  sequence.times_s = std::move(times_s);
  std::vector<double> intervals_s;
  for (std::size_t n = 1; n < sequence.times_s.size(); ++n)
    intervals_s.push_back(sequence.times_s[n] - sequence.times_s[n - 1]);
  if (intervals_s.empty()) return;
  const double interval_s = median(intervals_s);
  const AVRational rate = rational_of(std::max(std::round(1000 / interval_s) / 1000, 0.001));
  sequence.frame_rate_num = rate.num;
  sequence.frame_rate_den = rate.den;
  sequence.variable_frame_rate = std::ranges::any_of(
      intervals_s, [&](double each_s) { return std::abs(each_s - interval_s) > 0.01 * interval_s; });
}

}  // namespace

Result<std::vector<double>> read_image_times(const fs::path& file, const std::vector<fs::path>& images) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  TimeLines reader(file);
  Result<std::vector<TimeLine>> lines = reader.read(*text);
  if (!lines) return fail(lines.error());
  if (lines->size() != images.size())
    return fail(file.string(),
                fmt::format("has {} times, but the sequence has {} images", lines->size(), images.size()));
  if (std::ranges::all_of(*lines, [](const TimeLine& line) { return !line.name.empty(); }))
    lines = by_name(file, *lines, images);
  if (!lines) return fail(lines.error());
  std::vector<double> times_s;
  for (std::size_t i = 0; i < lines->size(); ++i) {
    const TimeLine& line = (*lines)[i];
    const double time_s = reader.between_s(lines->front(), line);
    if (!std::isfinite(time_s))
      return fail(reader.place_of(line.line), "the time is too far from that of the first image");
    if (i > 0 && !(reader.between_s((*lines)[i - 1], line) > 0 && time_s > times_s.back()))
      return fail(reader.place_of(line.line), "the time is not after that of the image before");
    times_s.push_back(time_s);
  }
  return times_s;
}

bool is_image_sequence(const fs::path& path) {
  return is_folder(path) || is_number_pattern(path);
}

Result<std::vector<fs::path>> files_of_sequence(const fs::path& path) {
  if (is_folder(path)) return images_in(path);
  Result<std::vector<fs::path>> files = files_of_pattern(path);
  if (files && kind_of_image(path).empty())
    return fail(path.string(), "is a sequence of files that are not PNG, TIFF or JPEG images", ErrorKind::cannot_read);
  return files;
}

Result<ImageSequence> listed_sequence(const fs::path& path, const SequenceTiming& timing) {
  Result<std::vector<fs::path>> files = files_of_sequence(path);
  if (!files) return fail(files.error());
  ImageSequence sequence{.files = std::move(*files)};
  if (is_folder(path)) warn_of_gaps(path, sequence.files, sequence.warnings);
  if (!timing.times_file.empty()) {
    Result<std::vector<double>> times_s = read_image_times(timing.times_file, sequence.files);
    if (!times_s) return fail(times_s.error());
    set_stated_times(sequence, std::move(*times_s));
    return sequence;
  }
  const bool is_known = timing.frame_rate_hz > 0 && std::isfinite(timing.frame_rate_hz);
  space_evenly(sequence, is_known ? timing.frame_rate_hz : kDefaultSequenceRate_hz);
  if (!is_known)
    sequence.warnings.push_back({path.string(), fmt::format("images do not say when they were taken; {} frames/s are "
                                                            "assumed: set footage.frame_rate or footage.timestamps",
                                                            short_number_text(kDefaultSequenceRate_hz))});
  return sequence;
}

}  // namespace sigs
