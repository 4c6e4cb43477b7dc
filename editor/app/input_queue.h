// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

namespace sigs::editor {

// What a key does where text is typed; it decides how key events may be joined in one update.
enum class KeyKind {
  // A letter, digit or sign without Ctrl, Alt or Super: it comes again as a character.
  sign,
  // Shift, Ctrl, Alt, Super.
  modifier,
  // All others: may move a text's cursor, end a text or open one.
  action,
};

// An event of the keyboard as GLFW reports it: a key that went down or up, or a character that was typed.
struct KeyEvent {
  // GLFW_KEY_..., the platform's code, and GLFW_MOD_... bits.
  int key = 0;
  int scancode = 0;
  bool down = false;
  int modifiers = 0;
  KeyKind kind = KeyKind::action;
  // Unicode code point; where it is not 0, no other member counts.
  unsigned character = 0;
};

// Spreads key events over updates. ImGui up to 1.86 reads the state of the keys once per update: a key that goes down
// and up in between would be lost, and text that is typed after a shortcut that opens a text field would come before
// it. The queue gives each update as many events as ImGui can handle in order.
class KeyQueue {
 public:
  // In the order in which the events happened.
  void push(const KeyEvent& event) { events_.push_back(event); }
  [[nodiscard]] bool empty() const { return events_.empty(); }

  // Removes and returns the events for this update, in order: up to the first that ImGui would mix up with one before
  // it. The rest wait for the next update.
  //   types_text  a text field has the focus, which takes characters and needs no key events for them
  [[nodiscard]] std::vector<KeyEvent> take_for_update(bool types_text);

 private:
  std::deque<KeyEvent> events_;
};

// A mouse button that went down or up.
struct ButtonEvent {
  // From 0: left, right, middle, ... as GLFW counts.
  int button = 0;
  bool down = false;
  // Where the mouse was, in screen coordinates of the window.
  double x = 0;
  double y = 0;
};

// Input for one update: which buttons are down, and where the mouse was at the last press or release among its events.
struct Buttons {
  std::array<bool, 5> down{};
  struct Place {
    double x = 0;
    double y = 0;
  };
  // None: no event; the present position of the mouse counts.
  std::optional<Place> at;
};

// Spreads mouse events over updates. ImGui up to 1.86 reads the buttons once per update: of two clicks during a slow
// update it would find one. The queue lets each button change once per update, in order.
class ButtonQueue {
 public:
  // Buttons that ImGui does not have (above the fifth) are ignored.
  void push(const ButtonEvent& event);
  [[nodiscard]] bool empty() const { return events_.empty(); }
  // Removes the events for this update: up to the second change of a button. Without events, the buttons as they were.
  [[nodiscard]] Buttons take_for_update();

 private:
  std::deque<ButtonEvent> events_;
  // As the last update was told.
  std::array<bool, 5> down_{};
};

}  // namespace sigs::editor
