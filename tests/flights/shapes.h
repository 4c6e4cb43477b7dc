// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flights/body.h"

namespace sigs::flights {

// Parts as a camera on an aircraft sees them (body.h's Part).
[[nodiscard]] Part tail_boom();
[[nodiscard]] Part nose();
[[nodiscard]] Part wing_tip_left();
[[nodiscard]] Part wing_tip_right();
[[nodiscard]] Part spinner();
[[nodiscard]] Part engine_cowl();         // behind the spinner and its propeller
[[nodiscard]] Part belly();               // enters from the top
[[nodiscard]] Part strut();               // from the belly to the left
[[nodiscard]] Part windscreen();          // a frame around all of the view, with a post
[[nodiscard]] Part bonnet();              // along all of the lower border
[[nodiscard]] Part pod();                 // enters from the top right
[[nodiscard]] Part side_float();          // enters from the lower left
[[nodiscard]] std::vector<Part> skids();  // two, from the sides to below
[[nodiscard]] Propeller propeller();

[[nodiscard]] Part plain(Part part, const cv::Scalar& color);  // without stripes
[[nodiscard]] Part lifted(Part part, double share);            // of the image's height

}  // namespace sigs::flights
