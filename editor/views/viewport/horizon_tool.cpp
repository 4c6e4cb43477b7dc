// SPDX-License-Identifier: MIT
#include "editor/views/viewport/horizon_tool.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "base/pose.h"
#include "editor/views/shown_camera.h"
#include "editor/views/viewport/heading_marks.h"
#include "editor/views/viewport/overlays.h"
#include "editor/widgets/keys.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/zoomable_image.h"

namespace sigs::editor {

namespace {

constexpr double kLineReach_px = 7;  // of the line, where text is 15 px high

glm::dvec2 image_size(const ToolContext& tool) {
  return {tool.canvas.image_px.width, tool.canvas.image_px.height};
}

std::vector<PixelLine> horizon_of(const ToolContext& tool) {
  return horizon_through_lens(tool.eye.world_from_camera, tool.eye.lens, image_size(tool));
}

HorizonTilt tilt_of(const Project& project) {
  const Attitude attitude = mount_attitude(project.camera);
  return {attitude.roll_rad, attitude.pitch_rad};
}

// Hundredths of a degree are less than a pixel and keep the numbers short.
double rounded_deg(double angle_rad) {
  return std::round(deg_of_rad(angle_rad) * 100) / 100;
}

void put_tilt(const ViewContext& context, const HorizonTilt& tilt, const std::string& gesture) {
  context.edits.change(
      "set horizon",
      [roll_deg = rounded_deg(tilt.roll_rad), pitch_deg = rounded_deg(tilt.pitch_rad)](Project& project) {
        project.camera.roll_deg = roll_deg;
        project.camera.pitch_deg = pitch_deg;
      },
      gesture);
}

// On the line, within the mouse's reach.
std::optional<HorizonGrip> grip_at(const ToolContext& tool) {
  if (is_turned_by_file(tool.context)) return std::nullopt;
  const std::optional<HorizonGrip> grip =
      grip_of(horizon_of(tool), tool.canvas.view.image_of(tool.mouse), image_size(tool));
  if (!grip) return std::nullopt;
  const double away_px = glm::distance(tool.canvas.view.screen_of(grip->on_line_px), tool.mouse);
  return away_px <= scaled(kLineReach_px) ? grip : std::nullopt;
}

std::string readout(const Project& project) {
  return fmt::format("roll {:.2f}\u00b0   pitch {:.2f}\u00b0", project.camera.roll_deg.value_or(0),
                     project.camera.pitch_deg.value_or(0));
}

void draw_handle(const ImageCanvas& canvas, const glm::dvec2& pixel) {
  const ImVec2 at = im(canvas.view.screen_of(pixel));
  canvas.draw.AddCircleFilled(at, scaled(6), IM_COL32(16, 18, 22, 220));
  canvas.draw.AddCircleFilled(at, scaled(4), color::kHorizon | IM_COL32_A_MASK);
}

// Beside the line's left handle, where intruders are seldom.
void draw_text(const ImageCanvas& canvas, const HorizonGrip& grip, const std::string& text, LabelPlacer& labels) {
  const glm::dvec2 left = canvas.view.screen_of(grip.first_px) - glm::dvec2(scaled(6), 0);
  const glm::dvec2 right = canvas.view.screen_of(grip.last_px) + glm::dvec2(scaled(6) - label_size(text).x, 0);
  const glm::dvec2 below(0, scaled(10) + label_size(text).y);
  const glm::dvec2 above(0, -scaled(10));
  const std::array places{left + below, left + above, right + below, right + above};
  draw_label(canvas, labels, places, text, color::kText, true);
}

}  // namespace

void keep_horizon(const ViewContext& context) {
  put_tilt(context, tilt_of(context.project()), {});
}

bool HorizonTool::press(const ToolContext& tool) {
  const std::optional<HorizonGrip> grip = grip_at(tool);
  if (!grip) return false;
  taken_ = Taken{.part = grip->part,
                 .start = tilt_of(tool.context.project()),
                 .pivot_px = grip->middle_px,
                 .offset_px = grip->on_line_px - tool.canvas.view.image_of(tool.mouse),
                 .gesture = drag_gesture_at(tool.context, tool.mouse, fmt::format("horizon {}", ++gestures_))};
  return true;
}

void HorizonTool::drag(const ToolContext& tool) {
  Taken& taken = *taken_;
  if (taken.gesture.is_lost(tool.context) || taken.gesture.cancelled_by_key(tool.context)) {
    taken_.reset();
    return;
  }
  taken.gesture.is_moving = taken.gesture.is_moving || taken.gesture.has_left_press(tool.mouse);
  if (!taken.gesture.is_moving) return;
  const glm::dvec2 pixel = tool.canvas.view.image_of(tool.mouse) + taken.offset_px;
  const std::optional<HorizonTilt> tilt = taken.part == HorizonPart::middle
                                              ? lifted_to(pixel, taken.start.roll_rad, tool.eye.lens)
                                              : through(taken.pivot_px, pixel, taken.start, tool.eye.lens);
  if (tilt) put_tilt(tool.context, *tilt, taken.gesture.name);
}

void HorizonTool::release(const ViewContext& context) {
  if (taken_) taken_->gesture.end(context);
  taken_.reset();
}

std::optional<HorizonPart> HorizonTool::part_at(const ToolContext& tool) const {
  if (taken_) return taken_->part;
  const std::optional<HorizonGrip> grip = grip_at(tool);
  return grip ? std::optional(grip->part) : std::nullopt;
}

void HorizonTool::draw(const ToolContext& tool, bool highlighted, LabelPlacer& labels) const {
  draw_horizon(tool.canvas, tool.eye);
  draw_heading_marks(tool.canvas, tool.context, tool.eye, labels);
  const bool is_known = knows_horizon(tool.context.project().camera) || is_turned_by_file(tool.context);
  if (is_known && !highlighted && !taken_) return;
  const glm::dvec2 center = (image_size(tool) - 1.0) / 2.0;
  const std::optional<HorizonGrip> grip = grip_of(horizon_of(tool), center, image_size(tool));
  if (!grip) return;
  const glm::dvec2 middle = tool.canvas.view.screen_of(grip->middle_px);
  const auto handle = static_cast<double>(scaled(6));
  tool.context.ui_probe.note("viewport/horizon", {middle - handle, middle + handle});
  if (!is_turned_by_file(tool.context))
    for (const glm::dvec2& pixel : {grip->first_px, grip->middle_px, grip->last_px}) draw_handle(tool.canvas, pixel);
  if (!is_known)
    draw_text(tool.canvas, *grip, "Horizon not set: drag this line onto it, its ends to tilt it", labels);
  else if (taken_ && taken_->gesture.is_moving)
    draw_text(tool.canvas, *grip, readout(tool.context.project()), labels);
}

}  // namespace sigs::editor
