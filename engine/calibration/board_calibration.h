// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/board.h"
#include "calibration/lens_projection.h"
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

}  // namespace sigs
