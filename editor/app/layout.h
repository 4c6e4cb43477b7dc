// SPDX-License-Identifier: MIT
#pragma once

#include "editor/document/settings.h"
#include "editor/views/inspector/inspector_view.h"
#include "editor/views/own_body/own_body_view.h"
#include "editor/views/stages/stages_view.h"
#include "editor/views/start_page.h"
#include "editor/views/timeline/timeline_view.h"
#include "editor/views/viewport/cameras_view.h"
#include "editor/views/viewport/viewport_view.h"
#include "editor/views/world/world_view.h"

namespace sigs::editor {

// Draws all panels of an open project: footage, stages or own body as tabs (of a rig for one of its cameras, or the
// footage of all) and the world view side by side above the
// timeline, the inspector at the right. The lines between panels can be dragged, and a double click puts them back;
// their positions are kept in the settings. It owns the views, and with them their zoom and switches, as long as the
// program runs.
class Layout {
 public:
  // Fills the current ImGui window, which is the window below the menu bar. Settings change where a line is dragged.
  void draw(const ViewContext& context, OwnBodySession& own_body, Settings& settings);
  // The middle of the images' panel on the screen, as it was drawn last.
  [[nodiscard]] ImVec2 images_at() const { return images_at_; }
  // Height of the timeline in screen pixels where the panels have room_px of height in all: what the settings want, as
  // far as the images above keep some room.
  [[nodiscard]] static float timeline_height_px(const Settings& settings, float room_px);
  // Brings the own-body view to the front, or the footage with the horizon line over it or ready for a box around
  // something lit, in the next update.
  void show_own_body() {
    wants_own_body_ = true;
    cameras_.show_all(false);
  }
  void toggle_all_cameras() { cameras_.show_all(!cameras_.shows_all()); }
  void show_horizon() {
    show_footage();
    viewport_.show_horizon();
  }
  void show_light_like() {
    show_footage();
    viewport_.ask_for_lit_box();
  }

 private:
  void show_footage() {
    wants_footage_ = true;
    cameras_.show_all(false);
  }
  // What is above the timeline. The world view makes room while the own body is worked on.
  void draw_images(const ViewContext& context, OwnBodySession& own_body, Settings& settings);
  void draw_tabs(const ViewContext& context, OwnBodySession& own_body);

  CameraTabs cameras_;
  Mosaic mosaic_;
  ViewportView viewport_;
  WorldView world_;
  TimelineView timeline_;
  InspectorView inspector_;
  StagesView stages_;
  OwnBodyView own_body_;
  FirstSteps first_steps_;
  // A tab that is to come to the front in the next update.
  bool wants_own_body_ = false;
  bool wants_footage_ = false;
  bool shows_own_body_ = false;  // the own-body view was in front in the last update
  ImVec2 images_at_{0, 0};
};

}  // namespace sigs::editor
