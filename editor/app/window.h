// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <array>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "editor/document/settings.h"

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
  unsigned character = 0;  // Unicode code point; where it is not 0, no other member counts
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
  int button = 0;  // From 0: left, right, middle, ... as GLFW counts.
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
    [[nodiscard]] bool operator==(const Place&) const = default;
  };
  std::optional<Place> at;  // none: no event; the present position of the mouse counts
};

// Spreads mouse events over updates. ImGui up to 1.86 reads the buttons once per update: of two clicks during a slow
// update it would find one. The queue lets each button change once per update, in order. A button that goes up
// elsewhere than where the last event was is down there for an update before: what it drags gets there.
class ButtonQueue {
 public:
  // Buttons that ImGui does not have (above the fifth) are ignored.
  void push(const ButtonEvent& event);
  [[nodiscard]] bool empty() const { return events_.empty(); }
  // Removes the events for this update: up to the second change of a button, or a release elsewhere. Without events,
  // the buttons as they were.
  [[nodiscard]] Buttons take_for_update();

 private:
  std::deque<ButtonEvent> events_;
  std::array<bool, 5> down_{};  // as the last update was told
  std::optional<Buttons::Place> at_;
};

// A window of the desktop with an OpenGL context and ImGui in it. One per program; all calls but wake() come from the
// thread that opened it.
class Window {
 public:
  // Opens a window of the size that the settings remember, no larger than the screen has room for. Error unavailable
  // where there is no display or no OpenGL 3.3.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const Settings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Waits for an event or a wake(), at most timeout_s seconds; not at all while input of earlier events is left.
  // Returns whether one came. Events are only received here.
  bool wait(double timeout_s);
  static void wake();  // ends a wait(); may be called from any thread

  // All ImGui calls of an update lie between these two. The font's size follows the settings and the screen's scale;
  // end() draws the regions of the window that look different from the update before. While a mouse button is held,
  // panels that lie neither under the mouse nor at `image_at` may wait.
  //   image_at  a place on the screen of the image that edits are made for
  void begin(const Settings& settings);
  void end(const ImVec2& image_at);

  // Whether the person asked to close the window; refuse_to_close() takes the request back.
  [[nodiscard]] bool wants_to_close() const;
  void refuse_to_close();
  void set_title(const std::string& title);
  [[nodiscard]] bool has_dropped() const;
  // Files that were dropped onto the window since the last call.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped();

  // Writes the size of the window, and whether it is maximised, into the settings for the next start.
  void remember_in(Settings& settings) const;

  void toggle_full_screen();

  // Number of keys (without modifiers) whose release ImGui has received so far.
  [[nodiscard]] int released_keys() const;
  [[nodiscard]] bool has_input_left() const;  // whether keys or mouse buttons wait for a later update

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  // The places whose panels are drawn in this update though others have to wait; none: all are drawn.
  [[nodiscard]] static std::vector<ImVec2> places_drawn_first(State& state, const ImVec2& image_at);
  std::unique_ptr<State> state_;
};

}  // namespace sigs::editor
