// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "calibration/board.h"
#include "calibration/lens_projection.h"

namespace sigs {

// Fits a lens and the board's poses to the corners seen: least squares of the distances in the image (Zhang 2000) by
// the method of Levenberg and Marquardt. The poses are eliminated from the equations (Triggs et al. 1999, section 6).

// Where the board is: p_in_optical = turn * p_on_board + at_m.
struct BoardPose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d at_m = {0, 0, 1};

  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& p_on_board) const { return turn * p_on_board + at_m; }
};

// The corners of a view that count.
struct FitView {
  std::vector<Eigen::Vector3d> on_board_m;
  std::vector<Eigen::Vector2d> at_px;  // as many

  [[nodiscard]] std::size_t size() const { return at_px.size(); }
};
[[nodiscard]] FitView fit_view_of(const BoardView& view, const CalibrationBoard& board);

// A lens with the pose of the board in each view.
struct LensFit {
  FitModel model = FitModel::pinhole;
  Intrinsics intrinsics;
  std::vector<BoardPose> poses;
  double cost = 0;  // sum of squared distances, px^2; with a threshold, of Huber's function of them
};

// What of the intrinsics may change, as d intrinsics / d free parameters: a column for each.
using FreeIntrinsics = Eigen::MatrixXd;
[[nodiscard]] FreeIntrinsics all_free(FitModel model);
[[nodiscard]] FreeIntrinsics focal_length_alone(
    FitModel model);  // fx and fy by the same factor, as long as they are equal
[[nodiscard]] FreeIntrinsics none_free(FitModel model);

struct FitLimits {
  double huber_px = 0;  // residuals beyond count linearly (Huber 1964); 0: all count by their squares
  int iterations = 60;
};

// The fit nearest to `start` with the smallest cost. Views must have poses in `start`, and 4 corners or more.
[[nodiscard]] LensFit refined(std::span<const FitView> views, LensFit start, const FreeIntrinsics& free,
                              const FitLimits& limits);

// The board's pose by a lens that is known: directions of the corners by the lens, from them the homography of the
// board's plane (direct linear transformation), refined. Corners beyond the lens' valid field are left out at first.
// Nothing where fewer than 6 are left or where they do not determine a pose.
[[nodiscard]] std::optional<BoardPose> pose_seen(FitModel model, const Intrinsics& intrinsics, const FitView& view,
                                                 const FitLimits& limits);

// Distance of each corner from where the fit has it, measured minus projected; infinite where it has no pixel.
[[nodiscard]] std::vector<Eigen::Vector2d> residuals_px(FitModel model, const Intrinsics& intrinsics,
                                                        const BoardPose& pose, const FitView& view);

// Root of the mean square of the lengths.
[[nodiscard]] double rms_px(std::span<const Eigen::Vector2d> residuals_px);

// Covariance of the free intrinsics: the larger, for each parameter, of that from the residuals' variance and of the
// one that lets errors within a view depend on each other (White 1980, by views). It is not smaller than what the
// corners' own scatter says.
[[nodiscard]] Eigen::VectorXd standard_deviations(std::span<const FitView> views, const LensFit& fit);

}  // namespace sigs
