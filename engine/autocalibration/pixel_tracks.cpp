// SPDX-License-Identifier: MIT
#include "autocalibration/lens_by_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/least_squares.h"
#include "base/statistics.h"
#include "video/frame_source.h"

namespace sigs {

namespace {

constexpr int kStretch = 300;      // frames
constexpr int kIdsEach = 1 << 24;  // features that one stretch may have

struct Stretch {
  int first = 0;
  int count = 0;
};

std::vector<Stretch> stretches_of(int frames, int max_frames) {
  if (frames <= max_frames) return {{0, frames}};
  const int count = std::max(1, max_frames / kStretch);
  const int length = std::min(kStretch, max_frames);
  std::vector<Stretch> all;
  for (int i = 0; i < count; ++i) {
    const auto room = static_cast<long long>(frames - length);
    all.push_back({static_cast<int>(count == 1 ? room / 2 : room * i / (count - 1)), length});
  }
  return all;
}

}  // namespace

Result<PixelTracks> tracked_pixels(FrameSource& footage, int max_frames, const AutocalibrationControl& control) {
  const std::vector<double> times_s = footage.info().times_s;
  PixelTracks tracks{.size_px = footage.info().size_px};
  const std::vector<Stretch> stretches = stretches_of(footage.info().frame_count(), max_frames);
  int total = 0;
  for (const Stretch& stretch : stretches) total += stretch.count;
  for (int s = 0; s < static_cast<int>(stretches.size()); ++s) {
    const Stretch& stretch = stretches[static_cast<std::size_t>(s)];
    FeatureTracker tracker(tracks.size_px, {}, {});
    LumaStream stream(footage, {.first = stretch.first, .every = 1, .count = stretch.count});
    while (const std::optional<Result<LumaFrame>> frame = stream.next()) {
      if (const Result<void> goes_on = check_interrupt(control.cancel); !goes_on) return fail(goes_on.error());
      if (!*frame) return fail(frame->error());
      const int number = (*frame)->number;
      TrackedFrame found{.number = number, .time_s = times_s[static_cast<std::size_t>(number)], .stretch = s};
      found.features = tracker.next((*frame)->luma);
      for (Feature& feature : found.features) feature.id += s * kIdsEach;
      found.is_repeated = tracker.is_repeated();
      tracks.frames.push_back(std::move(found));
      if (control.progress) control.progress(static_cast<int>(tracks.frames.size()), total);
    }
    tracks.step_px = tracker.scale();
  }
  return tracks;
}

double median_motion_px(std::span<const PixelPair> pairs) {
  std::vector<double> motions;
  for (const PixelPair& pair : pairs) motions.push_back(glm::length(pair.after - pair.before));
  return motions.empty() ? 0 : median(std::move(motions));
}

std::vector<PixelPair> common_pixels(const TrackedFrame& before, const TrackedFrame& after) {
  std::vector<PixelPair> pairs;
  auto b = after.features.begin();
  for (const Feature& a : before.features) {
    while (b != after.features.end() && b->id < a.id) ++b;
    if (b == after.features.end()) break;
    if (b->id != a.id) continue;
    const PixelPair pair{{a.pixel_px.x, a.pixel_px.y}, {b->pixel_px.x, b->pixel_px.y}};
    if (is_finite(pair.before) && is_finite(pair.after)) pairs.push_back(pair);
  }
  constexpr double kMoves_px = 5;
  constexpr double kStill = 0.05;  // of the median motion
  const double motion_px = median_motion_px(pairs);
  if (motion_px > kMoves_px)
    std::erase_if(pairs, [&](const PixelPair& p) { return glm::length((p.after - p.before)) < kStill * motion_px; });
  return pairs;
}

}  // namespace sigs
