// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "camera/camera.h"
#include "support/test_data.h"

namespace sigs::editor::test {

// The samples' fisheye, a Brown-Conrady lens with every usual coefficient, and a pinhole.
[[nodiscard]] inline std::vector<Camera> example_lenses() {
  const auto sample = read_calibration(sigs::test::source_dir() / "assets/calibrations/sample.xml");
  REQUIRE(sample.has_value());
  auto brown = Lens::make(
      {LensModel::brown_conrady, 535.9, 533.2, 642.3, 470.6, {-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839}});
  auto pinhole = Lens::make({LensModel::brown_conrady, 900, 900, 639.5, 479.5, {}});
  return {*sample, Camera{*brown, {1280, 960}}, Camera{*pinhole, {1280, 960}}};
}

}  // namespace sigs::editor::test
