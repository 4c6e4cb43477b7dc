// SPDX-License-Identifier: MIT
#include "occlusion/footage_segments.h"

#include <utility>

namespace sigs {

namespace {

constexpr std::size_t kMax = 48;

MeanFrame merged(const MeanFrame& a, const MeanFrame& b) {
  const int frames = a.frames + b.frames;
  return {a.luma * (1.0 * a.frames / frames) + b.luma * (1.0 * b.frames / frames), frames};
}

void append(std::vector<MeanFrame>& segments, const MeanFrame& image, int max_frames) {
  if (segments.empty() || segments.back().frames + image.frames > max_frames)
    segments.push_back(image);
  else
    segments.back() = merged(segments.back(), image);
}

}  // namespace

void FootageSegments::add(const MeanFrame& image) {
  append(segments_, image, max_frames_);
  while (segments_.size() > kMax) {
    max_frames_ *= 2;
    std::vector<MeanFrame> longer;
    for (const MeanFrame& segment : segments_) append(longer, segment, max_frames_);
    segments_ = std::move(longer);
  }
}

}  // namespace sigs
