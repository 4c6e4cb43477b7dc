// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/result.h"
#include "frame/composed_frame.h"
#include "frame/render_plan.h"
#include "scene/scene.h"
#include "truth/annotation.h"
#include "video/frame.h"

namespace sigs {

// The one entry point: whatever shows or writes an image of a scene calls this function. The same scene, frame and
// background give the same bytes on every thread.
//   frame       number of the frame, counted from 0 over the whole footage
//   background  that frame of the footage; its size is the scene's. It is copied unless it is moved in; moved in, its
//               samples are rewritten in place, so they must not be shared
// Errors: `unavailable` where OpenGL is needed and the machine has none; those of the renderer;
// those of check_spectrum().
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background,
                                                  ComposeContext& context, Stages stages = Stages::leave_out);
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background,
                                                  ComposeContext& context, Stages stages = Stages::leave_out);

// Whether a frame of thermal footage shows heat as the project says; other footage always does.
// Errors: it is in colours without a palette, or its colours are not those of the palette that is stated (bad_project).
[[nodiscard]] Result<void> check_spectrum(const Scene& scene, const Frame& background, int frame);

// The truth of a frame in which nothing is drawn, as compose_frame() has it, without the footage's frame. None where
// something is, or may be: where only the footage tells whether a cloud hides it.
//   footage, bit_depth  colours and bits of the frame's samples
[[nodiscard]] Result<std::optional<FrameTruth>> truth_without_image(const Scene& scene, int frame,
                                                                    const ColorInfo& footage, int bit_depth,
                                                                    ComposeContext& context);

// The stages of one intruder before blending, as compose_frame goes through them; for tests and measurements of single
// stages.
//   placed      one of moment.intruders
//   footage     colours of the frame that it would be blended onto; they decide when a blurred intruder is too faint
//   background  that frame, for the colour of haze; null: haze has the colour that the settings give
//   bit_depth   of its samples
[[nodiscard]] Result<IntruderLayers> intruder_layers(const Scene& scene, const SceneMoment& moment,
                                                     const PlacedIntruder& placed, ComposeContext& context,
                                                     const ColorInfo& footage = {}, const Frame* background = nullptr,
                                                     int bit_depth = 8);

}  // namespace sigs
