// SPDX-License-Identifier: MIT
#include "occlusion/synthetic_clip.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace sigs::test {

namespace {

constexpr int kPxPerFrame = 3;
const cv::Size kCloudsSize{640, 480};

void write_clip(const std::filesystem::path& path, VideoFormat format, int frames,
                const std::function<cv::Mat(int)>& luma) {
  format.size_px = luma(0).size();
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) throw std::runtime_error(writer.error().text());
  for (int n = 0; n < frames; ++n) {
    Frame frame = blank_frame(format.layout, format.size_px, format.color);
    frame.planes[0] = luma(n);
    frame.planes[1].setTo(128);
    frame.planes[2].setTo(128);
    frame.time_s = n * 0.04;
    if (!writer->write(frame, n)) throw std::runtime_error("clip");
  }
  if (!writer->finish()) throw std::runtime_error("clip");
}

// Sum of octaves of smoothly interpolated random values, the finest 1 px apart, each twice as wide and as strong as the
// one before; from -0.5 to 0.5.
cv::Mat smoothed_noise(cv::Size size, int octaves, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat sum = cv::Mat::zeros(size, CV_32FC1);
  for (int octave = 0; octave < octaves; ++octave) {
    const int cell = 1 << octave;
    cv::Mat coarse(size.height / cell + 4, size.width / cell + 4, CV_32FC1);
    random.fill(coarse, cv::RNG::UNIFORM, -cell, cell);
    cv::Mat fine;
    cv::resize(coarse, fine, {}, cell, cell, cv::INTER_CUBIC);
    sum += fine(cv::Rect({cell, cell}, size));
  }
  cv::normalize(sum, sum, -0.5, 0.5, cv::NORM_MINMAX);
  return sum;
}

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
  write_clip(path, {.codec = VideoCodec::ffv1, .container = Container::mkv}, frames, luma);
}

void write_h264_clip(const std::filesystem::path& path, int frames, int crf, const std::function<cv::Mat(int)>& luma) {
  write_clip(path, {.codec = VideoCodec::h264, .container = Container::mp4, .crf = crf, .threads = 2}, frames, luma);
}

cv::Mat soft_clouds_body() {
  constexpr int kFine = 4;  // by which it is drawn larger: half-covered pixels get their share
  cv::Mat fine = cv::Mat::zeros(kCloudsSize * kFine, CV_8UC1);
  cv::ellipse(fine, cv::Point(320, 490) * kFine, cv::Size(173, 130) * kFine, 0, 0, 360, 255, cv::FILLED);
  const std::vector<cv::Point> boom{
      cv::Point(312, 400) * kFine, {316 * kFine, 216 * kFine}, {324 * kFine, 216 * kFine}, {328 * kFine, 400 * kFine}};
  cv::fillConvexPoly(fine, boom, 255);
  cv::Mat body;
  cv::resize(fine, body, kCloudsSize, 0, 0, cv::INTER_AREA);
  return body >= 128;
}

std::function<cv::Mat(int)> soft_clouds_luma(const SoftClouds& settings) {
  const cv::Size sky_size(kCloudsSize.width + settings.px_per_frame * settings.frames, kCloudsSize.height);
  const cv::Mat sky = smoothed_noise(sky_size, 8, 5) * settings.cloud_contrast + 150;
  const cv::Mat paint = smoothed_noise(kCloudsSize, 7, 6) * settings.paint_contrast + 110;
  const cv::Mat body = settings.has_body ? soft_clouds_body() : cv::Mat(cv::Mat::zeros(kCloudsSize, CV_8UC1));
  return [settings, sky, paint, body](int n) {
    cv::Mat frame = sky(cv::Rect({settings.px_per_frame * n, 0}, kCloudsSize)).clone();
    paint.copyTo(frame, body);
    frame *= 1 + settings.exposure * std::sin(0.08 * n);
    cv::RNG random(static_cast<std::uint64_t>(n) + 1000);
    cv::Mat grain(kCloudsSize, CV_32FC1);
    random.fill(grain, cv::RNG::NORMAL, 0, 3);
    cv::Mat luma;
    cv::Mat(frame + grain).convertTo(luma, CV_8U);
    return luma;
  };
}

void write_flight(const std::filesystem::path& path, int frames, cv::Size size_px) {
  write_luma_clip(path, frames, [size_px](int n) { return flight_luma(n, size_px); });
}

}  // namespace sigs::test
