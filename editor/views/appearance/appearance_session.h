// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "editor/document/document.h"
#include "editor/preview/appearance_job.h"

namespace sigs::editor {

// "Match the footage": how the footage looks is estimated in the background and put into the project as one undo step.
// Knows no window. For the window's thread, all calls.
class AppearanceSession {
 public:
  //   edits  where changes of the project and messages go; must outlive this
  //   wake   called from another thread as the estimate goes on
  //   work   what an estimate does; tests give one that reads no video
  AppearanceSession(Edits& edits, std::function<void()> wake, AppearanceJob::Work work = estimated_appearance);

  // Begins an estimate of the project's footage. Nothing happens while one is running; without footage it says so.
  void start(const Document& document);
  void stop() { job_.cancel(); }
  // Another project was opened, or none.
  void forget();

  // Once per update: takes the state, stops where the project has another footage, and puts what was found into the
  // project.
  void follow(const Document& document);

  // As of the last follow().
  [[nodiscard]] const AppearanceState& state() const { return state_; }

 private:
  void take();

  Edits& edits_;
  AppearanceJob job_;
  AppearanceState state_;
  std::filesystem::path video_;              // that is looked at
  std::shared_ptr<const Appearance> taken_;  // put into the project
  bool was_running_ = false;
};

// "7 of 9 quantities found in 48 frames" for the message and the inspector.
[[nodiscard]] std::string summary_of(const Appearance& appearance);

}  // namespace sigs::editor
