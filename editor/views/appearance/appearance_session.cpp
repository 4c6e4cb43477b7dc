// SPDX-License-Identifier: MIT
#include "editor/views/appearance/appearance_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace sigs::editor {

std::string summary_of(const Appearance& appearance) {
  const std::vector<AppearanceQuantity> quantities = quantities_of(appearance);
  const auto found = std::count_if(quantities.begin(), quantities.end(),
                                   [](const AppearanceQuantity& quantity) { return quantity.estimate.is_known; });
  return fmt::format("{} of {} quantities found in {} frames", found, quantities.size(), appearance.frames_used);
}

AppearanceSession::AppearanceSession(Edits& edits, std::function<void()> wake, AppearanceJob::Work work)
    : edits_(edits), job_(std::move(wake), std::move(work)) {}

void AppearanceSession::start(const Document& document) {
  const Project& project = document.project();
  if (project.footage.video.empty()) {
    edits_.ask(ShowMessage{"There is no footage to match: choose a video first.", true});
    return;
  }
  video_ = resolved(project, project.footage.video);
  job_.start({project});
}

void AppearanceSession::forget() {
  job_.forget();
  state_ = {};
  taken_ = nullptr;
  was_running_ = false;
}

void AppearanceSession::follow(const Document& document) {
  const Project& project = document.project();
  if (resolved(project, project.footage.video) != video_ && job_.is_running()) job_.forget();
  state_ = job_.state();
  const bool has_ended = std::exchange(was_running_, state_.is_running()) && !state_.is_running();
  if (state_.value != nullptr && state_.value != taken_) take();
  if (has_ended && state_.phase == JobPhase::failed)
    edits_.ask(ShowMessage{"The footage could not be matched: " + state_.error.text(), true});
}

void AppearanceSession::take() {
  taken_ = state_.value;
  edits_.end_gesture();
  edits_.change("match the footage", [found = taken_](Project& project) { apply(*found, project); });
  edits_.ask(ShowMessage{"Matched the footage: " + summary_of(*taken_) + ". What was not found has its default."});
}

}  // namespace sigs::editor
