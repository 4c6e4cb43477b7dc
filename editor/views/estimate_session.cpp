// SPDX-License-Identifier: MIT
#include "editor/views/estimate_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/pose.h"
#include "editor/document/project_paths.h"
#include "scene/scene_parts.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

void use_motion(Project& project, const EstimatedMotion& motion) {
  FoundAttitudes found = motion.found;
  found.file = path_in_project(project, motion.file);
  follow_attitudes(project, found);
}

}  // namespace

fs::path new_attitude_file(const Project& project) {
  return new_file_beside(project, ".attitude", ".csv");
}

std::string summary_of(const EstimatedMotion& motion) {
  std::string text = fmt::format("{} frames", motion.frames);
  if (motion.lost_frames > 0) text += fmt::format(", {} of them unknown", motion.lost_frames);
  if (motion.level_sd_rad)
    text += fmt::format("; level by the horizon, to {:.2g}\u00b0", deg_of_rad(*motion.level_sd_rad));
  else if (motion.is_level_stated)
    text += "; no horizon was found: frame 0 has the roll and pitch that were set";
  else
    text += "; no horizon was found: frame 0 counts as level until the horizon is set";
  if (motion.is_gyro_used) text += "; with the log's gyroscope";
  return text;
}

EgoMotionSession::EgoMotionSession(Edits& edits, std::function<void()> wake, Work work)
    : EstimateSession(edits, std::move(wake), std::move(work), "The camera's motion was not found",
                      [&edits](const std::shared_ptr<const EstimatedMotion>& found) {
                        edits.change("use estimated camera motion", [found](Project& p) { use_motion(p, *found); });
                        edits.ask(ShowMessage{"Camera motion: " + summary_of(*found) + "."});
                      }) {}

void EgoMotionSession::start(const Document& document) {
  const Project& project = document.project();
  if (project.footage.video.empty() || !states_lens(project.footage))
    return edits().ask(
        ShowMessage{"The camera's motion is estimated from footage and calibration: choose both first.", true});
  if (document.active_camera() > 0)
    return edits().ask(
        ShowMessage{fmt::format("The aircraft's motion is estimated by its first camera: choose {} first.",
                                document.cameras().front().name),
                    true});
  begin(document, {project, new_attitude_file(project)});
}

std::string summary_of(const Appearance& appearance) {
  const std::vector<AppearanceQuantity> quantities = quantities_of(appearance);
  const auto found =
      std::ranges::count_if(quantities, [](const AppearanceQuantity& quantity) { return quantity.estimate.is_known; });
  return fmt::format("{} of {} quantities found in {} frames", found, quantities.size(), appearance.frames_used);
}

LightSession::LightSession(Edits& edits, std::function<void()> wake, Work work)
    : EstimateSession(
          edits, std::move(wake), std::move(work), "The light could not be found",
          [&edits](const std::shared_ptr<const LitLike>& found) {
            edits.change("light like this", [found](Project& project) { apply(*found, project); });
            edits.ask(ShowMessage{fmt::format("As bright as what is in the box: exposure {:.2f} \u00b1 {:.2f}.",
                                              found->exposure.value, found->exposure.sd)});
          }) {}

void LightSession::start(const Document& document, const LightLike& wanted) {
  if (document.project().intruders.empty())
    return edits().ask(ShowMessage{"There is no intruder to be lit: add one first.", true});
  begin(document, {document.project(), wanted.frame, wanted.box});
}

AppearanceSession::AppearanceSession(Edits& edits, std::function<void()> wake, Work work)
    : EstimateSession(edits, std::move(wake), std::move(work), "The footage could not be matched",
                      [&edits](const std::shared_ptr<const Appearance>& found) {
                        edits.change("match the footage", [found](Project& project) { apply(*found, project); });
                        edits.ask(ShowMessage{"Matched the footage: " + summary_of(*found) +
                                              ". What was not found has its default."});
                      }) {}

void AppearanceSession::start(const Document& document) {
  if (document.project().footage.video.empty())
    return edits().ask(ShowMessage{"There is no footage to match: choose a video first.", true});
  begin(document, document.project());
}

}  // namespace sigs::editor
