// SPDX-License-Identifier: MIT
#include "calibration/autocalibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/pose.h"
#include "plot/plot.h"
#include "project/json_reading.h"

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
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

namespace {

constexpr double kMargin = 0.02;  // of an axis

// Its limits as a line, and the value as a mark upon it.
void add_row(Plot& plot, const std::string& name, const LensAnswer& answer, double row) {
  PlotSeries limits{.title = name + (answer.fit ? "" : ": " + answer.reason)};
  PlotSeries value{.title = name, .is_scatter = true};
  if (answer.fit) {
    const double low_deg = deg_of_rad(answer.fit->field_low_rad);
    const double high_deg = deg_of_rad(answer.fit->field_high_rad);
    limits.title += ", 95 %";
    limits.runs = {{{low_deg, row}, {high_deg, row}}};
    value.runs = {{{deg_of_rad(answer.fit->lens.horizontal_field_rad()), row}}};
    plot.x_range.first = std::min(plot.x_range.first, std::floor(low_deg - 2));
    plot.x_range.last = std::max(plot.x_range.last, std::ceil(high_deg + 2));
  }
  plot.series.push_back(std::move(limits));
  if (answer.fit) plot.series.push_back(std::move(value));
}

Plot fields_plot(const Autocalibration& found) {
  const double field_deg = deg_of_rad(found.fit.lens.horizontal_field_rad());
  std::vector<std::pair<std::string, LensAnswer>> rows{
      {"gyroscope", found.gyro.answer}, {"turns", found.turn}, {"file states", found.stated}};
  if (found.source == AutocalibrationSource::given) rows.push_back({"--fov", {.fit = found.fit, .reason = {}}});
  Plot plot{.title = "Field of view by each method",
            .x_label = "horizontal field of view [deg]",
            .y_label = "method, from the first in the key",
            .x_range = {std::floor(field_deg - 2), std::ceil(field_deg + 2)},
            .y_range = {0, static_cast<double>(rows.size()) + 1}};
  for (std::size_t i = 0; i < rows.size(); ++i)
    add_row(plot, rows[i].first, rows[i].second, static_cast<double>(rows.size() - i));
  return plot;
}

Plot angles_plot(const DivisionLens& lens) {
  constexpr int kSteps = 200;
  DivisionLens pinhole = lens;
  pinhole.distortion = 0;
  Plot plot{.title = "Angle from the axis",
            .x_label = "distance from the centre [px]",
            .y_label = "angle [deg]",
            .x_range = {0, lens.radius_px()},
            .series = {{.title = "this lens", .runs = {{}}}, {.title = "pinhole, same focal length", .runs = {{}}}}};
  for (int i = 0; i <= kSteps; ++i) {
    const double r_px = lens.radius_px() * i / kSteps;
    for (const auto& [by, series] : {std::pair(&lens, &plot.series[0]), {&pinhole, &plot.series[1]}}) {
      const double share = std::pow(r_px / by->radius_px(), 2);
      const double angle_deg = deg_of_rad(std::atan2(r_px, by->focal_px * (1 + by->distortion * share)));
      series->runs.front().push_back({r_px, angle_deg});
      plot.y_range.last = std::max(plot.y_range.last, angle_deg * (1 + kMargin));
    }
  }
  return plot;
}

}  // namespace

cv::Mat autocalibration_plot(const Autocalibration& found) {
  const cv::Mat fields = image_of(fields_plot(found));
  const cv::Mat angles = image_of(angles_plot(found.fit.lens));
  cv::Mat both;
  cv::vconcat(fields, angles, both);
  return both;
}

}  // namespace sigs
