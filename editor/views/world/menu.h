// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "editor/views/world/picks.h"

namespace sigs::editor {

// What the right button offers where it was clicked.
class WorldMenu {
 public:
  // place_m: where a new waypoint would be, if that can be said.
  void open(const WorldPick& pick, const std::optional<glm::dvec3>& place_m);
  // Once per update; what a position is to be typed for, if that was chosen.
  [[nodiscard]] std::optional<Selection> draw(const WorldContext& world);

 private:
  enum class State { closed, asked, open };

  [[nodiscard]] std::optional<Selection> draw_items(const WorldContext& world) const;

  State state_ = State::closed;
  WorldPick pick_;
  std::optional<glm::dvec3> place_m_;
};

}  // namespace sigs::editor
