// SPDX-License-Identifier: MIT
#include "video/video_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/image_codecs.h"
#include "base/result.h"
#include "base/threads.h"
#include "video/frame.h"
#include "video/libav/video_file.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// What is written as PNG: one channel for gray, else BGR, of 8 or 16 bits.
cv::Mat png_image(const Frame& frame, int max_bit_depth) {
  cv::Mat image = std::min(frame.bit_depth, max_bit_depth) > 8 ? bgr16_of(frame) : bgr_of(frame);
  if (frame.layout == PixelLayout::gray) cv::extractChannel(image, image, 0);
  return image;
}

// Writes one image as folder/frame_000123.png: gray for gray footage (as full range), else RGB; 16-bit for frames of
// more than 8 bits. Error write_failed.
Result<void> write_png(const fs::path& folder, const Frame& frame, int number, int max_bit_depth) {
  const fs::path path = folder / fmt::format("frame_{:06}.png", number);
  std::vector<uchar> bytes;
  try {
    image_codecs::imencode(".png", png_image(frame, max_bit_depth), bytes);
  } catch (const cv::Exception& problem) {
    return fail(path.string(), "cannot be written as PNG: " + problem.err, ErrorKind::write_failed);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return fail(path.string(), fmt::format("could not be written: {}", std::strerror(errno)), ErrorKind::write_failed);
  return {};
}

}  // namespace

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
  // A failure for lack of memory is not reported here: it fails again where it is needed.
  static_cast<void>(guarded([this]() -> Result<void> {
    state_->file->warm_up();
    return {};
  }));
}

Result<void> VideoWriter::write(const Frame& frame, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    return state_->file ? state_->file->write(frame)
                        : write_png(state_->path, frame, number, state_->format.max_bit_depth);
  });
}

Result<void> VideoWriter::write_blank(double time_s, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write_blank(time_s);
    const VideoFormat& format = state_->format;
    return write_png(state_->path, blank_frame(format.layout, format.size_px, format.color, format.bit_depth), number,
                     format.max_bit_depth);
  });
}

Result<void> VideoWriter::finish() {
  ENSURE(!state_->finished);
  state_->finished = true;
  return guarded([this] { return state_->file ? state_->file->finish() : Result<void>(); });
}

int max_bit_depth(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::ffv1:
    case VideoCodec::png:
      return 16;
    case VideoCodec::hevc:
    case VideoCodec::av1:
      return 12;
    case VideoCodec::h264:
      return 10;
    case VideoCodec::mjpeg:
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
  }
  return "";
}

}  // namespace sigs
