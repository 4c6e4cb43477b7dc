// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>

#include "base/json.h"
#include "base/random.h"
#include "camera/camera.h"
#include "dataset/design_domain.h"
#include "dataset/recipe.h"
#include "truth/annotation.h"

namespace sigs {

// What a flight should show at one time. Numbers that are not named are free.
struct DomainWish {
  std::map<DomainNumber, Span> numbers;
  std::optional<HorizonSide> horizon;
};

// A flight of the kind image_position, as a recipe has it, that shows what is wished in the middle of its video, as far
// as geometry tells: to be checked by planning it. None: none was found, because the place has no pixel, or no speed of
// the aircraft gives that aspect at that closing speed before this camera.
//
// With p the ray to the intruder, u the camera's speed along p, a the aspect and s the intruder's speed, its velocity
// is s (-cos(a) p + sin(a) q), q level and at right angles to p, and the closing speed is s cos(a) + u.
[[nodiscard]] std::optional<Json> wished_flight(const DomainWish& wish, const Background& background,
                                                const Camera& lens, const Aircraft& aircraft, Random& random);

}  // namespace sigs
