// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "editor/document/settings.h"

namespace sigs::editor {

// A window with OpenGL and ImGui in it. One per program.
class Window {
 public:
  // Error unavailable where there is no display or no OpenGL 3.3.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(const Settings& settings);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Waits for an event or wake(), but not longer. Whether one came.
  bool wait(double timeout_s);
  // From any thread.
  static void wake();

  // One update: ImGui's calls lie between the two. The font follows the settings and the screen.
  void begin(const Settings& settings);
  void end();

  [[nodiscard]] bool wants_to_close() const;
  void refuse_to_close();
  void set_title(const std::string& title);
  [[nodiscard]] std::vector<std::filesystem::path> take_dropped();

  // Its size and whether it is maximised, for the next time.
  void remember_in(Settings& settings) const;

  void toggle_full_screen();

  // Keys that went up, modifiers aside, as far as ImGui has been told of them.
  [[nodiscard]] int released_keys() const;
  // Keys or buttons wait for a later turn.
  [[nodiscard]] bool has_input_left() const;

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sigs::editor
