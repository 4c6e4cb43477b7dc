// SPDX-License-Identifier: MIT
#include "editor/views/viewport/overlays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "editor/geometry/thinning.h"
#include "editor/views/readable.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr double kMark_px = 6;  // half a diamond
constexpr int kMostLabels = 120;
constexpr double kLeastSeen_px = 0.5;  // a smaller silhouette leaves no trace

ScreenRect on_screen(const PictureCanvas& canvas, const Box& box) {
  return {canvas.view.screen_of({box.x, box.y}), canvas.view.screen_of({box.x + box.width, box.y + box.height})};
}

Box edges_of(const cv::Rect& pixels) {
  return {pixels.x - 0.5, pixels.y - 0.5, static_cast<double>(pixels.width), static_cast<double>(pixels.height)};
}

const char* why_unseen(const IntruderTruth& truth) {
  if (!truth.in_picture) return "  not in the picture";
  const bool tiny = truth.silhouette && std::max(truth.silhouette->width, truth.silhouette->height) < kLeastSeen_px;
  return tiny ? "  too small to be seen" : "  hidden";
}

void draw_box(const PictureCanvas& canvas, const Studio& studio, const IntruderTruth& truth, PictureLabels& labels) {
  const std::optional<int> intruder = project_intruder(studio, truth.id);
  const Selection& selection = studio.document.selection();
  const bool selected = intruder && selection.intruder == *intruder &&
                        (selection.kind == Selected::intruder || selection.kind == Selected::waypoint);
  if (truth.silhouette)
    draw_outline(canvas, on_screen(canvas, *truth.silhouette), faded(color::kBox, truth.box ? 0.6 : 0.8), true);
  if (truth.box) draw_outline(canvas, on_screen(canvas, edges_of(*truth.box)), color::kBox, false);
  if (!truth.box && !truth.silhouette) return;
  const ScreenRect outer = on_screen(canvas, truth.silhouette.value_or(truth.box ? edges_of(*truth.box) : Box()));
  const bool in_sight = outer.high.x >= canvas.rect.low.x && outer.high.y >= canvas.rect.low.y &&
                        outer.low.x <= canvas.rect.high.x && outer.low.y <= canvas.rect.high.y;
  if (!in_sight) return;
  std::string text = truth.name + "  " + distance_text(glm::length(truth.position_m));
  if (!truth.box) text += why_unseen(truth);
  const double height = label_size(text).y;
  const double above = outer.low.y - scaled(4);
  const double below = outer.high.y + scaled(4) + height;
  const std::array places{glm::dvec2(outer.low.x, above), glm::dvec2(outer.low.x, below),
                          glm::dvec2(outer.low.x, above - height - 1), glm::dvec2(outer.low.x, below + height + 1)};
  labels.draw(canvas, places, text, selected ? color::kAccent : color::kBox, true);
}

void draw_diamond(ImDrawList& draw, const glm::dvec2& at, double radius, ImU32 fill, ImU32 rim) {
  const glm::dvec2 across(radius, 0);
  const glm::dvec2 down(0, radius);
  draw.AddQuadFilled(im(at - down), im(at + across), im(at + down), im(at - across), fill);
  draw.AddQuad(im(at - down), im(at + across), im(at + down), im(at - across), rim, scaled(1.2));
}

// Where the intruder itself is seen: its middle stays free.
void draw_open_diamond(ImDrawList& draw, const glm::dvec2& at, double radius, ImU32 color) {
  const glm::dvec2 across(radius, 0);
  const glm::dvec2 down(0, radius);
  draw.AddQuad(im(at - down), im(at + across), im(at + down), im(at - across), IM_COL32(12, 13, 16, 200), scaled(3.4));
  draw.AddQuad(im(at - down), im(at + across), im(at + down), im(at - across), color, scaled(1.6));
}

// Frames are whole where they were set by hand; spread ones are not.
std::string frame_text(double frame) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(frame - std::round(frame)) < 0.05 ? "%.0f" : "%.1f", frame);
  return text;
}

struct MarkStyle {
  bool selected = false;
  bool worked_on = false;  // of the intruder that is
  bool here = false;       // in this frame
};

void draw_mark(const PictureCanvas& canvas, const WaypointMark& mark, const MarkStyle& style) {
  const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
  const double radius = scaled(style.worked_on ? kMark_px : 4);
  const ImU32 own = intruder_color(mark.intruder);
  const ImU32 fill = style.selected ? color::kAccent : style.worked_on ? color::kWaypoint : faded(own, 0.7);
  if (style.here)
    draw_open_diamond(canvas.draw, at, radius + scaled(4), fill);
  else
    draw_diamond(canvas.draw, at, radius, fill, style.worked_on ? IM_COL32(20, 22, 26, 255) : faded(own, 0.9));
}

void draw_frame(const PictureCanvas& canvas, const glm::dvec2& at, double frame, const MarkStyle& style,
                PictureLabels& labels) {
  const std::string text = frame_text(frame);
  const glm::dvec2 size = label_size(text);
  const double right = at.x + scaled(9);
  const double left = at.x - scaled(9) - size.x;
  const double below = at.y + scaled(4) + size.y;
  const double above = at.y - scaled(4);
  const std::array places{glm::dvec2(right, below), glm::dvec2(left, below), glm::dvec2(right, above),
                          glm::dvec2(left, above)};
  labels.draw(canvas, places, text, style.selected ? color::kAccent : color::kText, style.selected);
}

}  // namespace

void OwnBodyTint::draw(const PictureCanvas& canvas, Textures& textures, const cv::Mat& own_body) {
  if (own_body.empty() || own_body.type() != CV_32FC1) return;
  if (made_for_.data != own_body.data) {
    made_for_ = own_body;
    tint_ = cv::Mat(own_body.size(), CV_8UC4);  // other memory: textures know pictures by it
    const ImVec4 tone = ImGui::ColorConvertU32ToFloat4(color::kOwnBody);
    own_body.forEach<float>([&](float share, const int* at) {
      const auto part = [](float value) { return cv::saturate_cast<uchar>(255.0F * value); };
      tint_.at<cv::Vec4b>(at[0], at[1]) = {part(tone.x), part(tone.y), part(tone.z), part(tone.w * share)};
    });
  }
  draw_picture(canvas.draw, textures, tint_, canvas.view, canvas.rect);
}

void draw_picture_grid(const PictureCanvas& canvas, PictureGrid grid) {
  if (grid == PictureGrid::none) return;
  const glm::ivec2 fields = grid == PictureGrid::thirds ? glm::ivec2(3, 3) : glm::ivec2(8, 6);
  const ScreenRect picture = canvas.picture_on_screen();
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  const ImU32 light = IM_COL32(255, 255, 255, 90);
  for (int i = 1; i < fields.x; ++i) {
    const double x = std::round(picture.low.x + picture.size().x * i / fields.x);
    canvas.draw.AddRectFilled(im({x, picture.low.y}), im({x + 1, picture.high.y}), light);
  }
  for (int j = 1; j < fields.y; ++j) {
    const double y = std::round(picture.low.y + picture.size().y * j / fields.y);
    canvas.draw.AddRectFilled(im({picture.low.x, y}), im({picture.high.x, y + 1}), light);
  }
  canvas.draw.PopClipRect();
}

void draw_boxes(const PictureCanvas& canvas, const Studio& studio, const Picture& picture, PictureLabels& labels) {
  for (const IntruderTruth& truth : picture.truth.intruders) draw_box(canvas, studio, truth, labels);
}

void keep_waypoints_free(const PictureCanvas& canvas, const Studio& studio, std::span<const WaypointMark> marks,
                         PictureLabels& labels) {
  const std::optional<int> current = current_intruder(studio);
  const double radius = scaled(kMark_px) - 1;
  int kept = 0;
  for (const WaypointMark& mark : marks) {
    const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
    if (mark.intruder != current || !canvas.rect.contains(at) || ++kept > kMostLabels) continue;
    labels.keep_free({at - radius, at + radius});
  }
}

void draw_waypoints(const PictureCanvas& canvas, const Studio& studio, std::span<const WaypointMark> marks,
                    const FootageEye& eye, PictureLabels& labels) {
  const Selection& selection = studio.document.selection();
  const std::optional<int> current = current_intruder(studio);
  const double radius = scaled(kMark_px);
  int named = 0;
  Thinning thinning(scaled(3));
  canvas.draw.PushClipRect(im(canvas.rect.low), im(canvas.rect.high), true);
  for (const WaypointMark& mark : marks) {
    const glm::dvec2 at = canvas.view.screen_of(mark.pixel);
    if (!ScreenRect{canvas.rect.low - radius, canvas.rect.high + radius}.contains(at)) continue;
    const bool is_selected = selection == Selection{Selected::waypoint, mark.intruder, mark.waypoint};
    if (thinning.leaves_out(at) && !is_selected) continue;
    studio.places.note("viewport/waypoint/" + std::to_string(mark.intruder) + "/" + std::to_string(mark.waypoint),
                       {at - radius, at + radius});
    const MarkStyle style{
        .selected = is_selected, .worked_on = current == mark.intruder, .here = std::abs(mark.frame - eye.frame) < 0.5};
    draw_mark(canvas, mark, style);
    // Waypoints crowd where the flight goes straight away: the first of a crowd is named, and what is selected.
    if (!style.worked_on || ++named > kMostLabels) continue;
    draw_frame(canvas, at, mark.frame, style, labels);
  }
  canvas.draw.PopClipRect();
}

}  // namespace sigs::editor
