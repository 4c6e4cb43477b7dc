// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>

#include "base/output_stream.h"
#include "base/result.h"
#include "video/frame.h"
#include "video/stream_splice.h"

namespace sigs {

// png, tiff and jpeg: numbered images; raw: uncompressed; source: the footage's own, most of which is copied
// (video/stream_splice.h).
enum class VideoCodec { ffv1, h264, hevc, av1, mjpeg, png, tiff, jpeg, raw, source };
enum class Container { mkv, mp4, avi, nut, y4m, mov };

// What is written, and into which file format.
struct VideoFormat {
  VideoCodec codec = VideoCodec::ffv1;
  Container container = Container::mkv;  // images: of no meaning
  int jpeg_quality = 95;                 // jpeg: 1 to 100
  int crf = 18;                          // h264, hevc: 0 (lossless) to 51; av1: 0 (lossless) to 63
  int threads = 1;                       // of the encoder; the bytes do not depend on their number
  cv::Size size_px;
  PixelLayout layout = PixelLayout::yuv420;
  int bit_depth = 8;       // of the frames
  int max_bit_depth = 16;  // frames of more bits are rounded to this many
  ColorInfo color;
  int frame_rate_num = 25;  // nominal rate; frames carry their own times
  int frame_rate_den = 1;
  int pixel_aspect_num = 1;  // sample aspect ratio
  int pixel_aspect_den = 1;
};

// Writes frames to a file, to a stream or, as images, to a folder. The bytes depend on the format and the frames alone:
// no dates, no machine, no thread count. The caller gives the file its final name (base/staged_outputs.h).
class VideoWriter {
 public:
  //   path  the file to write, whatever its extension; for images the folder, which must exist
  // Errors: usage (codec and container do not go together, as ffv1 and mp4; the codec cannot store the size),
  // unavailable (no such encoder), cannot_create.
  [[nodiscard]] static Result<VideoWriter> open(const std::filesystem::path& path, const VideoFormat& format);

  // The same to a pipe: each frame leaves the process as soon as it is encoded. Containers nut and y4m.
  // Further errors: interrupted.
  [[nodiscard]] static Result<VideoWriter> open_stream(OutputStream out, const VideoFormat& format);

  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  // A copy of the footage with other frames in it (video/stream_splice.h): write() takes those that the plan encodes,
  // in order, and passes over those that it copies; finish() copies the rest, and reads the file once to see that each
  // frame is there at its time. Errors: cannot_create, cannot_read (the footage has changed), unavailable, interrupted.
  [[nodiscard]] static Result<VideoWriter> open_splice(const std::filesystem::path& path, const SplicePlan& plan,
                                                       const std::atomic<bool>* cancel);

  // Prepares in advance what the first images would have to wait for. Optional: the bytes are the same without it.
  void warm_up();

  // Writes the next frame. Its layout, depth and size are those of the format, its time_s is later than that of the
  // frame before.
  //   number  names the image of a sequence: frame_000123.png
  // Errors: write_failed (disk full), bad_data (the time is not later).
  [[nodiscard]] Result<void> write(const Frame& frame, int number);

  // Writes a frame whose samples are all 0; the bytes are those of write(). FFV1 encodes only the first of them.
  [[nodiscard]] Result<void> write_blank(double time_s, int number);

  // Writes what the encoder still has in its buffers, and the end of the container. Without it the file is incomplete.
  // Nothing can be written afterwards. Error write_failed.
  [[nodiscard]] Result<void> finish();

 private:
  struct State;
  explicit VideoWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// The most bits of a sample that a codec stores: ffv1, png, tiff, raw, source 16; hevc, av1 12; h264 10; mjpeg, jpeg 8.
// Deeper frames are rounded to it. Footage of a depth that the codec lacks (9 bits, 14 bits) is stored with the next
// higher one that it has.
[[nodiscard]] int max_bit_depth(VideoCodec codec);

// "h264".
[[nodiscard]] const char* name_of(VideoCodec codec);

// The highest crf of a codec: 51 for h264 and hevc, 63 for av1; 0 for codecs without one.
[[nodiscard]] int max_crf(VideoCodec codec);

// The container that footage is in, of those that the codec source writes: mkv, mp4, mov, avi; mp4 for all others.
[[nodiscard]] Container container_of(const VideoInfo& footage);

// The extension of a container's file name, without the dot: "mkv", "mp4", "avi", "nut", "y4m", "mov".
[[nodiscard]] const char* extension_of(Container container);

// Whether a codec writes a folder of numbered images instead of a video: png, tiff, jpeg.
[[nodiscard]] constexpr bool writes_images(VideoCodec codec) {
  return codec == VideoCodec::png || codec == VideoCodec::tiff || codec == VideoCodec::jpeg;
}

// The extension of its images with the dot: ".png", ".tiff", ".jpg". Empty for the other codecs.
[[nodiscard]] const char* image_extension_of(VideoCodec codec);

}  // namespace sigs
