// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/views/stages/stage_grid.h"
#include "editor/views/stages/stage_tiles.h"
#include "editor/views/studio.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

// The stages of the frame side by side, linked zoom, differences.
class StagesView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const Studio& studio);
  // While it is not drawn: a frame's stages are a dozen frames.
  void forget();

 private:
  enum class Look { stages, against_input, against_method };

  void wish(const Studio& studio);
  void draw_toolbar_of(const Studio& studio);
  [[nodiscard]] std::string own_label(const Studio& studio) const;
  void draw_method_choice(const Studio& studio);
  void draw_intruder_choice(const Studio& studio);
  void draw_gain();
  void zoom_to_intruder(const Studio& studio);
  void draw_notice(const Studio& studio, const ScreenRect& rect) const;
  [[nodiscard]] ToolbarItem look_button(const char* label, const char* tooltip, Look look);
  [[nodiscard]] MethodChoice own_method(const Studio& studio) const;
  // The method that is looked at, or compared with.
  [[nodiscard]] MethodChoice other_method(const Studio& studio) const;
  [[nodiscard]] const Picture* looked_at(const Studio& studio) const;
  [[nodiscard]] std::vector<int> choices(const Studio& studio) const;
  [[nodiscard]] std::optional<int> intruder(const Studio& studio) const;
  [[nodiscard]] std::vector<StageTile> tiles(const Studio& studio);
  [[nodiscard]] std::vector<StageTile> input_tiles(const Picture& picture);
  [[nodiscard]] std::vector<StageTile> method_tiles(const Studio& studio);

  StageGrid grid_;
  Differences differences_;
  Look look_ = Look::stages;
  std::optional<MethodChoice> method_;  // none: the project's own
  std::optional<int> intruder_;         // the scene's number; none: the one that is worked on
  double gain_ = 8;
  std::shared_ptr<const Picture> staged_;  // the newest there was: shown until there is a newer one
  std::shared_ptr<const Picture> compared_;
};

}  // namespace sigs::editor
