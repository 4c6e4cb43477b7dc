// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"

namespace sigs::editor {

// What the editor remembers between runs: sizes of the window and its panels, and recent projects. Not part of any
// project. A plain value; the ranges are enforced by read_settings() alone.
struct Settings {
  // Height of the text, kMinFont_px .. kMaxFont_px, times the screen's own scale. Everything else follows the text.
  double font_px = 15;
  // Of the window without the desktop's frame, divided by the screen's scale.
  int window_width_px = 1600;
  int window_height_px = 960;
  bool maximised = false;
  // Sizes of panels, in pixels where the text is 15 px high.
  double inspector_width = 330;
  double timeline_height = 210;
  double world_share = 0.38;  // share of the width that the world view has beside the footage, 0..1
  bool show_world = true;
  bool show_inspector = true;
  bool all_settings = false;          // the inspector shows every setting, not only those that most projects need
  bool loop = true;                   // playing starts again at the range's end
  double autosave_s = 20;             // seconds from an edit until the recovery file is written
  std::filesystem::path last_folder;  // where the file browser was last; "": nowhere yet
  std::vector<std::filesystem::path> recent;  // project files, absolute, newest first, at most 12

  [[nodiscard]] bool operator==(const Settings&) const = default;
};

inline constexpr double kMinFont_px = 10;
inline constexpr double kMaxFont_px = 32;

// File of the settings: $XDG_CONFIG_HOME/sigs/editor.json, else ~/.config/sigs/editor.json.
[[nodiscard]] std::filesystem::path settings_file();

// Values out of range are brought into it; a file that is missing or unreadable gives the defaults.
[[nodiscard]] Settings read_settings(const std::filesystem::path& file);
// Makes the folder where it is not there. Errors: those of write_text().
[[nodiscard]] Result<void> write_settings(const Settings& settings, const std::filesystem::path& file);

// Puts a project at the head of the recent ones, once; the oldest beyond 12 goes.
void remember_project(Settings& settings, const std::filesystem::path& project);

}  // namespace sigs::editor
