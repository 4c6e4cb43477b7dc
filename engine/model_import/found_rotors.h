// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "model_import/scene_file.h"

namespace sigs {

// Whether a part or its material is named as a rotor, whatever its shape.
[[nodiscard]] bool is_named_as_rotor(const ImportedScene& scene, const ImportedPart& part);

// Replaces parts that are named as rotors (rotor, propeller, prop, blade) by discs of blades that turn
// (docs/rotors.md). A name tells the axis: of a propeller along the nose, of a tail rotor across, of any other rotor
// upright. The shape tells hub and radius, and how many blades there are where they can be counted; the rest is a
// guess. Parts of one name that lie left and right are two rotors; parts at one hub are one. What is no disc about such
// an axis stays.
//   scene  nose +x, left +y, up +z, metres
// Returns a line for each rotor: what was found, what is guessed.
[[nodiscard]] std::vector<std::string> turn_rotors(ImportedScene& scene);

}  // namespace sigs
