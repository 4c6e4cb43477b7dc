// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

namespace sigs::editor {

enum class KeyKind {
  sign,      // of letters, digits and signs without Ctrl: told of again as a character
  modifier,  // Shift, Ctrl, Alt, Super
  action,    // all others: may move a text's cursor, end a text or open one
};

// What the keyboard did, as the system tells it: a key that went down or up, or the character that came of it.
struct KeyEvent {
  int key = 0;
  int scancode = 0;
  bool down = false;
  int modifiers = 0;
  KeyKind kind = KeyKind::action;
  unsigned character = 0;  // not 0: a character, and nothing else counts
};

// ImGui up to 1.86 looks at keys once per update: one that goes down and up in between goes by unseen, and what is
// typed after a chord that opens a text field would come before it. Keeps what came, and lets as much into an update as
// it can see in order.
class KeyQueue {
 public:
  void push(const KeyEvent& event) { events_.push_back(event); }
  [[nodiscard]] bool empty() const { return events_.empty(); }

  // What this update may see. types_text: characters go into a text field, which needs no more than them.
  [[nodiscard]] std::vector<KeyEvent> take_for_update(bool types_text);

 private:
  std::deque<KeyEvent> events_;
};

}  // namespace sigs::editor
