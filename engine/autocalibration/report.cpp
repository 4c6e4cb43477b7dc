// SPDX-License-Identifier: MIT
#include "autocalibration/autocalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/pose.h"
#include "plot/plot.h"

namespace sigs {

namespace {

Json fit_json(const LensEstimate& fit) {
  return {{"horizontal_field_deg", deg_of_rad(fit.lens.horizontal_field_rad())},
          {"horizontal_field_low_deg", deg_of_rad(fit.field_low_rad)},
          {"horizontal_field_high_deg", deg_of_rad(fit.field_high_rad)},
          {"focal_px", fit.lens.focal_px},
          {"distortion", fit.lens.distortion},
          {"distortion_sd", fit.distortion_sd}};
}

Json answer_json(const LensAnswer& answer) {
  Json json = answer.fit ? fit_json(*answer.fit) : Json::object();
  json["used"] = answer.fit.has_value();
  json["remark"] = answer.reason;
  if (answer.fit && answer.fit->parts > 0) {
    json["independent_parts"] = answer.fit->parts;
    json["residual_px"] = answer.fit->residual_px;
  }
  return json;
}

Json gyro_json(const GyroAnswer& gyro) {
  Json json = answer_json(gyro.answer);
  if (gyro.source.empty()) return json;
  json["rates"] = gyro.source;
  json["correlation"] = gyro.correlation;
  json["offset_s"] = gyro.offset_s;
  json["offset_sd_s"] = gyro.offset_sd_s;
  return json;
}

}  // namespace

Result<CalibrationText> calibration_text(const Autocalibration& found) {
  Result<LensParameters> lens = parameters_of(found.fit.lens);
  if (!lens) return fail(lens.error());
  return CalibrationText{
      .lens = *std::move(lens),
      .size_px = found.fit.lens.size_px,
      .comment = "A rough calibration, without a board: " + summary_of(found),
      .numbers = {{"rough_calibration", 1},
                  {"horizontal_field_deg", deg_of_rad(found.fit.lens.horizontal_field_rad())},
                  {"horizontal_field_low_deg", deg_of_rad(found.fit.field_low_rad)},
                  {"horizontal_field_high_deg", deg_of_rad(found.fit.field_high_rad)},
                  {"radial_distortion_sd", found.fit.distortion_sd}},
  };
}

std::string summary_of(const Autocalibration& found) {
  const LensEstimate& fit = found.fit;
  const double field_deg = deg_of_rad(fit.lens.horizontal_field_rad());
  const std::string limits =
      fit.field_low_rad < fit.field_high_rad
          ? fmt::format(" (95 %: {:.1f} to {:.1f})", deg_of_rad(fit.field_low_rad), deg_of_rad(fit.field_high_rad))
          : std::string();
  return fmt::format(
      "field of view {:.1f} degrees across{}, focal length {:.1f} px, by {}; distortion {:.3f} +- {:.3f}", field_deg,
      limits, fit.lens.focal_px, name_of(found.source), fit.lens.distortion, fit.distortion_sd);
}

std::string json_of(const Autocalibration& found) {
  Json json{{"rough", true},
            {"source", found.source == AutocalibrationSource::given       ? "given"
                       : found.source == AutocalibrationSource::gyroscope ? "gyroscope"
                       : found.source == AutocalibrationSource::turn      ? "turn"
                                                                          : "stated"},
            {"width", found.fit.lens.size_px.width},
            {"height", found.fit.lens.size_px.height},
            {"frames", found.frames}};
  json["lens"] = fit_json(found.fit);
  json["gyroscope"] = gyro_json(found.gyro);
  json["turn"] = answer_json(found.turn);
  json["stated"] = answer_json(found.stated);
  json["warnings"] = Json::array();
  for (const Warning& warning : found.warnings) json["warnings"].push_back(warning.text());
  return json_text(json);
}

namespace {

constexpr PlotColor kMeasured{20, 90, 180}, kPinhole{120, 120, 120};

struct Row {
  std::string name;
  LensAnswer answer;
};

std::vector<Row> rows_of(const Autocalibration& found) {
  std::vector<Row> rows{{"gyroscope", found.gyro.answer}, {"turns", found.turn}, {"file states", found.stated}};
  if (found.source == AutocalibrationSource::given) rows.push_back({"--fov", {.fit = found.fit, .reason = {}}});
  return rows;
}

// A row for each source: its field of view with the limits, or why it has none.
Plot fields_plot(const Autocalibration& found) {
  const std::vector<Row> rows = rows_of(found);
  PlotSeries limits{.color = kMeasured};
  PlotSeries fields{.kind = SeriesKind::marks, .color = kMeasured};
  std::vector<PlotTick> names;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<double>(i);
    names.push_back({row, rows[i].name});
    if (!rows[i].answer.fit) continue;
    const LensEstimate& fit = *rows[i].answer.fit;
    limits.runs.push_back({{deg_of_rad(fit.field_low_rad), row}, {deg_of_rad(fit.field_high_rad), row}});
    fields.runs.push_back({{deg_of_rad(fit.lens.horizontal_field_rad()), row}});
  }
  PlotSpan degrees = range_of({limits, fields}, &PlotPoint::x, 0.1);
  degrees = {std::floor(degrees.first / 5 - 0.5) * 5, std::ceil(degrees.last / 5 + 0.5) * 5};
  Plot plot{.title = "horizontal field of view, degrees, with 95 % limits",
            .x_range = degrees,
            .y_range = {static_cast<double>(rows.size()) - 0.5, -0.5},
            .y_ticks = std::move(names),
            .height = 340};
  constexpr std::size_t kLine = 110;  // letters of a reason that fit
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!rows[i].answer.fit)
      plot.notes.push_back(
          {{(degrees.first + degrees.last) / 2, static_cast<double>(i)}, rows[i].answer.reason.substr(0, kLine)});
  plot.series = {std::move(limits), std::move(fields)};
  return plot;
}

PlotSeries angles_of(std::string title, const DivisionLens& lens, PlotColor color) {
  PlotSeries series{.title = std::move(title), .runs = {{}}, .color = color};
  for (int i = 0; i <= 200; ++i) {
    const double r_px = lens.radius_px() * i / 200;
    const double angle_rad =
        std::atan2(r_px, lens.focal_px * (1 + lens.distortion * std::pow(r_px / lens.radius_px(), 2)));
    series.runs.front().push_back({r_px, deg_of_rad(angle_rad)});
  }
  return series;
}

Plot curve_plot(const DivisionLens& lens) {
  DivisionLens pinhole = lens;
  pinhole.distortion = 0;
  const std::vector<PlotSeries> series{angles_of("a pinhole of the same focal length", pinhole, kPinhole),
                                       angles_of("the lens", lens, kMeasured)};
  return {.title = "angle from the axis, degrees",
          .x_label = "distance from the centre, px",
          .x_range = {0, lens.radius_px()},
          .y_range = {0, range_of(series, &PlotPoint::y).last},
          .series = series,
          .height = 400};
}

}  // namespace

cv::Mat autocalibration_plot(const Autocalibration& found) {
  return image_of({fields_plot(found), curve_plot(found.fit.lens)});
}

}  // namespace sigs
