// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/document/field_edits.h"

namespace sigs::editor {

// How a field is shown, where its type does not say all.
struct RowOptions {
  // "": by its key.
  std::string label;
  // Not empty: it cannot be edited, and why.
  std::string off_because;
  // A text that is one of these is chosen from a list.
  std::vector<std::string> names;
  // The value of an optional number when it is switched on.
  std::optional<double> suggested;
  bool is_color = false;
};

// A text that is being typed becomes the field's value when it is finished.
struct TypedText {
  std::string key;
  std::string text;
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
                                                TypedText& typed);

// A number with its unit: dragged, or typed after a click; true in updates in which it has changed. Stays in the range.
[[nodiscard]] bool number_input(const char* id, double& value, const Field& field, float width);

// X, Y, Z side by side, or below each other where there is no room; true in updates in which one has changed.
[[nodiscard]] bool vector_input(glm::dvec3& value, const Field& field, float width);

}  // namespace sigs::editor
