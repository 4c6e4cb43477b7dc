// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "editor/preview/ego_motion_job.h"
#include "editor/views/estimate_session.h"

namespace sigs::editor {

// The camera's motion is estimated from the footage and put into the project: camera.track names the file,
// camera.attitude_deg is that of the camera at frame 0, and the file has its whole attitude (follow_attitudes()).
class EgoMotionSession : public EstimateSession<EgoMotionRequest, EstimatedMotion> {
 public:
  // work: tests give one that reads no video.
  EgoMotionSession(Edits& edits, std::function<void()> wake, Work work = estimated_motion);

  // Begins an estimate of the project's footage, into a file beside the project that is not there yet. Nothing happens
  // while one is running; without footage it says what is missing.
  void start(const Document& document);

 private:
  void use(const Document& document, const std::shared_ptr<const EstimatedMotion>& found) override;
};

// One beside the project that is not there yet: NAME.attitude.csv, NAME.attitude_2.csv, ...; beside the footage where
// the project was never saved.
[[nodiscard]] std::filesystem::path new_attitude_file(const Project& project);

// "found in 300 frames, 12 of them unknown; ..." for the message and the inspector.
[[nodiscard]] std::string summary_of(const EstimatedMotion& motion);

}  // namespace sigs::editor
