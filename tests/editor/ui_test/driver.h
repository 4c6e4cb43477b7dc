// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace sigs::test {

// A place on the screen as the editor's probe gives it.
struct ScreenPlace {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
  [[nodiscard]] double center_x() const { return x + width / 2; }
  [[nodiscard]] double center_y() const { return y + height / 2; }
};

// How long anything may take, on the busiest of machines. Nothing waits so long where all is well.
constexpr double kPatience_s = 240;

// Variables that a program gets besides those of the test.
using Environment = std::map<std::string, std::string>;

// True where Xvfb and xdotool are there; else says skipped.
[[nodiscard]] bool can_drive_windows();

// Whether the interface shows an element in a state of the editor, by its name.
[[nodiscard]] bool shows(const nlohmann::json& state, const std::string& place);

// A virtual display with the editor, driven by real mouse and key events. Throws std::runtime_error
// where something does not happen within kPatience_s.
class EditorDriver {
 public:
  //   home  an empty folder for settings and recovery files
  EditorDriver(const std::filesystem::path& home, int width_px, int height_px);
  ~EditorDriver();
  EditorDriver(const EditorDriver&) = delete;
  EditorDriver& operator=(const EditorDriver&) = delete;

  // SIGS_TEST_EDITOR, a program, stands for the build's own editor.
  void start(const std::vector<std::string>& arguments, const Environment& environment = {});
  void kill();                      // as a crash does
  [[nodiscard]] bool running();     // false once the program has ended
  [[nodiscard]] int exit_status();  // waits for the end

  // The editor's present state (editor/app/app.h).
  [[nodiscard]] nlohmann::json state() const;
  [[nodiscard]] bool has_place(const std::string& name) const;
  [[nodiscard]] ScreenPlace place(const std::string& name);  // waits for it
  void wait_for(const std::string& what, const std::function<bool(const nlohmann::json&)>& is_so);
  // The image of the present revision and frame is shown.
  void wait_for_image();
  void settle();  // some updates of the window's loop

  // Each of these returns when the window has processed the events and shown the result, or has ended.
  // Hurried, they return when the events have been processed.
  void set_hurried(bool hurried) { hurried_ = hurried; }
  void move(double x, double y);
  void click(double x, double y, int button = 1);
  void click(const std::string& place, int button = 1);
  // Whether it was processed fast enough; on a busy machine it may have been two clicks.
  [[nodiscard]] bool double_click(double x, double y);
  // In steps, with the button held; keys ("ctrl") are held meanwhile.
  void drag(double x, double y, double to_x, double to_y, int button = 1, const std::string& held_key = {});
  void drag(const std::string& place, double by_x, double by_y, int button = 1, const std::string& held_key = {});
  // The same within one update, as on a machine that was busy meanwhile.
  void drag_at_once(double x, double y, double to_x, double to_y);
  // The parts of a drag, for what happens in its middle.
  void hold(double x, double y, int button = 1);
  void release(int button = 1);
  void wheel(double x, double y, int clicks);  // positive: away from the user
  void key(const std::string& keys);           // "ctrl+z"
  void type(const std::string& text);
  // Sends keys, and kills the editor so long after, whatever it does then.
  void kill_after_key(const std::string& keys, double delay_s);
  // Gives the window another size.
  void resize(int width_px, int height_px);
  // Sizes, width and height, one straight after the other, as a hand that drags an edge gives them.
  void resize_through(const std::vector<std::pair<int, int>>& sizes_px);
  // Takes the window from the screen and puts it there again: all of it has to be drawn anew.
  void hide_and_show();

  void screenshot(const std::filesystem::path& file, bool with_mouse = false) const;  // PNG

 private:
  [[nodiscard]] std::shared_ptr<const nlohmann::json> look() const;  // state()
  // Those that do not wait for the result: one update has processed the event.
  void point_at(double x, double y);
  void press(int button);
  void lift(int button);
  void wait_until_seen(const std::string& what, const std::function<bool(const nlohmann::json&)>& is_so);
  void wait_until_at_rest();
  void xdotool(const std::vector<std::string>& arguments) const;

  std::filesystem::path home_;
  std::filesystem::path probe_;
  mutable std::string read_;  // of the probe, whose state this is: parsed when it has changed
  mutable std::shared_ptr<const nlohmann::json> state_;
  std::string display_;
  int width_px_;
  int height_px_;
  pid_t screen_ = -1;
  pid_t editor_ = -1;
  int exit_status_ = 0;
  bool hurried_ = false;
  int released_keys_ = 0;  // since the start, without modifiers
};

}  // namespace sigs::test
