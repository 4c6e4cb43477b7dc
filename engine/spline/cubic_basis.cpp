// SPDX-License-Identifier: MIT
#include "spline/cubic_basis.h"

#include <cmath>

#include "base/ensure.h"

namespace sigs {

double cubic_basis(double t, double first_knot, double h) {
  ENSURE(h > 0);
  const double steps = (t - first_knot) / h;
  if (!(steps > 0 && steps < 4)) return 0;
  const double knot = std::floor(steps);
  const double x = steps - knot;
  const auto& c = kCubicBasisPieces[static_cast<std::size_t>(knot)];
  return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

}  // namespace sigs
