// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "editor/document/document.h"
#include "editor/preview/background_job.h"

namespace sigs::editor {

// Something about the project's footage is estimated in the background, and used by the project when it is done. What
// it is, and how it is used, the classes say that are made from this one. Knows no window. For the window's thread, all
// calls.
template <class Request, class Value>
class EstimateSession {
 public:
  using Work = typename BackgroundJob<Request, Value>::Work;

  EstimateSession(const EstimateSession&) = delete;
  EstimateSession& operator=(const EstimateSession&) = delete;
  virtual ~EstimateSession() = default;

  void stop() { job_.cancel(); }
  // Another project was opened, or none.
  void forget() {
    job_.forget();
    state_ = {};
    taken_ = nullptr;
    was_running_ = false;
  }

  // Once per update: takes the state, stops where the project has another footage, and uses what was found, once.
  void follow(const Document& document) {
    if (video_of(document) != video_ && job_.is_running()) job_.forget();
    state_ = job_.state();
    const bool has_ended = std::exchange(was_running_, state_.is_running()) && !state_.is_running();
    if (state_.value != nullptr && state_.value != taken_) {
      taken_ = state_.value;
      edits_.end_gesture();
      use(document, taken_);
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
  EstimateSession(Edits& edits, std::function<void()> wake, Work work, std::string failure)
      : edits_(edits), failure_(std::move(failure)), job_(std::move(wake), std::move(work)) {}

  // Nothing happens while an estimate is running.
  void begin(const Document& document, Request request) {
    if (!job_.start(std::move(request))) return;
    video_ = video_of(document);
    was_running_ = true;  // also where it ends before the next follow()
  }

  // Puts what was found into the project as one undo step, and says so.
  virtual void use(const Document& document, const std::shared_ptr<const Value>& found) = 0;

  [[nodiscard]] Edits& edits() { return edits_; }

 private:
  [[nodiscard]] static std::filesystem::path video_of(const Document& document) {
    return resolved(document.project(), document.project().footage.video);
  }

  Edits& edits_;
  std::string failure_;
  BackgroundJob<Request, Value> job_;
  JobState<Request, Value> state_;
  std::filesystem::path video_;         // that is looked at
  std::shared_ptr<const Value> taken_;  // used by the project
  bool was_running_ = false;
};

}  // namespace sigs::editor
