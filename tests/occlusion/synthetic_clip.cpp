// SPDX-License-Identifier: MIT
#include "occlusion/synthetic_clip.h"

#include <stdexcept>

namespace sigs::test {

namespace {

constexpr int kPxPerFrame = 3;

}  // namespace

cv::Rect block_in(cv::Size size_px) {
  return {size_px.width / 4, size_px.height / 2, size_px.width / 2, size_px.height - size_px.height / 2};
}

cv::Mat flight_luma(int frame, cv::Size size_px) {
  cv::Mat luma(size_px, CV_8UC1);
  cv::RNG chance(7);
  cv::Mat land(size_px.height, 1024, CV_8UC1);
  chance.fill(land, cv::RNG::UNIFORM, 90, 200);
  for (int x = 0; x < size_px.width; ++x) land.col((x + kPxPerFrame * frame) % land.cols).copyTo(luma.col(x));
  luma(block_in(size_px)).setTo(40);
  return luma;
}

void write_luma_clip(const std::filesystem::path& path, int frames, const std::function<cv::Mat(int)>& luma) {
  const cv::Size size = luma(0).size();
  const VideoFormat format{.codec = VideoCodec::ffv1, .container = Container::mkv, .size_px = size};
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) throw std::runtime_error(writer.error().text());
  for (int n = 0; n < frames; ++n) {
    Frame frame = blank_frame(format.layout, size, format.color);
    frame.planes[0] = luma(n);
    frame.planes[1].setTo(128);
    frame.planes[2].setTo(128);
    frame.time_s = n * 0.04;
    if (!writer->write(frame, n)) throw std::runtime_error("clip");
  }
  if (!writer->finish()) throw std::runtime_error("clip");
}

void write_flight(const std::filesystem::path& path, int frames, cv::Size size_px) {
  write_luma_clip(path, frames, [size_px](int n) { return flight_luma(n, size_px); });
}

}  // namespace sigs::test
