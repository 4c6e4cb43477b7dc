// SPDX-License-Identifier: MIT
#include "editor/widgets/gizmo_handle.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "editor/widgets/keys.h"
#include "editor/widgets/texts.h"
#include "editor/widgets/theme.h"

namespace sigs::editor {

namespace {

constexpr double kArrow_px = 78;  // where the text is 15 px high
constexpr std::array<GizmoPart, 3> kArrows{GizmoPart::x, GizmoPart::y, GizmoPart::z};
constexpr std::array<GizmoPart, 3> kPlanes{GizmoPart::xy, GizmoPart::yz, GizmoPart::zx};
constexpr std::array<ImU32, 3> kPlaneColors{color::kAxisZ, color::kAxisX, color::kAxisY};  // of the axis they leave out
constexpr std::array<const char*, 3> kNames{"X", "Y", "Z"};

std::optional<GizmoShape> shape_of(const glm::dvec3& at_m, const GizmoInput& input) {
  return gizmo_shape({.center_m = at_m, .arrow_px = scaled(kArrow_px)}, input.camera, input.rect);
}

void draw_arrow(ImDrawList& list, const glm::dvec2& from, const glm::dvec2& tip, ImU32 color, const char* name) {
  const glm::dvec2 along = tip - from;
  const double length = glm::length(along);
  if (length < 2) return;
  const glm::dvec2 unit = along / length;
  const glm::dvec2 across{-unit.y, unit.x};
  const double head = std::min<double>(scaled(11), length * 0.6);
  const glm::dvec2 neck = tip - unit * head;
  list.AddLine(im(from), im(neck), IM_COL32(0, 0, 0, 110), scaled(4.5));
  list.AddLine(im(from), im(neck), color, scaled(2.5));
  list.AddTriangleFilled(im(tip), im(neck + across * (head * 0.42)), im(neck - across * (head * 0.42)), color);
  ImFont* small = font(Font::small);
  const ImVec2 size = small->CalcTextSizeA(small->FontSize, 1e6F, 0, name);
  const glm::dvec2 middle = tip + unit * static_cast<double>(scaled(10));
  const ImVec2 corner = im(middle - glm::dvec2(size.x, size.y) / 2.0);
  list.AddText(small, small->FontSize, {corner.x + 1, corner.y + 1}, IM_COL32(0, 0, 0, 150), name);
  list.AddText(small, small->FontSize, corner, color, name);
}

void draw_plane(ImDrawList& list, const std::array<glm::dvec2, 4>& quad, ImU32 color, bool hot) {
  list.AddQuadFilled(im(quad[0]), im(quad[1]), im(quad[2]), im(quad[3]), faded(color, hot ? 0.75 : 0.35));
  list.AddQuad(im(quad[0]), im(quad[1]), im(quad[2]), im(quad[3]), faded(color, hot ? 1 : 0.8), 1);
}

constexpr const char* kId = "point entry";
constexpr double kMaxCoordinate_m = 1e8;

struct Row {
  const char* id;
  const char* name;
  const char* meaning;
  ImU32 color;
};
constexpr std::array<Row, 3> kRows{{{"##x", "X", "forward", color::kAxisX},
                                    {"##y", "Y", "right", color::kAxisY},
                                    {"##z", "Z", "down", color::kAxisZ}}};

}  // namespace

GizmoResult GizmoHandle::update(const glm::dvec3& at_m, const GizmoInput& input) {
  if (dragging()) return continue_drag(input);
  hovered_ = GizmoPart::none;
  const std::optional<GizmoShape> shape = shape_of(at_m, input);
  if (!shape || !input.mouse_is_free) return {};
  hovered_ = part_at(*shape, dv(ImGui::GetMousePos()), scaled(7));
  if (hovered_ == GizmoPart::none) return {};
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    const bool middle = hovered_ == GizmoPart::screen;
    return {.wants_numbers = !middle, .wants_middle = middle};
  }
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return {};
  take(hovered_, at_m);
  return {};
}

void GizmoHandle::take(GizmoPart part, const glm::dvec3& at_m) {
  drag_ = {.part = part, .start_m = at_m, .start_mouse = dv(ImGui::GetMousePos())};
  has_moved_ = false;
}

GizmoResult GizmoHandle::continue_drag(const GizmoInput& input) {
  if (pressed(Key::escape)) {
    abandon_drag();
    return {.cancelled = true};
  }
  GizmoResult answer;
  // A click that trembles moves nothing.
  has_moved_ = has_moved_ || glm::distance(dv(ImGui::GetMousePos()), drag_.start_mouse) >= 3;
  if (has_moved_ && ImGui::IsMousePosValid())
    answer.moved_to = dragged(drag_, dv(ImGui::GetMousePos()), input.camera, input.rect, input.snap_m);
  answer.released = !ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (answer.released) abandon_drag();
  return answer;
}

void GizmoHandle::draw(ImDrawList& list, const glm::dvec3& at_m, const GizmoInput& input) const {
  const std::optional<GizmoShape> shape = shape_of(at_m, input);
  if (!shape) return;
  const auto hot = [&](GizmoPart part_drawn) { return part() == part_drawn; };
  for (std::size_t i = 0; i < 3; ++i)
    if (shape->planes[i]) draw_plane(list, *shape->planes[i], kPlaneColors[i], hot(kPlanes[i]));
  for (std::size_t i = 0; i < 3; ++i)
    if (shape->tips[i])
      draw_arrow(list, shape->center, *shape->tips[i], hot(kArrows[i]) ? color::kWaypoint : color::kAxes[i], kNames[i]);
  list.AddCircleFilled(im(shape->center), scaled(hot(GizmoPart::screen) ? 7.5 : 6), IM_COL32(0, 0, 0, 130));
  list.AddCircle(im(shape->center), scaled(hot(GizmoPart::screen) ? 7.5 : 6), color::kWaypoint, 0, scaled(1.8));
}

std::vector<ScreenRect> GizmoHandle::covered(const glm::dvec3& at_m, const GizmoInput& input) const {
  std::vector<ScreenRect> rects;
  const std::optional<GizmoShape> shape = shape_of(at_m, input);
  if (!shape) return rects;
  const double half = scaled(6);
  constexpr int kSteps = 8;  // along an arrow, with its letter
  for (const auto& tip : shape->tips)
    for (int i = 0; tip && i <= kSteps; ++i) {
      const glm::dvec2 at = glm::mix(shape->center, *tip, 1.15 * i / kSteps);
      rects.push_back({at - half, at + half});
    }
  for (const auto& plane : shape->planes)
    if (plane)
      rects.push_back({glm::min(glm::min((*plane)[0], (*plane)[1]), glm::min((*plane)[2], (*plane)[3])),
                       glm::max(glm::max((*plane)[0], (*plane)[1]), glm::max((*plane)[2], (*plane)[3]))});
  return rects;
}

void GizmoHandle::probe_places(UiProbe& ui_probe, const glm::dvec3& at_m, const GizmoInput& input) const {
  if (!ui_probe.wanted()) return;
  const std::optional<GizmoShape> shape = shape_of(at_m, input);
  if (!shape) return;
  const auto note = [&](const char* name, const glm::dvec2& at) {
    ui_probe.note(std::string("gizmo/") + name, {at - 4.0, at + 4.0});
  };
  constexpr std::array<const char*, 3> kPlaces{"x", "y", "z"};
  constexpr std::array<const char*, 3> kPlanePlaces{"xy", "yz", "zx"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (shape->tips[i]) note(kPlaces[i], glm::mix(shape->center, *shape->tips[i], 0.85));
    if (shape->planes[i]) note(kPlanePlaces[i], ((*shape->planes[i])[0] + (*shape->planes[i])[2]) / 2.0);
  }
  note("middle", shape->center);
}

void PointEntry::open(std::string title, const glm::dvec3& point_m) {
  title_ = std::move(title);
  point_m_ = point_m;
  state_ = State::asked;
}

void PointEntry::draw_fields() {
  draw_text(title_, color::kText, Font::bold);
  for (int i = 0; i < 3; ++i) {
    const Row& row = kRows[static_cast<std::size_t>(i)];
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(row.color), "%s", row.name);
    ImGui::SameLine(scaled(34));
    ImGui::SetNextItemWidth(scaled(130));
    if (i == 0 && appearing_) ImGui::SetKeyboardFocusHere();
    ImGui::InputDouble(row.id, &point_m_[i], 0, 0, "%.3f", ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    ImGui::TextDisabled("m %s", row.meaning);
  }
}

// Closing waits for the next update: the key that closes it must find it open still, or the rest of the program would
// take that key as well.
std::optional<glm::dvec3> PointEntry::draw() {
  if (state_ == State::closed) return std::nullopt;
  appearing_ = state_ == State::asked;
  if (appearing_) {
    ImGui::OpenPopup(kId);
    state_ = State::open;
  }
  if (!ImGui::BeginPopup(kId)) {
    state_ = State::closed;
    return std::nullopt;
  }
  std::optional<glm::dvec3> taken;
  if (state_ == State::leaving) {
    state_ = State::closed;
    ImGui::CloseCurrentPopup();
  } else {
    draw_fields();
    const bool apply = ImGui::Button("Apply", {scaled(90), 0}) || enter_pressed();
    ImGui::SameLine();
    const bool leave = ImGui::Button("Cancel", {scaled(90), 0}) || pressed(Key::escape);
    // What a person may type that is no place: an overflow, 1e400.
    if (apply && is_finite(point_m_)) taken = glm::clamp(point_m_, -kMaxCoordinate_m, kMaxCoordinate_m);
    if (taken || leave) state_ = State::leaving;
  }
  ImGui::EndPopup();
  return taken;
}

}  // namespace sigs::editor
