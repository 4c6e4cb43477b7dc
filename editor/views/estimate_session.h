// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "editor/document/document.h"
#include "editor/preview/background_job.h"
#include "editor/preview/jobs.h"

namespace sigs::editor {

// Something about the project's footage is estimated in the background, and used by the project when it is done. What
// it is, and how it is used, the classes say that are made from this one. Knows no window. For the window's thread, all
// calls.
template <class Request, class Value>
class EstimateSession {
 public:
  using Work = typename BackgroundJob<Request, Value>::Work;
  using Use = std::function<void(const std::shared_ptr<const Value>& found)>;

  EstimateSession(const EstimateSession&) = delete;
  EstimateSession& operator=(const EstimateSession&) = delete;

  void stop() { job_.cancel(); }
  // Another project was opened, or none.
  void forget() {
    job_.forget();
    state_ = {};
    taken_ = nullptr;
    was_running_ = false;
  }

  // Once per update: takes the state, stops where the project has another footage, and uses what was found, once; of a
  // rig the camera that it was begun for is active then.
  void follow(const Document& document) {
    if (video_of(document) != video_ && job_.is_running()) job_.forget();
    state_ = job_.state();
    const bool has_ended = std::exchange(was_running_, state_.is_running()) && !state_.is_running();
    if (state_.value != nullptr && state_.value != taken_) {
      taken_ = state_.value;
      edits_.end_gesture();
      if (camera_ != document.active_camera()) edits_.activate_camera(camera_);
      use_(taken_);
    }
    if (has_ended && state_.phase == JobPhase::failed)
      edits_.ask(ShowMessage{failure_ + ": " + state_.error.text(), true});
  }

  // As of the last follow().
  [[nodiscard]] const JobState<Request, Value>& state() const { return state_; }

 protected:
  //   edits    where changes of the project and messages go; must outlive this
  //   wake     called from another thread as the estimate goes on
  //   failure  how the message about an estimate that failed begins
  //   use      puts what was found into the project as one undo step, and says so
  EstimateSession(Edits& edits, std::function<void()> wake, Work work, std::string failure, Use use)
      : edits_(edits), failure_(std::move(failure)), use_(std::move(use)), job_(std::move(wake), std::move(work)) {}

  // Nothing happens while an estimate is running.
  void begin(const Document& document, Request request) {
    if (!job_.start(std::move(request))) return;
    camera_ = document.active_camera();
    video_ = video_of(document);
    was_running_ = true;  // also where it ends before the next follow()
  }

  [[nodiscard]] Edits& edits() { return edits_; }

 private:
  [[nodiscard]] std::filesystem::path video_of(const Document& document) const {
    const std::vector<RigCamera>& cameras = document.cameras();
    const FootageSettings& footage = camera_ < cameras.size() ? cameras[camera_].footage : document.project().footage;
    return resolved(document.whole(), footage.video);
  }

  Edits& edits_;
  std::string failure_;
  Use use_;
  BackgroundJob<Request, Value> job_;
  JobState<Request, Value> state_;
  std::size_t camera_ = 0;              // of a rig, whose footage is looked at
  std::filesystem::path video_;         // that is looked at
  std::shared_ptr<const Value> taken_;  // used by the project
  bool was_running_ = false;
};

// The camera's motion is estimated from the footage and put into the project: camera.track names the file,
// camera.attitude_deg is that of the camera at frame 0, and the file has its whole attitude (follow_attitudes()).
class EgoMotionSession : public EstimateSession<EgoMotionRequest, EstimatedMotion> {
 public:
  // work: tests give one that reads no video.
  EgoMotionSession(Edits& edits, std::function<void()> wake, Work work = estimated_motion);

  // Begins an estimate of the project's footage, into a file beside the project that is not there yet. Nothing happens
  // while one is running; without footage it says what is missing.
  void start(const Document& document);
};

// One beside the project that is not there yet: NAME.attitude.csv, NAME.attitude_2.csv, ...; beside the footage where
// the project was never saved.
[[nodiscard]] std::filesystem::path new_attitude_file(const Project& project);

// "found in 300 frames, 12 of them unknown; ..." for the message and the inspector.
[[nodiscard]] std::string summary_of(const EstimatedMotion& motion);

// "Match the footage": how the footage looks is estimated and set in the project.
class AppearanceSession : public EstimateSession<Project, Appearance> {
 public:
  // work: tests give one that reads no video.
  AppearanceSession(Edits& edits, std::function<void()> wake, Work work = estimated_appearance);

  // Begins an estimate of the project's footage. Nothing happens while one is running; without footage it says so.
  void start(const Document& document);
};

// "Lit like this": the exposure is found by something real in the footage, and set in the project.
class LightSession : public EstimateSession<LightRequest, LitLike> {
 public:
  LightSession(Edits& edits, std::function<void()> wake, Work work = found_light);

  // Begins to look at the box. Nothing happens while one is looked at; without an intruder it says so.
  void start(const Document& document, const LightLike& wanted);
};

// "7 of 9 quantities found in 48 frames" for the message.
[[nodiscard]] std::string summary_of(const Appearance& appearance);

}  // namespace sigs::editor
