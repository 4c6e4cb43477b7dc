// SPDX-License-Identifier: MIT
#include "calibration/rough_tracks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "video/luma_stream.h"

namespace sigs {

namespace {

constexpr int kStretch = 300;      // frames
constexpr int kLooks = 10;         // images that are handed out
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

Result<PixelTracks> tracked_pixels(FrameSource& footage, int max_frames,
                                   const std::function<void(int number, const cv::Mat&)>& looked_at,
                                   const RoughControl& control) {
  const std::vector<double> times_s = footage.info().times_s;
  PixelTracks tracks{.size_px = footage.info().size_px};
  const std::vector<Stretch> stretches = stretches_of(footage.info().frame_count(), max_frames);
  int total = 0;
  for (const Stretch& stretch : stretches) total += stretch.count;
  const int every = std::max(1, total / kLooks);
  for (int s = 0; s < static_cast<int>(stretches.size()); ++s) {
    const Stretch& stretch = stretches[static_cast<std::size_t>(s)];
    FeatureTracker tracker(tracks.size_px, {}, {});
    LumaStream stream(footage, {.first = stretch.first, .every = 1, .count = stretch.count});
    while (const std::optional<Result<LumaFrame>> frame = stream.next()) {
      if (control.cancel != nullptr && *control.cancel)
        return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
      if (!*frame) return fail(frame->error());
      const int number = (*frame)->number;
      TrackedFrame found{.number = number, .time_s = times_s[static_cast<std::size_t>(number)], .stretch = s};
      found.features = tracker.next((*frame)->luma);
      for (Feature& feature : found.features) feature.id += s * kIdsEach;
      found.is_repeated = tracker.is_repeated();
      const int done = static_cast<int>(tracks.frames.size());
      if (looked_at && done % every == every / 2) looked_at(number, (*frame)->luma);
      tracks.frames.push_back(std::move(found));
      if (control.progress) control.progress(done + 1, total);
    }
    tracks.step_px = tracker.scale();
  }
  return tracks;
}

double median_motion_px(std::span<const PixelPair> pairs) {
  if (pairs.empty()) return 0;
  std::vector<double> motions;
  for (const PixelPair& pair : pairs) motions.push_back((pair.after - pair.before).norm());
  const auto middle = motions.begin() + static_cast<std::ptrdiff_t>(motions.size() / 2);
  std::nth_element(motions.begin(), middle, motions.end());
  return *middle;
}

std::vector<PixelPair> common_pixels(const TrackedFrame& before, const TrackedFrame& after) {
  std::vector<PixelPair> pairs;
  auto b = after.features.begin();
  for (const Feature& a : before.features) {
    while (b != after.features.end() && b->id < a.id) ++b;
    if (b == after.features.end()) break;
    if (b->id != a.id) continue;
    const PixelPair pair{{a.pixel_px.x, a.pixel_px.y}, {b->pixel_px.x, b->pixel_px.y}};
    if (pair.before.allFinite() && pair.after.allFinite()) pairs.push_back(pair);
  }
  constexpr double kMoves_px = 5;
  constexpr double kStill = 0.05;  // of the median motion
  const double motion_px = median_motion_px(pairs);
  if (motion_px > kMoves_px)
    std::erase_if(pairs, [&](const PixelPair& p) { return (p.after - p.before).norm() < kStill * motion_px; });
  return pairs;
}

}  // namespace sigs
