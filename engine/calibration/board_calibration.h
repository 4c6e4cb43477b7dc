// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "calibration/board.h"
#include "calibration/lens_fit.h"
#include "camera/calibration_text.h"
#include "camera/lens.h"

namespace sigs {

// A lens from views of a board.

// Which models are tried.
enum class ModelWanted { automatic, pinhole, brown_conrady, fisheye };

// One corner seen, as it is plotted.
struct CornerResidual {
  cv::Point2d at_px;
  cv::Point2d off_px;  // measured minus projected
};

// A model that was fitted.
struct CalibratedModel {
  FitModel model = FitModel::pinhole;
  LensParameters lens;
  std::vector<double> sd;                 // standard deviations of fx fy cx cy and of the coefficients
  double rms_px = 0;                      // of the corners that were fitted
  double held_out_px = 0;                 // of views that were not (lens_fit.h)
  std::vector<CornerResidual> residuals;  // of the corners of all views used
};

// What became of a view.
struct CalibratedView {
  std::string name;
  int corners = 0;
  int corners_left_out = 0;
  bool is_used = false;
  double error_px = 0;    // rms by the model chosen; infinite where the board has no pose with it
  double edge_px = 0;     // BoardView::edge_px
  double tilt_deg = 0;    // between the board's normal and the optical axis
  double distance_m = 0;  // of the board's first corner
};

struct BoardCalibration {
  cv::Size size_px;
  std::vector<CalibratedModel> models;  // those fitted, from the simplest
  std::size_t chosen = 0;               // index in `models`
  std::vector<CalibratedView> views;
  std::vector<Warning> warnings;

  [[nodiscard]] const CalibratedModel& best() const { return models[chosen]; }
  [[nodiscard]] int views_used() const;
};

// Fits the models to the views, of which up to half may be wrong, and chooses: from the simplest on, each that is
// clearly better by its held-out error (lens_fit.h) than the one chosen so far. 8 coefficients need 12 views.
// Warnings: fewer than 10 views, many views left out, a corner of the image without any corner of the board, all views
// facing the board, a focal length with a standard deviation of more than 0.5 %, a lens that does not reach the image's
// corners.
// Errors (bad_data): fewer than 3 views; no lens fits 3 of them.
[[nodiscard]] Result<BoardCalibration> calibrate_views(const std::vector<BoardView>& views,
                                                       const CalibrationBoard& board, cv::Size size_px,
                                                       ModelWanted wanted = ModelWanted::automatic);

// A calibration with a board for people, for programs, and as a file.

// A table of the models with errors and standard deviations, the one chosen marked.
[[nodiscard]] std::string board_report_text(const BoardCalibration& calibration);

// The same with all numbers and all views, as JSON (docs/calibrating.md lists the members).
[[nodiscard]] std::string board_report_json(const BoardCalibration& calibration, const CalibrationBoard& board);

// The chosen lens with its errors and standard deviations.
[[nodiscard]] CalibrationText calibration_text_of(const BoardCalibration& calibration, const CalibrationBoard& board);

// Two panels and two diagrams below them, BGR, 8 bits: the residuals of the chosen model as arrows where they are in
// the image, means of cells; how many corners were seen in each cell of the image; the residuals by their distance from
// the principal point, for each model; the error of each view, used and not used.
[[nodiscard]] cv::Mat board_plot(const BoardCalibration& calibration);

}  // namespace sigs
