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
