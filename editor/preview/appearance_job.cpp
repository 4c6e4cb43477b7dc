// SPDX-License-Identifier: MIT
#include "editor/preview/appearance_job.h"

#include "appearance/project_hints.h"
#include "first_project/first_project.h"
#include "scene/opened_project.h"

namespace sigs::editor {

Result<Appearance> estimated_appearance(const AppearanceRequest& request, const JobControl& control) {
  const FootageSettings& settings = request.project.footage;
  Result<FrameSource> footage = open_footage(request.project, control.cancel, Quantisers::read);
  if (!footage) return fail(footage.error());
  const Result<AppearanceHints> hints =
      hints_of(request.project, footage->info(), is_still_guessed(request.project, "camera.position_m"), control.warn);
  if (!hints) return fail(hints.error());
  return estimate_appearance(*footage, {.first = settings.first_frame, .last = settings.last_frame}, *hints,
                             {.progress = control.progress, .cancel = control.cancel});
}

Result<LitLike> found_light(const LightRequest& request, const JobControl& control) {
  return lit_like(request.project, request.frame, request.box,
                  {.progress = control.progress, .cancel = control.cancel});
}

}  // namespace sigs::editor
