// SPDX-License-Identifier: MIT
#include "video/libav/packet_table.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>

extern "C" {
#include <libavutil/crc.h>
}

#include "base/ensure.h"

namespace sigs::libav {

namespace {

// A slice footer: slice_size (3 bytes, big endian, without the footer), error_status (1), slice_crc_parity (4).
constexpr size_t kFooterBytes = 8;

// Whether every slice of an FFV1 version 3 packet has a matching checksum (RFC 9043, section 4.9, slice footer). A
// stream written without checksums never matches. FFmpeg's decoder conceals a damaged slice without a report.
bool ffv1_checksums_match(std::span<const uint8_t> packet) {
  if (packet.empty()) return false;
  const AVCRC* table = av_crc_get_table(AV_CRC_32_IEEE);
  while (!packet.empty()) {
    if (packet.size() < kFooterBytes) return false;
    const auto footer = packet.last(kFooterBytes);
    const size_t slice_bytes = (size_t{footer[0]} << 16 | size_t{footer[1]} << 8 | footer[2]) + kFooterBytes;
    if (slice_bytes > packet.size()) return false;
    // The checksum is chosen so that the whole slice with it has the remainder 0.
    if (av_crc(table, 0, packet.last(slice_bytes).data(), slice_bytes) != 0) return false;
    packet = packet.first(packet.size() - slice_bytes);
  }
  return true;
}

PacketMark mark_of(const AVPacket& packet) {
  return {.pts = packet.pts,
          .dts = packet.dts,
          .file_position = packet.pos,
          .size = packet.size,
          .key = (packet.flags & AV_PKT_FLAG_KEY) != 0,
          .discarded = (packet.flags & AV_PKT_FLAG_DISCARD) != 0,
          .corrupt = (packet.flags & AV_PKT_FLAG_CORRUPT) != 0};
}

// Whether an image that the container calls a keyframe is one by its own header, as far as FFmpeg has a parser for it.
// Some containers call the images of an intra refresh keyframes, or all images.
class KeyCheck {
 public:
  explicit KeyCheck(const AVCodecParameters& parameters) : context_(avcodec_alloc_context3(nullptr)) {
    ENSURE(context_ != nullptr && avcodec_parameters_to_context(context_.get(), &parameters) >= 0);
    parser_.reset(av_parser_init(static_cast<int>(parameters.codec_id)));
    if (parser_ != nullptr) parser_->flags |= PARSER_FLAG_COMPLETE_FRAMES;
  }

  [[nodiscard]] bool allows(const AVPacket& packet) {
    if (parser_ == nullptr) return true;
    uint8_t* data = nullptr;
    int size = 0;
    parser_->pict_type = AV_PICTURE_TYPE_NONE;
    av_parser_parse2(parser_.get(), context_.get(), &data, &size, packet.data, packet.size, packet.pts, packet.dts,
                     packet.pos);
    return parser_->pict_type != AV_PICTURE_TYPE_P && parser_->pict_type != AV_PICTURE_TYPE_B;
  }

 private:
  struct Close {
    void operator()(AVCodecParserContext* parser) const { av_parser_close(parser); }
  };
  CodecPtr context_;
  std::unique_ptr<AVCodecParserContext, Close> parser_;
};

// Marks the packets whose checksums do not match. A stream in which none match has no checksums.
void mark_corrupt(std::vector<PacketMark>& marks, const std::vector<bool>& checksums_match) {
  if (std::find(checksums_match.begin(), checksums_match.end(), true) == checksums_match.end()) return;
  for (size_t i = 0; i < marks.size(); ++i)
    if (!checksums_match[i]) marks[i].corrupt = true;
}

}  // namespace

PacketTable PacketTable::read(Demuxer& demuxer) {
  PacketTable table;
  const bool is_ffv1 = demuxer.stream().codecpar->codec_id == AV_CODEC_ID_FFV1;
  std::vector<bool> checksums_match;
  KeyCheck key_check(*demuxer.stream().codecpar);
  const PacketPtr packet = new_packet();
  while (demuxer.next(*packet)) {
    table.marks_.push_back(mark_of(*packet));
    if (table.marks_.back().key && packet->size > 0) table.marks_.back().key = key_check.allows(*packet);
    if (is_ffv1) checksums_match.push_back(ffv1_checksums_match({packet->data, static_cast<size_t>(packet->size)}));
  }
  table.broke_off_ = demuxer.broke_off();
  mark_corrupt(table.marks_, checksums_match);
  table.sort_by_position();
  return table;
}

void PacketTable::sort_by_position() {
  by_position_.resize(marks_.size());
  std::iota(by_position_.begin(), by_position_.end(), 0);
  std::stable_sort(by_position_.begin(), by_position_.end(),
                   [&](int a, int b) { return (*this)[a].file_position < (*this)[b].file_position; });
}

bool PacketTable::any_corrupt() const {
  return std::any_of(marks_.begin(), marks_.end(), [](const PacketMark& mark) { return mark.corrupt; });
}

bool PacketTable::looks_like(int ordinal, const AVPacket& packet) const {
  const PacketMark& mark = (*this)[ordinal];
  return mark.file_position == packet.pos && mark.size == packet.size && mark.pts == packet.pts;
}

bool PacketTable::matches(int ordinal, const AVPacket& packet) const {
  return packet.pos >= 0 && looks_like(ordinal, packet);
}

std::optional<int> PacketTable::ordinal_of(const AVPacket& packet) const {
  const auto first =
      std::lower_bound(by_position_.begin(), by_position_.end(), packet.pos,
                       [&](int ordinal, int64_t position) { return (*this)[ordinal].file_position < position; });
  std::optional<int> found;
  for (auto it = first; it != by_position_.end() && (*this)[*it].file_position == packet.pos; ++it) {
    if (!matches(*it, packet)) continue;
    if (found) return {};  // an edit list may present the same bytes twice
    found = *it;
  }
  return found;
}

}  // namespace sigs::libav
