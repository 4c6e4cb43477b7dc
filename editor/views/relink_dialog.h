// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "editor/document/relink.h"
#include "editor/views/studio.h"

namespace sigs::editor {

// Asks where the project's missing files are. One that was found lets the others be found.
class RelinkDialog {
 public:
  void open(const Project& project);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once a turn while it is open. What was chosen becomes one step of undo.
  void draw(const Studio& studio);

 private:
  void draw_rows(const Studio& studio);
  void browse(const Studio& studio, const MissingFile& missing);
  void found(const MissingFile& missing, const std::filesystem::path& place);
  void apply(const Studio& studio) const;

  bool open_ = false;
  std::vector<MissingFile> missing_;
  std::map<std::string, std::filesystem::path> places_;     // by field: what the person chose
  std::map<std::string, std::filesystem::path> suggested_;  // by field
};

}  // namespace sigs::editor
