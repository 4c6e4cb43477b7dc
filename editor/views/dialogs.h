// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/document/project_paths.h"
#include "editor/document/settings.h"
#include "editor/preview/background_job.h"
#include "editor/views/context.h"

namespace sigs::editor {

// Small windows over everything else, drawn once per update while they are wanted.

// Index of the answer that was given, in the update in which it is; none before. Escape gives the last one.
[[nodiscard]] std::optional<int> draw_question(const Question& question, UiProbe& ui_probe);

// A key and what it does, under the heading of its group.
struct HelpLine {
  std::string group;
  std::string keys;
  std::string what;
};
// False once it was closed; so with the others. The caller then stops drawing it.
[[nodiscard]] bool draw_help(std::span<const HelpLine> lines, UiProbe& ui_probe);

[[nodiscard]] bool draw_about(const std::string& version, UiProbe& ui_probe);

// How the editor looks and behaves. Changes go into the settings at once, but for the size of the text, which counts
// when the slider is let go: it moves everything.
class SettingsDialog {
 public:
  [[nodiscard]] bool draw(Settings& settings, UiProbe& ui_probe);

 private:
  double font_px_ = 0;  // what the slider shows while it is held; 0: it is not
};

// Asks where the project's missing files are. One that was found lets the others be found (suggested_places()).
class RelinkDialog {
 public:
  // Looks which files are missing.
  void open(const Project& project);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once per update while it is open. What was chosen becomes one step of undo when the person agrees.
  void draw(const ViewContext& context);

 private:
  void draw_rows(const ViewContext& context);
  // Asks for one file.
  void browse(const ViewContext& context, const MissingFile& missing);
  // The person has chosen one: the others are looked for beside it.
  void found(const MissingFile& missing, const std::filesystem::path& place);

  bool open_ = false;
  std::vector<MissingFile> missing_;
  // By the field's key: what the person chose, and what suggested_places() proposes from that.
  std::map<std::string, std::filesystem::path> places_;
  std::map<std::string, std::filesystem::path> suggested_;
};

// The bar along the window's upper edge: menus, the project's name with a dot where something is unsaved, the number
// of its problems, and a running export. Which panels are shown it changes in the settings at once.
void draw_menu_bar(const ViewContext& context, bool has_project, const ExportState& exporting, Settings& settings);

// Passing messages, above the timeline. Errors stay longer, and as long as the mouse is over one; a click takes any
// away.
class Toasts {
 public:
  // A message that is shown already counts up instead of appearing twice. now_s: seconds of a steady clock, in all
  // calls.
  void show(const ShowMessage& shown_message, double now_s);
  // foot: the middle of the lowest one's lower edge; width_px: room from left to right.
  void draw(UiProbe& ui_probe, double now_s, ImVec2 foot, float width_px);
  // Another project is open: they would speak of one that is not.
  void clear() { toasts_.clear(); }

  // Whether one will pass by itself: the window has to be drawn again soon.
  [[nodiscard]] bool is_passing() const { return !toasts_.empty(); }

  // Of messages that are shown.
  [[nodiscard]] std::size_t count() const { return toasts_.size(); }
  // Takes away those whose time is over; draw() does so too.
  void pass(double now_s);

 private:
  struct Toast {
    std::string text;
    bool is_error = false;
    // When its time is over.
    double until_s = 0;
    int times = 1;  // how often the same message came
  };
  std::deque<Toast> toasts_;  // oldest first
};

}  // namespace sigs::editor
