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

// The view of how a frame is made: all stages side by side with linked zoom; or the difference between the output and
// the footage, or between two methods. While it is drawn the preview makes the stages too (ViewNeeds).
class StagesView {
 public:
  // Into what is left of the current ImGui window.
  void draw(const ViewContext& context);
  // To be called while it is not drawn: releases its images, as a frame's stages are a dozen frames.
  void forget();

 private:
  // The stages of one method, the output against the footage, or the project's own method against another one.
  enum class Mode { stages, against_input, against_method };

  // Asks for what is to be shown, and takes what is there.
  void request_preview(const ViewContext& context);
  void draw_toolbar_of(const ViewContext& context);
  // What the button for the project's own method says.
  [[nodiscard]] std::string own_label(const ViewContext& context) const;
  void draw_method_choice(const ViewContext& context);
  void draw_intruder_choice(const ViewContext& context);
  void draw_gain();
  // To the visible box of the intruder that is looked at; a message where there is none.
  void zoom_to_intruder(const ViewContext& context);
  // Why something is missing or of another frame, over the images.
  void draw_notice(const ViewContext& context, const ScreenRect& rect) const;
  [[nodiscard]] ToolbarItem look_button(const ViewContext& context, const char* label, const char* tooltip, Mode look);
  [[nodiscard]] MethodChoice own_method(const ViewContext& context) const;
  // The method that is looked at, or compared with; never the project's own where two are compared.
  [[nodiscard]] MethodChoice other_method(const ViewContext& context) const;
  // The image whose stages are shown: by the project's own method, or by the other one. Null: not there yet.
  [[nodiscard]] const PreviewImage* image_with_stages(const ViewContext& context) const;
  // Numbers, in the scene, of the intruders that have stages in that image.
  [[nodiscard]] std::vector<int> choices(const ViewContext& context) const;
  // The one whose stages are shown: the chosen one, else the one that is worked on, else the first; none where no
  // intruder has stages.
  [[nodiscard]] std::optional<int> intruder(const ViewContext& context) const;
  // What the grid shows; empty while it is not there.
  [[nodiscard]] std::vector<StageTile> tiles(const ViewContext& context);
  [[nodiscard]] std::vector<StageTile> input_tiles(const PreviewImage& image);
  [[nodiscard]] std::vector<StageTile> method_tiles(const ViewContext& context);

  StageGrid grid_;
  Differences differences_;
  Mode look_ = Mode::stages;
  // As chosen; none: the project's own.
  std::optional<MethodChoice> method_;
  // As chosen, by the scene's number; none: the one that is worked on.
  std::optional<int> intruder_;
  // Differences are shown that many times as large.
  double gain_ = 8;
  // The newest there was of each: shown until there is a newer one.
  std::shared_ptr<const PreviewImage> staged_;
  std::shared_ptr<const PreviewImage> compared_;
};

}  // namespace sigs::editor
