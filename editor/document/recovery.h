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

// Unsaved work that an editor left behind when it crashed, as its recovery file describes it.
struct AbandonedProject {
  std::filesystem::path recovery_file;
  std::filesystem::path project_file;  // where the project belongs, absolute; "": it was never saved
  std::string name;
  std::int64_t written_unix_s = 0;  // when the recovery file was written, in seconds since 1970 (UTC)
  bool has_mask = false;            // an own-body mask that was not saved lies beside it
  std::string problem;              // "": it can be read, as far as is known; else why not
};

// The own-body mask that is being painted, as recovery sees it.
struct MaskToKeep {
  // 0: nothing of it is unsaved; else another number for every other mask, so that it is written no more often than it
  // changes.
  std::uint64_t state = 0;
  cv::Mat pixels;            // CV_8UC1
  bool has_strokes = false;  // as MaskPainting::has_strokes()
  std::size_t camera = 0;    // of a rig, that it is for
  bool is_changing = false;  // in the middle of a stroke: it is kept when that is over
};
// A mask that recovery gave back.
struct RecoveredMask {
  cv::Mat pixels;  // CV_8UC1
  bool has_strokes = false;
  std::size_t camera = 0;
};
// An abandoned project that was taken over.
struct RecoveredProject {
  ReadProject read;
  // The project's own file as that editor had read or saved it last; none: a recovery file of an older program, which
  // does not tell.
  std::optional<FileStamp> as_read;
  std::optional<RecoveredMask> mask;
  std::string mask_problem;  // why there is no mask, where there should be one; "": all is there
};

// $XDG_STATE_HOME/sigs/recovery, else ~/.local/state/sigs/recovery.
[[nodiscard]] std::filesystem::path recovery_folder();

// Those in a folder whose editor no longer runs, newest first; last those that cannot be read, by the name of their
// file. Files that this program did not make are passed over. A folder that is not there holds none.
[[nodiscard]] std::vector<AbandonedProject> abandoned_projects(const std::filesystem::path& folder);

// Removes it for good, with its mask. Nothing happens where another editor has taken it over meanwhile. Files that
// cannot be removed stay, without an error.
void discard(const AbandonedProject& abandoned);

// The unsaved changes of one running editor, kept in a file of their own until they are saved or given up. A lock
// beside that file is held while the editor runs: what is not locked was abandoned. Files are written on the calling
// thread, the window's.
class Recovery {
 public:
  // Touches nothing on disk; the folder is made when there is something to keep. Tests give another folder than
  // recovery_folder().
  explicit Recovery(std::filesystem::path folder);
  ~Recovery();  // leaves the file, for the case that this is no orderly end; forget() comes first
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;

  // To be called once per update: writes what is unsaved as soon as a change is delay_s old, removes the files where
  // nothing is unsaved. An error is returned once, and again only after writing went well in between; writing is tried
  // again each delay_s. The mask lies beside the project's file as a PNG.
  //   now_s  seconds of any steady clock
  [[nodiscard]] std::optional<Error> keep(const Document& document, double now_s, double delay_s,
                                          const MaskToKeep& mask = {});

  // What keep() would do, at once: before something that may end the program. Errors: cannot_create, write_failed.
  [[nodiscard]] Result<void> write(const Document& document, const MaskToKeep& mask = {});

  void forget();  // what is kept goes, as it was saved or given up; the lock stays held

  // Makes an abandoned project this editor's own: its file becomes ours until the document is saved or given up. What
  // was kept here before must have been forgotten. Errors: those of reading the file and of write(); cannot_read where
  // another editor was quicker. Then the abandoned project stays as it is. A mask that cannot be read is no error.
  [[nodiscard]] Result<RecoveredProject> take_over(const AbandonedProject& abandoned);

 private:
  [[nodiscard]] Result<void> hold_lock();  // makes the folder and takes the lock, once
  void remove_mask_other_than(const std::filesystem::path& kept) noexcept;

  std::filesystem::path folder_;
  std::filesystem::path file_;  // ours, whether it is there or not
  Descriptor lock_;             // open while this editor runs and has had something to keep
  // file_ is there; it holds the revision of this number. 0: a project that was taken over.
  bool written_ = false;
  std::uint64_t kept_revision_ = 0;
  // The mask that lies beside it, ours or one that was taken over; "": none. kept_mask_ is its state.
  std::filesystem::path mask_file_;
  std::uint64_t kept_mask_ = 0;
  std::optional<double> waiting_since_s_;  // when keep() first found something that is not on disk; none: all is
  bool error_reported_ = false;
};

}  // namespace sigs::editor
