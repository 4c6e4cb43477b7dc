// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/views/context.h"
#include "editor/views/stages/stage_grid.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

// The stages of the frame side by side, linked zoom, differences.
class StagesView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);
  // While it is not drawn: a frame's stages are a dozen frames.
  void forget();

 private:
  enum class Mode { stages, against_input, against_method };

  void request_preview(const ViewContext& context);
  void draw_toolbar_of(const ViewContext& context);
  [[nodiscard]] std::string own_label(const ViewContext& context) const;
  void draw_method_choice(const ViewContext& context);
  void draw_intruder_choice(const ViewContext& context);
  void draw_gain();
  void zoom_to_intruder(const ViewContext& context);
  void draw_notice(const ViewContext& context, const ScreenRect& rect) const;
  [[nodiscard]] ToolbarItem look_button(const char* label, const char* tooltip, Mode look);
  [[nodiscard]] MethodChoice own_method(const ViewContext& context) const;
  // The method that is looked at, or compared with.
  [[nodiscard]] MethodChoice other_method(const ViewContext& context) const;
  [[nodiscard]] const PreviewImage* frames_checked(const ViewContext& context) const;
  [[nodiscard]] std::vector<int> choices(const ViewContext& context) const;
  [[nodiscard]] std::optional<int> intruder(const ViewContext& context) const;
  [[nodiscard]] std::vector<StageTile> tiles(const ViewContext& context);
  [[nodiscard]] std::vector<StageTile> input_tiles(const PreviewImage& image);
  [[nodiscard]] std::vector<StageTile> method_tiles(const ViewContext& context);

  StageGrid grid_;
  Differences differences_;
  Mode look_ = Mode::stages;
  std::optional<MethodChoice> method_;  // none: the project's own
  std::optional<int> intruder_;         // the scene's number; none: the one that is worked on
  double gain_ = 8;
  std::shared_ptr<const PreviewImage> staged_;  // the newest there was: shown until there is a newer one
  std::shared_ptr<const PreviewImage> compared_;
};

}  // namespace sigs::editor
