// SPDX-License-Identifier: MIT
#include "editor/preview/appearance_job.h"

namespace sigs::editor {

Result<Appearance> estimated_appearance(const AppearanceRequest& request, const JobControl& control) {
  const FootageSettings& settings = request.project.footage;
  Result<FrameSource> footage = FrameSource::open(resolved(request.project, settings.video), control.cancel, Quantisers::read);
  if (!footage) return fail(footage.error());
  return estimate_appearance(*footage, {.first = settings.first_frame, .last = settings.last_frame}, {},
                             {.progress = control.progress, .cancel = control.cancel});
}

}  // namespace sigs::editor
