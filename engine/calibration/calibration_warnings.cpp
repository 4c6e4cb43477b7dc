// SPDX-License-Identifier: MIT
#include "calibration/calibration_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/text.h"

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

}  // namespace

std::vector<Warning> calibration_warnings(const BoardCalibration& calibration) {
  Texts texts;
  add_view_warnings(calibration, texts);
  add_coverage_warnings(calibration, texts);
  add_focal_warning(calibration.best(), texts);
  std::vector<Warning> warnings;
  for (std::string& text : texts) warnings.push_back({"", std::move(text)});
  return warnings;
}

}  // namespace sigs
