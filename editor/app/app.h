// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "editor/app/front_desk.h"
#include "editor/app/layout.h"
#include "editor/app/probe.h"
#include "editor/app/window.h"
#include "editor/document/document.h"
#include "editor/document/result_files.h"
#include "editor/document/settings.h"
#include "editor/preview/playback.h"
#include "editor/preview/previewer.h"
#include "editor/preview/scoring.h"
#include "editor/views/own_body/own_body_work.h"
#include "editor/widgets/textures.h"

namespace sigs::editor {

// The program: one window, one document, and what goes on between them.
class App {
 public:
  App(Window& window, Settings settings, Probe probe);

  // Shows the start page where there is no path.
  void open(const std::filesystem::path& path);

  // One turn of the loop: draws, then lets the document and the program take what was asked for.
  //   something_happened  an event or a wake came since the last turn
  void turn(double now_s, bool something_happened);
  // Seconds until the next turn is due, if nothing happens.
  [[nodiscard]] double patience_s() const;
  [[nodiscard]] bool done() const { return done_; }

 private:
  void ask_preview();
  void advance(const Shown& shown);
  void take_edits();
  void keep_mask_then(std::function<void()> next);
  void play(double speed);
  void draw(const Shown& shown);
  void take(const Request& request);
  bool take_results(const Request& request);
  void ask_scores(const Studio& studio);
  void tell_of_results();
  void show_title();
  void count_turns();

  Window& window_;
  Settings settings_;
  Textures textures_;
  Document document_;
  Edits edits_;
  Wishes wishes_;
  Places places_;
  Probe probe_;
  Previewer previewer_;
  OwnBodyWork own_body_;
  ResultFiles results_;
  Scoring scoring_;
  std::shared_ptr<const Scored> scored_;      // of this turn
  std::map<int, std::string> told_problems_;  // by the result file's id
  FrontDesk desk_;
  std::string title_;
  Playback playback_;
  Layout layout_;
  double now_s_ = 0;
  double counted_since_s_ = 0;
  int turns_ = 0;
  double turns_a_second_ = 0;
  int restless_turns_ = 0;
  bool done_ = false;
};

}  // namespace sigs::editor
