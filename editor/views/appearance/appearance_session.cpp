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

LightSession::LightSession(Edits& edits, std::function<void()> wake, Work work)
    : EstimateSession(edits, std::move(wake), std::move(work), "The light could not be found") {}

void LightSession::start(const Document& document, const LightLike& wanted) {
  if (document.project().intruders.empty()) {
    edits().ask(ShowMessage{"There is no intruder to be lit: add one first.", true});
    return;
  }
  begin(document, {document.project(), wanted.frame, wanted.box});
}

void LightSession::use(const Document&, const std::shared_ptr<const LitLike>& found) {
  edits().change("light like this", [found](Project& project) { apply(*found, project); });
  edits().ask(ShowMessage{fmt::format("As bright as what is in the box: exposure {:.2f} \u00b1 {:.2f}.",
                                      found->exposure.value, found->exposure.sd)});
}

AppearanceSession::AppearanceSession(Edits& edits, std::function<void()> wake, Work work)
    : EstimateSession(edits, std::move(wake), std::move(work), "The footage could not be matched") {}

void AppearanceSession::start(const Document& document) {
  if (document.project().footage.video.empty()) {
    edits().ask(ShowMessage{"There is no footage to match: choose a video first.", true});
    return;
  }
  begin(document, {document.project()});
}

void AppearanceSession::use(const Document&, const std::shared_ptr<const Appearance>& found) {
  edits().change("match the footage", [found](Project& project) { apply(*found, project); });
  edits().ask(ShowMessage{"Matched the footage: " + summary_of(*found) + ". What was not found has its default."});
}

}  // namespace sigs::editor
