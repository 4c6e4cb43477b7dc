// SPDX-License-Identifier: MIT
#include "appearance/noise_lasting.h"

#include <algorithm>

namespace sigs {

double lasting_share(std::span<const NoiseBlock* const> blocks) {
  constexpr double kOfTexture = 0.7;    // what neighbours share of smooth texture, the plane being subtracted
  constexpr double kMostOfNoise = 0.4;  // noise of which they share more is too much like texture
  constexpr double kOfRounding = 1.0 / 12;
  double variance = 0, change = 0, shared = 0, shared_change = 0;
  for (const NoiseBlock* const block : blocks) {
    variance += (block->variance + block->next_variance) / 2;
    change += block->change();
    shared += block->neighbours;
    shared_change += block->change_neighbours;
  }
  if (!(change > 0) || !(variance > change)) return 0;
  const double lasting = variance - change;
  const double noise_only = std::max(0.1 * change, change - kOfRounding * static_cast<double>(blocks.size()));
  const double of_noise = std::clamp(shared_change / noise_only, 0.0, 1.0);
  double lasting_noise = lasting;
  if (of_noise < kMostOfNoise)
    lasting_noise *= std::clamp((kOfTexture - (shared - shared_change) / lasting) / (kOfTexture - of_noise), 0.0, 1.0);
  return lasting_noise / (lasting_noise + change);
}

}  // namespace sigs
