// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "editor/document/field_edits.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/own_body/own_body_work.h"
#include "editor/views/studio.h"

namespace sigs::editor {

// Beside the canvas: how to detect, what came of it, what to paint on, and where the mask goes.
class OwnBodyPanel {
 public:
  // Into what is left of the current ImGui window. True in turns in which the painting was given another start.
  [[nodiscard]] bool draw(const Studio& studio, OwnBodyWork& work);

 private:
  void draw_settings(const Studio& studio);
  void draw_detection(const Studio& studio, OwnBodyWork& work) const;
  void draw_running(const Studio& studio, OwnBodyWork& work) const;
  void draw_found(const Studio& studio, const DetectionState& state) const;
  [[nodiscard]] bool draw_start_from(const Studio& studio, OwnBodyWork& work) const;
  void draw_misfit(const Studio& studio, OwnBodyWork& work) const;
  void draw_file(const Studio& studio, OwnBodyWork& work);
  void draw_replacing(const Studio& studio, OwnBodyWork& work);

  std::optional<FieldSheet> sheet_;
  std::uint64_t sheet_revision_ = 0;
  ProblemList problems_;
  RowMemory memory_;
  bool asks_to_replace_ = false;
};

}  // namespace sigs::editor
