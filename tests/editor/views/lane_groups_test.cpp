// SPDX-License-Identifier: MIT
#include "editor/views/timeline/timeline_view.h"

#include <doctest/doctest.h>

namespace sigs::editor {

TEST_CASE("headers of lanes stay within the window, in their order, whatever is scrolled away") {
  constexpr float kHeight = 18;
  constexpr float kTop = 100;
  constexpr float kBottom = 200;
  for (const float scrolled : {-500.0F, -150.0F, -60.0F, 0.0F, 60.0F, 500.0F})
    for (const float rows : {0.0F, 40.0F, 300.0F}) {
      const float first = header_y(kTop + scrolled, 0, 2, kHeight, kTop, kBottom);
      const float second = header_y(kTop + scrolled + kHeight + rows, 1, 2, kHeight, kTop, kBottom);
      CAPTURE(scrolled);
      CHECK(first >= kTop);
      CHECK(second >= first + kHeight);
      CHECK(second + kHeight <= kBottom);
    }
  CHECK(header_y(130, 0, 2, kHeight, kTop, kBottom) == 130);  // in sight: at its place
  CHECK(header_y(150, 1, 2, kHeight, kTop, kBottom) == 150);
  CHECK(header_y(150, 1, 2, kHeight, kTop, kTop + 10) == kTop + kHeight);  // no room at all
}

}  // namespace sigs::editor
