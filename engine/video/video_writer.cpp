// SPDX-License-Identifier: MIT
#include "video/video_writer.h"

#include <optional>
#include <utility>

#include "base/ensure.h"
#include "base/threads.h"
#include "video/libav/video_file.h"
#include "video/png_sequence.h"

namespace sigs {

namespace fs = std::filesystem;

struct VideoWriter::State {
  fs::path path;
  VideoFormat format;
  std::optional<libav::VideoFile> file;  // empty: a folder of images
  bool finished = false;
};

Result<VideoWriter> VideoWriter::open(const fs::path& path, const VideoFormat& format) {
  auto state = std::make_unique<State>();
  state->path = path;
  state->format = format;
  if (format.codec == VideoCodec::png) {
    std::error_code code;
    if (!fs::is_directory(path, code))
      return fail(path.string(), "no such folder to write images into", ErrorKind::cannot_create);
    return VideoWriter(std::move(state));
  }
  Result<libav::VideoFile> file = guarded([&] { return libav::VideoFile::create(path, format); });
  if (!file) return fail(file.error());
  state->file.emplace(std::move(*file));
  return VideoWriter(std::move(state));
}

VideoWriter::VideoWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

void VideoWriter::warm_up() {
  if (!state_->file) return;
  // What fails for want of memory fails again where it is needed, and is told there.
  static_cast<void>(guarded([this]() -> Result<void> {
    state_->file->warm_up();
    return {};
  }));
}

Result<void> VideoWriter::write(const Frame& frame, int number) {
  ENSURE(!state_->finished);
  return guarded([&] { return state_->file ? state_->file->write(frame) : write_png(state_->path, frame, number); });
}

Result<void> VideoWriter::write_blank(double time_s, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write_blank(time_s);
    const VideoFormat& format = state_->format;
    return write_png(state_->path, blank_frame(format.layout, format.size_px, format.color), number);
  });
}

Result<void> VideoWriter::finish() {
  ENSURE(!state_->finished);
  state_->finished = true;
  return guarded([this] { return state_->file ? state_->file->finish() : Result<void>(); });
}

const char* extension_of(Container container) {
  switch (container) {
    case Container::mkv:
      return "mkv";
    case Container::mp4:
      return "mp4";
    case Container::avi:
      return "avi";
  }
  return "";
}

}  // namespace sigs
