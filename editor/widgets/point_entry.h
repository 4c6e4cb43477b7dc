// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace sigs::editor {

// A small window in which a point is typed: x, y, z in metres. Enter takes it, Esc or a click beside leaves it.
class PointEntry {
 public:
  void open(std::string title, const glm::dvec3& point_m);
  // Once per update, within the same ImGui window each time; the point, in the update in which it is taken.
  [[nodiscard]] std::optional<glm::dvec3> draw();
  [[nodiscard]] bool is_open() const { return state_ != State::closed; }

 private:
  enum class State { closed, asked, open, leaving };

  void draw_fields();

  State state_ = State::closed;
  bool appearing_ = false;
  std::string title_;
  glm::dvec3 point_m_{0, 0, 0};
};

}  // namespace sigs::editor
