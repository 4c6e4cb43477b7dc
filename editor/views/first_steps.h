// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "editor/geometry/image_view.h"
#include "editor/views/context.h"

namespace sigs::editor {

// What a project needs before there is anything to see, in the order in which it is usually chosen: a card over the
// image, until all of it is there or the person puts the card away. Then where the horizon lies, at the image's
// lower edge, so that its line can be dragged.
class FirstSteps {
 public:
  // In the middle of `room`, in the current ImGui window.
  void draw(const ViewContext& context, const ScreenRect& room);

 private:
  std::uint64_t begun_ = 0;     // the document that had not all of it
  std::uint64_t shown_ = 0;     // the document whose horizon was shown
  std::uint64_t put_away_ = 0;  // the document for which it is not wanted
};

}  // namespace sigs::editor
