// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

namespace sigs::editor {

enum class KeyKind {
  sign,      // a letter, digit or sign without Ctrl: comes again as a character
  modifier,  // Shift, Ctrl, Alt, Super
  action,    // all others: may move a text's cursor, end a text or open one
};

// An event of the keyboard as GLFW reports it: a key that went down or up, or a character that was typed.
struct KeyEvent {
  int key = 0;
  int scancode = 0;
  bool down = false;
  int modifiers = 0;
  KeyKind kind = KeyKind::action;
  unsigned character = 0;  // Unicode code point; where it is not 0, no other member counts
};

// Spreads key events over updates. ImGui up to 1.86 reads the state of the keys once per update: a key that goes down
// and up in between would be lost, and text that is typed after a shortcut that opens a text field would come before
// it. The queue gives each update as many events as ImGui can handle in order.
class KeyQueue {
 public:
  void push(const KeyEvent& event) { events_.push_back(event); }
  [[nodiscard]] bool empty() const { return events_.empty(); }

  // Removes and returns the events for this update, in order. types_text: a text field has the focus, which takes
  // characters and needs no key events for them.
  [[nodiscard]] std::vector<KeyEvent> take_for_update(bool types_text);

 private:
  std::deque<KeyEvent> events_;
};

// A mouse button that went down or up.
struct ButtonEvent {
  int button = 0;
  bool down = false;
  double x = 0;  // where the mouse was, screen coordinates of the window
  double y = 0;
};

// Input for one update: which buttons are down, and where the mouse was at the last press or release among its events.
struct Buttons {
  std::array<bool, 5> down{};
  struct Place {
    double x = 0;
    double y = 0;
  };
  std::optional<Place> at;  // none: no event; the present position of the mouse counts
};

// Spreads mouse events over updates. ImGui up to 1.86 reads the buttons once per update: of two clicks during a slow
// update it would find one. The queue lets each button change once per update, in order.
class ButtonQueue {
 public:
  // Buttons that ImGui does not have (above the fifth) are ignored.
  void push(const ButtonEvent& event);
  [[nodiscard]] bool empty() const { return events_.empty(); }
  [[nodiscard]] Buttons take_for_update();

 private:
  std::deque<ButtonEvent> events_;
  std::array<bool, 5> down_{};
};

}  // namespace sigs::editor
