// SPDX-License-Identifier: MIT
#include "finishes.h"

namespace sigs::models {

namespace {

constexpr double kFourPercent = 0.16;  // Ks

}  // namespace

MaterialSpec lacquer(const std::string& name, const Colour& reflectance) {
  return {.name = name, .reflectance = reflectance, .specular = kFourPercent, .shininess = 100};
}

MaterialSpec lacquer_image(const std::string& name, const std::string& file) {
  return {.name = name, .specular = kFourPercent, .shininess = 100, .texture = file};
}

MaterialSpec matt(const std::string& name, const Colour& reflectance) {
  return {.name = name, .reflectance = reflectance};
}

MaterialSpec metal(const std::string& name, double reflectance) {
  return {.name = name, .reflectance = grey(reflectance), .specular = 0.8, .shininess = 40};
}

MaterialSpec glass(const std::string& name, double opacity) {
  return {.name = name,
          .reflectance = {0.013, 0.02, 0.026},
          .specular = kFourPercent,
          .shininess = 200,
          .opacity = opacity};
}

std::vector<MaterialSpec> lamps() {
  return {matt("light_red", {1, 0.02, 0.02}), matt("light_green", {0.02, 1, 0.2}), matt("light_white", grey(1))};
}

std::vector<MaterialSpec> together(const std::vector<std::vector<MaterialSpec>>& lists) {
  std::vector<MaterialSpec> all;
  for (const std::vector<MaterialSpec>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace sigs::models
