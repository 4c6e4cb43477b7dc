// SPDX-License-Identifier: MIT
#include "video/libav/frame_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>

#include "base/image_codecs.h"
#include "base/threads.h"
#include "video/libav/stream_info.h"

namespace sigs::libav {
namespace {

Result<CodecPtr> open_decoder(const AVCodecParameters& parameters, DecoderSettings settings) {
  const AVCodec* codec = avcodec_find_decoder(parameters.codec_id);
  if (codec == nullptr)
    return fail("", fmt::format("no decoder for the codec {}", avcodec_get_name(parameters.codec_id)),
                ErrorKind::cannot_read);
  CodecPtr context = new_context(codec);
  int error = avcodec_parameters_to_context(context.get(), &parameters);
  // With several threads it depends on their timing which macroblocks of a damaged MPEG-4 image FFmpeg loses.
  const bool alone =
      parameters.codec_id == AV_CODEC_ID_MPEG4 || (settings.quantisers && !is_intra_only(parameters.codec_id));
  context->thread_count = alone ? 1 : settings.threads;
  if (settings.quantisers) context->export_side_data |= AV_CODEC_EXPORT_DATA_VIDEO_ENC_PARAMS;
  context->has_b_frames = std::max(context->has_b_frames, settings.reorder_depth);
  context->max_pixels = kMaxImagePixels;
  if (error >= 0) error = avcodec_open2(context.get(), codec, nullptr);
  if (error < 0 &&
      std::exchange(settings.threads, 1) > 1)  // perhaps no more threads can be started; one gives the same
    return open_decoder(parameters, settings);
  check_memory(error);
  if (error < 0)
    return fail("", fmt::format("the {} decoder cannot be opened: {}", codec->name, text_of(error)),
                ErrorKind::cannot_read);
  return context;
}

// Whether the decoder has flagged an image as damaged.
bool is_damaged(const AVFrame& frame) {
  return frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
}

constexpr int kMaxSeeks = 5;
constexpr size_t kMaxRecent = 64;
constexpr size_t kMaxRecentBytes = 8 << 20;

// A time at or before the packet's, for seeking: some containers seek by decode time, some by presentation time.
std::optional<int64_t> seek_time(const PacketMark& mark) {
  if (mark.pts == AV_NOPTS_VALUE && mark.dts == AV_NOPTS_VALUE) return {};
  if (mark.pts == AV_NOPTS_VALUE) return mark.dts;
  if (mark.dts == AV_NOPTS_VALUE) return mark.pts;
  return std::min(mark.pts, mark.dts);
}

// Ordinal of the last keyframe before a packet; 0 where there is none.
int key_before(const PacketTable& table, int ordinal) {
  for (int i = ordinal - 1; i > 0; --i)
    if (table[i].key) return i;
  return 0;
}

// Codecs in which one packet is one shown image. This does not hold for MPEG-4 part 2 (packed and empty images), VP8
// (hidden ones), or H.264 in fields (two packets per image).
bool one_frame_per_packet(const AVCodecParameters& parameters) {
  switch (parameters.codec_id) {
    case AV_CODEC_ID_H264:
      return parameters.field_order == AV_FIELD_PROGRESSIVE || parameters.field_order == AV_FIELD_UNKNOWN;
    case AV_CODEC_ID_HEVC:
    case AV_CODEC_ID_VP9:
    case AV_CODEC_ID_AV1:
      return true;
    default:
      return is_intra_only(parameters.codec_id);
  }
}

bool is_in_fields(const AVCodecParameters& parameters) {
  return parameters.field_order != AV_FIELD_PROGRESSIVE && parameters.field_order != AV_FIELD_UNKNOWN;
}

// FFV1 and PNG may refer to the image before, but only in packets that are no keyframes.
bool each_stands_alone(const PacketTable& table, AVCodecID codec) {
  if (is_intra_only(codec)) return true;
  if (codec != AV_CODEC_ID_FFV1 && codec != AV_CODEC_ID_PNG) return false;
  for (int i = 0; i < table.size(); ++i)
    if (!table[i].key) return false;
  return true;
}

bool is_shown(const PacketMark& mark) {
  return !mark.discarded && mark.size > 0;
}

// The largest number of packets that come before another in decoding although they are shown after it: the greatest lag
// of an image's place in presentation behind its place in decoding.
int reorder_depth(const PacketTable& table, const std::vector<int>& ordinals) {
  int deepest = 0;
  std::vector<int> shown;
  for (int i = 0; i < table.size(); ++i)
    if (is_shown(table[i])) shown.push_back(i);
  for (size_t place = 0; place < ordinals.size(); ++place) {
    const auto decoded = std::lower_bound(shown.begin(), shown.end(), ordinals[place]) - shown.begin();
    deepest = std::max(deepest, static_cast<int>(decoded) - static_cast<int>(place));
  }
  return deepest;
}

// When the images are shown, by their time stamps, sorted: decoders give images in the order of their time stamps.
// Decoding times serve as well: they are the same set of instants, earlier by a constant. Nothing where stamps are
// missing or repeated.
std::optional<std::vector<double>> times_by(int64_t PacketMark::*stamp, const PacketTable& table,
                                            const std::vector<int>& ordinals, double tick_s) {
  std::vector<int64_t> stamps;
  for (const int ordinal : ordinals) stamps.push_back(table[ordinal].*stamp);
  std::sort(stamps.begin(), stamps.end());
  if (stamps.empty() || stamps.front() == AV_NOPTS_VALUE) return {};
  if (std::adjacent_find(stamps.begin(), stamps.end()) != stamps.end()) return {};
  std::vector<double> times_s;
  for (const int64_t one : stamps) times_s.push_back(static_cast<double>(one - stamps.front()) * tick_s);
  return times_s;
}

void set_times(FrameOrder& order, const PacketTable& table, double tick_s, double frame_period_s) {
  std::optional<std::vector<double>> times_s = times_by(&PacketMark::pts, table, order.ordinals, tick_s);
  if (!times_s) times_s = times_by(&PacketMark::dts, table, order.ordinals, tick_s);
  order.times_are_nominal = !times_s.has_value();
  if (times_s) order.times_s = *std::move(times_s);
  for (size_t n = 0; order.times_are_nominal && n < order.ordinals.size(); ++n)
    order.times_s.push_back(static_cast<double>(n) * frame_period_s);
}

}  // namespace

bool is_key(const AVFrame& frame) {
#if LIBAVUTIL_VERSION_INT >= AV_VERSION_INT(58, 7, 100)
  return (frame.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return frame.key_frame != 0;
#endif
}

bool is_intra_only(AVCodecID codec) {
  const AVCodecDescriptor* descriptor = avcodec_descriptor_get(codec);
  return descriptor != nullptr && (descriptor->props & AV_CODEC_PROP_INTRA_ONLY) != 0;
}

bool decodes_ahead(AVCodecID codec) {
  const AVCodec* decoder = avcodec_find_decoder(codec);
  return decoder != nullptr && (decoder->capabilities & AV_CODEC_CAP_FRAME_THREADS) != 0;
}

Result<void> PacketReader::reopen() {
  Result<Demuxer> demuxer = demuxer_.reopened(path_);
  if (!demuxer) return fail(demuxer.error());
  demuxer_ = std::move(*demuxer);
  met_ = -1;
  held_ = false;
  sought_ = false;
  return {};
}

bool PacketReader::seek_before(int ordinal) {
  int target = ordinal;
  for (int i = 0; i < kMaxSeeks && target > 0; ++i, target = key_before(*table_, target)) {
    const std::optional<int64_t> time = seek_time((*table_)[target]);
    if (!time || !demuxer_.seek(*time) || !demuxer_.next(*packet_)) return false;
    const std::optional<int> landed = table_->ordinal_of(*packet_);
    if (!landed) return false;
    if (*landed > ordinal) continue;
    met_ = *landed;
    held_ = true;
    sought_ = true;
    return true;
  }
  return false;
}

Result<void> PacketReader::go_to(int ordinal) {
  wanted_ = ordinal;
  if (ordinal <= read_ && ordinal >= read_ - static_cast<int>(recent_.size())) return {};
  recent_.clear();
  recent_bytes_ = 0;
  read_ = ordinal;
  if (ordinal > 0 && seek_before(ordinal)) return {};
  return reopen();
}

// Where memory is short that is the reason: not all demuxers say so.
Error PacketReader::changed() const {
  constexpr std::size_t kEnough_bytes = std::size_t{64} << 20;
  if (!has_free_memory(kEnough_bytes)) throw std::bad_alloc();
  return {path_.string(), "changed while it was being read"};
}

// Reads on up to packet read_, into packet_. False: the file ends before it.
Result<bool> PacketReader::read_on() {
  while (read_ < table_->size()) {
    if (!held_) {
      const bool more = demuxer_.next(*packet_);
      ++met_;
      if (!more || met_ >= table_->size() || !table_->looks_like(met_, *packet_)) {
        if (!sought_) return fail(changed());
        if (const Result<void> opened = reopen(); !opened) return fail(opened.error());
        continue;
      }
    }
    held_ = false;
    if (met_ >= read_) return true;
  }
  return false;
}

void PacketReader::keep() {
  PacketPtr kept = new_packet();
  recent_bytes_ += static_cast<size_t>(packet_->size);
  av_packet_move_ref(kept.get(), packet_.get());
  recent_.push_back(std::move(kept));
  ++read_;
  while (recent_.size() > 1 && (recent_.size() > kMaxRecent || recent_bytes_ > kMaxRecentBytes)) {
    recent_bytes_ -= static_cast<size_t>(recent_.front()->size);
    recent_.pop_front();
  }
}

Result<std::optional<int>> PacketReader::next(AVPacket& packet) {
  if (wanted_ == read_) {
    const Result<bool> more = read_on();
    if (!more) return fail(more.error());
    if (!*more) return std::optional<int>();
    keep();
  }
  av_packet_unref(&packet);
  const auto place = recent_.end() - (read_ - wanted_);
  if (av_packet_ref(&packet, place->get()) < 0) throw std::bad_alloc();
  return wanted_++;
}

Result<void> FrameDecoder::start(int ordinal, const DecoderSettings& settings, std::optional<int> end) {
  // A fresh decoder for each start: what a flushed one keeps differs from codec to codec.
  Result<CodecPtr> decoder = open_decoder(*reader_.demuxer().stream().codecpar, settings);
  if (!decoder) return fail(decoder.error());
  decoder_ = std::move(*decoder);  // the threads of the one before have ended
  fed_ = ordinal - 1;
  end_ = end.value_or(table_->size());
  decoder_errors_->restart(ordinal);
  in_work_.clear();
  damaged_.clear();
  wants_quantisers_ = settings.quantisers;
  tables_.clear();
  quantisers_ = nullptr;
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
  if (packet_->size == 0) return {};  // a dropped frame; to the decoder an empty packet would mean the end
  if ((*table_)[fed_].corrupt) damaged_.insert(fed_);
  if (wants_quantisers_ && decoder_->codec_id == AV_CODEC_ID_MJPEG)
    tables_[fed_] = jpeg_tables_in(packet_->data, static_cast<std::size_t>(packet_->size));
  // The decoder passes the time stamps on to the images. The ordinal is used as the time stamp: it exists for every
  // container and is unique.
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

void FrameDecoder::add_quantisers(DecodedFrame& image) {
  JpegTables tables;
  if (const auto found = tables_.find(image.ordinal); found != tables_.end()) {
    tables = found->second;
    tables_.erase(tables_.begin(), std::next(found));
  }
  image.quantisers = quantisers_of(*image.frame, decoder_->codec_id, tables);
  if (image.quantisers == nullptr && quantisers_ != nullptr && quantisers_->kind == QuantiserKind::mpeg) {
    FrameQuantisers like_before = *quantisers_;
    like_before.type = PictureType::unknown;
    image.quantisers = std::make_shared<const FrameQuantisers>(std::move(like_before));
  }
  quantisers_ = image.quantisers;
}

void FrameDecoder::note_decoder_errors() {
  for (const int ordinal : decoder_errors_->taken()) damaged_.insert(ordinal);
}

// An error that the decoder returns concerns the packet that it has had for longest.
void FrameDecoder::note_refusal() {
  damaged_.insert(in_work_.empty() ? fed_ : in_work_.front());
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
      if (wants_quantisers_) add_quantisers(image);
      if (is_damaged(*image.frame)) damaged_.insert(image.ordinal);
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

std::optional<FrameOrder> order_from_packets(const PacketTable& table, const AVFormatContext& format,
                                             const AVStream& stream) {
  if (!one_frame_per_packet(*stream.codecpar) || !has_true_time_stamps(format)) return {};
  const AVCodecID codec = stream.codecpar->codec_id;
  FrameOrder order{.intra_only = each_stands_alone(table, codec), .decodes_ahead = decodes_ahead(codec)};
  for (int i = 0; i < table.size(); ++i)
    if (is_shown(table[i])) order.ordinals.push_back(i);
  std::stable_sort(order.ordinals.begin(), order.ordinals.end(),
                   [&](int a, int b) { return table[a].pts < table[b].pts; });
  std::optional<std::vector<double>> times_s =
      times_by(&PacketMark::pts, table, order.ordinals, av_q2d(stream.time_base));
  if (!times_s) return {};
  order.times_s = *std::move(times_s);
  for (const int ordinal : order.ordinals) order.can_start.push_back(table[ordinal].key);
  order.reorder_depth = reorder_depth(table, order.ordinals);
  return order;
}

Result<FrameOrder> order_from_decoding(const PacketTable& table, FrameDecoder& images, AVRational frame_rate) {
  // Copied first: each start may open the file again, and the former stream then no longer exists.
  const AVStream& stream = images.demuxer().stream();
  const double tick_s = av_q2d(stream.time_base);
  const AVCodecID codec = stream.codecpar->codec_id;
  const bool in_fields = is_in_fields(*stream.codecpar);
  FrameOrder order;
  const auto decode_all = [&](int threads) -> Result<void> {
    order = {
        .intra_only = each_stands_alone(table, codec), .in_fields = in_fields, .decodes_ahead = decodes_ahead(codec)};
    if (const Result<void> started = images.start(0, {.threads = threads}); !started) return fail(started.error());
    while (true) {
      Result<std::optional<DecodedFrame>> image = images.next();
      if (!image) return fail(image.error());
      if (!*image) return {};
      order.ordinals.push_back((*image)->ordinal);
      order.can_start.push_back(is_key(*(*image)->frame));
    }
  };
  Result<void> decoded = decode_all(2);
  // With two threads the result of a damaged stream can depend on their timing.
  if (decoded && !images.damaged().empty()) decoded = decode_all(1);
  if (!decoded) return fail(decoded.error());
  set_times(order, table, tick_s, 1 / av_q2d(frame_rate));
  return order;
}

}  // namespace sigs::libav
