// SPDX-License-Identifier: MIT
#include "export/raw_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>
}

#include <doctest/doctest.h>

namespace sigs::test {

namespace {

RawImage image_of(const AVFrame& frame, double tick_s) {
  RawImage image{.planes = {}, .time_s = static_cast<double>(frame.best_effort_timestamp) * tick_s};
  const AVPixFmtDescriptor* const format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  REQUIRE((format->flags & AV_PIX_FMT_FLAG_PLANAR || format->nb_components == 1));
  REQUIRE(format->comp[0].depth == 8);
  for (int i = 0; i < format->nb_components; ++i) {
    const bool is_chroma = i > 0 && (format->flags & AV_PIX_FMT_FLAG_RGB) == 0;
    const int width = is_chroma ? AV_CEIL_RSHIFT(frame.width, format->log2_chroma_w) : frame.width;
    const int height = is_chroma ? AV_CEIL_RSHIFT(frame.height, format->log2_chroma_h) : frame.height;
    image.planes.push_back(
        cv::Mat(height, width, CV_8UC1, frame.data[i], static_cast<std::size_t>(frame.linesize[i])).clone());
  }
  return image;
}

void take_images(AVCodecContext* decoder, AVFrame* frame, double tick_s, std::size_t max_images, RawVideo& video) {
  while (avcodec_receive_frame(decoder, frame) == 0) {
    if (video.images.empty()) {
      video.is_full_range = frame->color_range == AVCOL_RANGE_JPEG || frame->format == AV_PIX_FMT_YUVJ420P;
      video.matrix = frame->colorspace;
      video.primaries = frame->color_primaries;
      video.transfer = frame->color_trc;
    }
    if (video.images.size() < max_images) video.images.push_back(image_of(*frame, tick_s));
    av_frame_unref(frame);
  }
}

AVCodecContext* opened_decoder(const AVFormatContext* input, int stream) {
  const AVCodecParameters* const parameters = input->streams[stream]->codecpar;
  const AVCodec* const codec = avcodec_find_decoder(parameters->codec_id);
  AVCodecContext* const decoder = avcodec_alloc_context3(codec);
  REQUIRE(avcodec_parameters_to_context(decoder, parameters) >= 0);
  decoder->thread_count = 1;
  decoder->pkt_timebase = input->streams[stream]->time_base;
  REQUIRE(avcodec_open2(decoder, codec, nullptr) >= 0);
  return decoder;
}

}  // namespace

RawVideo raw_video(const std::filesystem::path& path, int max_images) {
  av_log_set_level(AV_LOG_ERROR);
  AVFormatContext* input = nullptr;
  REQUIRE(avformat_open_input(&input, path.c_str(), nullptr, nullptr) >= 0);
  REQUIRE(avformat_find_stream_info(input, nullptr) >= 0);
  const int stream = av_find_best_stream(input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  REQUIRE(stream >= 0);
  AVCodecContext* decoder = opened_decoder(input, stream);
  const double tick_s = av_q2d(input->streams[stream]->time_base);
  const auto wanted = static_cast<std::size_t>(max_images);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  RawVideo video;
  while (video.images.size() < wanted && av_read_frame(input, packet) >= 0) {
    if (packet->stream_index == stream && avcodec_send_packet(decoder, packet) == 0)
      take_images(decoder, frame, tick_s, wanted, video);
    av_packet_unref(packet);
  }
  avcodec_send_packet(decoder, nullptr);
  take_images(decoder, frame, tick_s, wanted, video);
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&input);
  return video;
}

}  // namespace sigs::test
