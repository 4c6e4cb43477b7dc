// SPDX-License-Identifier: MIT
#include "dataset/portable_trig.h"

#include <cmath>
#include <numbers>

namespace sigs {

namespace {

// Taylor's series of cos and sin up to pi/4, where the term after the last one is under 1e-18.
CosSin series(double x) {
  const double square = x * x;
  double cos = 0;
  double sin = 0;
  for (int n = 18; n > 0; n -= 2) {
    cos = (1 + cos) * -square / (n * (n - 1));
    sin = (1 + sin) * -square / (n * (n + 1));
  }
  return {1 + cos, x * (1 + sin)};
}

}  // namespace

CosSin cos_sin_of_deg(double angle_deg) {
  int quarter = 0;
  const double rest_deg = std::remquo(angle_deg, 90.0, &quarter);  // exact; the quarters' last three bits
  const CosSin first = series(rest_deg * (std::numbers::pi / 180));
  switch (quarter & 3) {
    case 1:
      return {-first.sin, first.cos};
    case 2:
      return {-first.cos, -first.sin};
    case 3:
      return {first.sin, -first.cos};
    default:
      return first;
  }
}

}  // namespace sigs
