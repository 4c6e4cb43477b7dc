// SPDX-License-Identifier: MIT
#include "editor/views/timeline/lane_names.h"

#include <algorithm>
#include <cmath>

#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

void draw_lane_names(const TimelineStrip& strip, const char* title, ImVec2 low, float height, const std::string& value,
                     const std::string& extent) {
  ImGui::PushFont(font(Font::small));
  const float line = font(Font::small)->FontSize;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = strip.names_x + strip.names_width - scaled(8);
  const bool two_lines = !extent.empty() && height >= 2 * line + scaled(2);
  const float text_height = line * (two_lines ? 2 : 1);
  const float y = std::floor(low.y + std::min((height - text_height) / 2, scaled(4)));
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const std::string shown_title = elided(title, right - value_width - strip.names_x - scaled(8));
  list.AddText({strip.names_x + scaled(2), y}, color::kQuiet, shown_title.c_str());
  list.AddText({right - value_width, y}, color::kText, value.c_str());
  if (two_lines) {
    const std::string shown = elided(extent, right - strip.names_x);
    list.AddText({strip.names_x + scaled(2), y + line}, faded(color::kQuiet, 0.75), shown.c_str());
  }
  ImGui::PopFont();
}

}  // namespace sigs::editor
