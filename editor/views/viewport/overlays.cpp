// SPDX-License-Identifier: MIT
#include "editor/views/viewport/overlays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "editor/geometry/image_view.h"
#include "editor/views/own_body/own_body_images.h"
#include "editor/views/waypoint_actions.h"
#include "scene/scene_at.h"

namespace sigs::editor {

namespace {

constexpr double kMark_px = 6;  // half a diamond
constexpr int kMaxLabels = 120;
constexpr double kMinSeen_px = 0.5;  // a smaller silhouette leaves no trace

Box edges_of(const cv::Rect& pixels) {
  return {pixels.x - 0.5, pixels.y - 0.5, static_cast<double>(pixels.width), static_cast<double>(pixels.height)};
}

const char* why_not_visible(const IntruderTruth& truth) {
  if (!truth.in_image) return "  not in the image";
  const bool tiny = truth.amodal_box && std::max(truth.amodal_box->width, truth.amodal_box->height) < kMinSeen_px;
  return tiny ? "  too small to be seen" : "  hidden";
}

void draw_box(const ImageCanvas& canvas, const ViewContext& context, const IntruderTruth& truth, LabelPlacer& labels) {
  const std::optional<int> intruder = project_intruder(context, truth.id);
  const Selection& selection = context.document.selection();
  const bool selected = intruder && selection.intruder == *intruder &&
                        (selection.kind == Selected::intruder || selection.kind == Selected::waypoint);
  if (truth.amodal_box)
    draw_outline(canvas, canvas.on_screen(*truth.amodal_box), faded(color::kBox, truth.visible_box ? 0.6 : 0.8), true);
  if (truth.visible_box) draw_outline(canvas, canvas.on_screen(edges_of(*truth.visible_box)), color::kBox, false);
  if (!truth.visible_box && !truth.amodal_box) return;
  const ScreenRect outer =
      canvas.on_screen(truth.amodal_box.value_or(truth.visible_box ? edges_of(*truth.visible_box) : Box()));
  const bool in_sight = outer.high.x >= canvas.rect.low.x && outer.high.y >= canvas.rect.low.y &&
                        outer.low.x <= canvas.rect.high.x && outer.low.y <= canvas.rect.high.y;
  if (!in_sight) return;
  std::string text = truth.name + "  " + distance_text(glm::length(truth.position_m));
  if (!truth.visible_box) text += why_not_visible(truth);
  const double height = label_size(text).y;
  const double above = outer.low.y - scaled(4);
  const double below = outer.high.y + scaled(4) + height;
  const double beyond = outer.size().x / 2 + scaled(4);  // of the diamond of a waypoint in this frame
  const std::array places{glm::dvec2(outer.low.x, above),
                          glm::dvec2(outer.low.x, below),
                          glm::dvec2(outer.low.x, above - height - 1),
                          glm::dvec2(outer.low.x, below + height + 1),
                          glm::dvec2(outer.low.x, above - beyond),
                          glm::dvec2(outer.low.x, below + beyond)};
  draw_label(canvas, labels, places, text, selected ? color::kAccent : color::kBox, true);
}

struct MarkStyle {
  double around_px = 0;  // half of the diagonals of a diamond about what is seen there
  bool selected = false;
  bool worked_on = false;  // of the intruder that is
  bool here = false;       // in this frame
};

void draw_mark(const ImageCanvas& canvas, const WaypointMark& mark, const MarkStyle& style) {
  const ImVec2 at = im(canvas.view.screen_of(mark.pixel));
  const float radius = scaled(style.worked_on ? kMark_px : 4);
  const ImU32 own = intruder_color(mark.intruder);
  const ImU32 fill = style.selected ? color::kAccent : style.worked_on ? color::kWaypoint : faded(own, 0.7);
  if (style.here) {  // where the intruder itself is seen: its middle stays free
    const float around = std::max(radius + scaled(4), static_cast<float>(style.around_px));
    draw_diamond(canvas.draw, at, around, IM_COL32(12, 13, 16, 200), scaled(3.4));
    return draw_diamond(canvas.draw, at, around, fill, scaled(1.6));
  }
  draw_diamond(canvas.draw, at, radius, fill);
  draw_diamond(canvas.draw, at, radius, style.worked_on ? IM_COL32(20, 22, 26, 255) : faded(own, 0.9), scaled(1.2));
}

void draw_frame(const ImageCanvas& canvas, const glm::dvec2& at, double frame, const MarkStyle& style,
                LabelPlacer& labels) {
  const std::string text = frame_text(frame);
  const glm::dvec2 size = label_size(text);
  const double aside = std::max<double>(scaled(9), style.around_px + scaled(3));
  const double right = at.x + aside;
  const double left = at.x - aside - size.x;
  const double below = at.y + scaled(4) + size.y;
  const double above = at.y - scaled(4);
  const std::array places{glm::dvec2(right, below), glm::dvec2(left, below), glm::dvec2(right, above),
                          glm::dvec2(left, above)};
  draw_label(canvas, labels, places, text, style.selected ? color::kAccent : color::kText, style.selected);
}

// Of a diamond that leaves the intruder itself in sight, on the screen; 0 where it is not seen, or is so large that no
// mark covers it.
double around_intruder_px(const ImageCanvas& canvas, const ViewContext& context, int intruder) {
  constexpr double kMaxSize_px = 90;
  if (!context.shown.image) return 0;
  for (const IntruderTruth& truth : context.shown.image->truth.intruders) {
    if (!truth.visible_box || project_intruder(context, truth.id) != intruder) continue;
    const glm::dvec2 size = canvas.on_screen(edges_of(*truth.visible_box)).size();
    const double half = (size.x + size.y) / 2 + scaled(4);
    return half <= scaled(kMaxSize_px) ? half : 0;
  }
  return 0;
}

bool is_in_frame(const WaypointMark& mark, int frame) {
  return std::abs(mark.frame - frame) < 0.5;
}

// The path's own corners are not known here where speed is constant. Long clips have fewer and longer pieces, which are
// halved where the path is not straight in the image.
constexpr int kFramesBetweenCorners = 25;
constexpr int kMaxPieces = 300;
constexpr std::size_t kMaxPolyline = 8000;  // ImGui numbers the corners of what it draws by 16 bits

glm::dvec2 size_of(const cv::Size& size) {
  return {size.width, size.height};
}

// Moments from one frame to another, those of waypoints among them where there are not more; one alone where the frames
// are the same.
std::vector<double> times_between(const FootageShape& footage, int from, int to, std::span<const double> waypoints) {
  std::vector<double> times;
  const int step = std::max(kFramesBetweenCorners, (to - from) / kMaxPieces);
  for (int frame = from; frame < to; frame += step) times.push_back(time_of_frame_s(footage, frame));
  times.push_back(time_of_frame_s(footage, to));
  if (step == kFramesBetweenCorners || std::ssize(waypoints) > kMaxPieces) return times;
  for (const double frame : waypoints)
    if (frame > from && frame < to) times.push_back(time_of_frame_s(footage, frame));
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void draw_lines(const ImageCanvas& canvas, const std::vector<PixelLine>& lines, ImU32 color, float thick) {
  std::vector<ImVec2> points;
  for (const PixelLine& line : lines) {
    points.clear();
    for (const glm::dvec2& pixel : line) points.push_back(im(canvas.view.screen_of(pixel)));
    for (std::size_t first = 0; first + 1 < points.size(); first += kMaxPolyline - 1)
      canvas.draw.AddPolyline(points.data() + first, static_cast<int>(std::min(kMaxPolyline, points.size() - first)),
                              color, ImDrawFlags_None, thick);
  }
}

}  // namespace

void MaskTint::draw(const ImageCanvas& canvas, Textures& textures, const cv::Mat& mask) {
  if (mask.empty() || (mask.type() != CV_32FC1 && mask.type() != CV_8UC1)) return;
  if (made_for_.data != mask.data) {
    made_for_ = mask;
    // Other memory: textures know images by it.
    tint_ = tinted(mask, ImGui::ColorConvertU32ToFloat4(color::kOwnBody).w);
  }
  draw_image(canvas.draw, textures, tint_, canvas.view, canvas.rect);
}

cv::Mat clouds_of_frame(const ViewContext& context) {
  if (!context.project().footage.cloud_distance_m) return {};
  context.needs.stages = true;
  const PreviewImage* const image = context.shown.staged.get();
  if (image == nullptr) return {};
  const auto found = std::ranges::find(image->stages, "clouds", &Stage::name);
  return found != image->stages.end() ? found->image : cv::Mat();
}

void draw_image_grid(const ImageCanvas& canvas, ImageGrid grid) {
  if (grid == ImageGrid::none) return;
  const glm::ivec2 fields = grid == ImageGrid::thirds ? glm::ivec2(3, 3) : glm::ivec2(8, 6);
  const ScreenRect image = canvas.image_on_screen();
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  const ImU32 light = IM_COL32(255, 255, 255, 90);
  for (int i = 1; i < fields.x; ++i) {
    const double x = std::round(image.low.x + image.size().x * i / fields.x);
    canvas.draw.AddRectFilled(im({x, image.low.y}), im({x + 1, image.high.y}), light);
  }
  for (int j = 1; j < fields.y; ++j) {
    const double y = std::round(image.low.y + image.size().y * j / fields.y);
    canvas.draw.AddRectFilled(im({image.low.x, y}), im({image.high.x, y + 1}), light);
  }
  canvas.draw.PopClipRect();
}

void draw_boxes(const ImageCanvas& canvas, const ViewContext& context, const PreviewImage& image, LabelPlacer& labels) {
  for (const IntruderTruth& truth : image.truth.intruders) draw_box(canvas, context, truth, labels);
}

void keep_waypoints_free(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                         LabelPlacer& labels) {
  const std::optional<int> current = current_intruder(context);
  const double radius = scaled(kMark_px) - 1;
  const bool is_shown = context.shown.image && context.shown.scene;
  const int frame = is_shown ? counted_frame_at(context.shown.scene->draft.scene, context.shown.image->frame) : -1;
  int kept = 0;
  for (const WaypointMark& mark : marks) {
    const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
    if (mark.intruder != current || !canvas.rect.contains(at) || ++kept > kMaxLabels) continue;
    const double around = is_in_frame(mark, frame) ? around_intruder_px(canvas, context, mark.intruder) : 0;
    const double reach = std::max<double>(radius, around);
    labels.keep_free({at - reach, at + reach});
  }
}

void draw_waypoints(const ImageCanvas& canvas, const ViewContext& context, std::span<const WaypointMark> marks,
                    const FootageCamera& eye, LabelPlacer& labels, const std::string& place) {
  const Selection& selection = context.document.selection();
  const std::optional<int> current = current_intruder(context);
  const double radius = scaled(kMark_px);
  int named = 0;
  Thinning thinning(scaled(3));
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const WaypointMark& mark : marks) {
    const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
    if (!ScreenRect{canvas.rect.low - radius, canvas.rect.high + radius}.contains(at)) continue;
    const bool is_selected = selection == Selection{Selected::waypoint, mark.intruder, mark.waypoint};
    if (thinning.leaves_out(at) && !is_selected) continue;
    context.ui_probe.note(fmt::format("{}/waypoint/{}/{}", place, mark.intruder, mark.waypoint),
                          {at - radius, at + radius});
    const bool is_here = is_in_frame(mark, eye.frame);
    const MarkStyle style{.around_px = is_here ? around_intruder_px(canvas, context, mark.intruder) : 0,
                          .selected = is_selected,
                          .worked_on = current == mark.intruder,
                          .here = is_here};
    draw_mark(canvas, mark, style);
    // Waypoints crowd where the flight goes straight away: the first of a crowd is named, and what is selected.
    if (!style.worked_on || ++named > kMaxLabels) continue;
    draw_frame(canvas, at, mark.frame, style, labels);
  }
  canvas.draw.PopClipRect();
}

void PathOverlay::make(const ViewContext& context, const FootageCamera& eye) {
  const Scene& scene = context.shown.scene->draft.scene;
  pieces_.clear();
  const CountedFrames counted = counted_frames(scene);
  const int here = std::clamp(eye.frame, counted.first_frame, counted.last_frame);
  for (std::size_t i = 0; i < scene.intruders.size(); ++i) {
    const Trajectory& trajectory = scene.intruders[i].trajectory;
    const std::optional<int> intruder = project_intruder(context, static_cast<int>(i));
    const std::vector<double> waypoints = intruder ? frames_of_waypoints(context, *intruder) : std::vector<double>();
    const auto add = [&](int from, int to, bool past) {
      const std::vector<double> times = times_between(counted.footage, from, to, waypoints);
      if (times.size() < 2) return;
      const auto position = [&](double time_s) { return trajectory.position_m(time_s); };
      pieces_.push_back(
          {static_cast<int>(i), past,
           path_through_lens(position, times, eye.world_from_camera, eye.lens, size_of(scene.footage.size_px))});
    };
    add(counted.first_frame, here, true);
    add(here, counted.last_frame, false);
  }
}

void PathOverlay::draw(const ImageCanvas& canvas, const ViewContext& context, const FootageCamera& eye) {
  if (!context.shown.scene) return;
  if (scene_ != context.shown.scene || frame_ != eye.frame) make(context, eye);
  scene_ = context.shown.scene;
  frame_ = eye.frame;
  const std::optional<int> current = current_intruder(context);
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const PathPiece& piece : pieces_) {
    const std::optional<int> intruder = project_intruder(context, piece.intruder);
    const bool worked_on = intruder && current == intruder;
    const double opacity = (piece.past ? 0.4 : 0.95) * (worked_on ? 1 : 0.6);
    draw_lines(canvas, piece.lines, faded(intruder_color(intruder.value_or(0)), opacity), scaled(worked_on ? 2 : 1.3));
  }
  canvas.draw.PopClipRect();
}

void draw_horizon(const ImageCanvas& canvas, const FootageCamera& eye) {
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  draw_lines(canvas, horizon_through_lens(eye.world_from_camera, eye.lens, size_of(canvas.image_px)), color::kHorizon,
             scaled(1.4));
  canvas.draw.PopClipRect();
}

}  // namespace sigs::editor
