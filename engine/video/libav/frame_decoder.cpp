// SPDX-License-Identifier: MIT
#include "video/libav/frame_decoder.h"

#include <utility>

namespace sigs::libav {

Result<void> FrameDecoder::start(int ordinal, const DecoderSettings& settings, std::optional<int> end) {
  // A fresh decoder for each start: what a flushed one keeps of its past differs from codec to codec.
  Result<CodecPtr> decoder = open_decoder(*reader_.demuxer().stream().codecpar, settings);
  if (!decoder) return fail(decoder.error());
  decoder_ = std::move(*decoder);  // the threads of the one before have ended
  fed_ = ordinal - 1;
  end_ = end.value_or(table_->size());
  decoder_errors_->restart(ordinal);
  in_work_.clear();
  damaged_.clear();
  return reader_.go_to(ordinal);
}

Result<void> FrameDecoder::feed() {
  Result<std::optional<int>> ordinal = std::optional<int>();
  if (fed_ + 1 < end_) ordinal = reader_.next(*packet_);
  if (!ordinal) return fail(ordinal.error());
  if (!*ordinal) {
    avcodec_send_packet(decoder_.get(), nullptr);
    return {};
  }
  fed_ = **ordinal;
  if (packet_->size == 0) return {};  // a frame left out; to the decoder an empty packet means the end
  if ((*table_)[fed_].corrupt) note_damage(fed_);
  // The decoder hands time stamps through to the images. Ours is the ordinal: every container has it, and it is
  // unique.
  packet_->pts = packet_->dts = fed_;
  decoder_->opaque = decoder_errors_->tag_of(fed_);
  // FFmpeg waits for each image of FFV1, threads or not.
  const bool one_by_one =
      (decoder_->active_thread_type & FF_THREAD_FRAME) == 0 || decoder_->codec_id == AV_CODEC_ID_FFV1;
  while (in_work_.size() >= static_cast<size_t>(one_by_one ? 1 : decoder_->thread_count)) in_work_.pop_front();
  in_work_.push_back(fed_);
  const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
  check_memory(sent);
  if (sent < 0) note_refusal();
  note_decoder_errors();
  return {};
}

void FrameDecoder::note_damage(int ordinal) {
  damaged_.insert(ordinal);
}

void FrameDecoder::note_decoder_errors() {
  for (const int ordinal : decoder_errors_->taken()) note_damage(ordinal);
}

// An error that comes back is about the packet that has been in work for longest.
void FrameDecoder::note_refusal() {
  note_damage(in_work_.empty() ? fed_ : in_work_.front());
}

Result<std::optional<DecodedFrame>> FrameDecoder::next() {
  while (true) {
    FramePtr frame = new_frame();
    const int result = avcodec_receive_frame(decoder_.get(), frame.get());
    note_decoder_errors();
    check_memory(result);
    if (result == 0) {
      const int64_t stamp = frame->pts != AV_NOPTS_VALUE ? frame->pts : frame->pkt_dts;
      if (stamp < 0 || stamp >= table_->size()) continue;
      DecodedFrame image{.frame = std::move(frame), .ordinal = static_cast<int>(stamp)};
      if (is_damaged(*image.frame)) note_damage(image.ordinal);
      return std::optional<DecodedFrame>(std::move(image));
    }
    if (result == AVERROR_EOF) return std::optional<DecodedFrame>();
    if (result == AVERROR(EAGAIN)) {
      if (const Result<void> fed = feed(); !fed) return fail(fed.error());
    } else {
      note_refusal();
      if (fed_ + 1 >= end_ && !in_work_.empty()) in_work_.pop_front();
    }
  }
}

}  // namespace sigs::libav
