// SPDX-License-Identifier: MIT
#include "occlusion/film_segments.h"

#include <utility>

namespace sigs {

namespace {

constexpr std::size_t kMost = 48;

MeanPicture merged(const MeanPicture& a, const MeanPicture& b) {
  const int frames = a.frames + b.frames;
  return {a.luma * (1.0 * a.frames / frames) + b.luma * (1.0 * b.frames / frames), frames};
}

void append(std::vector<MeanPicture>& segments, const MeanPicture& picture, int longest_frames) {
  if (segments.empty() || segments.back().frames + picture.frames > longest_frames)
    segments.push_back(picture);
  else
    segments.back() = merged(segments.back(), picture);
}

}  // namespace

void FilmSegments::add(const MeanPicture& picture) {
  append(segments_, picture, longest_frames_);
  while (segments_.size() > kMost) {
    longest_frames_ *= 2;
    std::vector<MeanPicture> longer;
    for (const MeanPicture& segment : segments_) append(longer, segment, longest_frames_);
    segments_ = std::move(longer);
  }
}

}  // namespace sigs
