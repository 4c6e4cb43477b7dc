// SPDX-License-Identifier: MIT
#include "rig/rig_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/json.h"
#include "base/text.h"
#include "project/project.h"

namespace sigs {

namespace {

double bearing_of(const glm::dvec3& p_in_body) {
  return std::atan2(p_in_body.y, p_in_body.x);
}

double elevation_of(const glm::dvec3& p_in_body) {
  return std::atan2(-p_in_body.z, std::hypot(p_in_body.x, p_in_body.y));
}

}  // namespace

std::optional<double> range_error_m_per_px(const RigCameraGeometry& first, const RigCameraGeometry& second,
                                           const glm::dvec3& p_in_body) {
  constexpr double kStep = 1e-3;  // of the distance
  const glm::dvec3 ray_m = p_in_body - first.mount.position_m;
  const double distance_m = glm::length(ray_m);
  const Pose<frame::Camera, frame::Body> camera_from_body = inverse(body_from_camera(second.mount));
  const auto pixel_at = [&](double share) {
    return second.camera.lens.pixel(camera_from_body * (first.mount.position_m + ray_m * share));
  };
  const std::optional<glm::dvec2> nearer = pixel_at(1 - kStep);
  const std::optional<glm::dvec2> farther = pixel_at(1 + kStep);
  if (!nearer || !farther) return std::nullopt;
  constexpr double kMoves_px = 1e-8;  // less is rounding
  const double moved_px = glm::length(*farther - *nearer);
  if (!(moved_px > kMoves_px)) return std::nullopt;
  return 2 * kStep * distance_m / moved_px;
}

namespace {

// Of the cameras that show it the two with the least error; none: fewer than two, or on the line through both.
std::optional<StereoRange> best_pair(const std::vector<RigCameraGeometry>& cameras, const std::vector<bool>& shows,
                                     const glm::dvec3& p_in_body) {
  std::optional<StereoRange> best;
  for (std::size_t a = 0; a < cameras.size(); ++a)
    for (std::size_t b = a + 1; b < cameras.size(); ++b) {
      if (!shows[a] || !shows[b]) continue;
      const std::optional<double> by_b = range_error_m_per_px(cameras[a], cameras[b], p_in_body);
      const std::optional<double> by_a = range_error_m_per_px(cameras[b], cameras[a], p_in_body);
      if (!by_a || !by_b) continue;
      const double error_m = std::max(*by_a, *by_b);
      if (!best || error_m < best->error_m_per_px) best = StereoRange{a, b, error_m};
    }
  return best;
}

}  // namespace

RigTruth::RigTruth(std::vector<RigCameraGeometry> cameras, std::vector<RigIntruder> intruders)
    : cameras_(std::move(cameras)), intruders_(std::move(intruders)), frames_(cameras_.size()) {}

void RigTruth::add(std::size_t camera, const FrameTruth& truth) {
  const Pose<frame::Body, frame::Camera> body_from = body_from_camera(cameras_.at(camera).mount);
  const Pose<frame::World, frame::Camera> world_from_camera{truth.world_from_camera, truth.camera_position_m};
  RigFrame frame{
      .frame = truth.index, .time_s = truth.time_s, .world_from_aircraft = world_from_camera * inverse(body_from)};
  frame.intruders.resize(intruders_.size());
  for (const IntruderTruth& intruder : truth.intruders)
    frame.intruders.at(static_cast<std::size_t>(intruder.id)) = {.is_visible = intruder.visible_box.has_value(),
                                                                 .in_image = intruder.in_image,
                                                                 .visible_fraction = intruder.visible_fraction,
                                                                 .position_m = body_from * intruder.position_m,
                                                                 .world_from_intruder = intruder.world_from_body};
  const std::lock_guard lock(mutex_);
  frames_[camera].push_back(std::move(frame));
}

const RigFrame* RigTruth::frame_at(std::size_t camera, double time_s) const {
  const std::vector<RigFrame>& frames = frames_.at(camera);
  if (frames.empty()) return nullptr;
  const auto after = std::lower_bound(frames.begin(), frames.end(), time_s,
                                      [](const RigFrame& one, double wanted_s) { return one.time_s < wanted_s; });
  auto best = after == frames.end() ? std::prev(after) : after;
  if (after != frames.begin() && time_s - std::prev(after)->time_s < std::abs(best->time_s - time_s))
    best = std::prev(after);
  const double interval_s =
      frames.size() < 2 ? 0 : (frames.back().time_s - frames.front().time_s) / static_cast<double>(frames.size() - 1);
  return std::abs(best->time_s - time_s) <= 0.75 * interval_s + 1e-9 ? &*best : nullptr;
}

std::vector<RigRow> RigTruth::rows() const {
  std::vector<RigRow> rows;
  if (cameras_.empty()) return rows;
  for (const RigFrame& first : frames_[0]) {
    std::vector<const RigFrame*> frames;
    for (std::size_t k = 0; k < cameras_.size(); ++k) frames.push_back(frame_at(k, first.time_s));
    for (std::size_t i = 0; i < intruders_.size(); ++i) {
      const glm::dvec3& p_in_body = first.intruders[i].position_m;
      RigRow row{.frame = first.frame,
                 .time_s = first.time_s,
                 .intruder = static_cast<int>(i),
                 .range_m = glm::length(p_in_body),
                 .bearing_rad = bearing_of(p_in_body),
                 .elevation_rad = elevation_of(p_in_body)};
      for (const RigFrame* const frame : frames) {
        row.visible_fraction.push_back(frame != nullptr ? std::optional(frame->intruders[i].visible_fraction)
                                                        : std::nullopt);
        row.is_visible.push_back(frame != nullptr && frame->intruders[i].is_visible);
      }
      row.stereo = best_pair(cameras_, row.is_visible, p_in_body);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<CameraView> RigTruth::views(int intruder) const {
  std::vector<CameraView> views;
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    bool goes_on = false;
    for (const RigFrame& frame : frames_[k]) {
      const bool is_visible = frame.intruders.at(static_cast<std::size_t>(intruder)).is_visible;
      if (is_visible && !goes_on) views.push_back({k, frame.time_s, frame.time_s});
      if (is_visible) views.back().last_s = frame.time_s;
      goes_on = is_visible;
    }
  }
  std::stable_sort(views.begin(), views.end(),
                   [](const CameraView& a, const CameraView& b) { return a.first_s < b.first_s; });
  return views;
}

namespace {

// A camera's view of an intruder, with the times in between in which something hides it within the image.
struct HeldView : CameraView {
  bool footage_ends = false;  // the camera has no frame after it
};

// By first_s.
std::vector<HeldView> held_views(const std::vector<std::vector<RigFrame>>& frames, std::size_t intruder) {
  std::vector<HeldView> views;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    bool has_left = true;
    for (const RigFrame& frame : frames[k]) {
      const RigSighting& sighting = frame.intruders.at(intruder);
      if (sighting.is_visible && has_left) views.push_back({{k, frame.time_s, frame.time_s}, false});
      if (sighting.is_visible) views.back().last_s = frame.time_s;
      has_left = !sighting.is_visible && (has_left || !sighting.in_image);
    }
    if (!has_left) views.back().footage_ends = true;
  }
  std::ranges::stable_sort(views, {}, &HeldView::first_s);
  return views;
}

}  // namespace

std::vector<Handover> RigTruth::handovers(int intruder) const {
  const std::vector<HeldView> views = held_views(frames_, static_cast<std::size_t>(intruder));
  std::vector<Handover> handovers;
  if (views.empty()) return handovers;
  const HeldView* holder = &views.front();
  while (true) {
    // Of the views that go on when the holder's ends the one that lasts longest; else the first that begins afterwards.
    const HeldView* next = nullptr;
    for (const HeldView& view : views)
      if (view.first_s <= holder->last_s && view.last_s > holder->last_s &&
          (next == nullptr || view.last_s > next->last_s))
        next = &view;
    for (const HeldView& view : views)
      if (next == nullptr && view.first_s > holder->last_s) next = &view;
    if (next == nullptr) return handovers;
    if (!holder->footage_ends)
      handovers.push_back({holder->camera, next->camera, holder->last_s, next->first_s - holder->last_s});
    holder = next;
  }
}

namespace {

Json json_of(const RigCameraGeometry& camera) {
  const LensParameters& lens = camera.camera.lens.parameters();
  const glm::dquat turn = body_from_camera(camera.mount).rotation;
  const glm::dvec3& at_m = camera.mount.position_m;
  return {{"name", camera.name},
          {"video", camera.video},
          {"width", camera.camera.size_px.width},
          {"height", camera.camera.size_px.height},
          {"first_frame", camera.frames.first},
          {"last_frame", camera.frames.last},
          {"lens",
           {{"model", name_of(lens.model)},
            {"fx", lens.fx},
            {"fy", lens.fy},
            {"cx", lens.cx},
            {"cy", lens.cy},
            {"coefficients", lens.coefficients}}},
          {"mount",
           {{"position_m", Json::array({at_m.x, at_m.y, at_m.z})},
            {"attitude_deg",
             {{"roll", camera.mount.roll_deg}, {"pitch", camera.mount.pitch_deg}, {"yaw", camera.mount.yaw_deg}}},
            {"body_from_camera_wxyz", Json::array({turn.w, turn.x, turn.y, turn.z})}}},
          {"clock", {{"offset_s", camera.clock.offset_s}, {"drift_ppm", camera.clock.drift_ppm}}}};
}

}  // namespace

std::string RigTruth::json(const std::string& name) const {
  Json json{{"sigs_rig", 1}, {"name", name}, {"cameras", Json::array()}, {"intruders", Json::array()}};
  for (const RigCameraGeometry& camera : cameras_) json["cameras"].push_back(json_of(camera));
  for (std::size_t i = 0; i < intruders_.size(); ++i) {
    Json views = Json::array();
    for (const CameraView& view : this->views(static_cast<int>(i)))
      views.push_back({{"camera", cameras_[view.camera].name}, {"first_s", view.first_s}, {"last_s", view.last_s}});
    Json changes = Json::array();
    for (const Handover& one : handovers(static_cast<int>(i)))
      changes.push_back({{"time_s", one.time_s},
                         {"from", cameras_[one.from].name},
                         {"to", cameras_[one.to].name},
                         {"gap_s", one.gap_s}});
    json["intruders"].push_back({{"id", i},
                                 {"name", intruders_[i].name},
                                 {"category", intruders_[i].category},
                                 {"views", std::move(views)},
                                 {"handovers", std::move(changes)}});
  }
  return json_text(json);
}

std::string RigTruth::csv() const {
  constexpr double kDegree_rad = std::numbers::pi / 180;
  std::string text =
      "frame,time_s,intruder,name,range_m,bearing_deg,elevation_deg,seen_by,stereo_pair,stereo_error_m_per_px";
  for (const RigCameraGeometry& camera : cameras_) text += "," + csv_field(camera.name + "_visible_fraction");
  text += "\n";
  for (const RigRow& row : rows()) {
    std::string seen_by;
    for (std::size_t k = 0; k < cameras_.size(); ++k)
      if (row.is_visible[k]) seen_by += (seen_by.empty() ? "" : "+") + cameras_[k].name;
    text += fmt::format("{},{:.6f},{},{},{:.6f},{:.6f},{:.6f},{}", row.frame, row.time_s, row.intruder,
                        csv_field(intruders_[static_cast<std::size_t>(row.intruder)].name), row.range_m,
                        row.bearing_rad / kDegree_rad, row.elevation_rad / kDegree_rad, csv_field(seen_by));
    text += row.stereo
                ? fmt::format(",{},{:.6g}",
                              csv_field(cameras_[row.stereo->first].name + "+" + cameras_[row.stereo->second].name),
                              row.stereo->error_m_per_px)
                : ",,";
    for (const std::optional<double>& fraction : row.visible_fraction)
      text += fraction ? fmt::format(",{:.6f}", *fraction) : ",";
    text += "\n";
  }
  return text;
}

}  // namespace sigs
