// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "editor/document/document.h"
#include "editor/preview/ego_motion_job.h"

namespace sigs::editor {

// The camera's motion estimated from the footage in the background: started, stopped, and put into the project as one
// undo step when it is done. Knows no window. For the window's thread, all calls.
class EgoMotionSession {
 public:
  //   edits  where changes of the project and messages go; must outlive this
  //   wake   called from another thread as the estimate goes on
  //   work   what an estimate does; tests give one that reads no video
  EgoMotionSession(Edits& edits, std::function<void()> wake, EgoMotionJob::Work work = estimated_motion);

  // Begins an estimate of the project's footage, into a file beside the project that is not there yet. Nothing happens
  // while one is running; without footage it says what is missing.
  void start(const Document& document);
  void stop() { job_.cancel(); }
  // Another project was opened, or none.
  void forget();

  // Once per update: takes the state, stops where the project has another footage, and puts what was found into the
  // project: camera.track names the file, camera.attitude_deg is 0, as the file has the camera's whole attitude.
  void follow(const Document& document);

  // As of the last follow().
  [[nodiscard]] const EgoMotionState& state() const { return state_; }

 private:
  void take(const Document& document);

  Edits& edits_;
  EgoMotionJob job_;
  EgoMotionState state_;
  std::filesystem::path video_;                   // that is looked through
  std::shared_ptr<const EstimatedMotion> taken_;  // put into the project
  bool was_running_ = false;
};

// One beside the project that is not there yet: NAME.attitude.csv, NAME.attitude_2.csv, ...; beside the footage where
// the project was never saved.
[[nodiscard]] std::filesystem::path new_attitude_file(const Project& project);

// "found in 300 frames, 12 of them unknown; ..." for the message and the inspector.
[[nodiscard]] std::string summary_of(const EstimatedMotion& motion);

}  // namespace sigs::editor
