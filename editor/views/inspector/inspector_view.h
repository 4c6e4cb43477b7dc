// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/inspector/scene_blocks.h"
#include "editor/views/inspector/trajectory.h"

namespace sigs::editor {

// Every setting of the project, made from project/fields, and problems where they are.
class InspectorView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  void refresh(const ViewContext& context);
  void follow_selection(const ViewContext& context);
  void go_to_problem(const ViewContext& context, const std::string& key);
  void draw_top(const ViewContext& context, FieldRows& rows);
  void draw_blocks(const ViewContext& context, FieldRows& rows);
  void draw_found(const ViewContext& context, FieldRows& rows) const;
  void block(const ViewContext& context, const char* title, bool opens_first, const std::function<void()>& content);

  std::optional<FieldSheet> sheet_;
  std::uint64_t sheet_revision_ = 0;
  ProblemList problems_;
  RowMemory memory_;
  LightBlock light_;
  ModelBlock model_;
  TrajectoryBlock trajectory_;
  std::string filter_;
  std::string block_to_open_;
  int updates_to_open_ = 0;  // for how many updates yet
  Selection followed_;
};

}  // namespace sigs::editor
