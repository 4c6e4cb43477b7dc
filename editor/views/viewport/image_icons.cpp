// SPDX-License-Identifier: MIT
#include "editor/views/viewport/image_icons.h"

#include "editor/widgets/icon_shapes.h"

namespace sigs::editor::image_icon {

void box(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F}) pen.line({{0.75F * x, 0.2F * y}, {0.75F * x, 0.6F * y}, {0.3F * x, 0.6F * y}});
}

void path(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.line({{-0.8F, 0.55F}, {-0.35F, -0.1F}, {0, -0.25F}, {0.35F, -0.15F}, {0.8F, -0.55F}});
}

void waypoints(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.fill({{0, -0.55F}, {0.5F, 0}, {0, 0.55F}, {-0.5F, 0}});
}

void horizon(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.line({{-0.85F, 0.25F}, {0.85F, 0.25F}});
  pen.arc({0, 0.25F}, 0.45F, 3.1415927F, 6.2831853F);
}

void own_body(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.box({-0.8F, -0.65F}, {0.8F, 0.65F});
  pen.fill({{-0.8F, 0.65F}, {-0.2F, 0.1F}, {0.2F, 0.1F}, {0.8F, 0.65F}});
}

void grid(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  for (const float at : {-0.27F, 0.27F}) {
    pen.line({{at, -0.75F}, {at, 0.75F}});
    pen.line({{-0.75F, at}, {0.75F, at}});
  }
}

void wipe(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.box({-0.75F, -0.55F}, {0.75F, 0.55F});
  pen.filled_box({-0.75F, -0.55F}, {0, 0.55F});
  pen.line({{0, -0.85F}, {0, 0.85F}});
}

void fit(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F})
      pen.line({{0.75F * x, 0.25F * y}, {0.75F * x, 0.65F * y}, {0.3F * x, 0.65F * y}});
  pen.dot({0, 0}, 0.16F);
}

void target(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.circle({0, 0}, 0.5F);
  pen.line({{-0.85F, 0}, {-0.3F, 0}});
  pen.line({{0.3F, 0}, {0.85F, 0}});
  pen.line({{0, -0.85F}, {0, -0.3F}});
  pen.line({{0, 0.3F}, {0, 0.85F}});
}

void brush(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.line({{0.7F, -0.75F}, {-0.15F, 0.15F}});
  pen.fill({{-0.35F, 0}, {0, 0.35F}, {-0.3F, 0.7F}, {-0.8F, 0.75F}, {-0.65F, 0.3F}});
}

void eraser(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  IconPen pen(draw, center, side, color);
  pen.line({{-0.1F, 0.65F}, {-0.75F, 0.05F}, {0.15F, -0.7F}, {0.75F, -0.1F}, {-0.1F, 0.65F}, {0.75F, 0.65F}});
  pen.line({{-0.3F, -0.3F}, {0.35F, 0.25F}});
}

namespace {

// side_sign -1: the arrow's head is at the left.
void draw_turn(ImDrawList& draw, ImVec2 center, float side, ImU32 color, float side_sign) {
  IconPen pen(draw, center, side, color);
  const auto at = [side_sign](float x, float y) { return ImVec2(side_sign * -x, y); };
  pen.line({at(-0.7F, -0.2F), at(0.2F, -0.2F), at(0.55F, -0.05F), at(0.7F, 0.25F), at(0.55F, 0.55F), at(0.2F, 0.7F),
            at(-0.25F, 0.7F)});
  pen.line({at(-0.3F, -0.6F), at(-0.7F, -0.2F), at(-0.3F, 0.2F)});
}

}  // namespace

void undo(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  draw_turn(draw, center, side, color, -1);
}

void redo(ImDrawList& draw, ImVec2 center, float side, ImU32 color) {
  draw_turn(draw, center, side, color, 1);
}

}  // namespace sigs::editor::image_icon
