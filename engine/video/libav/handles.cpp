// SPDX-License-Identifier: MIT
#include "video/libav/handles.h"

#include <array>

#include "base/ensure.h"

namespace sigs::libav {

void Deleter::operator()(AVFormatContext* context) const {
  avformat_close_input(&context);
}
void Deleter::operator()(AVCodecContext* context) const {
  avcodec_free_context(&context);
}
void Deleter::operator()(AVPacket* packet) const {
  av_packet_free(&packet);
}
void Deleter::operator()(AVFrame* frame) const {
  av_frame_free(&frame);
}
void Deleter::operator()(SwsContext* context) const {
  sws_freeContext(context);
}

PacketPtr new_packet() {
  PacketPtr packet(av_packet_alloc());
  ENSURE(packet != nullptr);
  return packet;
}

FramePtr new_frame() {
  FramePtr frame(av_frame_alloc());
  ENSURE(frame != nullptr);
  return frame;
}

std::string text_of(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

std::string url_of(const std::filesystem::path& path) {
  return "file:" + path.string();
}

void silence() {
  av_log_set_level(AV_LOG_QUIET);
}

}  // namespace sigs::libav
