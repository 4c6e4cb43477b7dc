// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/document/project_paths.h"
#include "editor/document/settings.h"
#include "editor/views/context.h"
#include "editor/widgets/ui_probe.h"

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
  // What the slider shows while it is held; 0: it is not.
  double font_px_ = 0;
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
  void apply(const ViewContext& context) const;

  bool open_ = false;
  std::vector<MissingFile> missing_;
  // By the field's key: what the person chose, and what suggested_places() proposes from that.
  std::map<std::string, std::filesystem::path> places_;
  std::map<std::string, std::filesystem::path> suggested_;
};

}  // namespace sigs::editor
