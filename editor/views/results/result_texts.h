// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editor/preview/scoring.h"

namespace sigs::editor {

// What is said of a tracker in one frame: nothing scored is `unscored`, with a report or without.
enum class TrackerMoment { unknown, unscored, reported, lost, silent };

// silent: scored, and nothing was reported; lost: reported, but it does not touch the truth.
[[nodiscard]] TrackerMoment moment_of(const ScoredTracker& tracker, int first_frame, int frame);

// The score of a frame of the footage; nullptr where there is none.
[[nodiscard]] const FrameScore* score_at(const ScoredTracker& tracker, int first_frame, int frame);

// "3.2 px", "lost, 210 px", "no report", "not scored", "-".
[[nodiscard]] std::string moment_text(const ScoredTracker& tracker, int first_frame, int frame);

// "0.42 px", "3.2 px", "210 px"; "-" for what is not finite.
[[nodiscard]] std::string pixels_text(double value_px);
// The same with its sign and without unit: "+1.2".
[[nodiscard]] std::string signed_text(double value);
// "93 %"; "-" for what is not finite.
[[nodiscard]] std::string percent_text(double share);

// What the figures were measured by, for a person who reads them: "measured", "about: by outlines; measured 120 of
// 200".
[[nodiscard]] std::string truth_text(const Scored& scored);

// The file's name, with its folder where another file that is loaded has the same.
[[nodiscard]] std::string shown_name(const Scored& scored, const ScoredTracker& tracker);

}  // namespace sigs::editor
