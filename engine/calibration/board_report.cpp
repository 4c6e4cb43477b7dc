// SPDX-License-Identifier: MIT
#include "calibration/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/text.h"
#include "plot/plot.h"

namespace sigs {

namespace {

const char* kind_name(BoardKind kind) {
  return kind == BoardKind::charuco ? "charuco" : "chessboard";
}

Json number_or_null(double number) {
  return std::isfinite(number) ? Json(number) : Json();
}

Json model_json(const CalibratedModel& model) {
  Json sd;
  for (const double number : model.sd) sd.push_back(number_or_null(number));
  return {{"model", name_of(model.model)},
          {"fx_px", model.lens.fx},
          {"fy_px", model.lens.fy},
          {"cx_px", model.lens.cx},
          {"cy_px", model.lens.cy},
          {"coefficients", model.lens.coefficients},
          {"sd", sd},
          {"rms_px", number_or_null(model.rms_px)},
          {"held_out_px", number_or_null(model.held_out_px)}};
}

Json view_json(const CalibratedView& view) {
  return {{"name", view.name},
          {"used", view.is_used},
          {"corners", view.corners},
          {"corners_left_out", view.corners_left_out},
          {"error_px", number_or_null(view.error_px)},
          {"edge_px", view.edge_px},
          {"tilt_deg", view.tilt_deg},
          {"distance_m", view.distance_m}};
}

}  // namespace

std::string board_report_text(const BoardCalibration& calibration) {
  std::string text = fmt::format("  {:<16} {:>9} {:>11} {:>20} {:>20} {:>9} {:>9}\n", "model", "error px",
                                 "held out px", "fx px", "fy px", "cx px", "cy px");
  for (std::size_t i = 0; i < calibration.models.size(); ++i) {
    const CalibratedModel& model = calibration.models[i];
    const auto with_sd = [&](double value, int k) {
      return fixed_text(value, 2) + " +- " + fixed_text(model.sd[static_cast<std::size_t>(k)], 2);
    };
    text += fmt::format("{} {:<16} {:>9} {:>11} {:>20} {:>20} {:>9} {:>9}\n", i == calibration.chosen ? "*" : " ",
                        name_of(model.model), fixed_text(model.rms_px, 3), fixed_text(model.held_out_px, 3),
                        with_sd(model.lens.fx, 0), with_sd(model.lens.fy, 1), fixed_text(model.lens.cx, 2),
                        fixed_text(model.lens.cy, 2));
  }
  return text;
}

std::string board_report_json(const BoardCalibration& calibration, const CalibrationBoard& board) {
  Json report;
  report["width_px"] = calibration.size_px.width;
  report["height_px"] = calibration.size_px.height;
  report["board"] = {{"kind", kind_name(board.kind)},
                     {"columns", board.corners.width},
                     {"rows", board.corners.height},
                     {"square_m", board.square_m}};
  report["chosen"] = name_of(calibration.best().model);
  for (const CalibratedModel& model : calibration.models) report["models"].push_back(model_json(model));
  for (const CalibratedView& view : calibration.views) report["views"].push_back(view_json(view));
  report["warnings"] = Json::array();
  for (const Warning& warning : calibration.warnings) report["warnings"].push_back(warning.text());
  return json_text(report);
}

CalibrationText calibration_text_of(const BoardCalibration& calibration, const CalibrationBoard& board) {
  const CalibratedModel& best = calibration.best();
  return {.lens = best.lens,
          .size_px = calibration.size_px,
          .comment = fmt::format("{} with a {} of {} inner corners, {}", name_of(best.model), kind_name(board.kind),
                                 image_size_text(board.corners), count_text(calibration.views_used(), "view")),
          .numbers = {{"avg_reprojection_error", best.rms_px},
                      {"held_out_error_px", best.held_out_px},
                      {"nframes", calibration.views_used()},
                      {"square_size", board.square_m},
                      {"fx_sd_px", best.sd[0]},
                      {"fy_sd_px", best.sd[1]},
                      {"cx_sd_px", best.sd[2]},
                      {"cy_sd_px", best.sd[3]}}};
}

namespace {

constexpr double kPanelWidth = 620, kPanelHeight = 480;
constexpr int kCells = 16;  // of the image's width
constexpr PlotColor kArrow{20, 80, 170}, kOut{220, 60, 60}, kFaint{215, 215, 215};
constexpr std::array<PlotColor, 4> kModelColors{{{150, 150, 150}, {20, 90, 200}, {40, 140, 40}, {220, 100, 30}}};

// A panel over the image, x to the right and y down, with the image's border.
Plot image_panel(cv::Size size_px) {
  const double right = size_px.width - 0.5, bottom = size_px.height - 0.5;
  const PlotSeries border{.runs = {{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}, {-0.5, -0.5}}},
                          .color = PlotColor{90, 90, 90}};
  return {.x_label = "x, px",
          .x_range = {-0.5, right},
          .y_range = {bottom, -0.5},
          .series = {border},
          .same_scale = true,
          .width = kPanelWidth,
          .height = kPanelHeight};
}

// Sums over square cells of the image.
struct Cell {
  cv::Point2d at{0, 0};
  cv::Point2d off{0, 0};
  int count = 0;
};

int cell_rows(cv::Size size_px) {
  return std::max(1, cvRound(static_cast<double>(kCells) * size_px.height / size_px.width));
}

std::vector<Cell> cells_of(const CalibratedModel& model, cv::Size size_px) {
  const int rows = cell_rows(size_px);
  std::vector<Cell> cells(static_cast<std::size_t>(kCells) * static_cast<std::size_t>(rows));
  for (const CornerResidual& corner : model.residuals) {
    const int x = std::clamp(static_cast<int>((corner.at_px.x + 0.5) / size_px.width * kCells), 0, kCells - 1);
    const int y = std::clamp(static_cast<int>((corner.at_px.y + 0.5) / size_px.height * rows), 0, rows - 1);
    Cell& cell = cells[static_cast<std::size_t>(y * kCells + x)];
    cell.at += corner.at_px;
    cell.off += corner.off_px;
    ++cell.count;
  }
  for (Cell& cell : cells)
    if (cell.count > 0) {
      cell.at /= cell.count;
      cell.off /= cell.count;
    }
  return cells;
}

// A round factor by which arrows are lengthened, so that the longest is about as long as a cell.
double arrow_factor(const std::vector<Cell>& cells, double cell_px) {
  double longest = 1e-6;
  for (const Cell& cell : cells) longest = std::max(longest, std::hypot(cell.off.x, cell.off.y));
  const double most = cell_px / longest;
  const double power = std::pow(10, std::floor(std::log10(most)));
  return most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
}

// A line to the end of an arrow, and its head.
std::vector<PlotPoint> arrow(const cv::Point2d& from, const cv::Point2d& way) {
  const cv::Point2d to = from + way, across(-way.y, way.x);
  const cv::Point2d left = to - 0.3 * way + 0.2 * across, right = to - 0.3 * way - 0.2 * across;
  return {{from.x, from.y}, {to.x, to.y}, {left.x, left.y}, {to.x, to.y}, {right.x, right.y}};
}

Plot arrows_plot(const BoardCalibration& calibration) {
  const CalibratedModel& best = calibration.best();
  const std::vector<Cell> cells = cells_of(best, calibration.size_px);
  const double factor = arrow_factor(cells, static_cast<double>(calibration.size_px.width) / kCells);
  PlotSeries corners{.title = "corners", .kind = SeriesKind::areas, .color = kFaint};
  PlotSeries arrows{.title = short_number_text(factor) + " times as long", .color = kArrow};
  PlotSeries middle{
      .title = "principal point", .runs = {{{best.lens.cx, best.lens.cy}}}, .kind = SeriesKind::marks, .color = kOut};
  const double dot_px = calibration.size_px.width / kPanelWidth;
  for (const CornerResidual& corner : best.residuals)
    corners.runs.push_back(
        {{corner.at_px.x - dot_px, corner.at_px.y - dot_px}, {corner.at_px.x + dot_px, corner.at_px.y + dot_px}});
  for (const Cell& cell : cells)
    if (cell.count > 0) arrows.runs.push_back(arrow(cell.at, factor * cell.off));
  Plot plot = image_panel(calibration.size_px);
  plot.title = std::string("residuals of ") + name_of(best.model) + ", means of cells";
  plot.remark = "error " + fixed_text(best.rms_px, 3) + " px, held out " + fixed_text(best.held_out_px, 3) + " px";
  for (PlotSeries* const series : {&corners, &arrows, &middle}) plot.series.push_back(std::move(*series));
  return plot;
}

// A shade for each number of corners in a cell, from none (red) and few (pale) to the most (dark).
PlotColor shade_of(int count, int most) {
  if (count == 0) return {250, 215, 215};
  const double share = std::sqrt(static_cast<double>(count) / most);
  return {cvRound(225 - 185 * share), cvRound(240 - 140 * share), cvRound(250 - 60 * share)};
}

Plot coverage_panel(const BoardCalibration& calibration) {
  const int rows = cell_rows(calibration.size_px);
  const std::vector<Cell> cells = cells_of(calibration.best(), calibration.size_px);
  std::map<int, PlotSeries> by_count;
  const auto edge = [&](int column, int row) {
    return PlotPoint{static_cast<double>(column) * calibration.size_px.width / kCells - 0.5,
                     static_cast<double>(row) * calibration.size_px.height / rows - 0.5};
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < kCells; ++x)
      by_count[cells[static_cast<std::size_t>(y * kCells + x)].count].runs.push_back({edge(x, y), edge(x + 1, y + 1)});
  const int most = std::max(1, by_count.rbegin()->first);
  const std::size_t bare = by_count.contains(0) ? by_count[0].runs.size() : 0;
  Plot plot = image_panel(calibration.size_px);
  plot.title = "corners seen in each cell";
  plot.remark =
      fmt::format("{} of {} cells bare; {}", bare, cells.size(), count_text(calibration.views_used(), "view"));
  for (auto& [count, series] : by_count) {
    series.kind = SeriesKind::areas;
    series.color = shade_of(count, most);
    if (count <= 1 || count == most) series.title = count == 0 ? "none" : count_text(count, "corner");
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// Root mean squares of rings around the principal point, of equal widths.
std::vector<PlotPoint> rings_of(const CalibratedModel& model, double largest_px) {
  constexpr int kRings = 20;
  std::vector<double> squares(kRings, 0);
  std::vector<int> counts(kRings, 0);
  for (const CornerResidual& corner : model.residuals) {
    const double radius_px = std::hypot(corner.at_px.x - model.lens.cx, corner.at_px.y - model.lens.cy);
    const auto ring = static_cast<std::size_t>(std::clamp(static_cast<int>(radius_px / largest_px * kRings), 0, 19));
    squares[ring] += corner.off_px.ddot(corner.off_px);
    ++counts[ring];
  }
  std::vector<PlotPoint> line;
  for (int i = 0; i < kRings; ++i)
    if (counts[static_cast<std::size_t>(i)] >= 5)
      line.push_back({(i + 0.5) / kRings * largest_px,
                      std::sqrt(squares[static_cast<std::size_t>(i)] / counts[static_cast<std::size_t>(i)])});
  return line;
}

Plot radius_plot(const BoardCalibration& calibration) {
  const double largest_px = std::hypot(calibration.size_px.width, calibration.size_px.height) / 2;
  Plot plot{.title = "rms of the residuals, px",
            .x_label = "distance from the principal point, px",
            .x_range = {0, largest_px},
            .width = kPanelWidth,
            .height = kPanelHeight};
  for (std::size_t i = 0; i < calibration.models.size(); ++i) {
    const CalibratedModel& model = calibration.models[i];
    plot.series.push_back({.title = std::string(i == calibration.chosen ? "* " : "") + name_of(model.model),
                           .runs = {rings_of(model, largest_px)},
                           .color = kModelColors[static_cast<std::size_t>(model.model)]});
  }
  // A model that misses by much would press the others to the axis.
  const double most = 1.1 * range_of(plot.series, &PlotPoint::y, 0).last;
  plot.y_range = {0, std::clamp(most, 1e-3, 3 * std::max(calibration.best().rms_px, 1e-3))};
  return plot;
}

Plot views_plot(const BoardCalibration& calibration) {
  double largest = 1e-3;
  for (const CalibratedView& view : calibration.views)
    if (view.is_used) largest = std::max(largest, view.error_px);
  const double most = 2.5 * largest;
  PlotSeries used{.title = "used", .kind = SeriesKind::areas, .color = kArrow};
  PlotSeries unused{.title = "not used, cut off where larger", .kind = SeriesKind::areas, .color = kOut};
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const CalibratedView& view = calibration.views[i];
    const double error = std::isfinite(view.error_px) ? std::min(view.error_px, most) : most;
    const auto left = static_cast<double>(i);
    (view.is_used ? used : unused).runs.push_back({{left + 0.15, error}, {left + 0.85, 0}});
  }
  return {.title = "error of each view, px",
          .x_label = "view",
          .x_range = {0, static_cast<double>(calibration.views.size())},
          .y_range = {0, most},
          .series = {std::move(used), std::move(unused)},
          .width = kPanelWidth,
          .height = kPanelHeight};
}

}  // namespace

cv::Mat board_plot(const BoardCalibration& calibration) {
  return image_of(
      {arrows_plot(calibration), coverage_panel(calibration), radius_plot(calibration), views_plot(calibration)}, 2);
}

}  // namespace sigs
