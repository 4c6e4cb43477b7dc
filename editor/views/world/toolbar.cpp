// SPDX-License-Identifier: MIT
#include "editor/views/world/toolbar.h"

#include <vector>

#include "editor/widgets/icon_shapes.h"
#include "editor/widgets/toolbar.h"

namespace sigs::editor {

namespace {

void orbit_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.line({{0, -0.85F}, {0.75F, -0.45F}, {0.75F, 0.45F}, {0, 0.85F}, {-0.75F, 0.45F}, {-0.75F, -0.45F}}, true);
  pen.line({{-0.75F, -0.45F}, {0, -0.05F}, {0.75F, -0.45F}});
  pen.line({{0, -0.05F}, {0, 0.85F}});
}

void top_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.box({-0.7F, -0.1F}, {0.7F, 0.85F});
  pen.line({{0, -0.95F}, {0, -0.35F}});
  pen.line({{-0.28F, -0.6F}, {0, -0.3F}, {0.28F, -0.6F}});
}

void side_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.box({0.0F, -0.7F}, {0.9F, 0.7F});
  pen.line({{-0.95F, 0}, {-0.3F, 0}});
  pen.line({{-0.55F, -0.28F}, {-0.25F, 0}, {-0.55F, 0.28F}});
}

void camera_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.box({-0.9F, -0.5F}, {0.3F, 0.5F}, 0.2F);
  pen.line({{0.3F, -0.1F}, {0.9F, -0.5F}, {0.9F, 0.5F}, {0.3F, 0.1F}});
}

void frame_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.line({{-0.8F, -0.35F}, {-0.8F, -0.8F}, {-0.35F, -0.8F}});
  pen.line({{0.35F, -0.8F}, {0.8F, -0.8F}, {0.8F, -0.35F}});
  pen.line({{0.8F, 0.35F}, {0.8F, 0.8F}, {0.35F, 0.8F}});
  pen.line({{-0.35F, 0.8F}, {-0.8F, 0.8F}, {-0.8F, 0.35F}});
  pen.dot({0, 0}, 0.22F);
}

void perspective_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.line({{-0.35F, -0.7F}, {0.35F, -0.7F}, {0.9F, 0.7F}, {-0.9F, 0.7F}}, true);
  pen.line({{0, -0.7F}, {0, 0.7F}});
  pen.line({{-0.55F, -0.15F}, {0.55F, -0.15F}});
}

void snap_icon(ImDrawList& list, ImVec2 center, float side, ImU32 color) {
  IconPen pen(list, center, side, color);
  pen.line({{-0.65F, -0.8F}, {-0.65F, 0.1F}, {-0.4F, 0.6F}, {0, 0.8F}, {0.4F, 0.6F}, {0.65F, 0.1F}, {0.65F, -0.8F}});
  pen.line({{-0.85F, -0.45F}, {-0.45F, -0.45F}});
  pen.line({{0.45F, -0.45F}, {0.85F, -0.45F}});
}

}  // namespace

WorldToolbarResult draw_world_toolbar(WorldViewState& look) {
  WorldToolbarResult answer;
  const auto preset = [&](ToolButton button, WorldViewPreset wanted) {
    button.on = look.preset == wanted;
    return ToolbarItem{.button = button, .clicked = [&answer, wanted] { answer.preset = wanted; }};
  };
  const std::vector<ToolbarItem> items{
      preset(
          {"orbit", orbit_icon, "Orbit", "From behind and above; left drag turns, middle drag or Shift + left moves"},
          WorldViewPreset::orbit),
      preset({"top", top_icon, "Top", "From above, the camera's way upwards"}, WorldViewPreset::top),
      preset({"side", side_icon, "Side", "From the right-hand side, the camera flying to the right"},
             WorldViewPreset::side),
      preset({"camera", camera_icon, "Camera", "From behind the camera, going with it"}, WorldViewPreset::camera),
      {.is_gap = true},
      {.button = {"frame", frame_icon, "", "Everything in sight (F); the light too while it is selected"},
       .clicked = [&] { answer.frame_all = true; }},
      {.button = {"perspective", perspective_icon, "", "Perspective; off: parallel, true to scale",
                  look.eye.projection == Projection::perspective},
       .clicked =
           [&] {
             const bool is_on = look.eye.projection == Projection::perspective;
             look.eye.projection = is_on ? Projection::parallel : Projection::perspective;
           }},
      {.button = {"snap", snap_icon, "", "Move in round steps (Ctrl: the other way for once)", look.snap},
       .clicked = [&] { look.snap = !look.snap; }},
  };
  draw_toolbar(items);
  return answer;
}

}  // namespace sigs::editor
