// SPDX-License-Identifier: MIT
#include "appearance/noise_line.h"

#include <algorithm>
#include <cmath>

namespace sigs {

NoiseLine line_through(const std::vector<NoiseLevel>& levels, bool is_level) {
  constexpr double kNarrow = 0.25;     // of the brightness
  constexpr double kMostUnsure = 0.7;  // deviation of an end's variance, as a share of the mean of both
  double low = 1, high = 0;
  for (const NoiseLevel& level : levels) {
    low = std::min(low, level.brightness);
    high = std::max(high, level.brightness);
  }
  NoiseLine line{.is_level = is_level || high - low < kNarrow};
  std::vector<double> robust(levels.size(), 1.0);
  for (int round = 0; round < 4; ++round) {
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0, total = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double b = levels[i].brightness, a = 1 - b;
      const double w = levels[i].weight * robust[i] / std::pow(levels[i].variance + 0.02, 2);  // equal relative errors
      aa += w * a * a;
      ab += w * a * b;
      bb += w * b * b;
      ay += w * a * levels[i].variance;
      by += w * b * levels[i].variance;
      total += w;
    }
    const double determinant = aa * bb - ab * ab;
    if (line.is_level || !(determinant > 1e-6 * aa * bb)) {
      line.dark = line.bright = (ay + by) / total;
      line.is_level = true;
    } else {
      line.dark = std::max(0.0, (bb * ay - ab * by) / determinant);
      line.bright = std::max(0.0, (aa * by - ab * ay) / determinant);
      // A line that is negative at one end is 0 there.
      if (line.dark == 0) line.bright = by / bb;
      if (line.bright == 0) line.dark = ay / aa;
    }
    double squares = 0, n = 0, weights = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double fit = line.dark * (1 - levels[i].brightness) + line.bright * levels[i].brightness;
      const double off = (levels[i].variance - fit) / (fit + 0.02);
      robust[i] = 1 / (1 + std::pow(off / (off > 0 ? 0.15 : 0.4), 2));  // texture adds and never takes away
      squares += robust[i] * off * off;
      n += robust[i];
      weights += robust[i] * levels[i].weight;
    }
    const double scatter = std::max(0.04, std::sqrt(squares / std::max(n - 2, 1.0)));
    // Each level errs by the scatter, whatever its weight.
    const double usual_weight = weights / std::max(n, 1e-9);
    line.dark_sd = scatter * (line.is_level ? line.dark : std::sqrt(usual_weight * bb / determinant));
    line.bright_sd = scatter * (line.is_level ? line.bright : std::sqrt(usual_weight * aa / determinant));
  }
  const double sure = kMostUnsure * (line.dark + line.bright) / 2 + 0.02;
  if (!line.is_level && std::max(line.dark_sd, line.bright_sd) > sure) return line_through(levels, true);
  return line;
}

}  // namespace sigs
