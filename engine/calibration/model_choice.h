// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "calibration/lens_fit.h"

namespace sigs {

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
