// SPDX-License-Identifier: MIT
#include "calibration_cases/case_score.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "calibration/lens_fit.h"

namespace sigs::test {

namespace {

constexpr std::uint32_t kHeldOutSeed = 4242;

Intrinsics intrinsics_of(const LensParameters& lens) {
  Intrinsics all{lens.fx, lens.fy, lens.cx, lens.cy};
  all.insert(all.end(), lens.coefficients.begin(), lens.coefficients.end());
  return all;
}

double field_error_px(FitModel model, const Intrinsics& lens, const made::BoardRenderer& truth) {
  made::PoseRange range;
  if (truth.camera().fisheye) range.smallest_share = 0.4, range.largest_share = 1.1;
  double squares = 0;
  double count = 0;
  for (const cv::Affine3d& pose : made::made_poses(truth, 12, range, kHeldOutSeed)) {
    FitView view;
    const std::vector<cv::Point3d> on_board = truth.board().corners_m();
    const std::vector<cv::Point2d> at_px = truth.corners_px(pose);
    for (std::size_t i = 0; i < at_px.size(); ++i) {
      view.on_board_m.emplace_back(on_board[i].x, on_board[i].y, 0);
      view.at_px.emplace_back(at_px[i].x, at_px[i].y);
    }
    const auto found = pose_seen(model, lens, view, {});
    if (!found) return INFINITY;
    const double error_px = rms_px(residuals_px(model, lens, *found, view));
    squares += error_px * error_px;
    ++count;
  }
  return std::sqrt(squares / count);
}

void bend(BoardView& view) {
  const cv::Point2d first = view.at_px.front();
  const double length_px = std::max(1.0, cv::norm(view.at_px.back() - first));
  for (cv::Point2d& at : view.at_px) at.y += 24 * std::pow(cv::norm(at - first) / length_px - 0.5, 2);
}

void scatter(BoardView& view, cv::RNG& random) {
  for (cv::Point2d& at : view.at_px)
    if (random.uniform(0, 5) == 0) at += cv::Point2d(random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0));
}

// The corners of the last row are those of the one before.
void repeat_row(BoardView& view, int columns) {
  for (std::size_t i = view.size() - 1; i >= static_cast<std::size_t>(columns); --i)
    if (view.ids[i] / columns == view.ids.back() / columns)
      view.at_px[i] = view.at_px[i - static_cast<std::size_t>(columns)];
}

}  // namespace

CalibrationBoard board_of(const made::MadeBoard& board) {
  return {.kind = board.marker_m > 0 ? BoardKind::charuco : BoardKind::chessboard,
          .corners = board.corners,
          .square_m = board.square_m,
          .marker_m = board.marker_m,
          .dictionary = board.dictionary};
}

LensError error_of(FitModel model, const LensParameters& lens, const made::BoardRenderer& truth) {
  const cv::Matx33d& k = truth.camera().matrix;
  return {.focal_percent = 100 * std::max(std::abs(lens.fx / k(0, 0) - 1), std::abs(lens.fy / k(1, 1) - 1)),
          .center_px = std::hypot(lens.cx - k(0, 2), lens.cy - k(1, 2)),
          .field_px = field_error_px(model, intrinsics_of(lens), truth)};
}

LensError error_of_opencv(const made::BoardCase& one, const made::BoardRenderer& truth,
                          const std::vector<BoardView>& views) {
  const CalibrationBoard board = board_of(one.board);
  cv::Mat matrix, coefficients;
  std::vector<cv::Mat> turns, shifts;
  std::vector<std::vector<cv::Point3f>> on_board;
  std::vector<std::vector<cv::Point2f>> at_px;
  for (const BoardView& view : views) {
    on_board.emplace_back();
    at_px.emplace_back();
    for (std::size_t i = 0; i < view.size(); ++i) {
      const cv::Point2d at_m = board.corner_m(view.ids[i]);
      on_board.back().emplace_back(static_cast<float>(at_m.x), static_cast<float>(at_m.y), 0.0F);
      at_px.back().emplace_back(view.at_px[i]);
    }
  }
  try {
    if (one.camera.fisheye)
      cv::fisheye::calibrate(on_board, at_px, one.camera.size_px, matrix, coefficients, turns, shifts,
                             cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
    else
      cv::calibrateCamera(on_board, at_px, one.camera.size_px, matrix, coefficients, turns, shifts);
  } catch (const cv::Exception&) {
    return {};
  }
  const LensParameters lens{
      .model = one.camera.fisheye ? LensModel::kannala_brandt : LensModel::brown_conrady,
      .fx = matrix.at<double>(0, 0),
      .fy = matrix.at<double>(1, 1),
      .cx = matrix.at<double>(0, 2),
      .cy = matrix.at<double>(1, 2),
      .coefficients = std::vector<double>(coefficients.begin<double>(), coefficients.end<double>())};
  return error_of(one.camera.fisheye ? FitModel::kannala_brandt : FitModel::brown_conrady_5, lens, truth);
}

void spoil(std::vector<BoardView>& views, const made::BoardCase& one, std::uint32_t seed) {
  if (!one.half_bad) return;
  cv::RNG random(seed * 31U + 7U);
  for (std::size_t v = 2; v < views.size(); v += 4) {
    const auto kind = v / 4 % 3;
    if (kind == 0) scatter(views[v], random);
    if (kind == 1) bend(views[v]);
    if (kind == 2) repeat_row(views[v], one.board.corners.width);
  }
}

}  // namespace sigs::test
