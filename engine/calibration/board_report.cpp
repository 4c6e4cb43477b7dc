// SPDX-License-Identifier: MIT
#include "calibration/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/text.h"
#include "telemetry/plot_axes.h"

namespace sigs {

namespace {

using Json = nlohmann::ordered_json;

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

constexpr int kPanelWidth_px = 620;
constexpr int kPanelHeight_px = 480;
constexpr int kLeft_px = 64;
constexpr int kRight_px = 20;
constexpr int kTop_px = 50;
constexpr int kBottom_px = 44;
constexpr int kCells = 16;  // of the image's width
const cv::Scalar kInk(60, 60, 60);
const cv::Scalar kFaint(150, 150, 150);
const cv::Scalar kArrow(170, 80, 20);
const cv::Scalar kOut(60, 60, 220);
const std::array<cv::Scalar, 4> kModelInks{cv::Scalar(150, 150, 150), cv::Scalar(200, 90, 20), cv::Scalar(40, 140, 40),
                                           cv::Scalar(30, 100, 220)};

// A panel with its axes: from values to pixels.
class Chart {
 public:
  Chart(cv::Mat image, cv::Rect2d range, bool is_downwards)
      : image_(image),
        range_(range),
        is_downwards_(is_downwards),
        frame_(kLeft_px, kTop_px, kPanelWidth_px - kLeft_px - kRight_px, kPanelHeight_px - kTop_px - kBottom_px) {}

  // The same scale in both directions, as large as fits.
  void keep_shape() {
    const double scale = std::min(frame_.width / range_.width, frame_.height / range_.height);
    frame_.width = cvRound(range_.width * scale);
    frame_.height = cvRound(range_.height * scale);
  }
  [[nodiscard]] double px_per_unit() const { return frame_.width / range_.width; }

  [[nodiscard]] cv::Point2d at(double x, double y) const {
    const double down = (y - range_.y) / range_.height;
    return {frame_.x + (x - range_.x) / range_.width * frame_.width,
            frame_.y + (is_downwards_ ? down : 1 - down) * frame_.height};
  }

  void draw_frame(const std::string& title, const std::string& remark, const std::string& x_title) {
    std::vector<PlacedTick> x;
    for (const Tick& tick : ticks_between(range_.x, range_.x + range_.width, tick_step(range_.width)))
      x.push_back({tick, cvRound(at(tick.value, range_.y).x)});
    std::vector<PlacedTick> y;
    for (const Tick& tick : ticks_between(range_.y, range_.y + range_.height, tick_step(range_.height)))
      y.push_back({tick, cvRound(at(range_.x, tick.value).y)});
    draw_axes(image_, frame_.tl(), frame_.br(), x, y, {.ink = kInk});
    draw_text(image_, title, {kLeft_px, 20}, kInk);
    draw_text(image_, remark, {kLeft_px, 39}, kFaint);
    draw_text_until(image_, x_title, {frame_.br().x, frame_.br().y + 36}, kInk);
  }

  cv::Mat& image() { return image_; }

 private:
  cv::Mat image_;
  cv::Rect2d range_;
  bool is_downwards_;
  cv::Rect frame_;
};

cv::Rect2d image_range(cv::Size size_px) {
  return {-0.5, -0.5, static_cast<double>(size_px.width), static_cast<double>(size_px.height)};
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

void draw_arrows(cv::Mat image, const BoardCalibration& calibration) {
  const CalibratedModel& best = calibration.best();
  Chart chart(image, image_range(calibration.size_px), true);
  chart.keep_shape();
  const std::vector<Cell> cells = cells_of(best, calibration.size_px);
  const double factor = arrow_factor(cells, static_cast<double>(calibration.size_px.width) / kCells);
  chart.draw_frame(std::string("residuals of ") + name_of(best.model) + ", means of cells",
                   "arrows " + short_number_text(factor) + " times as long; error " + fixed_text(best.rms_px, 3) +
                       " px, held out " + fixed_text(best.held_out_px, 3) + " px",
                   "x [px]");
  for (const CornerResidual& corner : best.residuals)
    cv::circle(chart.image(), chart.at(corner.at_px.x, corner.at_px.y), 1, {215, 215, 215}, cv::FILLED);
  for (const Cell& cell : cells)
    if (cell.count > 0)
      cv::arrowedLine(chart.image(), chart.at(cell.at.x, cell.at.y),
                      chart.at(cell.at.x + factor * cell.off.x, cell.at.y + factor * cell.off.y), kArrow, 1,
                      cv::LINE_AA, 0, 0.3);
  const cv::Point middle = chart.at(best.lens.cx, best.lens.cy);
  cv::drawMarker(chart.image(), middle, kOut, cv::MARKER_CROSS, 12);
}

void draw_coverage(cv::Mat image, const BoardCalibration& calibration) {
  Chart chart(image, image_range(calibration.size_px), true);
  chart.keep_shape();
  const int rows = cell_rows(calibration.size_px);
  const std::vector<Cell> cells = cells_of(calibration.best(), calibration.size_px);
  int most = 1;
  int bare = 0;
  for (const Cell& cell : cells) {
    most = std::max(most, cell.count);
    bare += cell.count == 0 ? 1 : 0;
  }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < kCells; ++x) {
      const int count = cells[static_cast<std::size_t>(y * kCells + x)].count;
      const double share = std::sqrt(static_cast<double>(count) / most);
      const cv::Scalar color =
          count == 0 ? cv::Scalar(215, 215, 250) : cv::Scalar(250 - 60 * share, 240 - 140 * share, 225 - 185 * share);
      const auto edge = [&](int column, int row) {
        return chart.at(static_cast<double>(column) * calibration.size_px.width / kCells - 0.5,
                        static_cast<double>(row) * calibration.size_px.height / rows - 0.5);
      };
      cv::rectangle(chart.image(), cv::Rect(cv::Point(edge(x, y)), cv::Point(edge(x + 1, y + 1))), color, cv::FILLED);
    }
  chart.draw_frame("corners seen, from 1 (pale) to " + std::to_string(most) + " (dark) a cell",
                   std::to_string(bare) + " of " + std::to_string(cells.size()) + " cells bare (red); " +
                       count_text(calibration.views_used(), "view"),
                   "x [px]");
}

// Root mean squares of rings around the principal point, of equal widths.
std::vector<cv::Point2d> rings_of(const CalibratedModel& model, double largest_px) {
  constexpr int kRings = 20;
  std::vector<double> squares(kRings, 0);
  std::vector<int> counts(kRings, 0);
  for (const CornerResidual& corner : model.residuals) {
    const double radius_px = std::hypot(corner.at_px.x - model.lens.cx, corner.at_px.y - model.lens.cy);
    const auto ring = static_cast<std::size_t>(std::clamp(static_cast<int>(radius_px / largest_px * kRings), 0, 19));
    squares[ring] += corner.off_px.ddot(corner.off_px);
    ++counts[ring];
  }
  std::vector<cv::Point2d> line;
  for (int i = 0; i < kRings; ++i)
    if (counts[static_cast<std::size_t>(i)] >= 5)
      line.emplace_back((i + 0.5) / kRings * largest_px,
                        std::sqrt(squares[static_cast<std::size_t>(i)] / counts[static_cast<std::size_t>(i)]));
  return line;
}

void draw_by_radius(cv::Mat image, const BoardCalibration& calibration) {
  const double largest_px = std::hypot(calibration.size_px.width, calibration.size_px.height) / 2;
  double most = 0;
  std::vector<std::vector<cv::Point2d>> lines;
  for (const CalibratedModel& model : calibration.models) {
    lines.push_back(rings_of(model, largest_px));
    for (const cv::Point2d& point : lines.back()) most = std::max(most, point.y);
  }
  // A model that misses by much would press the others to the axis.
  most = std::clamp(1.1 * most, 1e-3, 3 * std::max(calibration.best().rms_px, 1e-3));
  Chart chart(image, {0, 0, largest_px, most}, false);
  chart.draw_frame("rms of the residuals [px]", "", "distance from the principal point [px]");
  int x = kLeft_px;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const cv::Scalar& ink = kModelInks[static_cast<std::size_t>(calibration.models[i].model)];
    std::vector<cv::Point> points;
    for (const cv::Point2d& point : lines[i]) points.emplace_back(chart.at(point.x, std::min(point.y, most)));
    cv::polylines(chart.image(), points, false, ink, i == calibration.chosen ? 2 : 1, cv::LINE_AA);
    const std::string name = std::string(i == calibration.chosen ? "* " : "") + name_of(calibration.models[i].model);
    draw_text(chart.image(), name, {x, 39}, ink);
    x += 20 + cv::getTextSize(name, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, nullptr).width;
  }
}

void draw_views(cv::Mat image, const BoardCalibration& calibration) {
  double largest = 1e-3;
  for (const CalibratedView& view : calibration.views)
    if (view.is_used) largest = std::max(largest, view.error_px);
  const double most = 2.5 * largest;
  const auto count = static_cast<double>(calibration.views.size());
  Chart chart(image, {0, 0, count, most}, false);
  chart.draw_frame("error of each view [px]", "blue: used; red: not used, cut off where larger", "view");
  for (std::size_t i = 0; i < calibration.views.size(); ++i) {
    const CalibratedView& view = calibration.views[i];
    const double error = std::isfinite(view.error_px) ? std::min(view.error_px, most) : most;
    const auto left = static_cast<double>(i);
    cv::rectangle(chart.image(), cv::Rect(cv::Point(chart.at(left + 0.15, error)), cv::Point(chart.at(left + 0.85, 0))),
                  view.is_used ? kArrow : kOut, cv::FILLED);
  }
}

}  // namespace

cv::Mat board_plot(const BoardCalibration& calibration) {
  cv::Mat page(2 * kPanelHeight_px, 2 * kPanelWidth_px, CV_8UC3, cv::Scalar::all(255));
  const auto panel = [&](int column, int row) {
    return page(cv::Rect(column * kPanelWidth_px, row * kPanelHeight_px, kPanelWidth_px, kPanelHeight_px));
  };
  draw_arrows(panel(0, 0), calibration);
  draw_coverage(panel(1, 0), calibration);
  draw_by_radius(panel(0, 1), calibration);
  draw_views(panel(1, 1), calibration);
  return page;
}

}  // namespace sigs
