// SPDX-License-Identifier: MIT
#include "calibration/lens_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pose.h"

namespace sigs {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rotation by a vector: its direction is the axis, its length the angle (Rodrigues).
Eigen::Matrix3d turn_by(const Eigen::Vector3d& vector_rad) {
  const double angle_rad = vector_rad.norm();
  if (angle_rad < 1e-300) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, vector_rad / angle_rad).toRotationMatrix();
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

// The pose moved by a small rotation about the board's origin and a small shift.
BoardPose moved(const BoardPose& pose, const Vector6& by) {
  const Eigen::Matrix3d turn = turn_by(by.head<3>()) * pose.turn;
  return {Eigen::Quaterniond(turn).normalized().toRotationMatrix(), pose.at_m + by.tail<3>()};
}

double huber_cost(double squared_px, double huber_px) {
  if (huber_px <= 0 || squared_px <= huber_px * huber_px) return squared_px;
  return 2 * huber_px * std::sqrt(squared_px) - huber_px * huber_px;
}

double huber_weight(double squared_px, double huber_px) {
  return huber_px <= 0 || squared_px <= huber_px * huber_px ? 1 : huber_px / std::sqrt(squared_px);
}

double cost_of(std::span<const FitView> views, const LensFit& fit, double huber_px) {
  double cost = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (std::size_t i = 0; i < views[v].size(); ++i) {
      const auto at = pixel_of(fit.model, fit.intrinsics, fit.poses[v] * views[v].on_board_m[i]);
      if (!at) return kInfinity;
      cost += huber_cost((views[v].at_px[i] - *at).squaredNorm(), huber_px);
    }
  return cost;
}

// The normal equations of one view.
struct ViewEquations {
  Matrix6 pose = Matrix6::Zero();
  Vector6 pose_right = Vector6::Zero();
  Eigen::MatrixXd mixed;  // 6 x free intrinsics
  Eigen::MatrixXd lens;
  Eigen::VectorXd lens_right;

  void damp(double lambda) {
    pose.diagonal() = pose.diagonal() * (1 + lambda) + Vector6::Constant(1e-12);
    lens.diagonal() *= 1 + lambda;
  }
};

ViewEquations equations_of(const FitView& view, const LensFit& fit, const BoardPose& pose, const FreeIntrinsics& free,
                           double huber_px) {
  const auto count = free.cols();
  ViewEquations sums{.mixed = Eigen::MatrixXd::Zero(6, count),
                     .lens = Eigen::MatrixXd::Zero(count, count),
                     .lens_right = Eigen::VectorXd::Zero(count)};
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Eigen::Vector3d turned = pose.turn * view.on_board_m[i];
    const auto seen = projected(fit.model, fit.intrinsics, turned + pose.at_m);
    if (!seen) continue;
    const Eigen::Vector2d residual = view.at_px[i] - seen->at_px;
    const double weight = huber_weight(residual.squaredNorm(), huber_px);
    Eigen::Matrix<double, 2, 6> by_pose;
    by_pose << seen->by_point * -cross_matrix(turned), seen->by_point;
    const Eigen::MatrixXd by_lens = seen->by_intrinsics.leftCols(free.rows()) * free;
    sums.pose += weight * by_pose.transpose() * by_pose;
    sums.pose_right += weight * by_pose.transpose() * residual;
    sums.mixed += weight * by_pose.transpose() * by_lens;
    sums.lens += weight * by_lens.transpose() * by_lens;
    sums.lens_right += weight * by_lens.transpose() * residual;
  }
  return sums;
}

std::vector<ViewEquations> all_equations(std::span<const FitView> views, const LensFit& fit, const FreeIntrinsics& free,
                                         double huber_px) {
  std::vector<ViewEquations> all;
  for (std::size_t v = 0; v < views.size(); ++v)
    all.push_back(equations_of(views[v], fit, fit.poses[v], free, huber_px));
  return all;
}

// The fit after one damped step. The poses are eliminated: S x = b of the intrinsics alone is solved first.
LensFit stepped(const LensFit& fit, std::vector<ViewEquations> all, const FreeIntrinsics& free, double lambda) {
  const auto count = free.cols();
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::LDLT<Matrix6>> solved;
  for (ViewEquations& view : all) {
    view.damp(lambda);
    solved.emplace_back(view.pose);
    reduced += view.lens - view.mixed.transpose() * solved.back().solve(view.mixed);
    right += view.lens_right - view.mixed.transpose() * solved.back().solve(view.pose_right);
  }
  const Eigen::VectorXd step = count > 0 ? Eigen::VectorXd(reduced.ldlt().solve(right)) : Eigen::VectorXd(0);
  LensFit next = fit;
  next.intrinsics += free * step;
  for (std::size_t v = 0; v < all.size(); ++v)
    next.poses[v] = moved(fit.poses[v], solved[v].solve(all[v].pose_right - all[v].mixed * step));
  return next;
}

bool is_sane(const LensFit& fit) {
  return fit.intrinsics.allFinite() && fit.intrinsics[0] > 0 && fit.intrinsics[1] > 0;
}

// Directions of the corners by the lens, with where they are on the board, of those that have one.
struct SeenRays {
  std::vector<Eigen::Vector3d> rays;
  std::vector<Eigen::Vector2d> on_board_m;
};

SeenRays rays_of(FitModel model, const Intrinsics& intrinsics, const FitView& view) {
  SeenRays seen;
  const Result<Lens> lens = Lens::make(lens_of(model, intrinsics));
  if (!lens) return seen;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const auto ray = lens->ray({view.at_px[i].x(), view.at_px[i].y()});
    if (!ray) continue;
    const glm::dvec3 optical = optical_of(*ray);
    seen.rays.emplace_back(optical.x, optical.y, optical.z);
    seen.on_board_m.push_back(view.on_board_m[i].head<2>());
  }
  return seen;
}

// The homography that takes (X, Y, 1) on the board to a multiple of its ray, up to its factor: ray x (H p) = 0.
Eigen::Matrix3d homography_of(const SeenRays& seen, const Eigen::Vector2d& middle_m, double unit_m) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < seen.rays.size(); ++i) {
    const Eigen::Vector2d on_board = (seen.on_board_m[i] - middle_m) / unit_m;
    const Eigen::Matrix3d cross = cross_matrix(seen.rays[i]);
    Eigen::Matrix<double, 3, 9> rows;
    rows << cross * on_board.x(), cross * on_board.y(), cross;
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  return Eigen::Map<const Eigen::Matrix3d>(h.data());
}

std::optional<BoardPose> first_pose(const SeenRays& seen) {
  constexpr std::size_t kFewest = 6;
  if (seen.rays.size() < kFewest) return std::nullopt;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : seen.on_board_m) middle += p / static_cast<double>(seen.on_board_m.size());
  double unit = 0;
  for (const Eigen::Vector2d& p : seen.on_board_m) unit = std::max(unit, (p - middle).norm());
  if (!(unit > 0)) return std::nullopt;
  Eigen::Matrix3d h = homography_of(seen, middle, unit);
  double before = 0;
  for (std::size_t i = 0; i < seen.rays.size(); ++i)
    before += seen.rays[i].dot(h * ((seen.on_board_m[i] - middle) / unit).homogeneous());
  if (before < 0) h = -h;
  const double scale = (h.col(0).norm() + h.col(1).norm()) / 2;
  if (!(scale > 1e-12)) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << h.col(0), h.col(1), h.col(0).cross(h.col(1)) / scale;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  BoardPose pose{.turn = svd.matrixU() * svd.matrixV().transpose(), .at_m = h.col(2) / scale * unit};
  if (pose.turn.determinant() < 0) return std::nullopt;
  pose.at_m -= pose.turn * Eigen::Vector3d(middle.x(), middle.y(), 0);
  return pose;
}

}  // namespace

FitView fit_view_of(const BoardView& view, const CalibrationBoard& board) {
  FitView fit;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const cv::Point2d on_board_m = board.corner_m(view.ids[i]);
    fit.on_board_m.emplace_back(on_board_m.x, on_board_m.y, 0);
    fit.at_px.emplace_back(view.at_px[i].x, view.at_px[i].y);
  }
  return fit;
}

FreeIntrinsics all_free(FitModel model) {
  return FreeIntrinsics::Identity(intrinsic_count(model), intrinsic_count(model));
}

FreeIntrinsics focal_length_alone(FitModel model) {
  FreeIntrinsics free = FreeIntrinsics::Zero(intrinsic_count(model), 1);
  free(0, 0) = free(1, 0) = 1;
  return free;
}

FreeIntrinsics none_free(FitModel model) {
  return FreeIntrinsics::Zero(intrinsic_count(model), 0);
}

LensFit refined(std::span<const FitView> views, LensFit start, const FreeIntrinsics& free, const FitLimits& limits) {
  constexpr double kConverged = 1e-10;  // relative gain of a step
  constexpr double kMaxDamping = 1e10;
  start.cost = cost_of(views, start, limits.huber_px);
  double lambda = 1e-3;
  for (int i = 0; i < limits.iterations && lambda < kMaxDamping && std::isfinite(start.cost); ++i) {
    const std::vector<ViewEquations> equations = all_equations(views, start, free, limits.huber_px);
    double gain = -1;
    for (; gain < 0 && lambda < kMaxDamping; lambda *= 10) {
      LensFit next = stepped(start, equations, free, lambda);
      next.cost = is_sane(next) ? cost_of(views, next, limits.huber_px) : kInfinity;
      if (!(next.cost <= start.cost)) continue;
      gain = start.cost - next.cost;
      start = std::move(next);
      lambda /= 100;
    }
    if (gain <= kConverged * start.cost) break;
  }
  return start;
}

std::optional<BoardPose> pose_seen(FitModel model, const Intrinsics& intrinsics, const FitView& view,
                                   const FitLimits& limits) {
  const std::optional<BoardPose> first = first_pose(rays_of(model, intrinsics, view));
  if (!first) return std::nullopt;
  LensFit fit{.model = model, .intrinsics = intrinsics, .poses = {*first}};
  fit = refined(std::span(&view, 1), std::move(fit), none_free(model), limits);
  if (!std::isfinite(fit.cost)) return std::nullopt;
  return fit.poses.front();
}

std::vector<Eigen::Vector2d> residuals_px(FitModel model, const Intrinsics& intrinsics, const BoardPose& pose,
                                          const FitView& view) {
  std::vector<Eigen::Vector2d> residuals;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const auto at = pixel_of(model, intrinsics, pose * view.on_board_m[i]);
    residuals.push_back(at ? Eigen::Vector2d(view.at_px[i] - *at) : Eigen::Vector2d::Constant(kInfinity));
  }
  return residuals;
}

double rms_px(std::span<const Eigen::Vector2d> residuals_px) {
  if (residuals_px.empty()) return 0;
  double sum = 0;
  for (const Eigen::Vector2d& residual : residuals_px) sum += residual.squaredNorm();
  return std::sqrt(sum / static_cast<double>(residuals_px.size()));
}

Eigen::VectorXd standard_deviations(std::span<const FitView> views, const LensFit& fit) {
  const FreeIntrinsics free = all_free(fit.model);
  const auto count = free.cols();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(count, count);  // of the views' own gradients
  double squares = 0;
  double freedom = -static_cast<double>(count);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ViewEquations view = equations_of(views[v], fit, fit.poses[v], free, 0);
    const Eigen::LDLT<Matrix6> pose(view.pose);
    information += view.lens - view.mixed.transpose() * pose.solve(view.mixed);
    const Eigen::VectorXd gradient = view.lens_right - view.mixed.transpose() * pose.solve(view.pose_right);
    scatter += gradient * gradient.transpose();
    for (const Eigen::Vector2d& residual : residuals_px(fit.model, fit.intrinsics, fit.poses[v], views[v]))
      squares += residual.squaredNorm();
    freedom += 2.0 * static_cast<double>(views[v].size()) - 6;
  }
  const Eigen::MatrixXd inverse = information.completeOrthogonalDecomposition().pseudoInverse();
  const double variance = freedom > 0 ? squares / freedom : kInfinity;
  const double few_views = static_cast<double>(views.size()) / std::max(1.0, static_cast<double>(views.size()) - 1);
  const Eigen::VectorXd by_corners = inverse.diagonal() * variance;
  const Eigen::VectorXd by_views = (inverse * scatter * inverse).diagonal() * few_views;
  return by_corners.cwiseMax(by_views).cwiseMax(0).cwiseSqrt();
}

}  // namespace sigs
