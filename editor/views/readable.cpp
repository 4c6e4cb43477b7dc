// SPDX-License-Identifier: MIT
#include "editor/views/readable.h"

#include <cmath>
#include <cstdio>

namespace sigs::editor {

std::string distance_text(double distance_m) {
  if (!std::isfinite(distance_m)) return "-";
  const bool far = distance_m >= 9999.5;
  const double value = far ? distance_m / 1000 : distance_m;
  const int digits = value < 9.995 ? 2 : value < 999.95 ? 1 : 0;
  char text[48];
  std::snprintf(text, sizeof text, "%.*f %s", digits, value, far ? "km" : "m");
  return text;
}

}  // namespace sigs::editor
