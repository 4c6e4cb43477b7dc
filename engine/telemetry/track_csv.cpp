// SPDX-License-Identifier: MIT
#include "telemetry/track_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"
#include "telemetry/log_samples.h"
#include "telemetry/track.h"

namespace sigs {
namespace {

constexpr std::size_t kMaxWarnings = 100;  // that are listed one by one
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// --- Writing.

// One channel on its way into rows.
struct Feed {
  std::vector<std::string> columns;
  const std::vector<double>* times_s = nullptr;
  std::function<std::vector<double>(std::size_t)> numbers;  // of sample i, one for each column
  std::size_t next = 0;
};

std::vector<Feed> feeds_of(const Track& track) {
  std::vector<Feed> feeds;
  for_each_channel(track, [&](std::string_view name, const auto& channel) {
    if (channel.empty()) return;
    Feed feed{.columns = csv_columns(name), .times_s = &channel.times_s};
    const bool has_own = channel.own_times_s.size() == channel.values.size();
    if (has_own) feed.columns.push_back(std::string(name) + "_own_s");
    feed.numbers = [name, &channel, has_own](std::size_t i) {
      std::vector<double> numbers = csv_numbers(name, channel.values[i]);
      if (has_own) numbers.push_back(channel.own_times_s[i]);
      return numbers;
    };
    feeds.push_back(std::move(feed));
  });
  return feeds;
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string settings_of(const Track& track) {
  std::string text;
  const auto say = [&](std::string_view key, const std::string& value) {
    if (!value.empty()) text += fmt::format("# {}: {}\n", key, on_one_line(value));
  };
  const auto yes = [](bool value) { return std::string(value ? "true" : "false"); };
  say("format", track.format);
  say("device", track.device);
  say("on_footage_time", yes(track.on_footage_time));
  say("utc_at_zero_s", exact_text(track.utc_at_zero_s));
  say("heading_is_north", yes(track.heading_is_north));
  say("level_is_known", yes(track.level_is_known));
  if (track.attitude_is_whole) say("attitude_is_whole", "true");
  say("height_above_ellipsoid", yes(track.height_above_ellipsoid));
  say("readout_s", exact_text(track.readout_s));
  if (track.damaged) say("damaged", "true");
  for_each_channel(track, [&](std::string_view name, const auto& channel) {
    if (channel.empty()) return;
    say(fmt::format("source {}", name), channel.source);
    say(fmt::format("clock {}", name), channel.clock);
  });
  for (std::size_t i = 0; i < std::min(kMaxWarnings, track.warnings.size()); ++i)
    say("warning", track.warnings[i].text());
  return text;
}

std::string row_of(std::vector<Feed>& feeds, double time_s) {
  std::string row = exact_text(time_s);
  for (Feed& feed : feeds) {
    const bool has_sample = feed.next < feed.times_s->size() && (*feed.times_s)[feed.next] == time_s;
    if (!has_sample) {
      row.append(feed.columns.size(), ',');
      continue;
    }
    for (const double number : feed.numbers(feed.next)) row.append(",").append(exact_text(number));
    ++feed.next;
  }
  return row + "\n";
}

// --- Reading.

// "30000/1001" or "29.97".
std::optional<double> rate_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<double> above = finite_number(trimmed(text.substr(0, slash)));
  const std::optional<double> below =
      slash == std::string_view::npos ? 1 : finite_number(trimmed(text.substr(slash + 1)));
  if (!above || !below || !(*above > 0) || !(*below > 0)) return {};
  return *above / *below;
}

struct Settings {
  std::map<std::string, std::string, std::less<>> values;
  std::vector<std::string> warnings;

  [[nodiscard]] std::string text(std::string_view key) const {
    const auto found = values.find(key);
    return found != values.end() ? found->second : std::string();
  }
};

// Takes the comments and empty lines before the columns off the text, and their number of lines.
Settings taken_settings(std::string_view& text, int& line_number) {
  Settings settings;
  text = without_bom(text);
  while (!text.empty()) {
    std::string_view rest = text;
    const std::string_view line = trimmed(next_line(rest));
    if (!line.empty() && line.front() != '#') break;
    text = rest;
    ++line_number;
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string key(trimmed(line.substr(1, colon - 1)));
    const std::string value(trimmed(line.substr(colon + 1)));
    if (key != "warning")
      settings.values[key] = value;
    else if (!value.empty())
      settings.warnings.push_back(value);
  }
  return settings;
}

std::vector<std::string> names_of(std::string_view header) {
  std::vector<std::string> names;
  for (const std::string_view field : csv_fields(header)) names.push_back(csv_column_name(field));
  return names;
}

int index_of(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// Where one channel's columns stand, and how a row's numbers become its next sample.
struct Sink {
  std::string_view name;
  std::vector<int> columns;  // -1: not there, 0 is taken
  int own_column = -1;
  std::function<bool(double time_s, std::span<const double> numbers, double own_s)> add;
  bool own_is_complete = true;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const std::atomic<bool>* cancel) : file_(file), cancel_(cancel) {
    track_.file = file;
    track_.format = "CSV";
  }

  Result<Track> read(std::string_view text) {
    const Settings settings = taken_settings(text, line_);
    apply(settings);
    const std::vector<std::string> names = names_of(next_line(text));
    ++line_;
    if (const Result<void> timed = find_time(names, settings); !timed) return fail(timed.error());
    find_channels(names, settings);
    while (!text.empty()) {
      if (line_ % 1024 == 0)
        if (const Result<void> goes_on = check_interrupt(cancel_); !goes_on) return fail(goes_on.error());
      const std::string_view line = next_line(text);
      ++line_;
      if (const std::string_view there = trimmed(line); !there.empty() && there.front() != '#') add_row(line);
    }
    add_samples();
    return finished();
  }

 private:
  struct Row {
    std::string_view text;
    int line = 0;
  };

  void warn(std::string what, int line = 0) {
    if (track_.warnings.size() == kMaxWarnings + said_before_)
      what = "there are more such lines", line = 0;
    else if (track_.warnings.size() > kMaxWarnings + said_before_)
      return;
    track_.warnings.push_back({line > 0 ? fmt::format("{}: line {}", file_.string(), line) : file_.string(), what});
  }

  void apply(const Settings& settings) {
    if (const std::string format = settings.text("format"); !format.empty()) track_.format = format;
    track_.device = settings.text("device");
    track_.on_footage_time = settings.text("on_footage_time") == "true";
    track_.utc_at_zero_s = finite_number(settings.text("utc_at_zero_s"));
    track_.heading_is_north = settings.text("heading_is_north") != "false";
    track_.level_is_known = settings.text("level_is_known") != "false";
    track_.attitude_is_whole = settings.text("attitude_is_whole") == "true";
    track_.height_above_ellipsoid = settings.text("height_above_ellipsoid") == "true";
    track_.readout_s = finite_number(settings.text("readout_s"));
    track_.damaged = settings.text("damaged") == "true";
    for (const std::string& warning : settings.warnings) track_.warnings.push_back({"", warning});
    said_before_ = track_.warnings.size();
  }

  Result<void> find_time(const std::vector<std::string>& names, const Settings& settings) {
    time_column_ = index_of(names, "time_s");
    if (time_column_ >= 0) return {};
    time_column_ = index_of(names, "frame");
    if (time_column_ < 0) return fail(place(), "there is no column time_s or frame");
    const std::optional<double> rate_hz = rate_of(settings.text("frame_rate"));
    if (!rate_hz)
      return fail(place(),
                  "its rows have frame numbers, but no line such as `# frame_rate: 30000/1001` says how many "
                  "there are in a second");
    row_s_ = 1 / *rate_hz;
    track_.on_footage_time = true;
    return {};
  }

  void find_channels(const std::vector<std::string>& names, const Settings& settings) {
    std::vector<bool> known(names.size(), false);
    known[static_cast<std::size_t>(time_column_)] = true;
    for_each_channel(track_, [&](std::string_view name, auto& channel) {
      Sink sink{.name = name};
      std::vector<std::string> missing;
      for (const std::string& column : csv_columns(name)) {
        sink.columns.push_back(index_of(names, column));
        if (sink.columns.back() < 0)
          missing.push_back(column);
        else
          known[static_cast<std::size_t>(sink.columns.back())] = true;
      }
      sink.own_column = index_of(names, std::string(name) + "_own_s");
      if (sink.own_column >= 0) known[static_cast<std::size_t>(sink.own_column)] = true;
      if (missing.size() == sink.columns.size()) return;
      if (missing == std::vector<std::string>{"height_m"}) {
        warn("there is no column height_m; the heights are 0");
      } else if (!missing.empty()) {
        return warn("without " + listed(missing) + " the other columns of " + std::string(name) + " are not used");
      }
      channel.source = settings.text("source " + std::string(name));
      if (channel.source.empty()) channel.source = "CSV";
      channel.clock = settings.text("clock " + std::string(name));
      if (channel.clock.empty() && row_s_ > 0) channel.clock = "frame number";
      sink.add = [name, &channel](double time_s, std::span<const double> numbers, double own_s) {
        typename std::decay_t<decltype(channel.values)>::value_type value{};
        if (!csv_value(name, numbers, value)) return false;
        channel.times_s.push_back(time_s);
        channel.values.push_back(value);
        channel.own_times_s.push_back(own_s);
        return true;
      };
      sinks_.push_back(std::move(sink));
    });
    std::vector<std::string> unknown;
    for (std::size_t i = 0; i < names.size() && unknown.size() < 40; ++i)
      if (!known[i]) unknown.push_back(names[i].empty() ? "(no name)" : names[i].substr(0, 60));
    if (!unknown.empty()) warn("columns that are not known: " + listed(unknown));
  }

  // The number in a cell; NaN where it is empty or none, which is then said.
  double cell(const std::vector<std::string_view>& fields, int column) {
    if (column < 0) return 0;
    if (column >= static_cast<int>(fields.size()) || fields[static_cast<std::size_t>(column)].empty()) return kNone;
    const std::string_view field = fields[static_cast<std::size_t>(column)];
    const std::optional<double> number = finite_number(field);
    if (!number) warn(fmt::format("\"{}\" is no number; left out", field.substr(0, 40)), line_);
    return number.value_or(kNone);
  }

  void add_row(std::string_view line) {
    const std::vector<std::string_view> fields = csv_fields(line);
    const double time_s = cell(fields, time_column_) * row_s();
    if (!std::isfinite(time_s)) return warn("has no time; left out", line_);
    rows_.add(time_s, {line, line_}, [this](double, const Row& row) { leave_out(row); });
  }

  void leave_out(const Row& row) {
    if (rows_left_out_++ == 0 || row.line < first_left_out_) first_left_out_ = row.line;
  }

  // Of the rows whose times go together.
  void add_samples() {
    rows_.finish([this](double, const Row& row) { leave_out(row); });
    if (rows_left_out_ > 0)
      warn("its time is before or after its neighbours'; " + count_text(rows_left_out_, "such row") + " left out",
           first_left_out_);
    for (std::size_t i = 0; i < rows_.values().size(); ++i) {
      line_ = rows_.values()[i].line;
      const std::vector<std::string_view> fields = csv_fields(rows_.values()[i].text);
      for (Sink& sink : sinks_) add_sample(sink, fields, rows_.times_s()[i]);
    }
  }

  void add_sample(Sink& sink, const std::vector<std::string_view>& fields, double time_s) {
    std::vector<double> numbers;
    int empty = 0;
    int optional = 0;
    for (const int column : sink.columns) {
      optional += column < 0;
      numbers.push_back(cell(fields, column));
      empty += !std::isfinite(numbers.back());
    }
    if (empty + optional == static_cast<int>(numbers.size())) return;
    if (empty > 0) return warn(std::string(sink.name) + " has only some of its cells; left out", line_);
    const double own_s = sink.own_column >= 0 ? cell(fields, sink.own_column) : kNone;
    if (!sink.add(time_s, numbers, own_s))
      return warn(std::string(sink.name) + " is out of its range; left out", line_);
    sink.own_is_complete = sink.own_is_complete && std::isfinite(own_s);
  }

  Result<Track> finished() {
    for_each_channel(track_, [&](std::string_view name, auto& channel) {
      for (const Sink& sink : sinks_)
        if (sink.name == name && !sink.own_is_complete) channel.own_times_s.clear();
      if (channel.empty()) channel = {};
    });
    if (!has_samples(track_)) return fail(file_.string(), "there is not one row in it with all columns of a channel");
    return std::move(track_);
  }

  [[nodiscard]] std::string place() const { return fmt::format("{}: line {}", file_.string(), line_); }
  [[nodiscard]] double row_s() const { return row_s_ > 0 ? row_s_ : 1; }

  std::filesystem::path file_;
  const std::atomic<bool>* cancel_;
  Track track_;
  std::vector<Sink> sinks_;
  int line_ = 0;
  int time_column_ = -1;
  double row_s_ = 0;  // time of one frame; 0: the rows have times
  StampedValues<Row> rows_;
  int rows_left_out_ = 0, first_left_out_ = 0;  // number, and line of the first
  std::size_t said_before_ = 0;                 // warnings that the file itself has
};

}  // namespace

std::string track_csv_text(const Track& track) {
  std::vector<Feed> feeds = feeds_of(track);
  std::string text = settings_of(track) + "time_s";
  for (const Feed& feed : feeds) text.append(",").append(listed(feed.columns, ","));
  text += "\n";
  while (true) {
    double next_s = std::numeric_limits<double>::infinity();
    for (const Feed& feed : feeds)
      if (feed.next < feed.times_s->size()) next_s = std::min(next_s, (*feed.times_s)[feed.next]);
    if (!std::isfinite(next_s)) return text;
    text += row_of(feeds, next_s);
  }
}

bool is_track_csv(std::string_view head) {
  int lines = 0;
  static_cast<void>(taken_settings(head, lines));
  const std::string_view header = next_line(head);
  if (header.find(',') == std::string_view::npos || header.find('\0') != std::string_view::npos) return false;
  const std::vector<std::string> names = names_of(header);
  if (index_of(names, "time_s") < 0 && index_of(names, "frame") < 0) return false;
  bool any = false;
  const Track none;
  for_each_channel(none, [&](std::string_view channel, const auto&) {
    for (const std::string& column : csv_columns(channel)) any = any || index_of(names, column) >= 0;
  });
  return any;
}

Result<Track> track_of_csv(std::string_view text, const std::filesystem::path& file, const std::atomic<bool>* cancel) {
  return Reader(file, cancel).read(text);
}

}  // namespace sigs
