// SPDX-License-Identifier: MIT
#include "editor/app/window.h"

#include <set>

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

std::vector<KeyEvent> KeyQueue::take_for_update(bool types_text) {
  std::vector<KeyEvent> taken;
  std::set<int> changed;
  bool is_pressed = false;  // a key went down, with the modifiers as they were
  bool acts = false;        // and it may change what is done with text
  for (; !events_.empty(); events_.pop_front()) {
    const KeyEvent& event = events_.front();
    const bool is_character = event.character != 0;
    const bool waits = is_character                      ? acts
                       : event.kind == KeyKind::modifier ? is_pressed || changed.contains(event.key)
                                                         : changed.contains(event.key);
    if (waits) break;
    const bool is_reported_twice = types_text && event.kind == KeyKind::sign;
    if (!is_character && !is_reported_twice) {
      changed.insert(event.key);
      is_pressed = is_pressed || (event.down && event.kind != KeyKind::modifier);
      acts = acts || (event.down && event.kind == KeyKind::action);
    }
    taken.push_back(event);
  }
  return taken;
}

}  // namespace sigs::editor
