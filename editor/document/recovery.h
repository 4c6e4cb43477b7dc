// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/file_lock.h"
#include "base/result.h"
#include "editor/document/document.h"
#include "project/json.h"

namespace sigs::editor {

// Unsaved work that an editor left behind when it crashed.
struct AbandonedProject {
  std::filesystem::path recovery_file;
  std::filesystem::path project_file;  // where the project belongs; "": it was never saved
  std::string name;
  std::int64_t written_unix_s = 0;
  bool has_mask = false;  // an own-body mask that was not saved lies beside it
  std::string problem;    // "": it can be read, as far as is known; else why not
};

// The own-body mask that is being painted, as recovery sees it.
struct MaskToKeep {
  std::uint64_t state = 0;  // 0: nothing of it is unsaved; else another number for every other mask
  cv::Mat pixels;           // CV_8UC1
  bool has_strokes = false;
  bool is_changing = false;  // in the middle of a stroke: to be kept when that is over
};
struct RecoveredMask {
  cv::Mat pixels;  // CV_8UC1
  bool has_strokes = false;
};
struct RecoveredProject {
  ReadProject read;
  std::optional<RecoveredMask> mask;
  std::string mask_problem;  // why there is none, where there should be one
};

// $XDG_STATE_HOME/sigs/recovery, else ~/.local/state/sigs/recovery.
[[nodiscard]] std::filesystem::path recovery_folder();

// Those whose editor no longer runs, newest first; last those that cannot be read, by the name of their file. Files
// that this program did not make are passed over. A folder that is not there holds none.
[[nodiscard]] std::vector<AbandonedProject> abandoned_projects(const std::filesystem::path& folder);

// Removes it for good.
void discard(const AbandonedProject& abandoned);

// The unsaved changes of one running editor, kept in a file of their own until they are saved or given up. A lock
// beside that file is held while the editor runs: what is not locked was abandoned.
class Recovery {
 public:
  explicit Recovery(std::filesystem::path folder);
  ~Recovery();  // leaves the file, for the case that this is no orderly end; forget() comes first
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;

  // To be called once per update: writes what is unsaved as soon as a change is that old, removes the files where
  // nothing is unsaved. An error is returned once, and again only after writing went well in between; writing is tried
  // again each delay_s. The mask lies beside the project's file as a PNG.
  [[nodiscard]] std::optional<Error> keep(const Document& document, double now_s, double delay_s,
                                          const MaskToKeep& mask = {});

  // What keep() would do, at once: before something that may end the program.
  [[nodiscard]] Result<void> write(const Document& document, const MaskToKeep& mask = {});

  // Saved, or given up.
  void forget();

  // Makes an abandoned project this editor's own: its file becomes ours until the document is saved or given up.
  // Error cannot_read where another editor was quicker.
  [[nodiscard]] Result<RecoveredProject> take_over(const AbandonedProject& abandoned);

 private:
  [[nodiscard]] Result<void> hold_lock();
  [[nodiscard]] bool is_kept(const Document& document, const MaskToKeep& mask) const;
  [[nodiscard]] Result<void> write_mask_of(const MaskToKeep& mask);
  void remove_mask_other_than(const std::filesystem::path& kept) noexcept;

  std::filesystem::path folder_;
  std::filesystem::path file_;  // ours, whether it is there or not
  Descriptor lock_;             // open while this editor runs and has had something to keep
  bool written_ = false;
  std::uint64_t kept_revision_ = 0;  // the state that lies in the file
  std::filesystem::path mask_file_;  // of the mask that lies beside it, ours or one that was taken over; "": none
  std::uint64_t kept_mask_ = 0;      // its state
  std::optional<double> waiting_since_s_;
  bool error_reported_ = false;
};

}  // namespace sigs::editor
