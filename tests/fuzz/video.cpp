// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/ensure.h"
#include "fuzz/fuzz_input.h"
#include "video/data_streams.h"
#include "video/frame_source.h"
#include "video/stream_splice.h"

namespace sigs::fuzz {

namespace {

void check_info(const VideoInfo& info) {
  check_messages(info.warnings);
  ENSURE(info.size_px.width > 0 && info.size_px.height > 0);
  ENSURE(info.frame_count() > 0 && info.times_s.front() == 0);
  ENSURE(info.frame_rate_num > 0 && info.frame_rate_den > 0);
  ENSURE(info.pixel_aspect_num > 0 && info.pixel_aspect_den > 0);
  for (const double time_s : info.times_s) ENSURE(std::isfinite(time_s));
}

// The last frame before the first: seeking, and going back.
void try_frames(const std::filesystem::path& path, Quantisers quantisers) {
  Result<FrameSource> source = FrameSource::open(path, nullptr, quantisers);
  if (!source) return check_message(source.error());
  check_info(source->info());
  for (const int n : {source->info().frame_count() - 1, 0, source->info().frame_count() / 2}) {
    const Result<Frame> frame = source->read(n);
    if (!frame) {
      check_message(frame.error());
      continue;
    }
    ENSURE(!frame->planes.empty() && frame->planes.front().size() == source->info().size_px);
  }
}

// What a copy of it with a changed frame would be. Not of HEVC: libx265 loses memory whenever an encoder is opened;
// nor of large images, for which encoders take more memory than a target may.
void try_splice(const std::filesystem::path& path) {
  const Result<FrameSource> source = FrameSource::open(path);
  if (!source || source->info().codec == "hevc" || source->info().size_px.area() > 1 << 21) return;
  std::vector<bool> changed(static_cast<std::size_t>(source->info().frame_count()), false);
  changed[changed.size() / 2] = true;
  const Result<SplicePlan> plan = plan_splice(source->info(), {.first = 0, .changed = std::move(changed)});
  if (!plan) return check_message(plan.error());
  check_messages(plan->warnings);
  ENSURE(plan->encoded[plan->encoded.size() / 2]);
}

void try_data(const std::filesystem::path& path) {
  const Result<std::vector<DataStream>> streams = data_streams_of(path);
  if (!streams) return check_message(streams.error());
  for (const DataStream& stream : *streams) {
    const Result<DataPackets> packets = read_data_stream(path, stream.index);
    if (!packets) check_message(packets.error());
  }
}

}  // namespace

void try_video(const FuzzInput& input) {
  const std::filesystem::path path = input.file("clip");
  try_frames(path, Quantisers::leave_out);
  try_frames(path, Quantisers::read);
  try_data(path);
  try_splice(path);
}

}  // namespace sigs::fuzz
