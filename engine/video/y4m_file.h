// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/output_stream.h"
#include "base/result.h"
#include "video/video_writer.h"

namespace sigs {

// Uncompressed video as mjpegtools, FFmpeg and GStreamer exchange it (yuv4mpeg(5)): a line of text with size, rate and
// layout, then for each frame "FRAME", a line break and its planes, samples of more than 8 bits in words of 16. Frames
// have no times: they come at the nominal rate. Matrix, primaries and transfer have no place in it; range and chroma
// site have.
class Y4mFile {
 public:
  // Writes the first line. Errors: usage (RGB, which it has no layout for), write_failed, interrupted.
  [[nodiscard]] static Result<Y4mFile> begin(OutputStream out, const VideoFormat& format);

  // Each frame leaves the process before the function returns. Errors: write_failed, interrupted.
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> finish() { return out_.close(); }

 private:
  Y4mFile(OutputStream out, int bit_depth) : out_(std::move(out)), bit_depth_(bit_depth) {}

  OutputStream out_;
  int bit_depth_ = 8;  // that is written
  std::string bytes_;  // of one frame, reused
};

}  // namespace sigs
