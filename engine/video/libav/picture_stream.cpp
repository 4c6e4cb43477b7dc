// SPDX-License-Identifier: MIT
#include "video/libav/picture_stream.h"

#include <algorithm>
#include <utility>

namespace sigs::libav {

Result<void> PictureStream::start(int ordinal, const DecoderSettings& settings) {
  // A fresh decoder for each start: what a flushed one keeps of its past differs from codec to codec.
  Result<CodecPtr> decoder = open_decoder(*reader_.demuxer().stream().codecpar, settings, *complaint_);
  if (!decoder) return fail(decoder.error());
  decoder_ = std::move(*decoder);
  fed_ = ordinal - 1;
  first_damage_.reset();
  complaint_->store(false);
  complained_of_ = -1;
  return reader_.go_to(ordinal);
}

Result<void> PictureStream::feed() {
  Result<std::optional<int>> ordinal = reader_.next(*packet_);
  if (!ordinal) return fail(ordinal.error());
  if (!*ordinal) {
    avcodec_send_packet(decoder_.get(), nullptr);
    return {};
  }
  fed_ = **ordinal;
  if (packet_->size == 0) return {};  // a frame left out; to the decoder an empty packet means the end
  // The decoder hands time stamps through to the pictures. Ours is the ordinal: every container has it, and it is
  // unique.
  packet_->pts = packet_->dts = fed_;
  const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
  check_memory(sent);
  if (sent < 0) note_damage(fed_);
  note_complaint();
  return {};
}

void PictureStream::note_damage(int ordinal) {
  first_damage_ = std::min(first_damage_.value_or(ordinal), ordinal);
}

// With one thread the packet that went in last is meant; with more it is one of the last few.
void PictureStream::note_complaint() {
  if (!complaint_->exchange(false)) return;
  const bool flags_pictures = !is_intra_only(decoder_->codec_id);
  if (!flags_pictures) complained_of_ = fed_;
  if (!flags_pictures || decoder_->thread_count > 1) note_damage(fed_);
}

Picture PictureStream::taken(FramePtr frame) {
  const int64_t stamp = frame->pts != AV_NOPTS_VALUE ? frame->pts : frame->pkt_dts;
  const bool known = stamp >= 0 && stamp < table_->size();
  Picture picture{.frame = std::move(frame), .ordinal = known ? static_cast<int>(stamp) : -1};
  picture.damaged = is_damaged(*picture.frame) ||
                    (known && ((*table_)[picture.ordinal].corrupt || picture.ordinal == complained_of_));
  if (picture.damaged) note_damage(picture.ordinal);
  return picture;
}

Result<std::optional<Picture>> PictureStream::next() {
  while (true) {
    FramePtr frame = new_frame();
    const int result = avcodec_receive_frame(decoder_.get(), frame.get());
    note_complaint();
    check_memory(result);
    if (result == 0) {
      Picture picture = taken(std::move(frame));
      if (picture.ordinal >= 0) return std::optional<Picture>(std::move(picture));
    } else if (result == AVERROR_EOF) {
      return std::optional<Picture>();
    } else if (result == AVERROR(EAGAIN)) {
      if (const Result<void> fed = feed(); !fed) return fail(fed.error());
    } else {
      note_damage(fed_);
    }
  }
}

}  // namespace sigs::libav
