// SPDX-License-Identifier: MIT
#include "video/clips.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
}

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>

#include "support/test_data.h"

namespace sigs::test {
namespace {

Samples image_samples(const AVFrame& image) {
  const auto format = static_cast<AVPixelFormat>(image.format);
  const int size = av_image_get_buffer_size(format, image.width, image.height, 1);
  Samples samples(static_cast<size_t>(size));
  av_image_copy_to_buffer(samples.data(), size, image.data, image.linesize, format, image.width, image.height, 1);
  return samples;
}

void receive(AVCodecContext* decoder, AVFrame* image, double tick_s, WholeDecode& decode) {
  while (avcodec_receive_frame(decoder, image) == 0) {
    decode.images.push_back(image_samples(*image));
    decode.times_s.push_back(static_cast<double>(image->best_effort_timestamp) * tick_s);
  }
}

// 32-bit mixing of an image's coordinates, so that the noise is the same wherever the test runs.
uint32_t grain(uint32_t x, uint32_t y, uint32_t number) {
  uint32_t h = x * 374761393U + y * 668265263U + number * 2246822519U;
  h = (h ^ (h >> 13)) * 1274126177U;
  return h ^ (h >> 16);
}

}  // namespace

ColorInfo color_info(ColorRange range, ColorMatrix matrix, ChromaSite site) {
  return {.range = range, .matrix = matrix, .chroma_site = site};
}

bool warns(const VideoInfo& info, const std::string& what) {
  return std::any_of(info.warnings.begin(), info.warnings.end(),
                     [&](const Warning& warning) { return warning.what.find(what) != std::string::npos; });
}

Samples samples_of(const Frame& frame) {
  Samples samples;
  for (const cv::Mat& plane : frame.planes)
    for (int y = 0; y < plane.rows; ++y)
      samples.insert(samples.end(), plane.ptr<uchar>(y), plane.ptr<uchar>(y) + plane.cols * plane.elemSize());
  return samples;
}

WholeDecode whole_decode(const std::filesystem::path& path) {
  WholeDecode decode;
  av_log_set_level(AV_LOG_QUIET);
  AVFormatContext* input = nullptr;
  REQUIRE(avformat_open_input(&input, path.c_str(), nullptr, nullptr) >= 0);
  REQUIRE(avformat_find_stream_info(input, nullptr) >= 0);
  const AVCodec* codec = nullptr;
  const int index = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  REQUIRE(index >= 0);
  AVCodecContext* decoder = avcodec_alloc_context3(codec);
  avcodec_parameters_to_context(decoder, input->streams[index]->codecpar);
  decoder->thread_count = 1;
  decoder->pkt_timebase = input->streams[index]->time_base;
  REQUIRE(avcodec_open2(decoder, codec, nullptr) >= 0);
  const double tick_s = av_q2d(input->streams[index]->time_base);
  AVPacket* packet = av_packet_alloc();
  AVFrame* image = av_frame_alloc();
  for (int result = 0; (result = av_read_frame(input, packet)) != AVERROR_EOF;) {
    if (result < 0) break;
    if (packet->stream_index == index && packet->size > 0) {
      avcodec_send_packet(decoder, packet);
      receive(decoder, image, tick_s, decode);
    }
    av_packet_unref(packet);
  }
  avcodec_send_packet(decoder, nullptr);
  receive(decoder, image, tick_s, decode);
  if (!decode.times_s.empty()) {
    const double begin_s = decode.times_s.front();
    for (double& time_s : decode.times_s) time_s -= begin_s;
  }
  av_frame_free(&image);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&input);
  return decode;
}

std::vector<PacketPlace> packets_of(const std::filesystem::path& path) {
  const std::vector<uint8_t> bytes = bytes_of(path);
  std::vector<PacketPlace> places;
  AVFormatContext* input = nullptr;
  REQUIRE(avformat_open_input(&input, path.c_str(), nullptr, nullptr) >= 0);
  REQUIRE(avformat_find_stream_info(input, nullptr) >= 0);
  const int index = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  AVPacket* packet = av_packet_alloc();
  while (av_read_frame(input, packet) >= 0) {
    if (packet->stream_index == index) {
      const auto found = std::search(bytes.begin(), bytes.end(), packet->data, packet->data + packet->size);
      REQUIRE(found != bytes.end());
      places.push_back({static_cast<size_t>(found - bytes.begin()), static_cast<size_t>(packet->size)});
    }
    av_packet_unref(packet);
  }
  av_packet_free(&packet);
  avformat_close_input(&input);
  return places;
}

bool run_ffmpeg(const std::string& arguments) {
  const std::string command = "ffmpeg -nostdin -hide_banner -loglevel quiet -y " + arguments;
  if (std::system(command.c_str()) == 0) return true;
  say_skipped("the ffmpeg program is missing or cannot do: " + arguments);
  return false;
}

bool make_clip(const std::string& options, const std::filesystem::path& path, const std::string& filter) {
  const std::string image = filter.empty() ? "testsrc2=size=128x96:rate=25:duration=2" : filter;
  return run_ffmpeg("-f lavfi -i \"" + image + "\" -threads 1 " + options + " \"" + path.string() + "\"");
}

Frame test_frame(PixelLayout layout, cv::Size size_px, int number, const ColorInfo& color, int bit_depth) {
  Frame frame;
  frame.layout = layout;
  frame.bit_depth = bit_depth;
  frame.color = color;
  frame.time_s = number / 25.0;
  const cv::Size step = chroma_step(layout);
  for (int i = 0; i < frame.plane_count(); ++i) {
    const bool is_chroma = i > 0 && layout != PixelLayout::rgb;
    const cv::Size size = is_chroma ? cv::Size((size_px.width + step.width - 1) / step.width,
                                               (size_px.height + step.height - 1) / step.height)
                                    : size_px;
    cv::Mat plane(size, bit_depth > 8 ? CV_16UC1 : CV_8UC1);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const uint32_t noise =
            grain(static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(3 * number + i));
        const int code = 40 + 20 * i + (3 * x + 2 * y + 5 * number) % 120 + static_cast<int>(noise % 16);
        if (bit_depth > 8)
          plane.at<ushort>(y, x) =
              static_cast<ushort>(code << (bit_depth - 8) | (noise >> 8) % (1U << (bit_depth - 8)));
        else
          plane.at<uchar>(y, x) = static_cast<uchar>(code);
      }
    frame.planes[static_cast<size_t>(i)] = plane;
  }
  return frame;
}

void write_clip(const std::filesystem::path& path, const VideoFormat& format, int count) {
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) FAIL(writer.error().text());
  for (int n = 0; n < count; ++n) {
    Frame frame = test_frame(format.layout, format.size_px, n, format.color, format.bit_depth);
    frame.time_s = static_cast<double>(n) * format.frame_rate_den / format.frame_rate_num;
    const Result<void> written = writer->write(frame, n);
    if (!written) FAIL(written.error().text());
  }
  const Result<void> finished = writer->finish();
  if (!finished) FAIL(finished.error().text());
}

FrameSource opened(const std::filesystem::path& path) {
  Result<FrameSource> source = FrameSource::open(path);
  if (!source) FAIL(source.error().text());
  return std::move(*source);
}

namespace {

void check_frame(FrameSource& source, const WholeDecode& truth, int n) {
  const Result<Frame> frame = source.read(n);
  if (!frame) FAIL(frame.error().text());
  CAPTURE(n);
  CHECK(!frame->damaged);
  const bool same = samples_of(*frame) == truth.images[static_cast<size_t>(n)];
  CHECK(same);
}

}  // namespace

void check_against(FrameSource& source, const WholeDecode& truth) {
  REQUIRE(source.info().frame_count() == static_cast<int>(truth.images.size()));
  const int count = source.info().frame_count();
  for (int n = 0; n < count; ++n) check_frame(source, truth, n);
  for (int n = count - 1; n >= 0; --n) check_frame(source, truth, n);
  for (const int n : shuffled(count)) check_frame(source, truth, n);
}

std::vector<uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& path, const std::vector<uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// std::shuffle differs between standard libraries; a step that shares no factor with count visits each once.
std::vector<int> shuffled(int count) {
  int step = 37;
  while (std::gcd(step, count) != 1) ++step;
  std::vector<int> order;
  for (int i = 0; i < count; ++i) order.push_back((i * step + count / 2) % count);
  return order;
}

}  // namespace sigs::test
