// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "model.h"
#include "paint.h"

namespace sigs::models {

// Reflectances of what is alike on all models.
inline constexpr double kTyre = 0.05, kSeam = 0.22, kOpening = 0.03;

// Lacquer and glass reflect 4 % (index of refraction 1.5); the renderer takes a quarter of Ks.
[[nodiscard]] MaterialSpec lacquer(const std::string& name, const Colour& reflectance);
[[nodiscard]] MaterialSpec lacquer_image(const std::string& name, const std::string& file);
[[nodiscard]] MaterialSpec matt(const std::string& name, const Colour& reflectance);
[[nodiscard]] MaterialSpec metal(const std::string& name, double reflectance);
[[nodiscard]] MaterialSpec glass(const std::string& name, double opacity);

// Lamps: light_red, light_green, light_white. The renderer has no light of a surface's own, so they are as bright as a
// lit surface can be.
[[nodiscard]] std::vector<MaterialSpec> lamps();

[[nodiscard]] std::vector<MaterialSpec> together(const std::vector<std::vector<MaterialSpec>>& lists);

}  // namespace sigs::models
