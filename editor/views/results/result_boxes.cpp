// SPDX-License-Identifier: MIT
#include "editor/views/results/result_boxes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "editor/views/results/result_texts.h"
#include "editor/widgets/elided.h"
#include "editor/widgets/screen_vec.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr ImU32 kGround = IM_COL32(8, 9, 11, 255);
constexpr double kMaxName_px = 150;
constexpr double kFarApart_px = 12;  // of the screen: nearer middles need no line
constexpr double kFree_px = 24;

glm::dvec2 middle_of(const ScreenRect& rect) {
  return (rect.low + rect.high) / 2.0;
}

ScreenRect on_screen(const ImageCanvas& canvas, const Box& box) {
  return {canvas.view.screen_of({box.x, box.y}), canvas.view.screen_of({box.x + box.width, box.y + box.height})};
}

// From where the truth's middle must be, by the errors, to the reported one.
void draw_path_line(const ImageCanvas& canvas, const ScreenRect& box, const FrameScore* score, ImU32 shade) {
  if (score == nullptr || !score->dx_px || !score->dy_px) return;
  const glm::dvec2 to = middle_of(box);
  const glm::dvec2 direction = glm::dvec2(*score->dx_px, *score->dy_px) * canvas.view.zoom;
  const double length = glm::length(direction);
  if (length < scaled(kFarApart_px)) return;
  // What is followed stays free.
  const glm::dvec2 from = to - direction * std::max(0.5, 1 - scaled(kFree_px) / length);
  canvas.draw.AddLine(im(from), im(to), faded(kGround, 0.5), scaled(2.5));
  canvas.draw.AddLine(im(from), im(to), faded(shade, 0.75), scaled(1));
}

void draw_reported(const ImageCanvas& canvas, const Scored& scored, const ScoredTracker& tracker, int frame) {
  const ReportedBox* const reported = tracker.results ? tracker.results->best_at(frame) : nullptr;
  if (reported == nullptr) return;
  const ImU32 shade = result_color(tracker.file.color);
  const ScreenRect box = on_screen(canvas, reported->box);
  draw_path_line(canvas, box, score_at(tracker, scored.first_frame, frame), shade);
  // A dark line outside, none between the dashes: where it agrees with the truth, that shows through.
  const double line = std::max(1.0F, std::round(scaled(1)));
  draw_outline(canvas, {box.low - 2 * line, box.high + 2 * line}, faded(kGround, 0.55), false);
  draw_outline(canvas, {box.low - line, box.high + line}, shade, true);
  draw_outline(canvas, box, shade, true);
}

struct LegendLine {
  std::string name;
  std::string value;
  ImU32 color = 0;
  bool is_dashed = true;
};

std::vector<LegendLine> legend_of(const Scored& scored, int frame) {
  std::vector<LegendLine> lines{{.name = "truth", .color = color::kBox, .is_dashed = false}};
  for (const ScoredTracker& tracker : scored.trackers) {
    if (!tracker.file.is_shown || !tracker.results) continue;
    lines.push_back({.name = elided(shown_name(scored, tracker), scaled(kMaxName_px)),
                     .value = moment_text(tracker, scored.first_frame, frame),
                     .color = result_color(tracker.file.color)});
  }
  return lines;
}

void draw_sample(ImDrawList& list, ImVec2 at, float width, const LegendLine& line) {
  const float thick = std::max(2.0F, scaled(2));
  const float dash = line.is_dashed ? scaled(5) : width;
  for (float x = 0; x < width; x += 2 * dash)
    list.AddRectFilled({at.x + x, at.y - thick / 2}, {at.x + std::min(x + dash, width), at.y + thick / 2}, line.color);
}

}  // namespace

void draw_result_boxes(const ImageCanvas& canvas, const ViewContext& context, int frame) {
  if (context.scored == nullptr) return;
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const ScoredTracker& tracker : context.scored->trackers)
    if (tracker.file.is_shown) draw_reported(canvas, *context.scored, tracker, frame);
  canvas.draw.PopClipRect();
}

void draw_result_legend(const ImageCanvas& canvas, const ViewContext& context, int frame) {
  if (context.scored == nullptr) return;
  ImGui::PushFont(font(Font::small));
  const std::vector<LegendLine> lines = legend_of(*context.scored, frame);
  const float sample = scaled(25);
  const float gap = scaled(7);
  const float row = std::ceil(ImGui::GetFontSize() + scaled(3));
  float names = 0;
  float values = 0;
  for (const LegendLine& line : lines) {
    names = std::max(names, ImGui::CalcTextSize(line.name.c_str()).x);
    values = std::max(values, ImGui::CalcTextSize(line.value.c_str()).x);
  }
  const ImVec2 size{2 * gap + sample + gap + names + 2 * gap + values, static_cast<float>(lines.size()) * row + gap};
  const glm::dvec2 low = glm::floor(glm::dvec2(canvas.rect.low.x + scaled(8), canvas.rect.high.y - scaled(8) - size.y));
  const ImVec2 at = im(low);
  context.ui_probe.note("viewport/legend", {low, low + glm::dvec2(size.x, size.y)});
  canvas.draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(12, 13, 16, 205), scaled(3));
  float y = at.y + gap / 2;
  for (const LegendLine& line : lines) {
    draw_sample(canvas.draw, {at.x + gap, std::floor(y + row / 2)}, sample, line);
    const float x = at.x + gap + sample + gap;
    canvas.draw.AddText({x, y}, color::kText, line.name.c_str());
    canvas.draw.AddText({x + names + 2 * gap, y}, line.color, line.value.c_str());
    y += row;
  }
  ImGui::PopFont();
}

}  // namespace sigs::editor
