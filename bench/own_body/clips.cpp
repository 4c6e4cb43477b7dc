// SPDX-License-Identifier: MIT
#include "own_body/clips.h"

#include <algorithm>

#include "accuracy/csv.h"
#include "video/video_writer.h"

namespace sigs::bench {

using accuracy::stop;

void write_h264(const std::filesystem::path& path, cv::Size size_px, int frames,
                const std::function<cv::Mat(int)>& image) {
  constexpr int kRate_hz = 25;
  const VideoFormat format{.codec = VideoCodec::h264,
                           .container = Container::mp4,
                           .crf = kCrf,
                           .threads = 2,
                           .size_px = size_px,
                           .frame_rate_num = kRate_hz};
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) stop(writer.error().text());
  for (int n = 0; n < frames; ++n) {
    Frame frame = frame_of_bgr(image(n), format.layout, format.color);
    frame.time_s = double(n) / kRate_hz;
    if (const Result<void> written = writer->write(frame, n); !written) stop(written.error().text());
  }
  if (const Result<void> finished = writer->finish(); !finished) stop(finished.error().text());
}

Clip encoded_clip(const flights::Flight& flight, int frames, const std::filesystem::path& folder) {
  std::string file = flight.name + ", " + std::to_string(flight.size_px.width);
  std::ranges::replace_if(
      file, [](char c) { return c == ' ' || c == ','; }, '_');
  const std::filesystem::path path = folder / (file + ".mp4");
  write_h264(path, flight.size_px, frames, flight.bgr);
  return {.name = flight.name, .path = path, .own_body = flight.own_body, .is_decidable = flight.is_decidable};
}

FrameSource opened(const std::filesystem::path& path) {
  Result<FrameSource> source = FrameSource::open(path);
  if (!source) stop(source.error().text());
  return std::move(*source);
}

}  // namespace sigs::bench
