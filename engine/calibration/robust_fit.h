// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <vector>

#include "calibration/lens_fit.h"

namespace sigs {

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

// The views and corners that count.
[[nodiscard]] std::vector<FitView> agreeing(std::span<const FitView> views, const Agreement& agreement);

// A lens of another model that is as near to the given one as it can be, up to an angle from the axis.
[[nodiscard]] Intrinsics converted(const LensFit& from, FitModel to, double largest_angle_rad);

}  // namespace sigs
