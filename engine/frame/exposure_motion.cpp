// SPDX-License-Identifier: MIT
#include "frame/exposure_motion.h"

#include <algorithm>
#include <optional>

namespace sigs {

namespace {

// Where the reference point appears in a frame that is taken since_s after the moment.
std::optional<glm::dvec2> pixel_at(const Scene& scene, const SceneMoment& moment, std::size_t intruder,
                                   const Lens& lens, double since_s) {
  constexpr int kSteps = 4;  // each takes the error times the share of the readout that the point moves by: 1e-2
  const double last_row = scene.footage.size_px.height - 1;
  const auto seen_at = [&](double row_s) {
    return lens.pixel(camera_from_body_at(scene, intruder, moment.time_s + since_s + row_s).translation_m);
  };
  std::optional<glm::dvec2> pixel = seen_at(0);
  if (!(scene.motion.readout_s > 0) || !(last_row > 0)) return pixel;
  for (int step = 0; step < kSteps && pixel; ++step)
    pixel = seen_at(scene.motion.readout_s * (std::clamp(pixel->y / last_row, 0.0, 1.0) - 0.5));
  return pixel;
}

}  // namespace

glm::dvec2 motion_during_exposure(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                  const Lens& lens) {
  if (!(moment.exposure_s > 0)) return {0, 0};
  const auto id = static_cast<std::size_t>(placed.id);
  const std::optional<glm::dvec2> first = pixel_at(scene, moment, id, lens, -moment.exposure_s / 2);
  const std::optional<glm::dvec2> last = pixel_at(scene, moment, id, lens, moment.exposure_s / 2);
  return first && last ? *last - *first : glm::dvec2(0, 0);
}

std::vector<cv::Point2d> earlier_places(const Scene& scene, int frame, const PlacedIntruder& placed, const Lens& lens,
                                        int count) {
  const auto id = static_cast<std::size_t>(placed.id);
  const auto pixel_in = [&](int n) {
    return lens.pixel(camera_from_body_at(scene, id, time_of_frame_s(scene.footage, n)).translation_m);
  };
  std::vector<cv::Point2d> places;
  const std::optional<glm::dvec2> now = pixel_in(frame);
  for (int k = 1; now && k <= std::min(count, frame); ++k) {
    const std::optional<glm::dvec2> then = pixel_in(frame - k);
    if (!then) break;
    places.emplace_back(then->x - now->x, then->y - now->y);
  }
  return places;
}

}  // namespace sigs
