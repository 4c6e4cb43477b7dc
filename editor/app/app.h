// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "editor/app/app_shell.h"
#include "editor/app/layout.h"
#include "editor/app/probe_writer.h"
#include "editor/app/window.h"
#include "editor/document/document.h"
#include "editor/document/result_files.h"
#include "editor/document/settings.h"
#include "editor/preview/playback.h"
#include "editor/preview/previewer.h"
#include "editor/preview/scoring.h"
#include "editor/views/own_body/own_body_session.h"
#include "editor/widgets/textures.h"

namespace sigs::editor {

// The program: one window, one document, and what goes on between them.
class App {
 public:
  App(Window& window, Settings settings, ProbeWriter probe);

  // Shows the start page where there is no path.
  void open(const std::filesystem::path& path);

  // One update of the loop: draws, then lets the document and the program handle what was asked for.
  //   something_happened  an event or a wake came since the last update
  void update(double now_s, bool something_happened);
  // Seconds until the next update is due, if nothing happens.
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
