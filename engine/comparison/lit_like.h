// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "appearance/appearance.h"
#include "base/image.h"
#include "base/result.h"
#include "project/project.h"
#include "scene/scene.h"
#include "video/frame.h"

namespace sigs {

// How strong the light has to be so that a project's intruder is as bright as something real in its footage.
struct LitLike {
  SunSettings sun;    // under which it was found: the project's; of a point light SunEstimate's default
  Estimate exposure;  // LightSettings::exposure; always known
};

struct LitLikeControl {
  std::function<void(int done, int total)> progress;  // images drawn; called on the calling thread
  const std::atomic<bool>* cancel = nullptr;          // set to true: ends soon with the error `interrupted`
};

// Looks at a target in `box` of a frame: an aircraft before the sky, or anything else that the sun lights and that
// differs from what is around it (appearance/target_look.h). The project's intruder is drawn beside it, at a
// place with a like background, as large and about as wide for its height, in eight views, under the project's own
// light; a point light becomes the sun first. The logarithm of the luminance at five quantiles, from the darkest to the
// brightest parts, is compared: the exposure is multiplied by the median ratio, and the drawing done again, as what is
// as bright as the sky cannot be told from it. The deviation is that from view to view and from quantile to quantile.
//
// The sun's direction stays: one target of unknown shape, paint and attitude does not show it (docs/appearance.md).
//   shape  of the footage; `frame_number` is of it
//   box    continuous pixels, loose
// Errors: usage without an intruder; bad_data where nothing in the box differs from its surroundings, or the frame has
// no like place for the intruder; those of posed_scene() and compose_frame(); interrupted.
[[nodiscard]] Result<LitLike> lit_like(const Project& project, const FootageShape& shape, const Frame& frame,
                                       int frame_number, const Box& box, const LitLikeControl& control = {});

// The same for a frame of the project's footage, which is opened for it. Errors: those of open_footage() too; usage
// where the footage has no such frame.
[[nodiscard]] Result<LitLike> lit_like(const Project& project, int frame_number, const Box& box,
                                       const LitLikeControl& control = {});

// Sets light.kind to the sun, its direction to that of `lit`, and the exposure, rounded to three decimals.
void apply(const LitLike& lit, Project& project);

// What was found, in the words of the list of an appearance; and the settings that apply() writes.
[[nodiscard]] std::vector<AppearanceQuantity> quantities_of(const LitLike& lit);
[[nodiscard]] std::vector<std::string> applied_settings(const LitLike& lit);

}  // namespace sigs
