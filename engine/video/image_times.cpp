// SPDX-License-Identifier: MIT
#include "video/image_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/input_file.h"
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

template <class Number>
std::optional<Number> whole_text_as(std::string_view text) {
  Number number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

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
      const std::optional<double> seconds = whole_text_as<double>(time);
      const bool is_heading = line.front() == '#' || (lines.empty() && !seconds && !std::exchange(has_heading_, true));
      if (is_heading) {
        in_nanoseconds_ |= line.find("[ns]") != std::string_view::npos;
        continue;
      }
      if (lines.empty()) in_nanoseconds_ |= is_long_whole(time);
      const std::optional<std::int64_t> whole =
          in_nanoseconds_ ? whole_text_as<std::int64_t>(time) : std::optional<std::int64_t>(0);
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

}  // namespace sigs
