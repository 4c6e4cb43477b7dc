// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "calibration/board.h"
#include "calibration/lens_fit.h"
#include "camera/lens.h"
#include "made_boards/board_cases.h"

namespace sigs::test {

// How far a lens that was fitted is from the one that took the images.

[[nodiscard]] CalibrationBoard board_of(const made::MadeBoard& board);

struct LensError {
  double focal_percent = NAN;  // the larger of fx and fy
  double center_px = NAN;      // distance of the principal points
  double field_px = NAN;       // rms over the corners of 12 views without noise that no fit has seen, poses fitted
};
[[nodiscard]] LensError error_of(FitModel model, const LensParameters& lens, const made::BoardRenderer& truth);

// OpenCV's calibrateCamera or fisheye::calibrate, with all these views, as many coefficients as the lens has.
[[nodiscard]] LensError error_of_opencv(const made::BoardCase& one, const made::BoardRenderer& truth,
                                        const std::vector<BoardView>& views);

// Where half the views of a case are bad, makes the corners of every fourth that is left wrong: a fifth of them
// anywhere within 12 px; all of them shifted along a curve by some 6 px, as on a board that is not flat; or one row
// taken for the next.
void spoil(std::vector<BoardView>& views, const made::BoardCase& one, std::uint32_t seed);

}  // namespace sigs::test
