// SPDX-License-Identifier: MIT
#include "editor/views/readable.h"

#include <algorithm>
#include <array>
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

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::clamp(seconds, 0.0, 1e7)));
  std::array<char, 32> text{};
  if (whole >= 3600)
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  else
    std::snprintf(text.data(), text.size(), "%ld:%02ld", whole / 60, whole % 60);
  return text.data();
}

}  // namespace sigs::editor
