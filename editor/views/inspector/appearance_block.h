// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "editor/views/context.h"
#include "editor/views/inspector/field_rows.h"

namespace sigs::editor {

// How the footage looks: the button that finds it, below it what it has found, each with its deviation, and the
// settings.
class AppearanceBlock {
 public:
  void draw(const ViewContext& context, FieldRows& rows);

 private:
  void draw_match(const ViewContext& context, const AppearanceState& state);

  std::shared_ptr<const Appearance> shown_;  // the list was scrolled to when it came
};

}  // namespace sigs::editor
