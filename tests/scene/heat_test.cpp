// SPDX-License-Identifier: MIT
#include "scene/model.h"

#include <doctest/doctest.h>

#include <utility>

#include "support/test_data.h"

namespace sigs::test {

TEST_CASE("a part's level is its heat above the sky, below it where warm is black, and never below black") {
  const HeatSettings heat{.skin = 51, .engine = 102, .exhaust = 500, .glass = 0, .rotor = 25.5};
  const HeatLevels white = heat_levels_of(heat, {.sky = 102});
  CHECK(white[static_cast<std::size_t>(HeatPart::skin)] == doctest::Approx(0.6));
  CHECK(white[static_cast<std::size_t>(HeatPart::engine)] == doctest::Approx(0.8));
  CHECK(white[static_cast<std::size_t>(HeatPart::exhaust)] == doctest::Approx(602.0 / 255));  // clips later
  CHECK(white[static_cast<std::size_t>(HeatPart::glass)] == doctest::Approx(0.4));
  const HeatLevels black = heat_levels_of(heat, {.sky = 102, .hot = HotChoice::black});
  CHECK(black[static_cast<std::size_t>(HeatPart::skin)] == doctest::Approx(0.2));
  CHECK(black[static_cast<std::size_t>(HeatPart::exhaust)] == 0);
}

TEST_CASE("the part of a surface is told by its material") {
  const auto part = [](const char* name, float opacity = 1) {
    return heat_part_of(Material{.name = name, .opacity = opacity});
  };
  CHECK(part("fuselage") == HeatPart::skin);
  CHECK(part("") == HeatPart::skin);
  CHECK(part("Engine_Nacelle") == HeatPart::engine);
  CHECK(part("cowl") == HeatPart::engine);
  CHECK(part("left_exhaust") == HeatPart::exhaust);
  CHECK(part("engine exhaust") == HeatPart::exhaust);
  CHECK(part("windows") == HeatPart::glass);
  CHECK(part("lens", 0.3F) == HeatPart::glass);
  CHECK(part("propeller_disc", 0.2F) == HeatPart::rotor);
  Material disc{.name = "main"};
  disc.rotor = Rotor{};
  CHECK(heat_part_of(disc) == HeatPart::rotor);
}

TEST_CASE("a heated mesh has neither livery nor highlights, and glass is opaque; discs stay thin") {
  Mesh mesh = read_obj(source_dir() / "assets/models/light-aircraft/light-aircraft.obj").value();
  heat_surfaces(mesh, {0.5F, 0.7F, 0.9F, 0.4F, 0.3F});
  bool has_glass = false, has_rotor = false;
  for (const Material& material : mesh.materials) {
    CHECK(material.texture.empty());
    CHECK(material.specular == glm::vec3(0));
    CHECK(material.diffuse.x == material.diffuse.z);
    has_glass |= heat_part_of(material) == HeatPart::glass;
    has_rotor |= heat_part_of(material) == HeatPart::rotor;
    if (heat_part_of(material) != HeatPart::rotor) CHECK(material.opacity == 1);
  }
  CHECK(has_rotor);
  // The name alone tells it afterwards: made opaque, a pane must not turn into skin.
  CHECK(has_glass);
}

}  // namespace sigs::test
