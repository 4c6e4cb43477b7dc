// SPDX-License-Identifier: MIT
#include "editor/views/viewport/horizon_tool.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/angles.h"
#include "editor/views/viewport/path.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_picture.h"

namespace sigs::editor {

namespace {

constexpr double kReach_px = 7;      // of the line, where text is 15 px high
constexpr double kLeastDrag_px = 3;  // a click's tremble is none

glm::dvec2 picture_size(const ToolTurn& turn) {
  return {turn.canvas.picture_px.width, turn.canvas.picture_px.height};
}

std::vector<PixelLine> horizon_of(const ToolTurn& turn) {
  return horizon_through_lens(turn.eye.world_from_camera, turn.eye.lens, picture_size(turn));
}

HorizonTilt tilt_of(const Project& project) {
  const Attitude attitude = mount_attitude(project.camera);
  return {attitude.roll_rad, attitude.pitch_rad};
}

// Hundredths of a degree are less than a pixel and keep the numbers short.
double rounded_deg(double angle_rad) {
  return std::round(deg_of_rad(angle_rad) * 100) / 100;
}

void put_tilt(const Studio& studio, const HorizonTilt& tilt, const std::string& gesture) {
  studio.edits.change(
      "set horizon",
      [roll_deg = rounded_deg(tilt.roll_rad), pitch_deg = rounded_deg(tilt.pitch_rad)](Project& project) {
        project.camera.roll_deg = roll_deg;
        project.camera.pitch_deg = pitch_deg;
      },
      gesture);
}

// On the line, within the mouse's reach.
std::optional<HorizonGrip> grip_at(const ToolTurn& turn) {
  if (!turn.studio.project().camera.attitude_file.empty()) return std::nullopt;
  const std::optional<HorizonGrip> grip =
      grip_of(horizon_of(turn), turn.canvas.view.picture_of(turn.mouse), picture_size(turn));
  if (!grip) return std::nullopt;
  const double away_px = glm::distance(turn.canvas.view.screen_of(grip->on_line_px), turn.mouse);
  return away_px <= scaled(kReach_px) ? grip : std::nullopt;
}

std::string readout(const Project& project) {
  char text[64];
  std::snprintf(text, sizeof text, "roll %.2f\u00b0   pitch %.2f\u00b0", project.camera.roll_deg.value_or(0),
                project.camera.pitch_deg.value_or(0));
  return text;
}

void draw_handle(const PictureCanvas& canvas, const glm::dvec2& pixel) {
  const ImVec2 at = im(canvas.view.screen_of(pixel));
  canvas.draw.AddCircleFilled(at, scaled(6), IM_COL32(16, 18, 22, 220));
  canvas.draw.AddCircleFilled(at, scaled(4), color::kHorizon | IM_COL32_A_MASK);
}

// Beside the line's left handle, where intruders are seldom.
void draw_text(const PictureCanvas& canvas, const HorizonGrip& grip, const std::string& text, PictureLabels& labels) {
  const glm::dvec2 left = canvas.view.screen_of(grip.first_px) - glm::dvec2(scaled(6), 0);
  const glm::dvec2 right = canvas.view.screen_of(grip.last_px) + glm::dvec2(scaled(6) - label_size(text).x, 0);
  const glm::dvec2 below(0, scaled(10) + label_size(text).y);
  const glm::dvec2 above(0, -scaled(10));
  const std::array places{left + below, left + above, right + below, right + above};
  labels.draw(canvas, places, text, color::kText, true);
}

}  // namespace

void keep_horizon(const Studio& studio) {
  put_tilt(studio, tilt_of(studio.project()), {});
}

bool HorizonTool::press(const ToolTurn& turn) {
  const std::optional<HorizonGrip> grip = grip_at(turn);
  if (!grip) return false;
  taken_ = Taken{.part = grip->part,
                 .start = tilt_of(turn.studio.project()),
                 .pivot_px = grip->middle_px,
                 .offset_px = grip->on_line_px - turn.canvas.view.picture_of(turn.mouse),
                 .pressed = turn.mouse,
                 .revision_before = turn.studio.document.revision().number,
                 .gesture = "horizon " + std::to_string(++gestures_)};
  return true;
}

void HorizonTool::drag(const ToolTurn& turn) {
  Taken& taken = *taken_;
  if (turn.studio.document.has_other_changes(taken.revision_before, taken.gesture)) {
    taken_.reset();
    return;
  }
  if (pressed(Key::escape)) {
    if (taken.is_moving) turn.studio.edits.cancel_gesture(taken.gesture);
    taken_.reset();
    return;
  }
  taken.is_moving = taken.is_moving || glm::distance(turn.mouse, taken.pressed) >= scaled(kLeastDrag_px);
  if (!taken.is_moving) return;
  const glm::dvec2 pixel = turn.canvas.view.picture_of(turn.mouse) + taken.offset_px;
  const std::optional<HorizonTilt> tilt = taken.part == HorizonPart::middle
                                              ? lifted_to(pixel, taken.start.roll_rad, turn.eye.lens)
                                              : through(taken.pivot_px, pixel, taken.start, turn.eye.lens);
  if (tilt) put_tilt(turn.studio, *tilt, taken.gesture);
}

void HorizonTool::release(const Studio& studio) {
  if (taken_ && taken_->is_moving) studio.edits.end_gesture();
  taken_.reset();
}

std::optional<HorizonPart> HorizonTool::part_at(const ToolTurn& turn) const {
  if (taken_) return taken_->part;
  const std::optional<HorizonGrip> grip = grip_at(turn);
  return grip ? std::optional(grip->part) : std::nullopt;
}

void HorizonTool::draw(const ToolTurn& turn, bool lit, PictureLabels& labels) const {
  draw_horizon(turn.canvas, turn.eye);
  const bool is_known = knows_horizon(turn.studio.project().camera);
  if (is_known && !lit && !taken_) return;
  const glm::dvec2 center = (picture_size(turn) - 1.0) / 2.0;
  const std::optional<HorizonGrip> grip = grip_of(horizon_of(turn), center, picture_size(turn));
  if (!grip) return;
  const glm::dvec2 middle = turn.canvas.view.screen_of(grip->middle_px);
  const auto handle = static_cast<double>(scaled(6));
  turn.studio.places.note("viewport/horizon", {middle - handle, middle + handle});
  if (turn.studio.project().camera.attitude_file.empty())
    for (const glm::dvec2& pixel : {grip->first_px, grip->middle_px, grip->last_px}) draw_handle(turn.canvas, pixel);
  if (!is_known)
    draw_text(turn.canvas, *grip, "Horizon not set: drag this line onto it, its ends to tilt it", labels);
  else if (taken_ && taken_->is_moving)
    draw_text(turn.canvas, *grip, readout(turn.studio.project()), labels);
}

}  // namespace sigs::editor
