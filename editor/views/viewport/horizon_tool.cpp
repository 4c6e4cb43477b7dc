// SPDX-License-Identifier: MIT
#include "editor/views/viewport/horizon_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/pose.h"
#include "editor/views/context.h"
#include "editor/views/viewport/overlays.h"

namespace sigs::editor {

namespace {

constexpr double kMinNumberGap_px = 52;  // between numbers, where text is 15 px high
constexpr double kUp_rad = 0.002;        // a small step towards the zenith
constexpr double kHeadingMark_px = 8;
constexpr double kMinorMark_px = 5;
constexpr ImU32 kBright = color::kHorizon | IM_COL32_A_MASK;
constexpr ImU32 kDark = IM_COL32(12, 13, 16, 170);
constexpr double kMinSpeed_mps = 0.5;
constexpr double kSpeedSpan_s = 0.1;

struct HeadingSteps {
  int number_deg;
  int mark_deg;
};
constexpr std::array<HeadingSteps, 5> kHeadingSteps{{{5, 1}, {10, 5}, {30, 10}, {45, 15}, {90, 30}}};

HeadingSteps steps_for(double number_gap_deg) {
  for (const HeadingSteps& steps : kHeadingSteps)
    if (steps.number_deg >= number_gap_deg) return steps;
  return kHeadingSteps.back();
}

glm::dvec3 direction_at(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          -std::sin(elevation_rad)};
}

std::optional<glm::dvec2> pixel_towards(const glm::dvec3& in_world, const FootageCamera& eye) {
  return eye.lens.pixel(glm::conjugate(eye.world_from_camera.rotation) * in_world);
}

bool is_in(const glm::dvec2& pixel, const glm::dvec2& image_px) {
  return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x <= image_px.x - 0.5 && pixel.y <= image_px.y - 0.5;
}

// How many degrees near the optical axis the text of a number needs.
double number_gap_deg_of(const ImageCanvas& canvas, const FootageCamera& eye) {
  const glm::dvec3 ahead = {1, 0, 0};
  const glm::dvec3 aside = {std::cos(rad_of_deg(1)), std::sin(rad_of_deg(1)), 0};
  const std::optional<glm::dvec2> a = eye.lens.pixel(ahead);
  const std::optional<glm::dvec2> b = eye.lens.pixel(aside);
  const double px_per_deg = a && b ? glm::distance(*a, *b) * canvas.view.zoom : 0;
  return scaled(kMinNumberGap_px) / std::max(px_per_deg, 1e-9);
}

void draw_mark(const ImageCanvas& canvas, const HeadingMark& mark) {
  const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
  const double length = scaled(mark.is_numbered ? kHeadingMark_px : kMinorMark_px);
  const double below = mark.is_numbered ? length * 0.4 : 0;
  const float width = scaled(mark.is_numbered ? 1.8F : 1.3F);
  const ImVec2 foot = im(at - mark.up * below);
  const ImVec2 tip = im(at + mark.up * length);
  canvas.draw.AddLine(foot, tip, kDark, width + scaled(1.8));
  canvas.draw.AddLine(foot, tip, kBright, width);
}

void draw_number(const ImageCanvas& canvas, const HeadingMark& mark, bool from_north, LabelPlacer& labels) {
  const std::string text = heading_text(mark.heading_deg, from_north);
  const glm::dvec2 size = label_size(text);
  const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
  const glm::dvec2 above = at + mark.up * static_cast<double>(scaled(kHeadingMark_px + 3)) - glm::dvec2(size.x / 2, 0);
  const glm::dvec2 below =
      at - mark.up * static_cast<double>(scaled(kHeadingMark_px + 3)) + glm::dvec2(-size.x / 2, size.y);
  draw_label(canvas, labels, std::array{above, below}, text, kBright, false);
}

void draw_flight_mark(const ImageCanvas& canvas, const glm::dvec2& pixel) {
  const glm::dvec2 at = canvas.view.screen_of(pixel);
  const double r = scaled(5);
  for (const auto& [shade, width] : {std::pair(kDark, 3.2F), std::pair(kBright, 1.5F)}) {
    canvas.draw.AddCircle(im(at), static_cast<float>(r), shade, 16, scaled(width));
    for (const glm::dvec2& wing : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, -1)})
      canvas.draw.AddLine(im(at + wing * r), im(at + wing * r * 2.2), shade, scaled(width));
  }
}

constexpr double kLineReach_px = 7;  // of the line, where text is 15 px high

glm::dvec2 image_size(const ToolContext& tool) {
  return {tool.canvas.image_px.width, tool.canvas.image_px.height};
}

std::vector<PixelLine> horizon_of(const ToolContext& tool) {
  return horizon_through_lens(tool.eye.world_from_camera, tool.eye.lens, image_size(tool));
}

// Of a rig the line tilts the mount of the active camera, while the aircraft is level.
bool can_be_dragged(const ViewContext& context) {
  const CameraSettings& camera = context.project().camera;
  const bool is_level = camera.roll_deg.value_or(0) == 0 && camera.pitch_deg.value_or(0) == 0;
  return !is_turned_by_file(context) && (!context.project().rig_view || is_level);
}

HorizonTilt tilt_of(const Project& project) {
  if (const std::optional<RigView>& view = project.rig_view)
    return {rad_of_deg(view->mount.roll_deg), rad_of_deg(view->mount.pitch_deg)};
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
        if (project.rig_view) {
          project.rig_view->mount.roll_deg = roll_deg;
          project.rig_view->mount.pitch_deg = pitch_deg;
          project.camera.roll_deg = project.camera.pitch_deg = 0;  // they count as set from then on
          return;
        }
        project.camera.roll_deg = roll_deg;
        project.camera.pitch_deg = pitch_deg;
      },
      gesture);
}

// On the line, within the mouse's reach.
std::optional<HorizonGrip> grip_at(const ToolContext& tool) {
  if (!can_be_dragged(tool.context)) return std::nullopt;
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

std::vector<HeadingMark> heading_marks(const FootageCamera& eye, const glm::dvec2& image_px, double reference_rad,
                                       double number_gap_deg) {
  const HeadingSteps steps = steps_for(number_gap_deg);
  std::vector<HeadingMark> marks;
  for (int heading_deg = 0; heading_deg < 360; heading_deg += steps.mark_deg) {
    const double azimuth_rad = rad_of_deg(heading_deg) - reference_rad;
    const std::optional<glm::dvec2> pixel = pixel_towards(direction_at(azimuth_rad, 0), eye);
    const std::optional<glm::dvec2> higher = pixel_towards(direction_at(azimuth_rad, kUp_rad), eye);
    if (!pixel || !higher || !is_in(*pixel, image_px) || glm::distance(*pixel, *higher) < 1e-6) continue;
    marks.push_back({.heading_deg = static_cast<double>(heading_deg),
                     .pixel = *pixel,
                     .up = glm::normalize(*higher - *pixel),
                     .is_numbered = heading_deg % steps.number_deg == 0});
  }
  return marks;
}

std::string heading_text(double heading_deg, bool from_north) {
  const int whole = static_cast<int>(std::lround(heading_deg)) % 360;
  if (!from_north) return fmt::format("{}\u00b0", whole > 180 ? whole - 360 : whole);
  if (whole % 90 == 0) return std::string(1, "NESW"[whole / 90]);
  return fmt::format("{:03}", whole);
}

namespace {

// What headings count from: true north where the scene knows it.
struct HeadingReference {
  double heading_of_x_rad = 0;
  bool is_north = false;
};

HeadingReference heading_reference(const ViewContext& context) {
  if (!context.shown.scene || !context.shown.scene->project) return {};
  const Scene& scene = context.shown.scene->draft.scene;
  const GeoSettings& geo = context.shown.scene->project->geo;
  // Without a heading and without a log the world's X axis is taken to be north.
  const bool is_known = geo.heading_deg || scene.motion.path;
  if (!scene.earth || !is_known) return {};
  return {.heading_of_x_rad = scene.earth->heading_rad(), .is_north = true};
}

// As a direction of the world; none where the camera hangs in the air.
std::optional<glm::dvec3> flight_direction(const ViewContext& context, int frame) {
  const double time_s = time_of(context, frame);
  const glm::dvec3 before_m = camera_pose_at(context, time_s - kSpeedSpan_s / 2).translation_m;
  const glm::dvec3 way_m = camera_pose_at(context, time_s + kSpeedSpan_s / 2).translation_m - before_m;
  if (glm::length(way_m) < kMinSpeed_mps * kSpeedSpan_s) return std::nullopt;
  return glm::normalize(way_m);
}

// Along the horizon, and a circle with wings in the direction of flight.
void draw_heading_marks(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye,
                        LabelPlacer& labels) {
  const glm::dvec2 image_px{canvas.image_px.width, canvas.image_px.height};
  const HeadingReference reference = heading_reference(context);
  const std::vector<HeadingMark> marks =
      heading_marks(eye, image_px, reference.heading_of_x_rad, number_gap_deg_of(canvas, eye));
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const HeadingMark& mark : marks) {
    draw_mark(canvas, mark);
    if (mark.is_numbered) draw_number(canvas, mark, reference.is_north, labels);
  }
  if (const std::optional<glm::dvec3> ahead = flight_direction(context, eye.frame))
    if (const std::optional<glm::dvec2> pixel = pixel_towards(*ahead, eye); pixel && is_in(*pixel, image_px))
      draw_flight_mark(canvas, *pixel);
  canvas.draw.PopClipRect();
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
  if (taken.gesture.is_lost(tool.context) || taken.gesture.cancelled_by_key(tool.context)) return taken_.reset();
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
  if (can_be_dragged(tool.context))
    for (const glm::dvec2& pixel : {grip->first_px, grip->middle_px, grip->last_px}) draw_handle(tool.canvas, pixel);
  if (!is_known)
    draw_text(tool.canvas, *grip, "Horizon not set: drag this line onto it, its ends to tilt it", labels);
  else if (taken_ && taken_->gesture.is_moving)
    draw_text(tool.canvas, *grip, readout(tool.context.project()), labels);
}

}  // namespace sigs::editor
