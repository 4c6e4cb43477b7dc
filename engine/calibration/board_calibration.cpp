// SPDX-License-Identifier: MIT
#include "calibration/board_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "base/pose.h"
#include "base/text.h"
#include "base/threads.h"
#include "calibration/lens_fit.h"

namespace sigs {

namespace {

constexpr int kEnoughViews = 10;
constexpr double kUncertainFocal = 0.005;
constexpr double kTilted_deg = 15;
constexpr int kTiltedViews = 3;
constexpr double kCornerShare = 0.2;  // of the image's sides: how far a corner of the image reaches

using Texts = std::vector<std::string>;

void add_view_warnings(const BoardCalibration& calibration, Texts& texts) {
  const int used = calibration.views_used();
  const auto all = static_cast<int>(calibration.views.size());
  if (used < kEnoughViews)
    texts.push_back(fmt::format("only {} used; show the board in 15 or more positions", count_text(used, "view")));
  if (2 * used < all)
    texts.push_back(fmt::format(
        "{} of {} views do not agree with the lens: did the board bend, was it moved fast, is the footage stabilised?",
        all - used, all));
  const auto is_tilted = [](const CalibratedView& view) { return view.is_used && view.tilt_deg > kTilted_deg; };
  if (std::ranges::count_if(calibration.views, is_tilted) < kTiltedViews)
    texts.push_back(
        fmt::format("nearly all views face the board: tilt it by {} to 45 degrees in some, or focal length "
                    "and distance cannot be distinguished",
                    kTilted_deg));
}

// The image's corners as shares of its sides, with names.
struct ImageCorner {
  const char* name;
  int x;
  int y;
};
constexpr std::array<ImageCorner, 4> kImageCorners{
    {{"upper left", 0, 0}, {"upper right", 1, 0}, {"lower left", 0, 1}, {"lower right", 1, 1}}};

bool is_covered(const BoardCalibration& calibration, const ImageCorner& corner) {
  const double width_px = kCornerShare * calibration.size_px.width;
  const double height_px = kCornerShare * calibration.size_px.height;
  return std::ranges::any_of(calibration.best().residuals, [&](const CornerResidual& seen) {
    const double x_px = corner.x == 0 ? seen.at_px.x : calibration.size_px.width - 1 - seen.at_px.x;
    const double y_px = corner.y == 0 ? seen.at_px.y : calibration.size_px.height - 1 - seen.at_px.y;
    return x_px < width_px && y_px < height_px;
  });
}

// The angle from the axis at which the lens sees a corner of the image; nothing where it has no ray.
std::optional<double> angle_rad(const Lens& lens, cv::Size size_px, const ImageCorner& corner, double inwards) {
  const auto place = [&](int share, int side_px) { return (share + (1 - 2 * share) * inwards) * (side_px - 1); };
  const auto ray = lens.ray({place(corner.x, size_px.width), place(corner.y, size_px.height)});
  return ray ? std::optional(std::acos(std::clamp(ray->x, -1.0, 1.0))) : std::nullopt;
}

void add_coverage_warnings(const BoardCalibration& calibration, Texts& texts) {
  constexpr double kHalfSphere_rad = std::numbers::pi / 2;
  const Result<Lens> lens = Lens::make(calibration.best().lens);
  std::string bare;
  std::string without_ray;
  for (const ImageCorner& corner : kImageCorners) {
    const auto seen_rad =
        lens ? angle_rad(*lens, calibration.size_px, corner, kCornerShare / 2) : std::optional<double>();
    // The corners beyond a fisheye's image circle cannot be covered.
    const bool is_beyond = is_fisheye(calibration.best().lens.model) && (!seen_rad || *seen_rad > kHalfSphere_rad);
    if (!is_beyond && !is_covered(calibration, corner)) bare += std::string(bare.empty() ? "" : ", ") + corner.name;
    if (!is_beyond && lens && !angle_rad(*lens, calibration.size_px, corner, 0))
      without_ray += std::string(without_ray.empty() ? "" : ", ") + corner.name;
  }
  if (!bare.empty())
    texts.push_back(
        fmt::format("no view reaches these corners of the image: {}; the lens is extrapolated there, show "
                    "the board there too",
                    bare));
  if (!without_ray.empty())
    texts.push_back(fmt::format("the lens has no direction for the outermost pixels of these corners of the image: {}",
                                without_ray));
}

void add_focal_warning(const CalibratedModel& model, Texts& texts) {
  const double share = std::max(model.sd[0] / model.lens.fx, model.sd[1] / model.lens.fy);
  if (share > kUncertainFocal)
    texts.push_back(fmt::format("the focal length is uncertain by {} %: show more tilted views, near and far",
                                fixed_text(100 * share, 1)));
}

// What a user should know of a calibration with a board: where its views do not support it. Each says what to do.
std::vector<Warning> calibration_warnings(const BoardCalibration& calibration) {
  Texts texts;
  add_view_warnings(calibration, texts);
  add_coverage_warnings(calibration, texts);
  add_focal_warning(calibration.best(), texts);
  std::vector<Warning> warnings;
  for (std::string& text : texts) warnings.push_back({"", std::move(text)});
  return warnings;
}

constexpr int kViewsForEight = 12;

std::vector<FitModel> models_of(ModelWanted wanted, std::size_t views) {
  std::vector<FitModel> models;
  const auto add = [&](FitModel model, std::initializer_list<ModelWanted> by) {
    if (std::ranges::find(by, wanted) != by.end()) models.push_back(model);
  };
  using enum ModelWanted;
  add(FitModel::pinhole, {automatic, pinhole});
  add(FitModel::brown_conrady_5, {automatic, brown_conrady});
  add(FitModel::kannala_brandt, {automatic, fisheye});
  if (views >= kViewsForEight) add(FitModel::brown_conrady_8, {automatic, brown_conrady});
  return models;
}

// The views that count are those of the model that three tenths of them fit best: with a model that is too simple
// those at the image's border would be left out.
std::optional<RobustFit> agreed_fit(std::span<const FitModel> models, std::span<const FitView> views,
                                    const LensFit& start) {
  std::optional<RobustFit> best;
  double best_px = 0;
  for (const FitModel model : models) {
    std::optional<RobustFit> fit = robust_fit(model, views, start);
    if (!fit) continue;
    std::vector<double> errors = fit->agreement.error_px;
    std::ranges::sort(errors);
    const double error_px = errors[(errors.size() - 1) * 3 / 10];
    if (best && error_px >= best_px) continue;
    best_px = error_px;
    best = std::move(fit);
  }
  return best;
}

// A model with what it leaves, fitted to the views that count.
struct FittedModel {
  CalibratedModel model;
  LensFit fit;
  std::vector<double> squares;  // held out
};

std::optional<FittedModel> fitted_model(FitModel model, std::span<const FitView> counting, const LensFit& reference) {
  LensFit fit{.model = model, .poses = reference.poses};
  fit.intrinsics = converted(reference, model, largest_angle_rad(reference, counting));
  fit = refined(counting, std::move(fit), all_free(model), {.iterations = 100});
  if (!std::isfinite(fit.cost) || !Lens::make(lens_of(model, fit.intrinsics))) return std::nullopt;
  FittedModel fitted;
  fitted.model.model = model;
  fitted.model.lens = lens_of(model, fit.intrinsics);
  fitted.squares = held_out_squares(counting, fit);
  fitted.model.sd = standard_deviations(counting, fit);
  fitted.model.held_out_px = held_out_px(fitted.squares);
  std::vector<glm::dvec2> all;
  for (std::size_t v = 0; v < counting.size(); ++v) {
    const std::vector<glm::dvec2> off = residuals_px(model, fit.intrinsics, fit.poses[v], counting[v]);
    for (std::size_t i = 0; i < off.size(); ++i)
      fitted.model.residuals.push_back({{counting[v].at_px[i].x, counting[v].at_px[i].y}, {off[i].x, off[i].y}});
    all.insert(all.end(), off.begin(), off.end());
  }
  fitted.model.rms_px = rms_px(all);
  fitted.fit = std::move(fit);
  return fitted;
}

// The reference with the poses of the views that count alone.
LensFit counting_poses(const RobustFit& reference) {
  LensFit fit = reference.fit;
  fit.poses.clear();
  for (std::size_t v = 0; v < reference.fit.poses.size(); ++v)
    if (reference.agreement.view[v]) fit.poses.push_back(reference.fit.poses[v]);
  return fit;
}

std::size_t choice(std::span<const FittedModel> fitted) {
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < fitted.size(); ++i)
    if (is_clearly_better(fitted[i].squares, fitted[chosen].squares)) chosen = i;
  return chosen;
}

CalibratedView view_of(const BoardView& seen, const FitView& view, const RobustFit& reference, std::size_t v,
                       const LensFit& chosen, const BoardPose& pose) {
  const auto left_out = std::ranges::count(reference.agreement.corner[v], false);
  const double facing = std::abs((pose.turn * glm::dvec3(0, 0, 1)).z);
  const FitView counting = reference.agreement.view[v] ? agreeing(view, reference.agreement.corner[v]) : view;
  return {.name = seen.name,
          .corners = static_cast<int>(seen.size()),
          .corners_left_out = static_cast<int>(left_out),
          .is_used = reference.agreement.view[v],
          .error_px = rms_px(residuals_px(chosen.model, chosen.intrinsics, pose, counting)),
          .edge_px = seen.edge_px,
          .tilt_deg = deg_of_rad(std::acos(std::min(1.0, facing))),
          .distance_m = glm::length(pose.at_m)};
}

std::vector<CalibratedView> views_of(const std::vector<BoardView>& seen, std::span<const FitView> views,
                                     const RobustFit& reference, const LensFit& chosen) {
  std::vector<CalibratedView> all;
  std::size_t next = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const bool is_used = reference.agreement.view[v];
    const BoardPose pose = is_used ? chosen.poses[next++] : reference.fit.poses[v];
    all.push_back(view_of(seen[v], views[v], reference, v, chosen, pose));
  }
  return all;
}

Error too_few(std::size_t views) {
  return {"", fmt::format("the board was found in {} sharp views that differ; show it in 15 or more positions, tilted, "
                          "near and far, in all parts of the image",
                          views)};
}

Result<BoardCalibration> calibrated(const std::vector<BoardView>& seen, const CalibrationBoard& board, cv::Size size_px,
                                    ModelWanted wanted) {
  constexpr std::size_t kFewest = 3;
  if (seen.size() < kFewest) return fail(too_few(seen.size()));
  std::vector<FitView> views;
  for (const BoardView& view : seen) views.push_back(fit_view_of(view, board));
  const std::optional<LensFit> start = first_fit(views, size_px);
  const std::vector<FitModel> models = models_of(wanted, views.size());
  const std::optional<RobustFit> reference = start ? agreed_fit(models, views, *start) : std::nullopt;
  if (!reference)
    return fail("", "no lens fits the views: is the board flat and not moving, are --corners and --model right?");
  const std::vector<FitView> counting = agreeing(views, reference->agreement);
  std::vector<FittedModel> fitted;
  for (const FitModel model : models) {
    if (model == FitModel::brown_conrady_8 && counting.size() < kViewsForEight) continue;
    std::optional<FittedModel> one = fitted_model(model, counting, counting_poses(*reference));
    if (one) fitted.push_back(std::move(*one));
  }
  if (fitted.empty()) return fail("", "no lens fits the views: is --model right?");
  BoardCalibration calibration{.size_px = size_px, .chosen = choice(fitted)};
  calibration.views = views_of(seen, views, *reference, fitted[calibration.chosen].fit);
  for (FittedModel& one : fitted) calibration.models.push_back(std::move(one.model));
  calibration.warnings = calibration_warnings(calibration);
  return calibration;
}

}  // namespace

int BoardCalibration::views_used() const {
  return static_cast<int>(std::ranges::count_if(views, [](const CalibratedView& view) { return view.is_used; }));
}

Result<BoardCalibration> calibrate_views(const std::vector<BoardView>& views, const CalibrationBoard& board,
                                         cv::Size size_px, ModelWanted wanted) {
  return guarded([&] { return calibrated(views, board, size_px, wanted); });
}

}  // namespace sigs
