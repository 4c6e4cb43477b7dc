// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sigs {

FootageShape shape_of(const VideoInfo& video) {
  return {.size_px = video.size_px,
          .part = video.part,
          .times_s = video.times_s,
          .frame_interval_s = double(video.frame_rate_den) / video.frame_rate_num};
}

double time_of_frame_s(const FootageShape& footage, double frame) {
  const std::vector<double>& times_s = footage.times_s;
  const double last = static_cast<double>(times_s.size()) - 1;
  if (times_s.empty()) return frame * footage.frame_interval_s;
  if (frame <= 0) return times_s.front() + frame * footage.frame_interval_s;
  if (frame >= last) return times_s.back() + (frame - last) * footage.frame_interval_s;
  const double whole = std::floor(frame);
  const double share = frame - whole;
  const auto index = static_cast<std::size_t>(whole);
  return share == 0 ? times_s[index] : times_s[index] + share * (times_s[index + 1] - times_s[index]);
}

double frame_at_time(const FootageShape& footage, double time_s) {
  const std::vector<double>& times_s = footage.times_s;
  if (times_s.empty()) return time_s / footage.frame_interval_s;
  if (time_s <= times_s.front()) return (time_s - times_s.front()) / footage.frame_interval_s;
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  const double last = static_cast<double>(times_s.size()) - 1;
  if (after == times_s.end()) return last + (time_s - times_s.back()) / footage.frame_interval_s;
  const auto frame = static_cast<double>(after - times_s.begin());
  return frame - (*after - time_s) / (*after - *std::prev(after));
}

Camera compositing_camera(const Scene& scene) {
  if (scene.compositing.method != MethodChoice::plain) return scene.camera;
  const LensParameters& lens = scene.camera.lens.parameters();
  return {*Lens::make({.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}), scene.camera.size_px};
}

}  // namespace sigs
