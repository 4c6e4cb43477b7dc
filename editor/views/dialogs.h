// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/document/settings.h"
#include "editor/views/context.h"
#include "editor/widgets/ui_probe.h"
#include "editor/document/project_paths.h"

namespace sigs::editor {

// Small windows over everything else, drawn once per update while they are wanted.

// The number of the answer that was given. Escape gives the last one.
[[nodiscard]] std::optional<int> draw_question(const Question& question, UiProbe& ui_probe);

// A key and what it does.
struct HelpLine {
  std::string group;
  std::string keys;
  std::string what;
};
// False once it was closed; so with the others.
[[nodiscard]] bool draw_help(std::span<const HelpLine> lines, UiProbe& ui_probe);

[[nodiscard]] bool draw_about(const std::string& version, UiProbe& ui_probe);

// How the editor looks and behaves. The size of the text counts when the slider is let go: it moves everything.
class SettingsDialog {
 public:
  [[nodiscard]] bool draw(Settings& settings, UiProbe& ui_probe);

 private:
  double font_px_ = 0;  // while the slider is held; 0: it is not
};

// Asks where the project's missing files are. One that was found lets the others be found.
class RelinkDialog {
 public:
  void open(const Project& project);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once per update while it is open. What was chosen becomes one step of undo.
  void draw(const ViewContext& context);

 private:
  void draw_rows(const ViewContext& context);
  void browse(const ViewContext& context, const MissingFile& missing);
  void found(const MissingFile& missing, const std::filesystem::path& place);
  void apply(const ViewContext& context) const;

  bool open_ = false;
  std::vector<MissingFile> missing_;
  std::map<std::string, std::filesystem::path> places_;     // by field: what the person chose
  std::map<std::string, std::filesystem::path> suggested_;  // by field
};

}  // namespace sigs::editor
