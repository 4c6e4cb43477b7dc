// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "editor/document/field_edits.h"
#include "editor/views/context.h"
#include "editor/views/inspector/field_inputs.h"
#include "project/validate.h"

namespace sigs::editor {

// What is wrong, by the key of the field that it is in.
using ProblemsByField = std::multimap<std::string, Problem, std::less<>>;

// What rows remember from one update to the next.
struct RowMemory {
  TypedText typed;
  std::string wanted_key;  // a row to be scrolled to and given the keyboard, once it is drawn
  int wanted_updates = 0;  // for how many updates yet
  bool gesture_is_open = false;
};

// Draws fields, each as a row: label, editor with its unit, a way back to the default, and what is wrong with it. Made
// anew each update.
class FieldRows {
 public:
  // place  what the fields' places on the screen begin with
  FieldRows(const ViewContext& context, const FieldSheet& sheet, const ProblemsByField& problems, RowMemory& memory,
            std::string place = "inspector/")
      : context_(context), sheet_(sheet), problems_(problems), memory_(memory), place_(std::move(place)) {}

  // Nothing where there is no such field.
  void row(std::string_view key, const RowOptions& look = {});
  // Those whose keys begin so, in the project's order.
  void rows(std::string_view prefix, const std::function<RowOptions(const Field&)>& look_of = {});
  void problem_lines(std::string_view key);

  // Any label and controls in the same columns: the width that the controls have from the cursor on.
  [[nodiscard]] float begin_row(const std::string& label, bool below = false);

  [[nodiscard]] const FieldSheet& sheet() const { return sheet_; }
  [[nodiscard]] const ProblemsByField& problems() const { return problems_; }

  // At the update's end: a gesture whose editor has gone away is finished.
  void finish();

 private:
  void draw_hint(const Field& field, const RowOptions& look) const;
  void draw_side_buttons(const Field& field, float top_y);
  void browse(const Field& field);
  void change(const Field& field, const Edited& edited);

  const ViewContext& context_;
  const FieldSheet& sheet_;
  const ProblemsByField& problems_;
  RowMemory& memory_;
  std::string place_;
};

// Pale wrapped text beside fields.
void note(const std::string& text, bool is_warning = false);

// Buttons with texts, side by side as long as there is room.
class ButtonFlow {
 public:
  [[nodiscard]] bool button(const char* label, const char* tooltip, bool enabled = true);

 private:
  float right_x_ = -1;  // of the last one, on the screen
};

}  // namespace sigs::editor
