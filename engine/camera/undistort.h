// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "camera/brown_conrady.h"
#include "camera/kannala_brandt.h"
#include "camera/valid_field.h"

namespace sigs::distortion {

// The p within the field that a model distorts to a given point, to the last digits that the arithmetic holds; nothing
// where there is none. Radial lenses need one number solved for. Where tangential or prism terms couple x and y,
// Newton's method in the plane, damped, starts from the radial answer; what it does not reach and what is not clearly
// outside the bent rim of the field is searched for over the whole field.
[[nodiscard]] std::optional<glm::dvec2> undistorted(const BrownConrady& model, const Field& field,
                                                    const glm::dvec2& distorted_point);
[[nodiscard]] std::optional<glm::dvec2> undistorted(const KannalaBrandt& model, const Field& field,
                                                    const glm::dvec2& distorted_point);

}  // namespace sigs::distortion
