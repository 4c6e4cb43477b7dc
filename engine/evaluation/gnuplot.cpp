// SPDX-License-Identifier: MIT
#include "evaluation/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "labels/label_text.h"

namespace sigs {

namespace {

// Okabe and Ito, "Color universal design" (2008), without yellow, which is hard to see on white.
constexpr std::array<std::string_view, 7> kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                  "#E69F00", "#56B4E9", "#000000"};
constexpr std::array<std::string_view, 5> kDashes{"solid", "(10,4)", "(3,3)", "(12,4,3,4)", "(16,4,3,4,3,4)"};
constexpr std::array<int, 7> kMarks{7, 5, 9, 13, 11, 2, 3};

// gnuplot runs nothing within single quotes. It reads a doubled quote as one in some places alone, so a quote in a name
// becomes an apostrophe.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : line_text(text)) out += c == '\'' ? std::string("\xE2\x80\x99") : std::string(1, c);
  return out + "'";
}

std::string range_text(const PlotSpan& range) {
  return fmt::format("[{}:{}]", exact_text(range.first), exact_text(range.last));
}

std::string terminal(const Plot& plot, PlotFormat kind) {
  if (kind == PlotFormat::svg)
    return fmt::format(
        "set terminal svg noenhanced size 960,500 font 'DejaVu Sans,Verdana,Arial,sans-serif,13' background '#ffffff' "
        "name {}\n",
        quoted(plot.name));
  return "if (strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal pngcairo noenhanced size 1440,750 fontscale 1.2 "
         "linewidth 1.5 background '#ffffff' } else { set terminal png noenhanced size 1440,750 }\n";
}

std::string blocks(const PlotSeries& series, std::size_t number) {
  std::string lines = fmt::format("$runs{} << END\n", number);
  std::string lone = fmt::format("$lone{} << END\n", number);
  for (const std::vector<PlotPoint>& run : series.runs) {
    const bool is_isolated = series.is_scatter || run.size() == 1;  // a line needs two
    for (const PlotPoint& point : run)
      (is_isolated ? lone : lines) += fmt::format("{} {}\n", exact_text(point.x), exact_text(point.y));
    if (!is_isolated) lines += "\n";
  }
  return fmt::format("{}END\n{}END\n", lines, lone);
}

bool has_lines(const PlotSeries& series) {
  return !series.is_scatter &&
         std::any_of(series.runs.begin(), series.runs.end(), [](const auto& r) { return r.size() > 1; });
}

bool has_isolated_points(const PlotSeries& series) {
  return std::any_of(series.runs.begin(), series.runs.end(),
                     [&](const auto& run) { return run.size() == 1 || (series.is_scatter && !run.empty()); });
}

// A series and its entry in the key, which it has even where it has no points.
std::string plot_entries(const PlotSeries& series, std::size_t number) {
  const std::string color = fmt::format(" linecolor rgb '{}'", kColors[number % kColors.size()]);
  const std::size_t dash = (number + number / kColors.size()) % kDashes.size();
  const std::string line = fmt::format(" with lines linewidth 2 dashtype {}{}", kDashes[dash], color);
  const int mark = kMarks[(number + number / kColors.size()) % kMarks.size()];
  const std::string points = fmt::format(" with points pointsize {} pointtype {} linewidth 2{}",
                                         series.is_scatter ? "1.4" : "0.4", series.is_scatter ? mark : 7, color);
  std::string text =
      fmt::format(", \\\n  keyentry{} title {}", series.is_scatter ? points : line, quoted(series.title));
  const std::string n = std::to_string(number);
  if (has_lines(series)) text += fmt::format(", \\\n  $runs{} using 1:2{} notitle", n, line);
  if (has_isolated_points(series)) text += fmt::format(", \\\n  $lone{} using 1:2{} notitle", n, points);
  return text;
}

// Ticks beside 0, from it outwards; one too near the previous one for both labels to be read is left out.
std::vector<double> symlog_ticks(const PlotSpan& range) {
  constexpr double kMinTickGap = 0.035;  // of the axis; about a label's height
  const auto place = [](double value) { return std::asinh(value / 10); };
  const double gap = kMinTickGap * (place(range.last) - place(range.first));
  std::vector<double> ticks;
  double last = 0;
  for (const double tick : {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000}) {
    if (place(tick) - last < gap) continue;
    last = place(tick);
    if (tick <= range.last) ticks.push_back(tick);
    if (-tick >= range.first) ticks.push_back(-tick);
  }
  return ticks;
}

std::string axes(const Plot& plot) {
  std::string text =
      fmt::format("set title {}\nset xlabel {}\nset ylabel {}\nset xrange {}\nset yrange {}\n", quoted(plot.title),
                  quoted(plot.x_label), quoted(plot.y_label), range_text(plot.x_range), range_text(plot.y_range));
  if (plot.y_scale == PlotScale::symlog) {
    text += "set nonlinear y via asinh(y/10.) inverse 10.*sinh(y)\nset ytics (0";
    for (const double tick : symlog_ticks(plot.y_range)) text.append(",").append(exact_text(tick));
    text += ")\n";
  }
  int object = 0;
  for (const PlotSpan& span : plot.shaded)
    text += fmt::format(
        "set object {} rectangle from first {}, graph 0 to first {}, graph 1 fillcolor rgb '#ececec' fillstyle solid "
        "noborder behind\n",
        ++object, exact_text(span.first), exact_text(span.last));
  return text;
}

}  // namespace

std::string gnuplot_program(const Plot& plot, PlotFormat kind) {
  std::string text = fmt::format(
      "set encoding utf8\n{}{}"
      "set grid linecolor rgb '#d0d0d0' linewidth 1 dashtype solid\nset border linecolor rgb '#404040'\n"
      "set key below left Left reverse samplen 4 width 2 spacing 1.2\nset tics nomirror\n",
      terminal(plot, kind), axes(plot));
  for (std::size_t i = 0; i < plot.series.size(); ++i) text += blocks(plot.series[i], i);
  text += "plot NaN notitle";
  for (std::size_t i = 0; i < plot.series.size(); ++i) text += plot_entries(plot.series[i], i);
  return text + "\n";
}

namespace {

namespace fs = std::filesystem;

// A folder for the files of one run, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code code;
    const fs::path all = fs::temp_directory_path(code);
    std::string name = (all / "sigs-plot-XXXXXX").string();
    if (!code && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code code;
    if (!path_.empty()) fs::remove_all(path_, code);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }  // empty: none could be created

 private:
  fs::path path_;
};

constexpr int kCommandNotFound = 127;  // what a child that cannot be started ends with

// Exit status; errno as a negative number where it could not be started.
int run(const fs::path& program, const fs::path& out, const fs::path& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), kFlags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), kFlags, 0600);
  std::string name = "gnuplot";
  std::string own_settings = "-d";  // gnuplot's own, not the user's
  std::string file = program.string();
  char* const arguments[] = {name.data(), own_settings.data(), file.data(), nullptr};
  pid_t child = 0;
  const int code = posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0) return -code;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -errno;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

// Its error message, on one line.
std::string error_line(const fs::path& err) {
  std::string text = read_text(err).value_or("");
  text.erase(0, text.find_first_not_of("\n "));
  const std::size_t place = text.find("line ");
  return place == std::string::npos ? text.substr(0, text.find('\n'))
                                    : text.substr(place, text.find('\n', place) - place);
}

}  // namespace

Result<std::string> gnuplot_output(const std::string& program) {
  const TemporaryFolder scratch;
  if (scratch.path().empty())
    return fail("gnuplot", "no temporary folder can be made, no plots are drawn: set TMPDIR to one",
                ErrorKind::unavailable);
  const fs::path file = scratch.path() / "plot.gp";
  if (const Result<void> written = write_text(file, program, true); !written) return fail(written.error());
  const int status = run(file, scratch.path() / "image", scratch.path() / "messages");
  if (status == -ENOENT || status == kCommandNotFound)
    return fail("gnuplot", "is not installed, no plots are drawn", ErrorKind::unavailable);
  if (status < 0)
    return fail("gnuplot", std::string("cannot be started: ") + std::strerror(-status), ErrorKind::unavailable);
  if (status != 0) return fail("gnuplot", "fails: " + error_line(scratch.path() / "messages"));
  Result<std::string> image = read_text(scratch.path() / "image");
  if (image && image->empty()) return fail("gnuplot", "drew nothing: " + error_line(scratch.path() / "messages"));
  return image;
}

}  // namespace sigs
