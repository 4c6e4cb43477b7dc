// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "editor/document/document.h"
#include "editor/preview/previewer.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// Tells whoever drives the window from outside what it shows: a JSON file, written anew after each update that changed
// it.
//   {"turn": 12, "frame": 3, "revision": 4, "unsaved": true, "current": true, "busy": false, "page": "project",
//    "problems": ["footage.video: ..."], "turns_a_second": 60, "places": {"ruler": [x, y, width, height], ...},
//    "memory": {"pictures": 1000, "decoded": ..., "shown": ..., "textures": ..., "sum": ..., "limit": ...}, in bytes
//    "mouse": [x, y], "buttons": 1, "released_keys": 7, "at_rest": true}
// By the last line a driver learns that what it did has been seen: where the mouse was in this update, a bit for each
// button that was down, how many keys have gone up, and whether some updates have gone by since without any of it.
struct ProbedWindow {
  std::string page;               // "start" or "project"
  double updates_per_second = 0;  // of the loop, over the last second
  int released_keys = 0;          // modifiers aside
  bool has_input_left = false;    // that a later turn will see
};

class ProbeWriter {
 public:
  // An empty path: nothing is written.
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

}  // namespace sigs::editor
