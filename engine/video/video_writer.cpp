// SPDX-License-Identifier: MIT
#include "video/video_writer.h"

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "base/ensure.h"
#include "base/result.h"
#include "base/threads.h"
#include "video/image_folder.h"
#include "video/libav/video_file.h"
#include "video/y4m_file.h"

namespace sigs {

namespace fs = std::filesystem;

struct VideoWriter::State {
  fs::path path;
  VideoFormat format;
  std::optional<libav::VideoFile> file;  // empty: another one
  std::optional<Y4mFile> y4m;            // empty: another one, or a folder of images
  bool finished = false;
};

Result<VideoWriter> VideoWriter::open(const fs::path& path, const VideoFormat& format) {
  auto state = std::make_unique<State>();
  state->path = path;
  state->format = format;
  if (writes_images(format.codec)) {
    std::error_code code;
    if (!fs::is_directory(path, code))
      return fail(path.string(), "no such folder to write images into", ErrorKind::cannot_create);
    return VideoWriter(std::move(state));
  }
  if (format.container == Container::y4m) {
    Result<OutputStream> out = OutputStream::create(path);
    if (!out) return fail(out.error());
    return open_stream(std::move(*out), format);
  }
  Result<libav::VideoFile> file = guarded([&] { return libav::VideoFile::create(path, format); });
  if (!file) return fail(file.error());
  state->file.emplace(std::move(*file));
  return VideoWriter(std::move(state));
}

Result<VideoWriter> VideoWriter::open_stream(OutputStream out, const VideoFormat& format) {
  auto state = std::make_unique<State>();
  state->path = out.name();
  state->format = format;
  return guarded([&]() -> Result<VideoWriter> {
    if (format.container == Container::y4m) {
      Result<Y4mFile> file = Y4mFile::begin(std::move(out), format);
      if (!file) return fail(file.error());
      state->y4m.emplace(std::move(*file));
    } else {
      Result<libav::VideoFile> file = libav::VideoFile::create(std::move(out), format);
      if (!file) return fail(file.error());
      state->file.emplace(std::move(*file));
    }
    return VideoWriter(std::move(state));
  });
}

VideoWriter::VideoWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

void VideoWriter::warm_up() {
  if (!state_->file) return;
  // A failure for lack of memory is not reported here: it fails again where it is needed.
  static_cast<void>(guarded([this]() -> Result<void> {
    state_->file->warm_up();
    return {};
  }));
}

Result<void> VideoWriter::write(const Frame& frame, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write(frame);
    if (state_->y4m) return state_->y4m->write(frame);
    return write_numbered_image(state_->path, state_->format, frame, number);
  });
}

Result<void> VideoWriter::write_blank(double time_s, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write_blank(time_s);
    const VideoFormat& format = state_->format;
    Frame blank = blank_frame(format.layout, format.size_px, format.color, format.bit_depth);
    if (state_->y4m) return state_->y4m->write(blank);
    return write_numbered_image(state_->path, format, blank, number);
  });
}

Result<void> VideoWriter::finish() {
  ENSURE(!state_->finished);
  state_->finished = true;
  return guarded([this] {
    if (state_->y4m) return state_->y4m->finish();
    return state_->file ? state_->file->finish() : Result<void>();
  });
}

int max_bit_depth(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::ffv1:
    case VideoCodec::png:
    case VideoCodec::tiff:
    case VideoCodec::raw:
      return 16;
    case VideoCodec::hevc:
    case VideoCodec::av1:
      return 12;
    case VideoCodec::h264:
      return 10;
    case VideoCodec::mjpeg:
    case VideoCodec::jpeg:
      break;
  }
  return 8;
}

const char* name_of(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::ffv1:
      return "ffv1";
    case VideoCodec::h264:
      return "h264";
    case VideoCodec::hevc:
      return "hevc";
    case VideoCodec::av1:
      return "av1";
    case VideoCodec::mjpeg:
      return "mjpeg";
    case VideoCodec::png:
      return "png";
    case VideoCodec::tiff:
      return "tiff";
    case VideoCodec::jpeg:
      return "jpeg";
    case VideoCodec::raw:
      return "raw";
  }
  return "";
}

int max_crf(VideoCodec codec) {
  if (codec == VideoCodec::av1) return 63;
  return codec == VideoCodec::h264 || codec == VideoCodec::hevc ? 51 : 0;
}

const char* extension_of(Container container) {
  switch (container) {
    case Container::mkv:
      return "mkv";
    case Container::mp4:
      return "mp4";
    case Container::avi:
      return "avi";
    case Container::nut:
      return "nut";
    case Container::y4m:
      return "y4m";
  }
  return "";
}

}  // namespace sigs
