// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "editor/preview/appearance_job.h"
#include "editor/views/estimate_session.h"

namespace sigs::editor {

// "Match the footage": how the footage looks is estimated and set in the project.
class AppearanceSession : public EstimateSession<AppearanceRequest, Appearance> {
 public:
  // work: tests give one that reads no video.
  AppearanceSession(Edits& edits, std::function<void()> wake, Work work = estimated_appearance);

  // Begins an estimate of the project's footage. Nothing happens while one is running; without footage it says so.
  void start(const Document& document);

 private:
  void use(const Document& document, const std::shared_ptr<const Appearance>& found) override;
};

// "Lit like this": the exposure is found by something real in the footage, and set in the project.
class LightSession : public EstimateSession<LightRequest, LitLike> {
 public:
  LightSession(Edits& edits, std::function<void()> wake, Work work = found_light);

  // Begins to look at the box. Nothing happens while one is looked at; without an intruder it says so.
  void start(const Document& document, const LightLike& wanted);

 private:
  void use(const Document& document, const std::shared_ptr<const LitLike>& found) override;
};

// "7 of 9 quantities found in 48 frames" for the message.
[[nodiscard]] std::string summary_of(const Appearance& appearance);

}  // namespace sigs::editor
