// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/document/field_edits.h"
#include "editor/preview/background_job.h"
#include "editor/views/context.h"
#include "project/validate.h"

namespace sigs::editor {

// How a field is shown, where its type does not say all.
struct RowOptions {
  std::string label;               // "": by its key
  std::string off_because;         // not empty: it cannot be edited, and why
  std::vector<std::string> names;  // a text that is one of these is chosen from a list
  // The value of an optional number when it is switched on.
  std::optional<double> suggested;
  bool is_color = false;
  bool is_hidden = false;  // rows() passes over it
};

// Where `is_off`, the row cannot be edited, for this reason.
[[nodiscard]] inline RowOptions off_where(bool is_off, const char* reason) {
  return {.off_because = is_off ? reason : ""};
}

// What is being typed: it becomes the value when it is finished, and is forgotten by Escape.
struct Typing {
  std::string key;  // of the field that a text is for
  std::string text;
  unsigned int item = 0;  // ImGui's id of the number
  double number = 0;
};

// A value that the person has given. One that is still being dragged or typed is not yet finished: it is part of a
// gesture.
struct Edited {
  PlainValue value;
  bool is_finished = false;
};

// The editor of a field by its type, from the cursor on, `width` screen pixels wide. None: nothing was edited in this
// update.
[[nodiscard]] std::optional<Edited> field_input(const Field& field, const RowOptions& look, float width,
                                                Typing& typing);

// To be called after a number that is dragged, or typed after a click (ImGui::DragScalar), with what that returned and
// left. True in updates in which the number takes effect: while it is dragged, and once it is typed.
[[nodiscard]] bool takes_effect(bool is_changed, double& value, Typing& typing);

// A number with its unit; true in updates in which it takes effect. Stays in the range.
[[nodiscard]] bool number_input(const char* id, double& value, const Field& field, float width, Typing& typing);

// What is wrong, by the key of the field that it is in: "intruders[0].model.file".
using ProblemsByField = std::multimap<std::string, Problem, std::less<>>;

// Whether something is wrong with a key, or with one that begins so.
[[nodiscard]] bool has_problem(const ProblemsByField& problems, std::string_view key);

// What rows remember from one update to the next; the view that makes FieldRows owns it.
struct RowMemory {
  Typing typing;
  // A row to be scrolled to and given the keyboard, once it is drawn; "": none.
  std::string wanted_key;
  int wanted_updates = 0;  // for how many updates it is still waited for
  // A value is being dragged or typed, so its undo step is not complete.
  bool gesture_is_open = false;
  // The project's fields, of the revision with this number.
  std::optional<FieldSheet> sheet;
  std::uint64_t sheet_revision = 0;
  std::uint64_t document = 0;  // Document::first_number(): what is being typed belongs to that project

  // Once per update: lists the fields anew for another revision, and forgets what was typed into another project.
  void refresh(const ViewContext& context);
};

// Draws fields, each as a row: label, editor with its unit, a way back to the default, and what is wrong with it.
// Changes become edits of the project. Made anew each update; what it is made from must outlive it.
class FieldRows {
 public:
  // place  what the names of the fields' places in the UI probe begin with
  // memory was refreshed in this update
  FieldRows(const ViewContext& context, const ProblemsByField& problems, RowMemory& memory,
            std::string place = "inspector/")
      : context_(context), sheet_(*memory.sheet), problems_(problems), memory_(memory), place_(std::move(place)) {}

  // Rows that most projects do not need (is_common()) are left out from now on, unless they are wrong, guessed or
  // gone to.
  void leave_out_uncommon() { leaves_out_uncommon_ = true; }
  // How many have been left out since.
  [[nodiscard]] int left_out() const { return left_out_; }

  // Nothing is drawn where there is no such field.
  void row(std::string_view key, const RowOptions& look = {});
  // The rows of all fields whose keys begin so, in the project's order. look_of: may be empty.
  void rows(std::string_view prefix, const std::function<RowOptions(const Field&)>& look_of = {});
  // What is wrong with a key, with advice; nothing where nothing is.
  void problem_lines(std::string_view key);
  // That a key was guessed, how (ViewContext::guesses), and what to do in the window; nothing where it was not.
  void guess_lines(std::string_view key);

  // Draws a label and leaves the cursor where its controls go; returns the width that they have, in screen pixels.
  // below: the controls go into the next line and have all of its width.
  [[nodiscard]] float begin_row(const std::string& label, bool below = false);

  [[nodiscard]] const FieldSheet& sheet() const { return sheet_; }
  [[nodiscard]] Typing& typing() const { return memory_.typing; }
  [[nodiscard]] const ProblemsByField& problems() const { return problems_; }

  // To be called when all rows of the update are drawn: a gesture whose editor has gone away is finished.
  void finish();

 private:
  [[nodiscard]] bool is_left_out(std::string_view key) const;
  // The tooltip: help, range, default and key.
  void draw_hint(const Field& field, const RowOptions& look) const;
  // At the right of a row: choosing a file, or back to the default.
  void draw_side_buttons(const Field& field, float top_y);
  void browse(const Field& field);
  void change(const Field& field, const Edited& edited);

  const ViewContext& context_;
  const FieldSheet& sheet_;
  const ProblemsByField& problems_;
  RowMemory& memory_;
  std::string place_;
  bool leaves_out_uncommon_ = false;
  int left_out_ = 0;
  std::set<std::string, std::less<>> told_groups_;  // whose guess has been drawn
};

// Pale wrapped text beside fields.
void note(const std::string& text, bool is_warning = false);

// Wrapped text that is clicked to go to a frame.
void frame_link(const ViewContext& context, const std::string& text, double frame, ImU32 shade);

// Buttons with texts, side by side as long as there is room.
class ButtonFlow {
 public:
  // True when it is clicked. tooltip may be "".
  [[nodiscard]] bool button(const char* label, const char* tooltip, bool enabled = true);

 private:
  float right_x_ = -1;  // right edge of the last one, on the screen; -1: there is none yet
};

// A bar with the frames that are done, and the button "Stop" below it. True when the button is clicked.
[[nodiscard]] bool draw_job_progress(int done, int total, bool is_stopping);

// The progress of a job that runs, whose button, known by this id, asks `stop`. False: it does not run.
template <class Asked, class Value>
[[nodiscard]] bool draw_if_running(const ViewContext& context, const JobState<Asked, Value>& state, const Request& stop,
                                   const char* id) {
  if (!state.is_running()) return false;
  if (draw_job_progress(state.done, state.total, state.is_stopping)) context.edits.ask(stop);
  context.ui_probe.note_item(id);
  return true;
}

}  // namespace sigs::editor
