// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "project/project.h"
#include "video/frame_source.h"

namespace sigs {

// Which videos of a dataset, or of the cameras of a rig, are made at the same time, and how they share the decoder of
// their footage. None of it changes their bytes.

// A video to be made.
struct PendingVideo {
  const Project* project = nullptr;
  FrameRange frames;    // to be exported
  cv::Size footage_px;  // size of its images
};

// The most videos that share a decoder, and the most memory that their exports are to need together, by an estimate.
// One video is made whatever it needs.
inline constexpr int kMaxSharing = 8;
inline constexpr double kMaxSharing_bytes = 1e9;

// Videos, as places in the list of pending ones, in its order.
struct Batch {
  enum class Kind {
    video,   // one
    shared,  // several of the same footage with about the same frames, at the same time, with one decoder
    images   // of one frame each, of the same clip, one after the other, so that its decoder goes forwards
  };
  Kind kind = Kind::video;
  std::vector<std::size_t> videos;
};

struct Schedule {
  std::vector<Batch> batches;
  int batches_at_a_time = 1;

  // Frames that an export of the batch composes in parallel.
  [[nodiscard]] int jobs_of_each(const Batch& batch, int cores) const;
};

// jobs: videos at the same time; 0: one for every four cores, of one clip up to kMaxSharing, of single images one for
// each core. Videos share a decoder where half of the frames of the longer one or more are in both; not those in H.264,
// HEVC and AV1, whose encoders take nearly all of the time and much memory.
[[nodiscard]] Schedule schedule_of(const std::vector<PendingVideo>& videos, int jobs, int cores);

// Calls make(video, footage) for each video of a shared batch, each call on a thread of its own. footage: a source of
// the video's that decodes for all of them and that no other call has; null where the clip cannot be opened, so that
// the export says why, and for a video for which the system grants no thread, which is made after the others.
// What a call throws is thrown again when all have ended.
void make_sharing(const Batch& batch, const std::vector<PendingVideo>& videos, const std::atomic<bool>* cancel,
                  const std::function<void(std::size_t video, FrameSource* footage)>& make);

}  // namespace sigs
