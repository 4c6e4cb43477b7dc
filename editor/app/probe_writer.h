// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "editor/document/document.h"
#include "editor/preview/previewer.h"
#include "editor/widgets/ui_probe.h"

namespace sigs::editor {

// Tells whoever drives the window from outside what it shows: a JSON file, written anew after each update that changed
// it.
//   {"turn": 12, "frame": 3, "revision": 4, "unsaved": true, "current": true, "busy": false, "page": "project",
//    "problems": ["footage.video: ..."], "turns_a_second": 60, "places": {"ruler": [x, y, width, height], ...},
//    "memory": {"pictures": 1000, "decoded": ..., "shown": ..., "textures": ..., "sum": ..., "limit": ...}}, in bytes
struct ProbedWindow {
  std::string page;               // "start" or "project"
  double updates_per_second = 0;  // of the loop, over the last second
};

class ProbeWriter {
 public:
  // An empty path: nothing is written.
  explicit ProbeWriter(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  void write(const Document& document, const PreviewOutput& shown, const UiProbe& ui_probe, const ProbedWindow& window);

 private:
  std::filesystem::path file_;
  std::string last_;
  int update_ = 0;
};

}  // namespace sigs::editor
