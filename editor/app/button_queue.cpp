// SPDX-License-Identifier: MIT
#include "editor/app/button_queue.h"

namespace sigs::editor {

void ButtonQueue::push(const ButtonEvent& event) {
  if (event.button >= 0 && static_cast<std::size_t>(event.button) < down_.size()) events_.push_back(event);
}

Buttons ButtonQueue::take_for_update() {
  Buttons buttons;
  std::array<bool, 5> changed{};
  for (; !events_.empty(); events_.pop_front()) {
    const ButtonEvent& event = events_.front();
    const auto button = static_cast<std::size_t>(event.button);
    if (changed[button]) break;
    changed[button] = true;
    down_[button] = event.down;
    buttons.at = {event.x, event.y};
  }
  buttons.down = down_;
  return buttons;
}

}  // namespace sigs::editor
