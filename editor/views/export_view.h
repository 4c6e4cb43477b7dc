// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/background_job.h"
#include "editor/preview/export_plan.h"
#include "editor/views/context.h"

namespace sigs::editor {

// The project's own settings of what is written; each change is an edit.
void draw_video_choices(const ViewContext& context);
void draw_mask_choice(const ViewContext& context);
void draw_label_choice(const ViewContext& context);
// Each as rows of a table of two columns, called as in the inspector (label_of()). They stay where they are whatever is
// chosen, greyed where they do not count.
void draw_quality(const ViewContext& context);
void draw_thresholds(const ViewContext& context);

// "120 of 322 frames, 41.2 frames/s, 0:05 left"
[[nodiscard]] std::string progress_text(const ExportState& state);
// "Export 37 %, 0:05 left", for the menu bar.
[[nodiscard]] std::string short_progress_text(const ExportState& state);

// What was written, with ways to it; or why nothing was.
void draw_result(const ViewContext& context, const ExportState& state);
void draw_warnings(const ExportState& state);

// A line that matters, behind an icon, wrapped.
void note_line(Icon icon, ImU32 color, const std::string& text);

// The window in which an export is set up, followed and found again. What belongs to the project (codec, masks, labels)
// is changed by edits, as in the inspector; folder, range and threads belong to this export.
class ExportView {
 public:
  // Shows the window in the next update; where an export runs or has ended, that export.
  void open(const Document& document);
  [[nodiscard]] bool is_open() const { return open_; }
  // Once per update while it is open. Starts, stops and forgets the job as the person asks; closing the window does not
  // stop it.
  void draw(const ViewContext& context, ExportJob& job);
  // The project has another file: the folder is chosen anew.
  void forget_folder() { folder_.clear(); }

 private:
  // What would be exported, as it is set at the moment.
  [[nodiscard]] ExportRequest request_of(const ViewContext& context) const;
  // One of the next for each phase of the job: before it, its parts; while it runs; after it.
  void draw_setup(const ViewContext& context, ExportJob& job);
  void draw_choices(const ViewContext& context);
  void draw_folder(const ViewContext& context);
  void draw_range(const ViewContext& context);
  void draw_cameras(const ViewContext& context);
  void draw_notes(const ViewContext& context);
  void draw_command(const ViewContext& context);
  void draw_running(const ViewContext& context, ExportJob& job, const ExportState& state);
  void draw_done(const ViewContext& context, ExportJob& job, const ExportState& state);

  // What the command needs besides the file.
  const Assignments& assignments(const Document& document);

  bool open_ = false;
  bool closed_ = false;       // the person has closed it in this update
  std::string folder_;        // where the files go, as typed; "": not chosen yet
  bool only_active_ = false;  // of a rig the active camera rather than all
  bool only_range_ = false;   // from in to out rather than the project's whole range
  int jobs_ = 0;              // frames composed in parallel; 0: by the number of cores
  // The question whether the files in there_ may be replaced is shown.
  bool overwrite_asked_ = false;
  // For the revision with this number.
  std::optional<Assignments> assignments_;
  std::uint64_t assignments_of_ = 0;
  std::vector<std::filesystem::path> there_;  // what would be overwritten
};

}  // namespace sigs::editor
