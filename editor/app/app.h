// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "editor/app/app_shell.h"
#include "editor/app/layout.h"
#include "editor/app/window.h"
#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/playback.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/preview_state.h"
#include "editor/preview/scoring.h"
#include "editor/views/own_body/own_body_session.h"
#include "editor/widgets/textures.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// For programs that drive the window from outside: writes what it shows into a JSON file, anew after each update that
// changed it.
//   {"turn": 12, "frame": 3, "revision": 4, "unsaved": true, "current": true, "busy": false, "page": "project",
//    "problems": ["footage.video: ..."], "turns_a_second": 60, "places": {"ruler": [x, y, width, height], ...},
//    "memory": {"pictures": 1000, "decoded": ..., "shown": ..., "textures": ..., "sum": ..., "limit": ...}, in bytes
//    "mouse": [x, y], "buttons": 1, "released_keys": 7, "at_rest": true}
// By the last line a driver learns that its input has arrived: position of the mouse in this update, one bit for each
// button that is down, number of keys released so far, and whether some updates have passed since without any input.
struct ProbedWindow {
  std::string page;               // "start" or "project"
  double updates_per_second = 0;  // of the loop, over the last second
  int released_keys = 0;          // modifiers aside
  bool has_input_left = false;    // that a later update will receive
};

class ProbeWriter {
 public:
  // Nothing is written where the path is empty.
  explicit ProbeWriter(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  void write(const Document& document, const PreviewOutput& shown, const UiProbe& ui_probe, const ProbedWindow& window);

 private:
  [[nodiscard]] bool is_at_rest(const nlohmann::json& input, bool has_input_left);

  std::filesystem::path file_;
  std::string last_;
  int update_ = 0;
  nlohmann::json last_input_;
  int turns_to_rest_ = 0;
};

// The editor: one window, one document, and everything that connects them.
class App {
 public:
  App(Window& window, Settings settings, ProbeWriter probe);

  // Opens a project; the start page is shown until then. Errors are shown in the window.
  void open(const std::filesystem::path& path);

  // One update of the loop: draws everything, then lets the document apply the edits and the program the requests that
  // the views queued.
  //   now_s               seconds of a steady clock
  //   something_happened  an event or a wake came since the last update
  void update(double now_s, bool something_happened);
  // Seconds until the next update is due if nothing happens.
  [[nodiscard]] double wait_timeout_s() const;
  [[nodiscard]] bool done() const { return done_; }

 private:
  void ask_preview();
  void advance(const PreviewOutput& shown);
  void take_edits();
  void keep_mask_then(std::function<void()> next);
  void play(double speed);
  void draw(const PreviewOutput& shown);
  void handle(const Request& request);
  bool handle_results(const Request& request);
  void ask_scores(const ViewContext& context);
  void report_result_problems();
  void show_title();
  void count_updates();

  Window& window_;
  Settings settings_;
  Textures textures_;
  Document document_;
  Edits edits_;
  ViewNeeds needs_;
  UiProbe ui_probe_;
  ProbeWriter probe_writer_;
  Previewer previewer_;
  OwnBodySession own_body_;
  ResultFiles results_;
  Scoring scoring_;
  std::shared_ptr<const Scored> scored_;          // of this update
  std::map<int, std::string> reported_problems_;  // by the result file's id
  AppShell shell_;
  std::string title_;
  Playback playback_;
  Layout layout_;
  double now_s_ = 0;
  double counted_since_s_ = 0;
  int updates_ = 0;
  double updates_per_second_ = 0;
  int redraw_updates_left_ = 0;
  bool done_ = false;
};

}  // namespace sigs::editor
