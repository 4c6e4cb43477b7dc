// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "editor/app/app_shell.h"
#include "editor/app/layout.h"
#include "editor/app/window.h"
#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/preview/playback.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/rig_preview.h"
#include "editor/preview/scoring.h"
#include "editor/views/context.h"
#include "editor/views/estimate_session.h"
#include "editor/views/own_body/own_body_session.h"

namespace sigs::editor {

// What the keys do, for the help page, by groups: what handle_keys follows, and below that what views take themselves
// while the mouse is over them.
[[nodiscard]] std::vector<HelpLine> help_lines();

// Asks for what the keys pressed in this update mean. Not while text is typed or a dialog is open; while the mouse
// holds something only those that go and play; without a project those of the program alone.
void handle_keys(const ViewContext& context, bool has_project);

// What the probe reports beside the document and the preview.
struct ProbedWindow {
  std::string page;               // "start" or "project"
  double updates_per_second = 0;  // of the loop, over the last second
  int released_keys = 0;          // number of keys released so far, modifiers aside
  bool has_input_left = false;    // there is input that a later update will receive
};

// For programs that drive the window from outside: writes what it shows into a JSON file, anew after each update that
// changed it. The file is replaced as a whole, so a reader never finds half of it.
//   {"turn": 12, "frame": 3, "revision": 4, "camera": 0, "unsaved": true, "current": true, "busy": false, "page":
//   "project",
//    "problems": ["footage.video: ..."], "turns_a_second": 60, "places": {"ruler": [x, y, width, height], ...},
//    "memory": {"images": 1000, "decoded": ..., "shown": ..., "textures": ..., "sum": ..., "limit": ...}, in bytes
//    "composites": 31, how often another composited frame was shown than in the update before,
//    "interval_ms": [33, 38, 52], from one of these to the next, of the last 200: the median, and what 90 and 99 of 100
//    stay below,
//    "mouse": [x, y], "buttons": 1, "released_keys": 7, "at_rest": true}
// By the last line a driver learns that its input has arrived: position of the mouse in this update, one bit for each
// button that is down, number of keys released so far, and whether some updates have passed since without any input.
class ProbeWriter {
 public:
  // Nothing is written where the path is empty.
  explicit ProbeWriter(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  // Once per update, what it draws: of the document as it was then.
  void note(const Document& document, const PreviewOutput& shown, const UiProbe& ui_probe, const ProbedWindow& window);
  // Once that is on the screen. A file that cannot be written is tried again in the next update.
  void write();

 private:
  // Whether input has been the same for three updates and none is left.
  [[nodiscard]] bool is_at_rest(const nlohmann::json& input, bool has_input_left);
  // How many composited frames were shown so far, with the one of this update.
  [[nodiscard]] int composites_shown(const std::shared_ptr<const PreviewImage>& image);
  [[nodiscard]] std::vector<double> intervals_ms() const;

  std::filesystem::path file_;
  nlohmann::json noted_;
  // The text that was written last, without its "turn", and the input of the update before.
  std::string last_;
  int update_ = 0;
  nlohmann::json last_input_;
  int turns_to_rest_ = 0;                    // updates until it is at rest
  std::weak_ptr<const PreviewImage> image_;  // of the update before; holds no image
  int composites_ = 0;
  std::deque<double> shown_at_s_;  // when the last of them were shown
};

// The editor: one window, one document, and everything that connects them. It lives on the window's thread; the
// previewer, the scoring and the jobs that it owns have threads of their own and wake the window.
class App {
 public:
  // The window must outlive it. Throws std::system_error where the system gives no threads. No project is open at
  // first.
  App(Window& window, Settings settings, ProbeWriter probe);

  // Opens a project; the start page is shown until it is read. Errors are shown in the window.
  void open(const std::filesystem::path& path) { shell_.handle(OpenProject{path}); }

  // One update of the loop: lays everything out, lets the document apply the edits that the views queued, asks the
  // preview for what is to be shown next, which is made while OpenGL draws, then has the program handle requests.
  // Nothing here waits for the preview.
  //   now_s               seconds of a steady clock
  //   something_happened  an event or a wake came since the last update
  void update(double now_s, bool something_happened);
  // Seconds until the next update is due if nothing happens: 0 while it plays or ImGui needs some more updates, 0.1
  // while something on the screen changes by itself, else 0.25.
  [[nodiscard]] double wait_timeout_s() const;
  // The person has quit; the settings are written by then.
  [[nodiscard]] bool done() const { return done_; }
  [[nodiscard]] bool plays() const { return playback_.playing(); }

 private:
  void ask_preview();
  void advance(const PreviewOutput& shown);  // moves the playhead while it plays
  // Takes the keyboard from a text that is being typed, which becomes an edit in the next update: true. False where
  // none is, or where it was taken in the update before.
  [[nodiscard]] bool finish_typing();
  // Lets the document apply what is queued; playing goes on from where the playhead was moved to.
  void take_edits();
  // Asks to save the own-body mask; next: once the edit that uses it is applied.
  void keep_mask_then(std::function<void()> next);
  void play(double speed);
  void draw(const PreviewOutput& shown, const std::vector<PreviewOutput>& rig);  // rig: of each camera, by its index
  void handle(const Request& request);
  // Requests of trackers' results. False: it was another one.
  bool handle_results(const Request& request);
  void ask_scores(const ViewContext& context);
  void report_result_problems();  // says once of each result file what is wrong with it
  void show_title();
  void count_updates();

  Window& window_;
  Settings settings_;
  std::vector<std::filesystem::path> kept_recent_;  // those of the settings' file
  Textures textures_;
  Document document_;
  Edits edits_;
  ViewNeeds needs_;  // of the views that were drawn in the last update
  UiProbe ui_probe_;
  ProbeWriter probe_writer_;
  RigPreview preview_;
  OwnBodySession own_body_;
  EgoMotionSession ego_motion_;
  HorizonWatch horizon_watch_;
  AppearanceSession appearance_;
  LightSession light_;
  ResultFiles results_;
  Scoring scoring_;
  std::shared_ptr<const Scored> scored_;          // of this update; null: no results are loaded
  std::map<int, std::string> reported_problems_;  // by the result file's id
  AppShell shell_;
  std::string title_;
  Playback playback_;
  Layout layout_;
  double now_s_ = 0;
  double counted_since_s_ = 0;  // of updates_
  int updates_ = 0;
  double updates_per_second_ = 0;
  int redraw_updates_left_ = 0;  // that follow at once (kUpdatesToSettle)
  bool has_left_text_ = false;   // finish_typing() took the keyboard in the update before
  bool done_ = false;
};

}  // namespace sigs::editor
