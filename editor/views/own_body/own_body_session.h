// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "editor/document/document.h"
#include "editor/document/mask_painting.h"
#include "editor/document/recovery.h"
#include "editor/preview/background_job.h"
#include "editor/preview/preview_output.h"

namespace sigs::editor {

// The own body's mask while it is worked on: found in the footage, painted, written and used. Knows no window. What was
// painted is never given up silently.
class OwnBodySession {
 public:
  // For the window's thread, all calls.
  //   edits   where changes of the project and requests go; must outlive this
  //   wake    called from another thread as a detection goes on
  //   detect  what a detection does; tests give one that reads no video
  OwnBodySession(Edits& edits, std::function<void()> wake, OwnBodyJob::Work detect = detected);

  // Once per update in which the mask is looked at: begins with the project's mask and follows it as long as nothing
  // else was made here, takes over what was found where nothing is painted by hand, and feathers that as the settings
  // say.
  void follow(const Document& document, const OpenedScene* scene);
  // Another project was opened, or none.
  void forget();

  // For the case of a crash; and what was kept so, after one: it is unsaved as it was.
  [[nodiscard]] MaskToKeep to_keep() const;
  void recover(const RecoveredMask& mask);

  // Begins a detection in the footage as the project has it, with the project's settings. False: one is running.
  bool start(const Document& document);
  [[nodiscard]] OwnBodyJob& job() { return job_; }
  // As of the last follow().
  [[nodiscard]] const DetectionState& detection() const { return detection_; }
  // What was found waits: strokes by hand are there that it would take the place of.
  [[nodiscard]] bool found_waits() const { return detection_.value != nullptr && detection_.value != taken_; }

  [[nodiscard]] MaskPainting& painting() { return painting_; }
  [[nodiscard]] const MaskPainting& painting() const { return painting_; }
  // False: the painting is of another size than the footage, or for another camera of the rig, and unsaved: it neither
  // fits nor may it go.
  [[nodiscard]] bool fits() const { return !is_elsewhere_ && painting_.mask().size() == footage_px_; }
  [[nodiscard]] cv::Size footage_px() const { return footage_px_; }
  void begin_anew();  // empty, of the footage's size, whatever was there

  // Each a step of the painting.
  void start_from_found();
  void start_from_empty();
  void start_from_project(const Project& project);
  [[nodiscard]] bool could_start_from_project(const Project& project) const;
  void ask_start_from_file(const Project& project);
  //   opacity  of a frame's clouds: CV_8UC1 of the footage's size
  void start_from_clouds(const cv::Mat& opacity);
  // The edge of the settings for the whole mask.
  void feather();
  // The settings ask for another edge than the mask has, which was not only found.
  [[nodiscard]] bool edge_waits() const;

  // 0: all is on disk. Else the state that is not: the same as long as nothing is painted.
  [[nodiscard]] std::uint64_t unsaved() const;
  // The file that holds the painting; "": none does.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] bool is_used(const Project& project) const;
  // What the painting is and whether it is on disk: "detected, not saved". Names no file but one that the painting was
  // read from or saved to.
  [[nodiscard]] std::string mask_text(const Project& project) const;
  // Of the image that is masked, 0..1; as of the last follow().
  [[nodiscard]] double share() const { return share_; }

  // Writes an 8-bit PNG under a name that is asked for; then goes on. Proposed is the painting's own file, where it was
  // written here, else a name that is not taken.
  void ask_save_as(const Project& project, std::function<void()> next = {});
  // The project names the file that holds the painting. Where the painting is not in a file yet, it is written first,
  // under a name that is asked for.
  void use(const Project& project);
  // Proposes a name that is not taken. next: once the edit that uses it is queued.
  void ask_save_and_use(const Project& project, std::function<void()> next = {});
  // The project's occluder is the painting, made of this frame, under a name that is asked for. An occluder without a
  // distance gets that of the project's clouds, where it states one; painted clouds take the place of those that are
  // found.
  void ask_use_as_occluder(const Project& project, int frame);
  // Before the painting is left behind: the same, of the camera that it was painted for, or only saved where it does
  // not fit the footage.
  void ask_keep(const Document& document, std::function<void()> next);
  // The same, into the file that the project names already: only after the person has agreed.
  void replace_and_use(const Project& project);
  // Whether that can be asked at all: the project names a PNG, and the painting is not in a file yet and has none of
  // its own.
  [[nodiscard]] bool could_replace(const Project& project) const;

 private:
  void ask_save(const std::filesystem::path& proposed, std::function<void()> next);
  [[nodiscard]] bool write(const std::filesystem::path& path);
  // Whether the painting is unsaved and another camera than the one that it is for is active.
  void note_active_camera(const Document& document);
  void name_in_project();
  void take_found();
  void take_project_mask(const Project& project, const cv::Mat& own_body);
  void take_soft_edge(double edge_px);
  void replace(const cv::Mat& mask, std::string step, std::string origin);
  void remember_file(const std::filesystem::path& file, bool written_here);
  void begin(const cv::Mat& mask, std::string origin);
  void measure_share();
  [[nodiscard]] std::string origin_of_whole() const;  // of the painting

  Edits& edits_;
  OwnBodyJob job_;
  DetectionState detection_;
  MaskPainting painting_;
  std::size_t camera_ = 0;     // of a rig, that is painted for
  bool is_elsewhere_ = false;  // another one is active, and the painting is unsaved
  cv::Size footage_px_;
  cv::Mat project_mask_;                  // CV_32FC1 as the scene has it; what the project was seen with last
  std::shared_ptr<const OwnBody> taken_;  // what was found and taken over, or passed over
  std::filesystem::path video_;           // that was looked through
  std::filesystem::path file_;
  bool file_is_own_ = false;                     // written here
  std::uint64_t file_whole_ = 0;                 // the painting's whole_state() that file_ belongs to
  std::map<std::uint64_t, std::string> origin_;  // of each whole_state()
  double edge_px_ = 0;                           // of the settings
  double mask_edge_px_ = 0;                      // of the mask as a whole
  double taken_edge_px_ = 0;                     // of taken_
  std::uint64_t found_state_ = 0;                // the painting's state() that is taken_
  std::uint64_t feathered_state_ = 0;            // and with another edge
  double share_ = 0;
  std::uint64_t share_state_ = 0;
};

// Where the mask of a project would lie: the file that it names, else one beside it.
[[nodiscard]] std::filesystem::path usual_mask_file(const Project& project);

}  // namespace sigs::editor
