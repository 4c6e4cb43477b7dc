// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace sigs {

// The uniform cubic B-spline basis, equation (2) of the paper, with the factor 1/(6 h^3) that makes the basis sum to
// one. (With the printed factor 1/h the sum is 6 h^2.)

// The function's four polynomials, from its first knot to its fifth: row j holds the coefficients 1, x, x^2, x^3 on the
// stretch from knot j to knot j + 1, where x runs from 0 to 1. Equation (2) in x = (t - knot) / h.
inline constexpr std::array<std::array<double, 4>, 4> kCubicBasisPieces{{
    {0, 0, 0, 1.0 / 6},
    {1.0 / 6, 3.0 / 6, 3.0 / 6, -3.0 / 6},
    {4.0 / 6, 0, -6.0 / 6, 3.0 / 6},
    {1.0 / 6, -3.0 / 6, 3.0 / 6, -1.0 / 6},
}};

// B(t) of the basis function whose support is [first_knot, first_knot + 4 h]; 0 outside. h > 0.
[[nodiscard]] double cubic_basis(double t, double first_knot, double h);

}  // namespace sigs
