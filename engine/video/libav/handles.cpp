// SPDX-License-Identifier: MIT
#include "video/libav/handles.h"

extern "C" {
#include <libavutil/imgutils.h>
}

#include <algorithm>
#include <cstdarg>
#include <new>
#include <utility>

namespace sigs::libav {
namespace {

constexpr std::string_view kGap = "Frame num gap";  // H.264: a reference image is missing; FFmpeg fills in another

// Reports at the level of errors that occur with intact footage too: supplemental information that FFmpeg cannot parse,
// references to images before a start in the middle of the file.
constexpr std::string_view kHarmless[] = {"SEI type", "mmco: unref", "number of reference frames"};

// FFmpeg reports the concealment of damaged macroblocks at the level of information only.
bool is_decoder_error(int level, std::string_view format) {
  for (const std::string_view begin : kHarmless)
    if (format.starts_with(begin)) return false;
  return level <= AV_LOG_ERROR || format.starts_with("concealing") || format.starts_with(kGap);
}

// Called from FFmpeg's own threads. A threaded decoder's contexts are copies of the one that was opened.
void note_decoder_error(void* source, int level, const char* format, va_list /*values*/) {
  if (source == nullptr || !is_decoder_error(level, format)) return;
  if (*static_cast<const AVClass**>(source) != avcodec_get_class()) return;
  void* tag = static_cast<const AVCodecContext*>(source)->opaque;
  if (tag != nullptr) DecoderErrors::report(tag, std::string_view(format).starts_with(kGap));
}

}  // namespace

PacketPtr new_packet() {
  PacketPtr packet(av_packet_alloc());
  if (packet == nullptr) throw std::bad_alloc();
  return packet;
}

PacketPtr new_packet(std::string_view bytes) {
  PacketPtr packet = new_packet();
  if (av_new_packet(packet.get(), static_cast<int>(bytes.size())) < 0) throw std::bad_alloc();
  std::copy(bytes.begin(), bytes.end(), packet->data);
  return packet;
}

CodecPtr new_context(const AVCodec* codec) {
  CodecPtr context(avcodec_alloc_context3(codec));
  if (context == nullptr) throw std::bad_alloc();
  return context;
}

FramePtr new_frame() {
  FramePtr frame(av_frame_alloc());
  if (frame == nullptr) throw std::bad_alloc();
  return frame;
}

std::size_t bytes_of(const AVFrame& frame) {
  const int bytes = av_image_get_buffer_size(static_cast<AVPixelFormat>(frame.format), frame.width, frame.height, 1);
  return static_cast<std::size_t>(std::max(bytes, 1));
}

std::string text_of(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

void check_memory(int error) {
  if (error == AVERROR(ENOMEM)) throw std::bad_alloc();
}

Error named(Error error, const std::filesystem::path& path) {
  if (error.where.empty() && error.kind != ErrorKind::interrupted) error.where = path.string();
  return error;
}

std::string url_of(const std::filesystem::path& path) {
  return "file:" + path.string();
}

void silence() {
  av_log_set_callback(note_decoder_error);
}

void DecoderErrors::restart(int first) {
  const std::lock_guard lock(mutex_);
  first_ = first;
  ordinals_.clear();
}

void* DecoderErrors::tag_of(int ordinal) {
  Tag& tag = tags_[static_cast<size_t>(ordinal) % tags_.size()];
  tag = {this, ordinal};
  return &tag;
}

std::vector<int> DecoderErrors::taken() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ordinals_, {});
}

void DecoderErrors::report(void* tag, bool of_a_gap) {
  const Tag named = *static_cast<const Tag*>(tag);
  const std::lock_guard lock(named.decoder_errors->mutex_);
  if (of_a_gap && named.ordinal <= named.decoder_errors->first_) return;
  named.decoder_errors->ordinals_.push_back(named.ordinal);
}

}  // namespace sigs::libav
