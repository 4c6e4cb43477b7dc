// SPDX-License-Identifier: MIT
#include "calibration/lens_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>

#include "base/least_squares.h"
#include "base/pose.h"

namespace sigs {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kOfPose = 6;  // unknowns: a small rotation about the board's origin, a small shift

BoardPose moved(const BoardPose& pose, std::span<const double> by) {
  const glm::dquat turn = turn_of({by[0], by[1], by[2]}) * glm::dquat(pose.turn);
  return {glm::mat3_cast(glm::normalize(turn)), pose.at_m + glm::dvec3(by[3], by[4], by[5])};
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
      cost += huber_cost(squared_length(views[v].at_px[i] - *at), huber_px);
    }
  return cost;
}

int count_of(const FreeIntrinsics& free) {
  return free.empty() ? 0 : *std::ranges::max_element(free) + 1;
}

// The equations of one view: of its pose, then of the free intrinsics.
NormalEquations equations_of(const FitView& view, const LensFit& fit, const BoardPose& pose, const FreeIntrinsics& free,
                             double huber_px) {
  NormalEquations sums(kOfPose + count_of(free));
  std::vector<double> slopes;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const glm::dvec3 turned = pose.turn * view.on_board_m[i];
    const auto seen = projected(fit.model, fit.intrinsics, turned + pose.at_m);
    if (!seen) continue;
    const glm::dvec2 residual = view.at_px[i] - seen->at_px;
    const double weight = huber_weight(squared_length(residual), huber_px);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const glm::dvec3& by_shift = seen->by_point[axis];
      const glm::dvec3 by_turn = glm::cross(turned, by_shift);
      slopes.assign({by_turn.x, by_turn.y, by_turn.z, by_shift.x, by_shift.y, by_shift.z});
      slopes.resize(static_cast<std::size_t>(sums.size()), 0);
      for (std::size_t k = 0; k < free.size(); ++k)
        if (free[k] >= 0) slopes[static_cast<std::size_t>(kOfPose + free[k])] += seen->by_intrinsics[axis][k];
      sums.add(slopes, residual[static_cast<int>(axis)], weight);
    }
  }
  return sums;
}

// The fit after one damped step. The poses are eliminated: the equations of the intrinsics alone are solved first.
LensFit stepped(const LensFit& fit, std::vector<NormalEquations> views, const FreeIntrinsics& free, double lambda) {
  NormalEquations lens(count_of(free));
  for (NormalEquations& view : views) {
    view.damp(lambda, 1e-12);
    view.eliminate(kOfPose);
    lens.add(view);
  }
  const std::vector<double> step = lens.solved();
  LensFit next = fit;
  for (std::size_t k = 0; k < free.size(); ++k)
    if (free[k] >= 0) next.intrinsics[k] += step[static_cast<std::size_t>(free[k])];
  for (std::size_t v = 0; v < views.size(); ++v) next.poses[v] = moved(fit.poses[v], views[v].eliminated(step));
  return next;
}

bool is_sane(const LensFit& fit) {
  return std::ranges::all_of(fit.intrinsics, [](double i) { return std::isfinite(i); }) && fit.intrinsics[0] > 0 &&
         fit.intrinsics[1] > 0;
}

// Directions of the corners by the lens, with where they are on the board, of those that have one.
struct SeenRays {
  std::vector<glm::dvec3> rays;
  std::vector<glm::dvec2> on_board_m;
};

SeenRays rays_of(FitModel model, const Intrinsics& intrinsics, const FitView& view) {
  SeenRays seen;
  const Result<Lens> lens = Lens::make(lens_of(model, intrinsics));
  if (!lens) return seen;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const auto ray = lens->ray(view.at_px[i]);
    if (!ray) continue;
    seen.rays.push_back(optical_of(*ray));
    seen.on_board_m.emplace_back(view.on_board_m[i]);
  }
  return seen;
}

// By the singular values (Kabsch 1976); nothing where that is a mirror image.
std::optional<glm::dmat3> nearest_rotation(const glm::dmat3& m) {
  cv::Matx33d u, vt;
  cv::Vec3d strengths;
  cv::SVD::compute(cv::Matx33d(glm::value_ptr(m)), strengths, u, vt);  // of the transpose: glm stores columns
  const glm::dmat3 rotation = glm::make_mat3((u * vt).val);
  return glm::determinant(rotation) > 0 ? std::optional(rotation) : std::nullopt;
}

// The homography that takes (X, Y, 1) on the board to a multiple of its ray, up to its factor: ray x (H p) = 0.
glm::dmat3 homography_of(const SeenRays& seen, const glm::dvec2& middle_m, double unit_m) {
  NormalEquations equations(9);
  for (std::size_t i = 0; i < seen.rays.size(); ++i) {
    const glm::dvec2 on_board = (seen.on_board_m[i] - middle_m) / unit_m;
    const glm::dmat3 cross = glm::transpose(cross_matrix(seen.rays[i]));
    for (int axis = 0; axis < 3; ++axis) {
      const glm::dvec3& row = cross[axis];
      const glm::dvec3 by_x = row * on_board.x;
      const glm::dvec3 by_y = row * on_board.y;
      equations.add(std::array{by_x.x, by_x.y, by_x.z, by_y.x, by_y.y, by_y.z, row.x, row.y, row.z}, 0);
    }
  }
  cv::Mat_<double> values, vectors;  // rows, by falling value
  cv::eigen(equations.matrix(), values, vectors);
  return glm::make_mat3(vectors[8]);
}

std::optional<BoardPose> first_pose(const SeenRays& seen) {
  constexpr std::size_t kFewest = 6;
  if (seen.rays.size() < kFewest) return std::nullopt;
  glm::dvec2 middle(0);
  for (const glm::dvec2& p : seen.on_board_m) middle += p / static_cast<double>(seen.on_board_m.size());
  double unit = 0;
  for (const glm::dvec2& p : seen.on_board_m) unit = std::max(unit, glm::length(p - middle));
  if (!(unit > 0)) return std::nullopt;
  glm::dmat3 h = homography_of(seen, middle, unit);
  double before = 0;
  for (std::size_t i = 0; i < seen.rays.size(); ++i)
    before += glm::dot(seen.rays[i], h * glm::dvec3((seen.on_board_m[i] - middle) / unit, 1));
  if (before < 0) h = -h;
  const double scale = (glm::length(h[0]) + glm::length(h[1])) / 2;
  if (!(scale > 1e-12)) return std::nullopt;
  const std::optional<glm::dmat3> turn = nearest_rotation({h[0], h[1], glm::cross(h[0], h[1]) / scale});
  if (!turn) return std::nullopt;
  return BoardPose{.turn = *turn, .at_m = h[2] / scale * unit - *turn * glm::dvec3(middle, 0)};
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
  FreeIntrinsics free(static_cast<std::size_t>(intrinsic_count(model)));
  std::iota(free.begin(), free.end(), 0);
  return free;
}

FreeIntrinsics focal_length_alone(FitModel model) {
  FreeIntrinsics free = none_free(model);
  free[0] = free[1] = 0;
  return free;
}

FreeIntrinsics none_free(FitModel model) {
  return FreeIntrinsics(static_cast<std::size_t>(intrinsic_count(model)), -1);
}

LensFit refined(std::span<const FitView> views, LensFit start, const FreeIntrinsics& free, const FitLimits& limits) {
  constexpr double kConverged = 1e-10;  // relative gain of a step
  constexpr double kMaxDamping = 1e10;
  start.cost = cost_of(views, start, limits.huber_px);
  double lambda = 1e-3;
  for (int i = 0; i < limits.iterations && lambda < kMaxDamping && std::isfinite(start.cost); ++i) {
    std::vector<NormalEquations> equations;
    for (std::size_t v = 0; v < views.size(); ++v)
      equations.push_back(equations_of(views[v], start, start.poses[v], free, limits.huber_px));
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

std::vector<glm::dvec2> residuals_px(FitModel model, const Intrinsics& intrinsics, const BoardPose& pose,
                                     const FitView& view) {
  std::vector<glm::dvec2> residuals;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const auto at = pixel_of(model, intrinsics, pose * view.on_board_m[i]);
    residuals.push_back(at ? view.at_px[i] - *at : glm::dvec2(kInfinity));
  }
  return residuals;
}

double rms_px(std::span<const glm::dvec2> residuals_px) {
  if (residuals_px.empty()) return 0;
  double sum = 0;
  for (const glm::dvec2& residual : residuals_px) sum += squared_length(residual);
  return std::sqrt(sum / static_cast<double>(residuals_px.size()));
}

std::vector<double> standard_deviations(std::span<const FitView> views, const LensFit& fit) {
  const FreeIntrinsics free = all_free(fit.model);
  NormalEquations information(count_of(free));
  cv::Mat_<double> scatter(information.size(), information.size(), 0.0);  // of the views' gradients
  double squares = 0;
  double freedom = -information.size();
  for (std::size_t v = 0; v < views.size(); ++v) {
    NormalEquations view = equations_of(views[v], fit, fit.poses[v], free, 0);
    view.eliminate(kOfPose);
    information.add(view);
    scatter += view.right() * view.right().t();
    for (const glm::dvec2& residual : residuals_px(fit.model, fit.intrinsics, fit.poses[v], views[v]))
      squares += squared_length(residual);
    freedom += 2.0 * static_cast<double>(views[v].size()) - 6;
  }
  const cv::Mat_<double> inverse = information.inverse();
  const double variance = freedom > 0 ? squares / freedom : kInfinity;
  const double few_views = static_cast<double>(views.size()) / std::max(1.0, static_cast<double>(views.size()) - 1);
  const cv::Mat_<double> by_views = cv::Mat(inverse * scatter * inverse * few_views);
  std::vector<double> deviations;
  for (int i = 0; i < information.size(); ++i)
    deviations.push_back(std::sqrt(std::max({inverse(i, i) * variance, by_views(i, i), 0.0})));
  return deviations;
}

}  // namespace sigs
