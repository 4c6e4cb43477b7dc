// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>

namespace sigs::editor {

// Points on the screen, as ImGui has them (float) and as we do (double), in the same coordinates.
[[nodiscard]] inline ImVec2 im(const glm::dvec2& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}
[[nodiscard]] inline glm::dvec2 dv(const ImVec2& p) {
  return {p.x, p.y};
}

}  // namespace sigs::editor
