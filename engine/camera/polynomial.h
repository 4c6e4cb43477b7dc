// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sigs::distortion {

// Polynomial in one variable, coefficients in ascending order: c[0] + c[1] u + c[2] u^2 + ...
using Polynomial = std::vector<double>;

[[nodiscard]] double value_at(const Polynomial& polynomial, double u);
[[nodiscard]] Polynomial derivative(const Polynomial& polynomial);
[[nodiscard]] Polynomial product(const Polynomial& a, const Polynomial& b);
[[nodiscard]] Polynomial sum(const Polynomial& a, const Polynomial& b, double b_factor = 1);

// Smallest u in (0, limit] from which on the polynomial, positive at 0, is no longer positive; infinity where there is
// none. Exact to the last bits, however narrow the dip: between two roots of its derivative a polynomial is monotonic.
[[nodiscard]] double first_fall(const Polynomial& polynomial, double limit);

}  // namespace sigs::distortion
