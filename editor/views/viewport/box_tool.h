// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "editor/views/context.h"
#include "editor/views/viewport/real_aircraft_session.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

// Boxes that are drawn over the footage by a drag of the left button: around something lit (LightLike), and around
// aircraft that the footage itself shows, which it also shows and deletes. The next drag over the image is such a box
// once it is asked for; Escape ends that.
class BoxTool {
 public:
  void ask_for_lit_box() { wanted_ = Wanted{}; }
  // Asks for boxes of one aircraft, one after the other; without a label of another one than any before. Says what to
  // do where the project has no file yet.
  void ask_for_real_aircraft(const ViewContext& context, std::optional<std::string> label = {});
  [[nodiscard]] bool is_wanted() const { return wanted_.has_value(); }
  [[nodiscard]] bool is_marking() const { return wanted_ && wanted_->is_real; }

  // Once per update, before the other calls: follows the document, and takes undo and redo while boxes of real
  // aircraft were the last thing that was worked on.
  void follow(const ViewContext& context);

  // A press of the left button over the image, while a box is wanted.
  void press(const ImageCanvas& canvas, const glm::dvec2& mouse);
  // Once per update while a box is wanted.
  //   hovered  the mouse is over the image
  //   down     a button is held
  void drag(const ViewContext& context, const ImageCanvas& canvas, bool hovered, bool down);

  // What to do and the box that is dragged.
  void draw(const ViewContext& context, const ImageCanvas& canvas) const;
  // The boxes of real aircraft in the frame that is shown: drawn ones solid, those filled in between dashed.
  void draw_real_aircraft(const ViewContext& context, const ImageCanvas& canvas, LabelPlacer& labels) const;

  // For the menu of the right button: remembers the box of a real aircraft at a pixel of the image, the smallest one
  // there; and the lines of the menu for it. Nothing where there is none, or they are not shown.
  void open_menu(const ViewContext& context, const ImageCanvas& canvas, const glm::dvec2& pixel, bool are_shown);
  void draw_menu(const ViewContext& context);

 private:
  struct Wanted {
    bool is_real = false;
    std::string label;  // of the real aircraft
    // Where the box begins and ends, pixels of the image; before the press they are not there.
    std::optional<glm::dvec2> from_px, to_px;
  };

  void take_box(const ViewContext& context, const ImageCanvas& canvas, const Box& box);
  // Says what went wrong with a change of the boxes; else undo is about them from here on.
  void tell(const ViewContext& context, const Result<void>& changed);

  RealAircraftSession real_aircraft_;
  std::optional<Wanted> wanted_;
  std::optional<RealAircraftBox> menu_box_;
  bool is_worked_in_ = false;  // the last press was for a box of a real aircraft
};

}  // namespace sigs::editor
