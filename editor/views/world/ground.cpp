// SPDX-License-Identifier: MIT
#include "editor/views/world/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "editor/geometry/ground_grid.h"

namespace sigs::editor {

namespace {

constexpr double kEdgeOn_rad = 0.03;
constexpr double kLabelledReach = 1.5;  // times the eye's distance: beyond, the lines are too close to each other
constexpr ImU32 kLine = IM_COL32(255, 255, 255, 15);
constexpr ImU32 kBoldLine = IM_COL32(255, 255, 255, 34);
constexpr std::array<ImU32, 3> kAxisColors{color::kAxisX, color::kAxisY, color::kAxisZ};

bool is_edge_on(const OrbitCamera& eye) {
  return std::abs(eye.elevation_rad) < kEdgeOn_rad;
}

std::string text_of(const GridLine& line) {
  return (line.is_of_x ? "X " : "Y ") + round_distance_text(line.at_m);
}

void draw_label(WorldCanvas& canvas, const GridLine& line, double text_px) {
  const double from_target_m = std::abs(line.at_m - canvas.eye().target_m[line.is_of_x ? 0 : 1]);
  if (from_target_m > kLabelledReach * canvas.eye().distance_m) return;
  const auto ends = canvas.within_rect(line.ends_m[0], line.ends_m[1]);
  if (!ends) return;
  const auto [a, b] = *ends;
  // Lines of one x end below, those of one y at the left, whichever direction they run.
  const bool a_is_it = line.is_of_x == (std::abs(canvas.eye().right().y) > 0.7) ? a.x < b.x : a.y > b.y;
  const glm::dvec2 at = a_is_it ? a : b;
  const glm::dvec2 inwards = glm::normalize((a_is_it ? b : a) - at + glm::dvec2(1e-9));
  const ImU32 color = faded(line.is_of_x ? color::kAxisX : color::kAxisY, 0.9);
  canvas.label(at + inwards * (2.2 * text_px), text_of(line), color, WorldCanvas::Side::centre);
}

// Level with the ground it is one line, with the metres along it.
void draw_edge_on(WorldCanvas& canvas, const GroundGrid& grid, double text_px) {
  const bool along_x = std::abs(canvas.eye().right().x) > 0.7;
  for (const GridLine& line : grid.lines) {
    if (line.is_of_x != along_x) continue;
    const glm::dvec3 foot_m = (line.ends_m[0] + line.ends_m[1]) / 2.0;
    const std::optional<glm::dvec2> foot = canvas.in_sight(foot_m);
    if (!foot) continue;
    const bool marked = std::llround(line.at_m / grid.step_m) % 5 == 0;
    const glm::dvec2 down{0, text_px * (marked ? 0.6 : 0.35)};
    canvas.list().AddLine(im(*foot), im(*foot + down), faded(color::kQuiet, 0.6));
    if (marked)
      canvas.label(*foot + glm::dvec2(0, text_px * 1.3), text_of(line),
                   faded(along_x ? color::kAxisX : color::kAxisY, 0.75), WorldCanvas::Side::centre);
  }
  const auto across =
      std::find_if(grid.lines.begin(), grid.lines.end(), [&](const GridLine& line) { return line.is_of_x != along_x; });
  if (across != grid.lines.end()) canvas.line(across->ends_m[0], across->ends_m[1], faded(color::kQuiet, 0.6));
}

}  // namespace

void draw_ground(WorldCanvas& canvas) {
  const GroundGrid grid = ground_grid(canvas.eye(), canvas.rect());
  const double text_px = font(Font::small)->FontSize;
  if (is_edge_on(canvas.eye())) {
    draw_edge_on(canvas, grid, text_px);
    return;
  }
  for (const GridLine& line : grid.lines)
    if (const auto ends = canvas.within_rect(line.ends_m[0], line.ends_m[1]))
      canvas.list().AddLine(im((*ends)[0]), im((*ends)[1]), line.bold ? kBoldLine : kLine);
}

void draw_ground_labels(WorldCanvas& canvas) {
  if (is_edge_on(canvas.eye())) return;
  const GroundGrid grid = ground_grid(canvas.eye(), canvas.rect());
  const double text_px = font(Font::small)->FontSize;
  for (const bool bold : {true, false})
    for (const GridLine& line : grid.lines)
      if (line.bold == bold && std::llround(line.at_m / grid.step_m) % 5 == 0) draw_label(canvas, line, text_px);
}

void draw_axes(WorldCanvas& canvas) {
  const double reach = scaled(24);
  const ScreenRect& rect = canvas.rect();
  const glm::dvec2 origin{rect.low.x + reach * 1.6, rect.high.y - reach * 1.6};
  const OrbitCamera& eye = canvas.eye();
  std::array<std::size_t, 3> order{0, 1, 2};  // far to near
  const auto depth = [&](std::size_t axis) { return eye.forward()[static_cast<int>(axis)]; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depth(a) > depth(b); });
  ImFont* face = font(Font::small);
  for (const std::size_t axis : order) {
    const auto i = static_cast<int>(axis);
    const glm::dvec2 direction{eye.right()[i], -eye.up()[i]};
    const glm::dvec2 tip = origin + direction * reach;
    canvas.list().AddLine(im(origin), im(tip), kAxisColors[axis], scaled(1.8));
    const char name[2] = {static_cast<char>('X' + i), 0};
    const ImVec2 size = face->CalcTextSizeA(face->FontSize, 1e6F, 0, name);
    const double length = glm::length(direction);
    if (length < 0.25) continue;  // the axis points at the eye
    const glm::dvec2 middle = tip + direction / length * (0.7 * face->FontSize);
    canvas.list().AddText(face, face->FontSize, im(middle - glm::dvec2(size.x, size.y) / 2.0), kAxisColors[axis], name);
  }
  canvas.keep_free({origin - reach * 1.5, origin + reach * 1.5});
}

}  // namespace sigs::editor
