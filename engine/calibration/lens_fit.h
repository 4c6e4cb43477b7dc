// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/board.h"
#include "camera/lens.h"

namespace sigs {

// The lens models that are fitted, and their projection with derivatives. Points are in OpenCV's optical frame: x
// right, y down, z forward.

// From the simplest to the most flexible.
enum class FitModel {
  pinhole,          // fx fy cx cy
  brown_conrady_5,  // and k1 k2 p1 p2 k3
  kannala_brandt,   // and k1 k2 k3 k4 of the angle
  brown_conrady_8,  // and k1 k2 p1 p2 k3 k4 k5 k6: a quotient of two polynomials
};

// "pinhole", "Brown-Conrady 5", "Kannala-Brandt", "Brown-Conrady 8".
[[nodiscard]] const char* name_of(FitModel model);

// Number of intrinsics with fx fy cx cy: 4, 9, 8, 12.
[[nodiscard]] int intrinsic_count(FitModel model);

constexpr int kMaxIntrinsics = 12;

// fx fy cx cy, then the coefficients in OpenCV's order.
using Intrinsics = std::vector<double>;

[[nodiscard]] LensParameters lens_of(FitModel model, const Intrinsics& intrinsics);

// A pixel and how it moves with the point and with the intrinsics.
struct ProjectedPoint {
  glm::dvec2 at_px;
  std::array<glm::dvec3, 2> by_point;                               // of x, of y
  std::array<std::array<double, kMaxIntrinsics>, 2> by_intrinsics;  // beyond intrinsic_count() they are 0
};

// The pixel of a point by the model's formula (OpenCV's projectPoints and fisheye::projectPoints), also beyond the
// field in which it is one to one. Nothing where the formula has no value: behind a pinhole, at the camera, at a
// denominator of 0.
[[nodiscard]] std::optional<ProjectedPoint> projected(FitModel model, const Intrinsics& intrinsics,
                                                      const glm::dvec3& p_in_optical);

// The pixel alone.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(FitModel model, const Intrinsics& intrinsics,
                                                 const glm::dvec3& p_in_optical);

// Fits a lens and the board's poses to the corners seen: least squares of the distances in the image (Zhang 2000) by
// the method of Levenberg and Marquardt. The poses are eliminated from the equations (Triggs et al. 1999, section 6).

// Where the board is: p_in_optical = turn * p_on_board + at_m.
struct BoardPose {
  glm::dmat3 turn{1};
  glm::dvec3 at_m{0, 0, 1};

  [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& p_on_board) const { return turn * p_on_board + at_m; }
};

// The corners of a view that count.
struct FitView {
  std::vector<glm::dvec3> on_board_m;
  std::vector<glm::dvec2> at_px;  // as many

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

// What of the intrinsics may change: for each the number of the free parameter that is added to it, -1 where none is.
using FreeIntrinsics = std::vector<int>;
[[nodiscard]] FreeIntrinsics all_free(FitModel model);
[[nodiscard]] FreeIntrinsics focal_length_alone(FitModel model);  // fx and fy together
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
[[nodiscard]] std::vector<glm::dvec2> residuals_px(FitModel model, const Intrinsics& intrinsics, const BoardPose& pose,
                                                   const FitView& view);

// Root of the mean square of the lengths.
[[nodiscard]] double rms_px(std::span<const glm::dvec2> residuals_px);

// Covariance of the free intrinsics: the larger, for each parameter, of that from the residuals' variance and of the
// one that lets errors within a view depend on each other (White 1980, by views). It is not smaller than what the
// corners' own scatter says.
[[nodiscard]] std::vector<double> standard_deviations(std::span<const FitView> views, const LensFit& fit);

// A first lens from views of which up to half may be wrong, and the views and corners that agree with it.

// Which views and corners count.
struct Agreement {
  std::vector<bool> view;                 // one for each view
  std::vector<std::vector<bool>> corner;  // of each view
  std::vector<double> error_px;           // rms of the corners that count; infinite without a pose

  [[nodiscard]] int view_count() const;
};

// A fit with poses for all views; those of views that do not count are the best for this lens.
struct RobustFit {
  LensFit fit;
  Agreement agreement;
};

// Finds a Kannala-Brandt lens with two coefficients around the image's middle, which is near enough to most lenses: of
// 24 sets of three views each, started at six focal lengths, the one for which the best two fifths of all views have
// the smallest errors (Rousseeuw 1984; the sets follow from their numbers alone). Nothing where no set gives a lens.
[[nodiscard]] std::optional<LensFit> first_fit(std::span<const FitView> views, cv::Size size_px);

// Fits a model to all views that agree, from a lens of any model with poses. The rule, applied until nothing changes:
//   corner  counts within 5 standard deviations (by the median of all distances) or 0.3 px
//   view    counts where its error is at most 2.5 times the error that three tenths of all views have at most, or
//           0.1 px, and at most a quarter of its corners are left out
// Nothing where the model cannot have such views (a pinhole that looks sideways) or fewer than 3 agree.
[[nodiscard]] std::optional<RobustFit> robust_fit(FitModel model, std::span<const FitView> views, const LensFit& start);

// The corners that count, and those of all views that count.
[[nodiscard]] FitView agreeing(const FitView& view, const std::vector<bool>& corners);
[[nodiscard]] std::vector<FitView> agreeing(std::span<const FitView> views, const Agreement& agreement);

// The largest angle from the axis at which the fit has a corner.
[[nodiscard]] double largest_angle_rad(const LensFit& fit, std::span<const FitView> views);

// A lens of another model that is as near to the given one as it can be, up to an angle from the axis.
[[nodiscard]] Intrinsics converted(const LensFit& from, FitModel to, double largest_angle_rad);

// How well a model predicts views that it was not fitted to, and which model is taken by that.

// The mean square distance of the corners of each view, px^2, for a lens that was fitted without this view: the views
// are dealt to 5 groups in turn, and each group is judged by the lens of the others. Of a judged view only the pose is
// fitted, which is counted: the sum of squares over 2 n - 6, times 2. Fewer than 5 views have a group each.
[[nodiscard]] std::vector<double> held_out_squares(std::span<const FitView> views, const LensFit& fit);

// Root of their mean.
[[nodiscard]] double held_out_px(std::span<const double> squares);

// Whether the second is clearly better: its held-out error is smaller by 2 % or more, and the mean logarithm of the
// views' ratios is more than twice its standard error. (Differences would be ruled by the few views of which a model
// that is too simple misses most.)
[[nodiscard]] bool is_clearly_better(std::span<const double> squares, std::span<const double> than_these);

}  // namespace sigs
