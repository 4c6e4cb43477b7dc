// SPDX-License-Identifier: MIT
// The plots of docs/ from the tables that the scripts of this folder make: bench/README.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/image_codecs.h"
#include "base/text.h"
#include "plot/plot.h"

namespace sigs::bench {
namespace {

namespace fs = std::filesystem;

constexpr PlotColor kDirect4{9, 105, 218}, kDirect1{108, 182, 255}, kClassic{207, 91, 0}, kPlain{130, 80, 223},
    kGreen{26, 127, 55}, kGrey{140, 149, 159}, kInk{48, 54, 61};
// Of lenses.
constexpr PlotColor kHues[] = {kDirect4, kClassic, kGreen, kPlain, {191, 57, 137}, {154, 103, 0}};

[[noreturn]] void stop(const std::string& why) {
  std::fprintf(stderr, "error: %s\n", why.c_str());
  std::exit(1);
}

// A row of a table: its fields by their columns' names.
using Row = std::map<std::string, std::string>;
using Filter = std::function<bool(const Row&)>;

std::vector<Row> rows_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> names;
  for (const std::string_view name : csv_fields(line)) names.emplace_back(name);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string_view> fields = csv_fields(line);
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), fields.size()); ++i) row[names[i]] = fields[i];
  }
  if (rows.empty()) stop(file.string() + ": no rows");
  return rows;
}

double number(const Row& row, const std::string& column) {
  return parsed_number(row.at(column)).value_or(std::nan(""));
}

// The rows that the filter lets through, as points; those without a number are left out.
//   factor  of y
PlotSeries series_of(const std::vector<Row>& rows, PlotSeries style, const std::string& x, const std::string& y,
                     const Filter& filter = {}, double factor = 1) {
  style.runs = {{}};
  for (const Row& row : rows) {
    const PlotPoint point{number(row, x), factor * number(row, y)};
    if ((!filter || filter(row)) && std::isfinite(point.x) && std::isfinite(point.y))
      style.runs.front().push_back(point);
  }
  return style;
}

PlotSeries marked(std::string title, PlotColor color) {
  return {.title = std::move(title), .kind = SeriesKind::marked_line, .color = color};
}

// An empty diagram with both axes logarithmic.
Plot log_panel(std::string title, std::string x_label, std::string y_label, PlotSpan x, PlotSpan y, double width,
               double height) {
  return {.title = std::move(title),
          .x_label = std::move(x_label),
          .y_label = std::move(y_label),
          .x_range = x,
          .y_range = y,
          .x_scale = PlotScale::log,
          .y_scale = PlotScale::log,
          .width = width,
          .height = height};
}

// The key of several panels, which have none themselves.
Plot key_of(std::vector<PlotSeries> series, double width) {
  return {.series = std::move(series), .width = width, .height = 0};
}

void without_titles(Plot& plot) {
  for (PlotSeries& series : plot.series) series.title.clear();
}

std::vector<std::string> different(const std::vector<Row>& rows, const std::string& column) {
  std::vector<std::string> values;
  for (const Row& row : rows)
    if (std::find(values.begin(), values.end(), row.at(column)) == values.end()) values.push_back(row.at(column));
  return values;
}

// Error against run time, a panel a scene.
cv::Mat frames_plot(const fs::path& folder) {
  const std::vector<Row> frames = rows_of(folder / "frames.csv");
  const Row machine = rows_of(folder / "machine.csv").front();
  std::vector<Plot> panels;
  for (const Row& scene : rows_of(folder / "scenes.csv")) {
    Plot panel = log_panel(scene.at("title"), "ms a frame", "RMSE, codes", {1, 600}, {0.008, 60}, 420, 300);
    const auto way = [&](const std::string& method, const std::string& samples) {
      return [&scene, method, samples](const Row& row) {
        return row.at("scene") == scene.at("scene") && row.at("method") == method && row.at("samples") == samples;
      };
    };
    const auto add = [&](PlotSeries style, const Filter& filter) {
      panel.series.push_back(series_of(frames, std::move(style), "total_ms", "rmse", filter));
    };
    add({.title = "plain", .kind = SeriesKind::marks, .color = kPlain}, way("plain", "4"));
    add(marked("classic", kClassic), way("classic", "4"));
    add(marked("direct, 1 sample a pixel", kDirect1), way("direct", "1"));
    add(marked("direct, 4 samples a pixel (numbers: supersampling)", kDirect4), way("direct", "4"));
    add({.title = "the default", .kind = SeriesKind::marks, .color = kInk}, [&](const Row& row) {
      return way("direct", machine.at("samples"))(row) && row.at("supersampling") == machine.at("supersampling");
    });
    for (const Row& row : frames) {
      if (way("direct", "4")(row))
        panel.notes.push_back({{number(row, "total_ms"), number(row, "rmse")}, row.at("supersampling")});
      if (row.at("scene") == scene.at("scene") && row.at("method") == "rounded")
        panel.levels.push_back(number(row, "rmse"));
    }
    panels.push_back(std::move(panel));
  }
  std::vector<PlotSeries> key = panels.front().series;
  key.push_back({.title = "dashed: the truth, rounded to 8 bits", .color = kGrey});
  for (Plot& panel : panels) without_titles(panel);
  panels.push_back(key_of(std::move(key), 4 * 420));
  return image_of(panels, 4);
}

// Milliseconds by the intruder's size, and how many times faster.
cv::Mat sizes_plot(const fs::path& folder) {
  const std::vector<Row> sizes = rows_of(folder / "sizes.csv");
  Plot times = log_panel("time of a frame of 1280 x 960", "size of the intruder, px", "ms a frame", {0.8, 500},
                         {0.1, 1000}, 700, 480);
  times.series = {series_of(sizes, marked("classic", kClassic), "size_px", "classic_ms"),
                  series_of(sizes, marked("direct", kDirect4), "size_px", "direct_ms"),
                  series_of(sizes, {.title = "of it drawing (OpenGL)", .color = kDirect1}, "size_px", "direct_draw_ms"),
                  series_of(sizes, {.title = "of it compositing", .color = kGreen}, "size_px", "direct_composite_ms")};
  Plot ratio =
      log_panel("classic's time over direct's", "size of the intruder, px", "times", {0.8, 500}, {1, 300}, 700, 480);
  ratio.remark = "dashed: 20 times, wanted up to 100 px";
  ratio.levels = {20};
  ratio.series = {series_of(sizes, marked("", kDirect4), "size_px", "ratio")};
  return image_of({times, ratio}, 2);
}

// From a pixel to its ray: error against time, a panel a lens.
cv::Mat lens_plot(const fs::path& folder) {
  std::vector<Row> rows = rows_of(folder / "lens.csv");
  // An inverse that finds no ray has no error: it is drawn at the upper edge.
  for (Row& row : rows)
    if (!(number(row, "max_px") < 3e4)) row["max_px"] = "30000";
  std::vector<Plot> panels;
  for (const std::string& lens : different(rows, "lens")) {
    Plot panel = log_panel(lens, "ns a point", "largest error, px", {25, 6000}, {1e-15, 1e5}, 500, 380);
    const auto by = [&](const Filter& inverse) {
      return [&lens, inverse](const Row& row) { return row.at("lens") == lens && inverse(row); };
    };
    const auto add = [&](PlotSeries style, const Filter& inverse) {
      panel.series.push_back(series_of(rows, std::move(style), "ns_per_point", "max_px", by(inverse)));
    };
    add({.title = "Lens::ray", .kind = SeriesKind::marks, .color = kDirect4},
        [](const Row& row) { return row.at("inverse") == "Lens::ray"; });
    add(marked("OpenCV: 5, 20, 100 iterations", kClassic), [](const Row& row) {
      return row.at("inverse").starts_with("OpenCV") && row.at("inverse").find(" or ") == std::string::npos;
    });
    add({.title = "OpenCV: up to 100, until 1e-12", .kind = SeriesKind::marks, .color = kPlain},
        [](const Row& row) { return row.at("inverse").find(" or ") != std::string::npos; });
    panels.push_back(std::move(panel));
  }
  const Plot key = key_of(panels.front().series, 3 * 500);
  for (Plot& panel : panels) without_titles(panel);
  panels.push_back(key);
  return image_of(panels, 3);
}

// Tabulated rays: error against memory and against time, a curve a lens, a point a tolerance.
cv::Mat lens_table_plot(const fs::path& folder) {
  const std::vector<Row> rows = rows_of(folder / "lens_table.csv");
  const std::vector<std::string> lenses = different(rows, "lens");
  struct Quantity {
    const char* column;
    const char* label;
    PlotSpan range;
  };
  std::vector<Plot> panels;
  for (const Quantity& quantity :
       {Quantity{"kbytes", "kB kept, whole image", {5, 1e5}}, Quantity{"first_ns", "ns a ray, first time", {3, 6000}},
        Quantity{"evaluations", "evaluations of the lens a ray", {0.01, 2}}}) {
    Plot panel = log_panel("", quantity.label, "largest error, px", quantity.range, {1e-14, 10}, 500, 480);
    panel.levels = {1e-3};
    for (std::size_t i = 0; i < lenses.size(); ++i)
      panel.series.push_back(series_of(rows, marked(lenses[i], kHues[i % std::size(kHues)]), quantity.column, "max_px",
                                       [&](const Row& row) { return row.at("lens") == lenses[i]; }));
    panels.push_back(std::move(panel));
  }
  std::vector<PlotSeries> key = panels.front().series;
  key.push_back({.title = "dashed: the default tolerance", .color = kGrey});
  for (Plot& panel : panels) without_titles(panel);
  panels.push_back(key_of(std::move(key), 3 * 500));
  return image_of(panels, 3);
}

// Flights: time and error by the number of waypoints, condition by the legs' ratio.
cv::Mat spline_plot(const fs::path& folder) {
  const std::vector<Row> rows = rows_of(folder / "spline.csv");
  const std::vector<Row> condition = rows_of(folder / "condition.csv");
  const Filter even = [](const Row& row) { return number(row, "ratio") == 1; };
  const Filter uneven = [](const Row& row) { return number(row, "ratio") == 1000; };
  const auto line = [&](const char* title, PlotColor color, const char* y, const Filter& filter, double factor) {
    return series_of(rows, marked(title, color), "waypoints", y, filter, factor);
  };
  Plot times = log_panel("time, s", "waypoints", "", {7, 15000}, {1e-9, 10}, 500, 480);
  times.series = {line("making the flight", kClassic, "build_ms", even, 1e-3),
                  line("one pose", kDirect4, "pose_ns", even, 1e-9),
                  line("one position", kDirect1, "position_ns", even, 1e-9)};
  Plot errors = log_panel("largest error, against long double", "waypoints", "", {7, 15000}, {1e-17, 1e-8}, 500, 480);
  errors.series = {line("position, m; even legs", kDirect4, "position_error_m", even, 1),
                   line("position, m; every other leg 1000 times shorter", kDirect1, "position_error_m", uneven, 1),
                   line("nose, rad; even legs", kClassic, "nose_error_rad", even, 1),
                   line("nose, rad; 1000 times shorter", kPlain, "nose_error_rad", uneven, 1)};
  Plot numbers = log_panel("condition numbers", "long legs over short legs", "", {0.7, 1.5e5}, {1, 1e6}, 500, 480);
  numbers.series = {
      series_of(condition, marked("rows as in textbooks", kClassic), "ratio", "textbook"),
      series_of(condition, marked("rows as solved here", kDirect4), "ratio", "divided"),
      series_of(condition, marked("the curve itself, by its waypoints", kGreen), "ratio", "interpolation")};
  return image_of({times, errors, numbers}, 3);
}

// The own body's mask: its error by run time, and the run time by that of decoding alone.
cv::Mat own_body_plot(const fs::path& folder) {
  std::vector<Row> rows = rows_of(folder / "time.csv");
  double most = 0;
  for (Row& row : rows) {
    most = std::max(most, number(row, "frames"));
    row["error"] = std::to_string(std::max(1e-4, 1 - number(row, "iou")));
  }
  const auto by_frames = [](const char* method) -> Filter {
    return [method](const Row& row) {
      return row.at("method") == method && row.at("every") == "1" && number(row, "settled_percent") == 0;
    };
  };
  const Filter every = [most](const Row& row) {
    return row.at("method") == "stable" && number(row, "settled_percent") == 0 && number(row, "frames") == most;
  };
  const Filter settled = [](const Row& row) {
    return row.at("method") == "stable" && number(row, "settled_percent") > 0;
  };
  Plot errors = log_panel("what is wrong of the mask", "seconds, from the opened file to the mask",
                          "1 - intersection over union", {}, {0.001, 1.5}, 640, 480);
  errors.series = {series_of(rows, marked("paper, by frames", kClassic), "wall_s", "error", by_frames("paper")),
                   series_of(rows, marked("stable, by frames", kDirect4), "wall_s", "error", by_frames("stable")),
                   series_of(rows, marked("stable, every 1 to 16", kDirect1), "wall_s", "error", every),
                   series_of(rows, {.title = "stable, stopped early", .kind = SeriesKind::marks, .color = kPlain},
                             "wall_s", "error", settled)};
  const PlotSpan seconds = range_of(errors.series, &PlotPoint::x, 0);
  errors.x_range = {seconds.first / 1.5, seconds.last * 1.5};
  for (const Row& row : rows)
    if (by_frames("stable")(row))
      errors.notes.push_back({{number(row, "wall_s"), number(row, "error")}, row.at("frames")});
  Plot ratio = log_panel("beside decoding the same frames and nothing else", "frames", "seconds by decoding's seconds",
                         {40, 2000}, {}, 640, 480);
  ratio.remark = "dashed: 1.3, the goal";
  ratio.levels = {1.3};
  ratio.series = {
      series_of(rows, marked("paper", kClassic), "frames", "wall_ratio", by_frames("paper")),
      series_of(rows, marked("stable", kDirect4), "frames", "wall_ratio", by_frames("stable")),
      series_of(rows, marked("stable, processor time", kDirect1), "frames", "cpu_ratio", by_frames("stable"))};
  ratio.y_scale = PlotScale::linear;
  ratio.y_range = {0, range_of(ratio.series, &PlotPoint::y).last};
  return image_of({errors, ratio}, 2);
}

// Memory, descriptors and threads of one process by what it has done.
//   samples  the table: frames.csv, dataset.csv or editor.csv
cv::Mat endurance_plot(const fs::path& samples) {
  const std::vector<Row> rows = rows_of(samples);
  const std::string part = samples.stem().string();
  const std::string unit = part == "dataset" ? "videos" : part == "editor" ? "minutes" : "frames";
  const auto panel = [&](const char* title, std::vector<PlotSeries> series) {
    const PlotSpan x = range_of(series, &PlotPoint::x, 0);
    return Plot{.title = title,
                .x_label = unit,
                .x_range = {0, x.last},
                .y_range = {0, range_of(series, &PlotPoint::y).last},
                .series = std::move(series),
                .height = 260};
  };
  return image_of({panel("memory, MB",
                         {series_of(rows, {.title = "own memory", .color = kDirect4}, "done", "own_kb", {}, 1 / 1024.0),
                          series_of(rows, {.title = "resident, with files and libraries", .color = kGrey}, "done",
                                    "resident_kb", {}, 1 / 1024.0)}),
                   panel("descriptors and threads",
                         {series_of(rows, {.title = "descriptors", .color = kClassic}, "done", "descriptors"),
                          series_of(rows, {.title = "threads", .color = kGreen}, "done", "threads")})});
}

// Difference from `exact` against processor time, a panel a scene. What differs nowhere has no mark.
cv::Mat quality_plot(const fs::path& folder) {
  const std::vector<Row> rows = rows_of(folder / "quality.csv");
  std::vector<Plot> panels;
  for (const std::string& scene : different(rows, "scene")) {
    if (scene.find("400px") == std::string::npos && scene.find("filling") == std::string::npos) continue;
    const auto way = [&scene](const std::string& name, const std::string& samples) {
      return [&scene, name, samples](const Row& row) {
        return row.at("scene") == scene && row.at("way") == name && row.at("samples") == samples;
      };
    };
    const bool is_large = scene.find("filling") != std::string::npos;
    Plot panel = log_panel(scene, "processor ms a frame", "RMSE against exact, codes",
                           is_large ? PlotSpan{60, 4000} : PlotSpan{5, 300}, {0.01, 20}, 420, 300);
    const auto add = [&](PlotSeries style, const Filter& filter) {
      panel.series.push_back(series_of(rows, std::move(style), "cpu_ms", "rmse", filter));
    };
    add(marked("supersampling 1, 2, 4 everywhere", kDirect1), way("all alike", "1"));
    add(marked("the same with 4 samples: 1, 2", kClassic), way("all alike", "4"));
    add({.title = "auto", .kind = SeriesKind::marks, .color = kGreen}, way("auto", "1"));
    add({.title = "draft", .kind = SeriesKind::marks, .color = kPlain}, way("draft", "1"));
    panel.levels = {0.25};
    panels.push_back(std::move(panel));
  }
  std::vector<PlotSeries> key = panels.front().series;
  key.push_back({.title = "dashed: the bound of auto", .color = kGrey});
  for (Plot& panel : panels) without_titles(panel);
  panels.push_back(key_of(std::move(key), 4 * 420));
  return image_of(panels, 4);
}

struct NamedPlot {
  const char* name;
  cv::Mat (*draw)(const fs::path& tables);
};
constexpr NamedPlot kPlots[] = {{"frames", frames_plot},         {"sizes", sizes_plot},    {"lens", lens_plot},
                                {"lens_table", lens_table_plot}, {"spline", spline_plot},  {"own_body", own_body_plot},
                                {"endurance", endurance_plot},   {"quality", quality_plot}};

}  // namespace
}  // namespace sigs::bench

int main(int argc, char** argv) {
  using namespace sigs::bench;
  if (argc != 4) stop("bench_plots PLOT TABLES IMAGE.png; TABLES is a folder, or the table itself for endurance");
  for (const NamedPlot& plot : kPlots) {
    if (plot.name != std::string_view(argv[1])) continue;
    std::vector<unsigned char> png;
    sigs::image_codecs::imencode(".png", plot.draw(argv[2]), png);
    std::ofstream out(argv[3], std::ios::binary);
    if (!out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size())))
      stop(std::string(argv[3]) + ": cannot be written");
    return 0;
  }
  stop(std::string(argv[1]) + ": no such plot");
}
