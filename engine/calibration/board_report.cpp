// SPDX-License-Identifier: MIT
#include "calibration/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/text.h"
#include "plot/plot.h"
#include "project/json_reading.h"

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
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
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

constexpr int kPanel_px = 720;  // wide; two are as wide as a diagram of module plot
constexpr int kMargin_px = 24;
constexpr int kTop_px = 56;
constexpr int kCells = 16;  // of the image's width
const cv::Scalar kInk(60, 60, 60);
const cv::Scalar kFaint(150, 150, 150);
const cv::Scalar kArrow(170, 80, 20);
const cv::Scalar kOut(60, 60, 220);

// A panel that shows the image's area, as wide as fits.
class ImagePanel {
 public:
  ImagePanel(cv::Size size_px, const std::string& title, const std::string& remark)
      : scale_((kPanel_px - 2.0 * kMargin_px) / size_px.width),
        panel_(kTop_px + cvRound(size_px.height * scale_) + kMargin_px, kPanel_px, CV_8UC3, cv::Scalar::all(255)) {
    cv::putText(panel_, title, {kMargin_px, 22}, cv::FONT_HERSHEY_SIMPLEX, 0.55, kInk, 1, cv::LINE_AA);
    cv::putText(panel_, remark, {kMargin_px, 44}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kFaint, 1, cv::LINE_AA);
    cv::rectangle(panel_, {kMargin_px - 1, kTop_px - 1}, {kPanel_px - kMargin_px, panel_.rows - kMargin_px}, kFaint);
  }

  [[nodiscard]] cv::Point at(double x_px, double y_px) const {
    return {kMargin_px + cvRound((x_px + 0.5) * scale_), kTop_px + cvRound((y_px + 0.5) * scale_)};
  }

  cv::Mat& image() { return panel_; }

 private:
  double scale_;
  cv::Mat panel_;
};

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

cv::Mat arrows_panel(const BoardCalibration& calibration) {
  const CalibratedModel& best = calibration.best();
  const std::vector<Cell> cells = cells_of(best, calibration.size_px);
  const double factor = arrow_factor(cells, static_cast<double>(calibration.size_px.width) / kCells);
  ImagePanel panel(calibration.size_px, std::string("residuals of ") + name_of(best.model) + ", means of cells",
                   "arrows " + short_number_text(factor) + " times as long; error " + fixed_text(best.rms_px, 3) +
                       " px, held out " + fixed_text(best.held_out_px, 3) + " px");
  for (const CornerResidual& corner : best.residuals)
    cv::circle(panel.image(), panel.at(corner.at_px.x, corner.at_px.y), 1, {215, 215, 215}, cv::FILLED);
  for (const Cell& cell : cells)
    if (cell.count > 0)
      cv::arrowedLine(panel.image(), panel.at(cell.at.x, cell.at.y),
                      panel.at(cell.at.x + factor * cell.off.x, cell.at.y + factor * cell.off.y), kArrow, 1,
                      cv::LINE_AA, 0, 0.3);
  cv::drawMarker(panel.image(), panel.at(best.lens.cx, best.lens.cy), kOut, cv::MARKER_CROSS, 12);
  return panel.image();
}

cv::Mat coverage_panel(const BoardCalibration& calibration) {
  const int rows = cell_rows(calibration.size_px);
  const std::vector<Cell> cells = cells_of(calibration.best(), calibration.size_px);
  int most = 1;
  for (const Cell& cell : cells) most = std::max(most, cell.count);
  const auto bare = std::ranges::count(cells, 0, &Cell::count);
  ImagePanel panel(calibration.size_px, "corners seen, from 1 (pale) to " + std::to_string(most) + " (dark) a cell",
                   std::to_string(bare) + " of " + std::to_string(cells.size()) + " cells bare (red); " +
                       count_text(calibration.views_used(), "view"));
  const auto edge = [&](int column, int row) {
    return panel.at(static_cast<double>(column) * calibration.size_px.width / kCells - 0.5,
                    static_cast<double>(row) * calibration.size_px.height / rows - 0.5);
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < kCells; ++x) {
      const int count = cells[static_cast<std::size_t>(y * kCells + x)].count;
      const double share = std::sqrt(static_cast<double>(count) / most);
      const cv::Scalar color =
          count == 0 ? cv::Scalar(215, 215, 250) : cv::Scalar(250 - 60 * share, 240 - 140 * share, 225 - 185 * share);
      cv::rectangle(panel.image(), cv::Rect(edge(x, y), edge(x + 1, y + 1)), color, cv::FILLED);
    }
  return panel.image();
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
  Plot plot{.title = "Residuals by their place",
            .x_label = "distance from the principal point [px]",
            .y_label = "rms of the residuals [px]",
            .x_range = {0, largest_px}};
  for (std::size_t i = 0; i < calibration.models.size(); ++i) {
    const std::string name = name_of(calibration.models[i].model);
    plot.series.push_back({.title = i == calibration.chosen ? name + ", chosen" : name,
                           .runs = {rings_of(calibration.models[i], largest_px)}});
    for (const PlotPoint& point : plot.series.back().runs.front())
      plot.y_range.last = std::max(plot.y_range.last, 1.1 * point.y);
  }
  // A model that misses by much would press the others to the axis.
  plot.y_range.last = std::clamp(plot.y_range.last, 1e-3, 3 * std::max(calibration.best().rms_px, 1e-3));
  return plot;
}

Plot views_plot(const BoardCalibration& calibration) {
  double largest = 1e-3;
  for (const CalibratedView& view : calibration.views)
    if (view.is_used) largest = std::max(largest, view.error_px);
  const double most = 2.5 * largest;
  Plot plot{.title = "Error of each view; of those not used, at the upper border where it is larger",
            .x_label = "view",
            .y_label = "error [px]",
            .x_range = {-1, static_cast<double>(calibration.views.size())},
            .y_range = {0, 1.05 * most},
            .series = {{.title = "used", .runs = {{}}, .is_scatter = true},
                       {.title = "not used", .runs = {{}}, .is_scatter = true}}};
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const CalibratedView& view = calibration.views[i];
    const double error_px = std::isfinite(view.error_px) ? std::min(view.error_px, most) : most;
    plot.series[view.is_used ? 0 : 1].runs.front().push_back({static_cast<double>(i), error_px});
  }
  return plot;
}

}  // namespace

cv::Mat board_plot(const BoardCalibration& calibration) {
  cv::Mat panels, page;
  cv::hconcat(arrows_panel(calibration), coverage_panel(calibration), panels);
  cv::vconcat(std::vector{panels, image_of(radius_plot(calibration)), image_of(views_plot(calibration))}, page);
  return page;
}

}  // namespace sigs
