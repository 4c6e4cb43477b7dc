// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/appearance_block.h"
#include "editor/views/inspector/encounter_block.h"
#include "editor/views/inspector/problems.h"
#include "editor/views/inspector/light_block.h"
#include "editor/views/inspector/scene_blocks.h"
#include "editor/views/inspector/trajectory.h"

namespace sigs::editor {

// The settings of the project, made from project/fields, with problems where they are: those that most projects need,
// or all. Blocks fold; a filter shows only the settings whose key, label or help has all its words, of all. Changes
// become edits of the project.
class InspectorView {
 public:
  // Once per update, into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  // Lists the fields and problems anew where the project or its surveys are others.
  void refresh(const ViewContext& context);
  // Opens the block of what was selected in another view.
  void follow_selection(const ViewContext& context);
  // Opens the block Appearance where the footage begins to be matched from another view.
  void follow_matching(const ViewContext& context);
  // Opens the block of a field's key, selects what it belongs to, and gives its row the keyboard.
  void go_to_problem(const ViewContext& context, const std::string& key);
  void draw_top(const ViewContext& context, FieldRows& rows);
  void draw_blocks(const ViewContext& context, FieldRows& rows);
  // The rows that the filter lets through, in place of the blocks.
  void draw_found(const ViewContext& context, FieldRows& rows) const;
  // A header that folds, with the number of its problems, and below it `content` while it is open. opens_first: whether
  // it is open when the program starts.
  // Below the content: how many settings are left out.
  void block(const ViewContext& context, const char* title, bool opens_first, const FieldRows& rows,
             const std::function<void()>& content);
  void draw_depth(const ViewContext& context) const;

  // Of the revision with this number; made anew for another one.
  std::optional<FieldSheet> sheet_;
  std::uint64_t sheet_revision_ = 0;
  ProblemList problems_;
  LossOfView loss_of_view_;
  RowMemory memory_;
  LightBlock light_;
  ModelBlock model_;
  AppearanceBlock appearance_;
  TrajectoryBlock trajectory_;
  EncounterBlock encounter_;
  std::string filter_;
  // Title of the block that is to be opened, and for how many updates yet: rows appear only when they are drawn.
  std::string block_to_open_;
  int updates_to_open_ = 0;
  // The document's selection in the update before.
  Selection followed_;
  bool was_matching_ = false;  // likewise
};

}  // namespace sigs::editor
