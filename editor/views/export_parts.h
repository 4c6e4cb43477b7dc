// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>

#include "editor/preview/background_job.h"
#include "editor/views/context.h"
#include "editor/widgets/icons.h"

namespace sigs::editor {

// The project's own settings of what is written; each change is an edit.
void draw_video_choices(const ViewContext& context);
void draw_mask_choice(const ViewContext& context);
void draw_label_choice(const ViewContext& context);
// Each as rows of a table of two columns, called as in the inspector (label_of()). They stay where they are whatever is
// chosen, greyed where they do not count.
void draw_quality(const ViewContext& context);
void draw_thresholds(const ViewContext& context);

// "120 of 322 frames, 41.2 frames/s, 0:05 left"
[[nodiscard]] std::string progress_text(const ExportState& state);
// "Export 37 %, 0:05 left", for the menu bar.
[[nodiscard]] std::string short_progress_text(const ExportState& state);

// What was written, with ways to it; or why nothing was.
void draw_result(const ViewContext& context, const ExportState& state);
void draw_warnings(const ExportState& state);

// A line that matters, behind an icon, wrapped.
void note_line(Icon icon, ImU32 color, const std::string& text);

}  // namespace sigs::editor
