// SPDX-License-Identifier: MIT
#include "export/schedule.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/threads.h"
#include "scene/opened_project.h"

namespace sigs {

namespace {

constexpr std::size_t kImagesOfABatch = 50;

Project without_crop(Project project) {
  project.footage.crop = {};
  return project;
}

// What a decoder depends on; all that have the same can share it.
using DecoderKey = std::pair<FootageKey, Quantisers>;

DecoderKey key_of(const Project& project) {
  return {footage_key(without_crop(project)), quantisers_for(project)};
}

int count_of(const FrameRange& frames) {
  return frames.last - frames.first + 1;
}

bool is_image(const PendingVideo& video) {
  return count_of(video.frames) == 1;
}

bool have_most_in_common(const FrameRange& a, const FrameRange& b) {
  const int common = std::min(a.last, b.last) - std::max(a.first, b.first) + 1;
  return 2 * common >= std::max(count_of(a), count_of(b));
}

// How many of the videos may share a decoder.
int most_sharing(const std::vector<PendingVideo>& videos, const std::vector<std::size_t>& group) {
  constexpr double kBytes_per_px = 60;  // of an export, measured: mostly images in its queues
  double most = kMaxSharing;
  for (const std::size_t video : group) {
    const VideoCodec codec = videos[video].project->output.codec;
    // These take most of the time for themselves, and the memory of dozens of images to look ahead at.
    if (codec == VideoCodec::h264 || codec == VideoCodec::hevc || codec == VideoCodec::av1) return 1;
    if (codec == VideoCodec::source) return 1;  // it decodes some frames alone
    most = std::min(most, kMaxSharing_bytes / (kBytes_per_px * std::max(1, videos[video].footage_px.area())));
  }
  return std::max(1, static_cast<int>(most));
}

// Pieces of about the same length, of `most` or fewer.
std::vector<std::vector<std::size_t>> pieces_of(const std::vector<std::size_t>& list, std::size_t most) {
  const std::size_t count = (list.size() + most - 1) / most;
  std::vector<std::vector<std::size_t>> pieces;
  for (std::size_t i = 0; i < count; ++i)
    pieces.emplace_back(list.begin() + static_cast<std::ptrdiff_t>(i * list.size() / count),
                        list.begin() + static_cast<std::ptrdiff_t>((i + 1) * list.size() / count));
  return pieces;
}

void append_videos(const std::vector<PendingVideo>& videos, int most, std::vector<Batch>& batches) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<DecoderKey, std::vector<std::size_t>> groups_of_footage;  // places in `groups`
  for (std::size_t i = 0; i < videos.size(); ++i) {
    if (is_image(videos[i])) continue;
    std::vector<std::size_t>& candidates = groups_of_footage[key_of(*videos[i].project)];
    const auto fit = std::ranges::find_if(candidates, [&](std::size_t group) {
      return have_most_in_common(videos[groups[group].front()].frames, videos[i].frames);
    });
    if (fit != candidates.end()) {
      groups[*fit].push_back(i);
      continue;
    }
    candidates.push_back(groups.size());
    groups.push_back({i});
  }
  for (const std::vector<std::size_t>& group : groups) {
    const auto fitting = static_cast<std::size_t>(std::min(most, most_sharing(videos, group)));
    for (std::vector<std::size_t>& piece : pieces_of(group, fitting))
      batches.push_back({piece.size() > 1 ? Batch::Kind::shared : Batch::Kind::video, std::move(piece)});
  }
}

void append_images(const std::vector<PendingVideo>& videos, std::vector<Batch>& batches) {
  std::map<DecoderKey, std::vector<std::size_t>> images;
  for (std::size_t i = 0; i < videos.size(); ++i)
    if (is_image(videos[i])) images[key_of(*videos[i].project)].push_back(i);
  for (auto& [footage, all] : images) {
    std::ranges::stable_sort(all, {}, [&](std::size_t video) { return videos[video].frames.first; });
    for (std::size_t i = 0; i < all.size(); i += kImagesOfABatch)
      batches.push_back({Batch::Kind::images,
                         {all.begin() + static_cast<std::ptrdiff_t>(i),
                          all.begin() + static_cast<std::ptrdiff_t>(std::min(i + kImagesOfABatch, all.size()))}});
  }
}

// An export of a video keeps some four cores busy, with decoding, composing and two encoders; that of an image one.
int wanted_batches(const std::vector<Batch>& batches, int jobs, int cores) {
  std::size_t largest = 0;  // of videos
  for (const Batch& batch : batches)
    if (batch.kind != Batch::Kind::images) largest = std::max(largest, batch.videos.size());
  if (largest == 0) return jobs > 0 ? jobs : cores;
  return (jobs > 0 ? jobs : std::max(1, cores / 4)) / static_cast<int>(largest);
}

// One source for each video of the batch; none where the clip cannot be opened or cropped.
std::vector<FrameSource> shared_sources(const Batch& batch, const std::vector<PendingVideo>& videos,
                                        const std::atomic<bool>* cancel) {
  constexpr int kAhead = 4;  // frames: exports have queues of their own
  const Project& project = *videos[batch.videos.front()].project;
  Result<FrameSource> footage = open_footage(without_crop(project), cancel, quantisers_for(project));
  if (!footage) return {};
  std::vector<FrameSteps> frames;
  for (const std::size_t video : batch.videos)
    frames.push_back({.first = videos[video].frames.first, .count = count_of(videos[video].frames)});
  std::vector<FrameSource> sources = FrameSource::shared(std::move(*footage), frames, kAhead);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Result<FrameSource> cropped = cropped_footage(std::move(sources[i]), *videos[batch.videos[i]].project);
    if (!cropped) return {};
    sources[i] = *std::move(cropped);
  }
  return sources;
}

}  // namespace

int Schedule::jobs_of_each(const Batch& batch, int cores) const {
  const int beside = batch.kind == Batch::Kind::shared ? static_cast<int>(batch.videos.size()) : 1;
  return std::max(1, cores / (batches_at_a_time * beside) - 1);
}

Schedule schedule_of(const std::vector<PendingVideo>& videos, int jobs, int cores) {
  Schedule schedule;
  append_videos(videos, jobs > 0 ? std::min(jobs, kMaxSharing) : kMaxSharing, schedule.batches);
  append_images(videos, schedule.batches);
  const int most = std::max(1, static_cast<int>(schedule.batches.size()));
  schedule.batches_at_a_time = std::clamp(wanted_batches(schedule.batches, jobs, cores), 1, most);
  return schedule;
}

void make_sharing(const Batch& batch, const std::vector<PendingVideo>& videos, const std::atomic<bool>* cancel,
                  const std::function<void(std::size_t video, FrameSource* footage)>& make) {
  std::vector<FrameSource> opened = shared_sources(batch, videos, cancel);
  std::vector<std::optional<FrameSource>> sources(batch.videos.size());
  for (std::size_t i = 0; i < opened.size(); ++i) sources[i] = std::move(opened[i]);
  std::mutex mutex;
  std::exception_ptr thrown;  // what a thread throws first
  std::vector<std::thread> threads;
  threads.reserve(batch.videos.size());
  std::vector<std::size_t> left;  // without a thread
  left.reserve(batch.videos.size());
  for (std::size_t i = 0; i < batch.videos.size(); ++i) {
    const auto make_one = [&, i] {
      try {
        make(batch.videos[i], sources[i] ? &*sources[i] : nullptr);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!thrown) thrown = std::current_exception();
      }
      sources[i].reset();  // no other reader waits for this one any more
    };
    Result<std::thread> thread = started_thread(make_one);
    if (thread) {
      threads.push_back(std::move(*thread));
    } else {
      sources[i].reset();
      left.push_back(i);
    }
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t i : left) make(batch.videos[i], nullptr);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace sigs
