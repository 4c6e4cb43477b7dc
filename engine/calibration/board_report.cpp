// SPDX-License-Identifier: MIT
#include "calibration/board_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text.h"

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

}  // namespace sigs
