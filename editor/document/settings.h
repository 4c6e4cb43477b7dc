// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs::editor {

// What the editor remembers between runs: sizes of the window and its panels, and recent projects. Not part of any
// project.
struct Settings {
  double font_px = 15;  // 10..32, times the screen's own scale; everything else follows the text
  int window_width_px = 1600;
  int window_height_px = 960;
  bool maximised = false;
  double inspector_width = 330;  // where the text is 15 px high
  double timeline_height = 210;
  double world_share = 0.38;  // of the width between footage and world view
  bool show_world = true;
  bool show_inspector = true;
  bool loop = true;        // playing starts again at the range's end
  double autosave_s = 20;  // seconds after an edit until the recovery file is written
  std::filesystem::path last_folder;
  std::vector<std::filesystem::path> recent;  // projects, newest first, at most 12

  [[nodiscard]] bool operator==(const Settings&) const = default;
};

inline constexpr double kMinFont_px = 10;
inline constexpr double kMaxFont_px = 32;

// File of the settings: $XDG_CONFIG_HOME/sigs/editor.json, else ~/.config/sigs/editor.json.
[[nodiscard]] std::filesystem::path settings_file();

// Values out of range are brought into it; a file that is missing or unreadable gives the defaults.
[[nodiscard]] Settings read_settings(const std::filesystem::path& file);
[[nodiscard]] Result<void> write_settings(const Settings& settings, const std::filesystem::path& file);

// Puts a project at the head of the recent ones.
void remember_project(Settings& settings, const std::filesystem::path& project);

}  // namespace sigs::editor
