// SPDX-License-Identifier: MIT
#include "camera/row_motion.h"

#include <algorithm>
#include <cmath>

#include "base/ensure.h"

namespace sigs {

namespace {

// A vibration of 50 Hz turns within a readout of 30 ms by one and a half periods: 20 nodes a period.
constexpr int kNodes = 33;

}  // namespace

RowMotion::RowMotion(const std::function<Pose<frame::Camera, frame::Body>(double)>& camera_from_body, int rows,
                     double readout_s)
    : rows_(rows) {
  ENSURE(rows >= 2 && readout_s > 0);
  for (int i = 0; i < kNodes; ++i) nodes_.push_back(camera_from_body(readout_s * (double(i) / (kNodes - 1) - 0.5)));
  for (int i = 1; i < kNodes; ++i)  // of a quaternion and its negative, the one next to its neighbour
    if (glm::dot(nodes_[i - 1].rotation, nodes_[i].rotation) < 0) nodes_[i].rotation = -nodes_[i].rotation;
}

Pose<frame::Camera, frame::Body> RowMotion::at_row(double row) const {
  const double at = std::clamp(row / (rows_ - 1), 0.0, 1.0) * (kNodes - 1);
  const auto before = static_cast<std::size_t>(std::min(std::floor(at), kNodes - 2.0));
  const double share = at - static_cast<double>(before);
  const Pose<frame::Camera, frame::Body>& a = nodes_[before];
  const Pose<frame::Camera, frame::Body>& b = nodes_[before + 1];
  return {glm::normalize(a.rotation * (1 - share) + b.rotation * share),
          glm::mix(a.translation_m, b.translation_m, share)};
}

std::optional<glm::dvec2> RowMotion::pixel(const Lens& lens, const glm::dvec3& p_in_body) const {
  constexpr int kMaxSteps = 20;
  constexpr double kSettled_px = 1e-4;
  double row = (rows_ - 1) / 2.0;
  std::optional<glm::dvec2> found;
  for (int step = 0; step < kMaxSteps; ++step) {
    const std::optional<glm::dvec2> pixel = lens.pixel(at_row(row) * p_in_body);
    if (!pixel) return found;
    found = pixel;
    if (std::abs(pixel->y - row) < kSettled_px) break;
    row = std::clamp(pixel->y, 0.0, rows_ - 1.0);
  }
  return found;
}

RowMotion::Turn RowMotion::row_transform(double row) const {
  const Pose<frame::Camera, frame::Body> at = at_row(row);
  const Pose<frame::Camera, frame::Body> middle = at_row((rows_ - 1) / 2.0);
  const glm::dquat turn = middle.rotation * glm::conjugate(at.rotation);
  const double distance_m = glm::length(at.translation_m);
  if (!(distance_m > 0)) return {glm::mat3_cast(turn), glm::dvec3(0)};
  return {glm::mat3_cast(turn), (middle.translation_m - turn * at.translation_m) / distance_m};
}

double RowMotion::max_shift_px(const Lens& lens) const {
  const std::optional<glm::dvec2> middle = lens.pixel(at_row((rows_ - 1) / 2.0).translation_m);
  double shift_px = 0;
  if (!middle) return shift_px;
  for (const Pose<frame::Camera, frame::Body>& node : nodes_)
    if (const std::optional<glm::dvec2> pixel = lens.pixel(node.translation_m))
      shift_px = std::max(shift_px, glm::distance(*pixel, *middle));
  return shift_px;
}

}  // namespace sigs
