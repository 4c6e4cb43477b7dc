// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "editor/document/settings.h"

namespace sigs::editor {

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
  // Ends a wait(); may be called from any thread.
  static void wake();

  // All ImGui calls of an update lie between these two. The font's size follows the settings and the screen's scale;
  // end() draws the regions of the window that look different from the update before.
  void begin(const Settings& settings);
  void end();

  // Whether the person asked to close the window; refuse_to_close() takes the request back.
  [[nodiscard]] bool wants_to_close() const;
  void refuse_to_close();
  void set_title(const std::string& title);
  // Files that were dropped onto the window since the last call.
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped();

  // Writes the size of the window, and whether it is maximised, into the settings for the next start.
  void remember_in(Settings& settings) const;

  void toggle_full_screen();

  // Number of keys (without modifiers) whose release ImGui has received so far.
  [[nodiscard]] int released_keys() const;
  // Whether keys or mouse buttons wait for a later update.
  [[nodiscard]] bool has_input_left() const;

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  // The place whose panel is drawn in this update though others have to wait; none: all are drawn.
  [[nodiscard]] static std::optional<ImVec2> place_drawn_first(State& state);
  std::unique_ptr<State> state_;
};

}  // namespace sigs::editor
