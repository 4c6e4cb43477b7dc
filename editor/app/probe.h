// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "editor/document/document.h"
#include "editor/preview/previewer.h"
#include "editor/widgets/places.h"

namespace sigs::editor {

// Tells whoever drives the window from outside what it shows: a JSON file, written anew after each turn that changed it.
//   {"turn": 12, "frame": 3, "revision": 4, "unsaved": true, "current": true, "busy": false, "page": "project",
//    "places": {"ruler": [x, y, width, height], ...}}
class Probe {
 public:
  // An empty path: nothing is written.
  explicit Probe(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] bool wanted() const { return !file_.empty(); }
  void tell(const Document& document, const Shown& shown, const Places& places, const std::string& page);

 private:
  std::filesystem::path file_;
  std::string last_;
  int turn_ = 0;
};

}  // namespace sigs::editor
