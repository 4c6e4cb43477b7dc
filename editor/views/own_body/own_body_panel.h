// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/own_body/own_body_session.h"

namespace sigs::editor {

// Beside the canvas: how to detect, what came of it, what to paint on, and where the mask goes.
class OwnBodyPanel {
 public:
  // Into what is left of the current ImGui window. True in updates in which the painting was given another start.
  [[nodiscard]] bool draw(const ViewContext& context, OwnBodySession& session);

 private:
  void draw_settings(const ViewContext& context);
  void draw_detection(const ViewContext& context, OwnBodySession& session) const;
  void draw_running(const ViewContext& context, OwnBodySession& session) const;
  void draw_found(const ViewContext& context, const DetectionState& state) const;
  [[nodiscard]] bool draw_start_from(const ViewContext& context, OwnBodySession& session) const;
  void draw_misfit(const ViewContext& context, OwnBodySession& session) const;
  void draw_file(const ViewContext& context, OwnBodySession& session);
  void draw_replacing(const ViewContext& context, OwnBodySession& session);

  std::optional<FieldSheet> sheet_;
  std::uint64_t sheet_revision_ = 0;
  ProblemList problems_;
  RowMemory memory_;
  bool asks_to_replace_ = false;
};

}  // namespace sigs::editor
