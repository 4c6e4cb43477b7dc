// SPDX-License-Identifier: MIT
#include "scene/heat.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "base/text.h"

namespace sigs {

namespace {

bool has_word(const std::string& name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return name.find(word) != std::string::npos; });
}

}  // namespace

HeatLevels heat_levels_of(const HeatSettings& heat, const ThermalSettings& thermal) {
  const double sign = thermal.hot == HotChoice::white ? 1 : -1;
  HeatLevels levels{};
  std::size_t i = 0;
  for (const double above_sky : {heat.skin, heat.engine, heat.exhaust, heat.glass, heat.rotor})
    levels[i++] = static_cast<float>(std::max((thermal.sky + sign * above_sky) / 255, 0.0));
  return levels;
}

HeatPart heat_part_of(const Material& material) {
  if (material.rotor) return HeatPart::rotor;
  const std::string name = lower_case(material.name);
  if (has_word(name, {"exhaust", "nozzle", "afterburn"})) return HeatPart::exhaust;
  if (has_word(name, {"engine", "nacelle", "cowl", "grille", "motor", "battery", "intake", "fan"}))
    return HeatPart::engine;
  if (has_word(name, {"propeller", "rotor", "blade"})) return HeatPart::rotor;
  if (has_word(name, {"glass", "window", "canopy", "windshield"}) || material.opacity < 1) return HeatPart::glass;
  return HeatPart::skin;
}

void heat_surfaces(Mesh& mesh, const HeatLevels& levels) {
  for (Material& material : mesh.materials) {
    material.diffuse = glm::vec3(levels[static_cast<std::size_t>(heat_part_of(material))]);
    material.specular = glm::vec3(0);
    material.texture = cv::Mat();
    // A disc that stands for blades stays as thin as it is.
    if (heat_part_of(material) != HeatPart::rotor) material.opacity = 1;
  }
}

}  // namespace sigs
