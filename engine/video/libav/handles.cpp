// SPDX-License-Identifier: MIT
#include "video/libav/handles.h"

#include <array>
#include <cstdarg>
#include <new>
#include <string_view>

namespace sigs::libav {
namespace {

// Patching up the macroblocks of a damaged picture is no more than information to FFmpeg.
bool is_complaint(int level, const char* format) {
  return level <= AV_LOG_ERROR || std::string_view(format).starts_with("concealing");
}

// Called from FFmpeg's own threads. A threaded decoder's contexts are copies of the one that was opened.
void note_complaint(void* source, int level, const char* format, va_list /*values*/) {
  if (source == nullptr || !is_complaint(level, format)) return;
  if (*static_cast<const AVClass**>(source) != avcodec_get_class()) return;
  const auto* context = static_cast<const AVCodecContext*>(source);
  if (context->opaque != nullptr) static_cast<Complaint*>(context->opaque)->store(true);
}

}  // namespace

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
  if (packet == nullptr) throw std::bad_alloc();
  return packet;
}

FramePtr new_frame() {
  FramePtr frame(av_frame_alloc());
  if (frame == nullptr) throw std::bad_alloc();
  return frame;
}

std::string text_of(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

void check_memory(int error) {
  if (error == AVERROR(ENOMEM)) throw std::bad_alloc();
}

std::string url_of(const std::filesystem::path& path) {
  return "file:" + path.string();
}

void silence() {
  av_log_set_callback(note_complaint);
}

}  // namespace sigs::libav
