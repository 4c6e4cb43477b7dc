// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "editor/document/project_paths.h"
#include "editor/views/context.h"

namespace sigs::editor {

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
