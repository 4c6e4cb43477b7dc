// SPDX-License-Identifier: MIT
#include "editor/views/viewport/problem_banner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/widgets/elided.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kMaxShown = 4;

float padding() {
  return scaled(8);
}

float icon_side() {
  return ImGui::GetFontSize();
}

std::string heading(std::size_t count) {
  return count == 1 ? "1 problem" : std::to_string(count) + " problems";
}

}  // namespace

std::vector<std::string> problems_of(const ViewContext& context, const PreviewImage* image) {
  std::vector<std::string> problems;
  const auto add = [&](const std::string& problem) {
    std::string shown = shortened(problem, 400);
    if (!shown.empty() && std::find(problems.begin(), problems.end(), shown) == problems.end())
      problems.push_back(std::move(shown));
  };
  if (context.shown.scene) {
    const OpenedScene& scene = *context.shown.scene;
    const bool no_footage = scene.footage && !scene.footage->problem.empty();
    if (no_footage) add("Grey replaces the footage: " + scene.footage->problem);
    for (const Problem& problem : scene.draft.problems)
      if (!(no_footage && problem.field == "footage.video")) add(problem.field + ": " + problem.what);
  }
  // What the scene is known to lack is not said again of each image.
  if (image != nullptr && problems.empty()) add(image->problem);
  return problems;
}

void ProblemBanner::lay_out(const ScreenRect& rect) {
  lines_.clear();
  const float margin = scaled(8);
  const float maximum_width = std::min(static_cast<float>(rect.size().x) - 2 * margin, scaled(640));
  const float indent = 2 * padding() + icon_side();
  const float room = std::max(scaled(60), maximum_width - indent - padding());
  std::vector<std::string> texts{heading(problems_.size())};
  if (!folded_) {
    texts.assign(problems_.begin(), problems_.begin() + static_cast<long>(std::min(kMaxShown, problems_.size())));
    if (problems_.size() > kMaxShown)
      texts.push_back("and " + std::to_string(problems_.size() - kMaxShown) +
                      " more, at their fields in the inspector");
  }
  glm::dvec2 size(0, 2 * padding() - scaled(3));
  for (const std::string& text : texts) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
    lines_.push_back({text, extent.y + scaled(3)});
    size = {std::max(size.x, static_cast<double>(extent.x + indent + padding())), size.y + lines_.back().height};
  }
  plate_.low = rect.low + static_cast<double>(margin);
  plate_.high = glm::min(plate_.low + glm::ceil(size), rect.high - 1.0);
}

void ProblemBanner::handle_mouse(const ScreenRect& rect, std::vector<std::string> problems) {
  if (problems != problems_) folded_ = false;
  problems_ = std::move(problems);
  hovered_ = false;
  if (problems_.empty()) return;
  lay_out(rect);
  if (plate_.size().x < 1 || plate_.size().y < 1) return;
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(im(plate_.low));
  if (ImGui::InvisibleButton("problems", im(plate_.size()))) folded_ = !folded_;
  hovered_ = ImGui::IsItemHovered();
  tooltip_for_item(folded_ ? "Click to unfold" : "Click to fold up");
  ImGui::SetCursorScreenPos(cursor);
}

void ProblemBanner::draw(ImDrawList& draw) const {
  if (problems_.empty() || lines_.empty()) return;
  draw.PushClipRect(im(plate_.low), im(plate_.high), true);
  draw.AddRectFilled(im(plate_.low), im(plate_.high), hovered_ ? IM_COL32(46, 44, 40, 240) : IM_COL32(30, 29, 27, 225),
                     scaled(4));
  draw.AddRectFilled(im(plate_.low), im({plate_.low.x + scaled(3), plate_.high.y}), color::kPartly, scaled(4),
                     ImDrawFlags_RoundCornersLeft);
  const auto left = static_cast<float>(plate_.low.x) + padding();
  const float text_x = left + icon_side() + padding();
  float y = static_cast<float>(plate_.low.y) + padding();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (i < kMaxShown)
      draw_icon(draw, Icon::warning, {left + icon_side() / 2, y + icon_side() / 2}, icon_side(), color::kPartly);
    const float room = static_cast<float>(plate_.high.x) - text_x - padding() + 1;
    draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {text_x, y}, i < kMaxShown ? color::kText : color::kQuiet,
                 lines_[i].text.c_str(), nullptr, room);
    y += lines_[i].height;
  }
  draw.PopClipRect();
}

}  // namespace sigs::editor
