// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/views/context.h"

namespace sigs::editor {

// The window in which an export is set up, followed and found again. What belongs to the project (codec, masks, labels)
// is changed by edits, as in the inspector; folder, range and threads belong to this export.
class ExportView {
 public:
  void open(const Document& document);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once per update while it is open.
  void draw(const ViewContext& context, ExportJob& job);
  // A project was opened or closed: the folder is chosen anew.
  void forget_folder() { folder_.clear(); }

 private:
  [[nodiscard]] ExportRequest request_of(const ViewContext& context) const;
  void draw_setup(const ViewContext& context, ExportJob& job);
  void draw_choices(const ViewContext& context);
  void draw_folder(const ViewContext& context);
  void draw_range(const ViewContext& context);
  void draw_notes(const ViewContext& context);
  void draw_command(const ViewContext& context);
  void draw_running(const ViewContext& context, ExportJob& job, const ExportState& state);
  void draw_done(const ViewContext& context, ExportJob& job, const ExportState& state);

  bool open_ = false;
  bool closed_ = false;
  std::string folder_;
  bool only_range_ = false;
  int jobs_ = 0;  // 0: chosen by the number of cores
  bool overwrite_asked_ = false;
  std::vector<std::filesystem::path> there_;  // what would be overwritten
};

}  // namespace sigs::editor
