// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
#include <optional>

namespace sigs::editor {

// What the mouse did, as the system tells it.
struct ButtonEvent {
  int button = 0;
  bool down = false;
  double x = 0;  // where the mouse was, screen coordinates of the window
  double y = 0;
};

// What one update sees: which buttons are down, and where the mouse was at the last press or release that it sees.
struct Buttons {
  std::array<bool, 5> down{};
  struct Place {
    double x = 0;
    double y = 0;
  };
  std::optional<Place> at;  // none: nothing happened, the mouse is where it is
};

// ImGui up to 1.86 looks at the mouse once per update: of two clicks within a slow update it would see one. Keeps what
// came, and lets each button change once per update, in order.
class ButtonQueue {
 public:
  // Buttons that are not ImGui's are passed over.
  void push(const ButtonEvent& event);
  [[nodiscard]] bool empty() const { return events_.empty(); }
  [[nodiscard]] Buttons take_for_update();

 private:
  std::deque<ButtonEvent> events_;
  std::array<bool, 5> down_{};
};

}  // namespace sigs::editor
