// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/own_body/own_body_session.h"

namespace sigs::editor {

// Beside the canvas: how to detect, what came of it, what to paint on, and where the mask goes. Settings of the
// detection are changed by edits of the project; all else goes to the session.
class OwnBodyPanel {
 public:
  // Into what is left of the current ImGui window. True in updates in which the painting was given another start.
  [[nodiscard]] bool draw(const ViewContext& context, OwnBodySession& session);

 private:
  // The project's fields of the method that is chosen.
  void draw_settings(const ViewContext& context);
  // A button that starts it, progress while it runs, and what the last run found with cautions about it.
  void draw_detection(const ViewContext& context, OwnBodySession& session) const;
  void draw_running(const ViewContext& context, OwnBodySession& session) const;
  void draw_found(const ViewContext& context, const DetectionState& state) const;
  // Buttons that replace the painting. True: one of them did.
  [[nodiscard]] bool draw_start_from(const ViewContext& context, OwnBodySession& session) const;
  // Where the painting is of another size than the footage.
  void draw_misfit(const ViewContext& context, OwnBodySession& session) const;
  // Whether the mask is on disk and used, and the buttons that save it.
  void draw_file(const ViewContext& context, OwnBodySession& session);
  // The question whether the project's own file may be replaced.
  void draw_replacing(const ViewContext& context, OwnBodySession& session);

  // Of the revision with this number; made anew for another one.
  std::optional<FieldSheet> sheet_;
  std::uint64_t sheet_revision_ = 0;
  ProblemList problems_;
  RowMemory memory_;
  // The question of draw_replacing() is open.
  bool asks_to_replace_ = false;
};

}  // namespace sigs::editor
