// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/preview/export_job.h"
#include "editor/views/studio.h"

namespace sigs::editor {

// The window in which an export is set up, followed and found again. What belongs to the project (codec, masks, labels)
// is changed by edits, as in the inspector; folder, range and threads belong to this export.
class ExportView {
 public:
  void open(const Document& document);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once a turn while it is open.
  void draw(const Studio& studio, ExportJob& job);
  // A project was opened or closed: the folder is chosen anew.
  void forget_folder() { folder_.clear(); }

 private:
  [[nodiscard]] ExportRequest request_of(const Studio& studio) const;
  void draw_setup(const Studio& studio, ExportJob& job);
  void draw_choices(const Studio& studio);
  void draw_folder(const Studio& studio);
  void draw_range(const Studio& studio);
  void draw_notes(const Studio& studio);
  void draw_command(const Studio& studio);
  void draw_running(const Studio& studio, ExportJob& job, const ExportState& state);
  void draw_done(const Studio& studio, ExportJob& job, const ExportState& state);

  bool open_ = false;
  bool closed_ = false;
  std::string folder_;
  bool only_range_ = false;
  int jobs_ = 0;  // 0: chosen by the number of cores
  bool overwrite_asked_ = false;
  std::vector<std::filesystem::path> there_;  // what would be overwritten
};

}  // namespace sigs::editor
