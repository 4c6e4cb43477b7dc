// SPDX-License-Identifier: MIT
#include "encounter_model/model_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "base/text.h"
#include "plot/plot.h"

namespace sigs {

namespace {

struct Meaning {
  const char* label;
  const char* what;
};

// The labels of the published files.
constexpr std::array<Meaning, 7> kMeanings{{{"G", "geographic domain"},
                                            {"A", "airspace class"},
                                            {"L", "altitude, ft"},
                                            {"v", "speed, kt"},
                                            {"\\dot v", "acceleration, kt/s"},
                                            {"\\dot h", "vertical rate, ft/min"},
                                            {"\\dot \\psi", "turn rate, deg/s"}}};

std::string meaning_of(const std::string& label) {
  const auto found =
      std::find_if(kMeanings.begin(), kMeanings.end(), [&](const Meaning& meaning) { return label == meaning.label; });
  return found == kMeanings.end() ? "-" : found->what;
}

using Row = std::vector<std::string>;

std::string limits_text(const ModelVariable& variable) {
  if (variable.boundaries.empty()) return "category";
  std::vector<std::string> limits;
  for (const double limit : variable.boundaries) limits.push_back(short_number_text(limit));
  if (limits.size() <= 12) return listed(limits, " ");
  return limits.front() + " ... " + limits.back();
}

std::string parents_text(const CountTable& table, const EncounterModel& model) {
  if (table.bins == 0) return "does not change";
  std::vector<std::string> names;
  for (const int parent : table.parents) {
    const auto at = static_cast<std::size_t>(parent);
    const bool is_next = at >= model.variables.size();
    const std::size_t variable = is_next ? static_cast<std::size_t>(model.next_of[at - model.variables.size()]) : at;
    names.push_back(model.variables[variable].label + (is_next ? "(t+1)" : ""));
  }
  return names.empty() ? "none" : listed(names);
}

// The table that draws a variable a second later; an empty one where it does not change.
CountTable next_table(const EncounterModel& model, std::size_t variable) {
  for (std::size_t i = 0; i < model.next_of.size(); ++i)
    if (model.next_of[i] == static_cast<int>(variable)) return model.transition.tables[model.variables.size() + i];
  return {};
}

Row row_of(const EncounterModel& model, std::size_t at) {
  const ModelVariable& variable = model.variables[at];
  const bool has_zero = variable.zero_bin && !variable.boundaries.empty();
  return {variable.label,
          meaning_of(variable.label),
          std::to_string(variable.bins),
          limits_text(variable),
          has_zero ? std::to_string(*variable.zero_bin + 1) : "-",
          variable.resample_rate > 0 ? number_text(1 / variable.resample_rate, 1) : "-",
          parents_text(model.initial.tables[at], model),
          parents_text(next_table(model, at), model)};
}

std::string table_text(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text.append(widths[i - 1] - columns_of(row[i - 1]) + 2, ' ');
      text.append(row[i]);
    }
    text.append("\n");
  }
  return text;
}

std::string network_text(const CountNetwork& network) {
  double counts = 0;
  std::size_t parameters = 0;
  std::size_t configurations = 0;
  std::size_t never_counted = 0;
  for (const CountTable& table : network.tables) {
    parameters += table.parameters();
    for (std::size_t begin = 0; begin < table.counts.size(); begin += static_cast<std::size_t>(table.bins)) {
      double sum = 0;
      for (const double count : std::span(table.counts).subspan(begin, static_cast<std::size_t>(table.bins)))
        sum += count;
      counts += sum;
      ++configurations;
      never_counted += sum > 0 ? 0 : 1;
    }
  }
  return fmt::format("{} parameters, {} counts, {} of {} configurations never counted\n", parameters,
                     short_number_text(counts), never_counted, configurations);
}

}  // namespace

std::string model_report_text(const EncounterModel& model) {
  std::vector<Row> rows{{"variable", "meaning", "bins", "limits", "zero bin", "redrawn after, s", "parents at first",
                         "parents a second later"}};
  for (std::size_t i = 0; i < model.variables.size(); ++i) rows.push_back(row_of(model, i));
  return table_text(rows) + "first second: " + network_text(model.initial) +
         "each further second: " + network_text(model.transition);
}

std::string track_csv_header(const EncounterModel& model) {
  std::string line =
      "track,time_s,north_m,east_m,up_m,heading_deg,speed_mps,vertical_speed_mps,acceleration_mps2,turn_rate_degps";
  for (const ModelVariable& variable : model.variables)
    if (variable.boundaries.empty()) line.append(",").append(csv_field(variable.label));
  return line + "\n";
}

std::string track_csv_rows(const ModelFlight& track, int number, const EncounterModel& model) {
  std::string categories;
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    if (model.variables[i].boundaries.empty()) categories.append(",").append(number_text(track.initial_values[i], 0));
  std::string text;
  for (const SampledPoint& point : track.points) {
    const double heading_deg = deg_of_rad(point.heading_rad);
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{}{}\n", number, number_text(point.time_s, 6),
        number_text(point.position_neu_m.x, 4), number_text(point.position_neu_m.y, 4),
        number_text(point.position_neu_m.z, 4), number_text(heading_deg - 360 * std::floor(heading_deg / 360), 6),
        number_text(point.speed_mps, 6), number_text(point.vertical_speed_mps, 6),
        number_text(point.acceleration_mps2, 6), number_text(deg_of_rad(point.turn_rate_radps), 6), categories);
  }
  return text;
}

namespace {

// Colours all around the circle of hues, dark enough on white.
PlotColor color_of(std::size_t number, std::size_t count) {
  const double hue = 6 * static_cast<double>(number) / static_cast<double>(count);
  const auto part = [hue](double middle) {
    const double away = std::abs(std::remainder(hue - middle, 6.0));
    return static_cast<int>(std::lround(40 + 150 * std::clamp(2 - away, 0.0, 1.0)));
  };
  return {part(0), part(2), part(4)};
}

PlotPoint from_above(const SampledPoint& point) {
  return {point.position_neu_m.y, point.position_neu_m.x};
}
PlotPoint altitude(const SampledPoint& point) {
  return {point.time_s, point.position_neu_m.z};
}
PlotPoint speed(const SampledPoint& point) {
  return {point.time_s, point.speed_mps};
}
PlotPoint vertical_speed(const SampledPoint& point) {
  return {point.time_s, point.vertical_speed_mps};
}

Plot plot_of(const std::vector<ModelFlight>& tracks, std::string title, PlotPoint (*place)(const SampledPoint&)) {
  Plot plot{.title = std::move(title), .x_label = "time, s", .height = 270};
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    PlotSeries& line = plot.series.emplace_back();
    line.color = color_of(i, tracks.size());
    std::vector<PlotPoint>& run = line.runs.emplace_back();
    for (const SampledPoint& point : tracks[i].points) run.push_back(place(point));
  }
  plot.x_range = range_of(plot.series, &PlotPoint::x, 0.04);
  plot.y_range = range_of(plot.series, &PlotPoint::y, 0.04);
  return plot;
}

}  // namespace

cv::Mat flights_plot(const std::vector<ModelFlight>& tracks) {
  Plot map = plot_of(tracks, "from above, north up; dots: the flights' ends", from_above);
  map.x_label = "m east";
  map.y_label = "m north";
  map.same_scale = true;
  map.height = 620;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    map.series.push_back({.runs = {{from_above(tracks[i].points.back())}}, .color = color_of(i, tracks.size())});
  return image_of({map, plot_of(tracks, "altitude, m", altitude), plot_of(tracks, "speed over the ground, m/s", speed),
                   plot_of(tracks, "vertical speed, m/s", vertical_speed)});
}

}  // namespace sigs
