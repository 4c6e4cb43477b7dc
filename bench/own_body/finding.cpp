// SPDX-License-Identifier: MIT
#include "own_body/finding.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "accuracy/csv.h"
#include "occlusion/detect.h"
#include "video/video_writer.h"

#include <algorithm>

namespace sigs::bench {

namespace {

// Wall-clock and processor seconds since it was made.
class Watch {
 public:
  [[nodiscard]] Taken taken() const { return {accuracy::wall_s() - wall_s_, accuracy::cpu_s() - cpu_s_}; }

 private:
  double wall_s_ = accuracy::wall_s();
  double cpu_s_ = accuracy::cpu_s();
};

void draw_outline(cv::Mat& image, const cv::Mat& mask, const cv::Scalar& color) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask >= 128, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  cv::drawContours(image, outlines, -1, color, 1);
}

}  // namespace

Finding found_in(const Clip& clip, const OwnBodySettings& settings, KeepStages stages) {
  FrameSource source = opened(clip.path);
  const Watch watch;
  Result<OwnBody> body = detect_own_body(source, 0, settings, {.stages = stages});
  const Taken taken = watch.taken();
  Finding finding{.wall_s = taken.wall_s, .cpu_s = taken.cpu_s};
  if (body)
    finding.body = std::move(*body);
  else
    finding.cannot = body.error().text();
  return finding;
}

Taken decoding_alone(const Clip& clip, int count) {
  FrameSource source = opened(clip.path);
  const Watch watch;
  for (int n = 0; n < count; ++n)
    if (const Result<Frame> frame = source.read(n); !frame) accuracy::stop(frame.error().text());
  return watch.taken();
}

double agreement(const Finding& finding, const Clip& clip) {
  if (!clip.is_decidable) return finding.cannot.empty() ? 0 : 1;
  if (!finding.cannot.empty()) return 0;
  return intersection_over_union(finding.body.mask, clip.own_body);
}

OwnBodySettings with_method(OwnBodyMethod method, int frames) {
  return {.method = method, .frames = frames};
}

const char* name_of(OwnBodyMethod method) {
  return method == OwnBodyMethod::paper ? "paper" : "stable";
}

cv::Mat overlay(const cv::Mat& bgr, const cv::Mat& mask, const cv::Mat& truth) {
  cv::Mat image = bgr.clone();
  cv::Mat tinted = 0.6 * image + cv::Scalar(0, 0, 102);
  tinted.copyTo(image, mask >= 128);
  if (!truth.empty()) draw_outline(image, truth, cv::Scalar(80, 255, 80));
  draw_outline(image, mask, cv::Scalar(60, 60, 255));
  return image;
}

void write_image(const std::filesystem::path& path, const cv::Mat& image) {
  std::filesystem::create_directories(path.parent_path());
  if (!cv::imwrite(path.string(), image)) accuracy::stop(path.string() + ": cannot be written");
}

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
