// SPDX-License-Identifier: MIT
#include "calibration/lens_fit.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace sigs::test {

namespace {

struct KnownModel {
  FitModel model;
  Intrinsics intrinsics;
};
const KnownModel kModels[] = {
    {FitModel::pinhole, {800, 810, 640, 480}},
    {FitModel::brown_conrady_5, {800, 810, 640, 480, -0.25, 0.08, 0.001, -0.002, -0.01}},
    {FitModel::kannala_brandt, {400, 390, 640, 480, 0.03, -0.01, 0.002, -0.0005}},
    {FitModel::brown_conrady_8, {800, 810, 640, 480, 0.4, 0.1, 0.001, -0.002, 0.02, 0.6, 0.2, 0.03}}};

}  // namespace

TEST_CASE("the slopes of a projection are the differences of its pixels") {
  constexpr double kChange = 1e-6;
  for (const KnownModel& known : kModels)
    for (const glm::dvec3& point : {glm::dvec3(0.3, -0.2, 1), glm::dvec3(-1.1, 0.4, 1.7), glm::dvec3(0, 0, 2)}) {
      CAPTURE(name_of(known.model));
      const auto there = projected(known.model, known.intrinsics, point);
      REQUIRE(there);
      CHECK(there->at_px == pixel_of(known.model, known.intrinsics, point).value());
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 before = point, after = point;
        before[axis] -= kChange;
        after[axis] += kChange;
        const glm::dvec2 slope = (pixel_of(known.model, known.intrinsics, after).value() -
                                  pixel_of(known.model, known.intrinsics, before).value()) /
                                 (2 * kChange);
        // Pixels are rounded to 1e-13, over the change; curvature adds less.
        CHECK(std::abs(there->by_point[0][axis] - slope.x) < 1e-5);
        CHECK(std::abs(there->by_point[1][axis] - slope.y) < 1e-5);
      }
      for (std::size_t i = 0; i < known.intrinsics.size(); ++i) {
        Intrinsics before = known.intrinsics, after = known.intrinsics;
        before[i] -= kChange;
        after[i] += kChange;
        const glm::dvec2 slope =
            (pixel_of(known.model, after, point).value() - pixel_of(known.model, before, point).value()) /
            (2 * kChange);
        CHECK(std::abs(there->by_intrinsics[0][i] - slope.x) < 1e-5);
        CHECK(std::abs(there->by_intrinsics[1][i] - slope.y) < 1e-5);
      }
    }
}

}  // namespace sigs::test
