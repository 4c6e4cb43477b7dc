// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editor/preview/scoring.h"
#include "editor/views/context.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// What is said of a tracker in one frame: nothing scored is `unscored`, with a report or without.
enum class TrackerMoment { unknown, unscored, reported, lost, silent };

// silent: scored, and nothing was reported; lost: reported, but it does not touch the truth.
[[nodiscard]] TrackerMoment moment_of(const ScoredTracker& tracker, int first_frame, int frame);

// The score of a frame of the footage; nullptr where there is none.
[[nodiscard]] const FrameScore* score_at(const ScoredTracker& tracker, int first_frame, int frame);

// "3.2 px", "lost, 210 px", "no report", "not scored", "-".
[[nodiscard]] std::string moment_text(const ScoredTracker& tracker, int first_frame, int frame);

// The same with its sign and without unit: "+1.2".
[[nodiscard]] std::string signed_text(double value);
// "93 %"; "-" for what is not finite.
[[nodiscard]] std::string percent_text(double share);

// What the figures were measured by, for a person who reads them: "measured", "about: by outlines; measured 120 of
// 200".
[[nodiscard]] std::string truth_text(const Scored& scored);

// The file's name, with its folder where another file that is loaded has the same.
[[nodiscard]] std::string shown_name(const Scored& scored, const ScoredTracker& tracker);

// What trackers reported in a frame: a box each, dashed in the tracker's colour on a dark line, so that it shows on
// every ground; a thin line from the truth's middle to its own where they are apart.
void draw_result_boxes(const ImageCanvas& canvas, const ViewContext& context, int frame);

// Which colour is whose, with the error in that frame, in the lower left corner.
void draw_result_legend(const ImageCanvas& canvas, const ViewContext& context, int frame);

// The results of trackers that are loaded: which colour is whose, what they come to, and what they are measured by.
// Nothing while none are.
void draw_results_panel(const ViewContext& context);

}  // namespace sigs::editor
