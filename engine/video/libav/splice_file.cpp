// SPDX-License-Identifier: MIT
#include "video/libav/splice_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"

namespace sigs::libav {
namespace {

namespace fs = std::filesystem;

// So many pictures wait at the begin of a group until it is known what they are quantised by.
constexpr std::size_t kMostWaiting = 8;

AVFormatContext* new_output(const std::string& muxer) {
  AVFormatContext* context = nullptr;
  const int error = avformat_alloc_output_context2(&context, nullptr, muxer.c_str(), nullptr);
  check_memory(error);
  if (error >= 0) context->flags |= AVFMT_FLAG_BITEXACT;
  return context;
}

// Whether a container has this tag for this codec; else it chooses one.
bool knows_tag(const AVOutputFormat& format, const AVCodecParameters& stream) {
  return format.codec_tag == nullptr || av_codec_get_id(format.codec_tag, stream.codec_tag) == stream.codec_id;
}

void copy_side_data(const AVStream& from, AVStream& to) {
  for (int i = 0; i < from.nb_side_data; ++i) {
    const AVPacketSideData& data = from.side_data[i];
    std::uint8_t* const copy = av_stream_new_side_data(&to, data.type, data.size);
    if (copy == nullptr) throw std::bad_alloc();
    std::memcpy(copy, data.data, data.size);
  }
}

// A stream of the output that is like one of the input.
AVStream& add_stream(AVFormatContext& output, const AVStream& from) {
  AVStream* const stream = avformat_new_stream(&output, nullptr);
  if (stream == nullptr || avcodec_parameters_copy(stream->codecpar, from.codecpar) < 0) throw std::bad_alloc();
  if (!knows_tag(*output.oformat, *from.codecpar)) stream->codecpar->codec_tag = 0;
  stream->time_base = from.time_base;
  stream->avg_frame_rate = from.avg_frame_rate;
  stream->r_frame_rate = from.r_frame_rate;
  stream->sample_aspect_ratio = from.sample_aspect_ratio;
  stream->disposition = from.disposition;
  av_dict_copy(&stream->metadata, from.metadata, 0);
  copy_side_data(from, *stream);
  return *stream;
}

void set_header(AVCodecParameters& stream, const Bytes& header) {
  if (header.empty()) return;
  av_freep(&stream.extradata);
  stream.extradata = static_cast<std::uint8_t*>(av_mallocz(header.size() + AV_INPUT_BUFFER_PADDING_SIZE));
  if (stream.extradata == nullptr) throw std::bad_alloc();
  std::copy(header.begin(), header.end(), stream.extradata);
  stream.extradata_size = static_cast<int>(header.size());
}

// FFmpeg's error of writing a header for some streams of the input; 0: there is none.
int error_of_header(const AVFormatContext& input, const std::string& muxer, const std::vector<int>& streams) {
  OutputPtr output(new_output(muxer));
  if (output == nullptr) return AVERROR_MUXER_NOT_FOUND;
  for (const int stream : streams) add_stream(*output, *input.streams[stream]);
  if (avio_open_dyn_buf(&output->pb) < 0) throw std::bad_alloc();
  const int error = avformat_write_header(output.get(), nullptr);
  std::uint8_t* bytes = nullptr;
  avio_close_dyn_buf(output->pb, &bytes);
  output->pb = nullptr;
  av_free(bytes);
  return std::min(error, 0);
}

// A time code that FFmpeg's mp4 writes itself, from what the video states.
bool is_time_code(const AVStream& stream) {
  return stream.codecpar->codec_tag == MKTAG('t', 'm', 'c', 'd');
}

std::string name_of(const AVStream& stream) {
  const AVDictionaryEntry* const handler = av_dict_get(stream.metadata, "handler_name", nullptr, 0);
  const char* const type = av_get_media_type_string(stream.codecpar->codec_type);
  std::array<char, AV_FOURCC_MAX_STRING_SIZE> tag{};
  av_fourcc_make_string(tag.data(), stream.codecpar->codec_tag);
  return fmt::format("stream {} ({}, {}{})", stream.index, type == nullptr ? "unknown" : type, tag.data(),
                     handler == nullptr ? "" : fmt::format(", \"{}\"", handler->value));
}

}  // namespace

Result<void> choose_streams(Splice& splice, std::vector<Warning>& warnings, const std::atomic<bool>* cancel) {
  const Result<InputPtr> input = open_input(splice.input, cancel);
  if (!input) return fail(input.error());
  const int video = video_stream_of(**input);
  if (const int error = error_of_header(**input, splice.muxer, {video}); error < 0)
    return fail("", fmt::format("cannot be written as {}: {}; use the codec h264", splice.muxer, text_of(error)),
                ErrorKind::usage);
  for (int i = 0; i < static_cast<int>((*input)->nb_streams); ++i) {
    const AVStream& stream = *(*input)->streams[i];
    const bool is_picture = (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
    if (is_time_code(stream) && av_dict_get((*input)->streams[video]->metadata, "timecode", nullptr, 0) != nullptr)
      splice.writes_time_code = true;
    else if (i == video || (!is_picture && error_of_header(**input, splice.muxer, {video, i}) == 0))
      splice.streams.push_back(i);
    else
      warnings.push_back({splice.input.string(), fmt::format("{} is left out: FFmpeg cannot write it into {}",
                                                             name_of(stream), splice.muxer)});
  }
  return {};
}

Result<SpliceFile> SpliceFile::create(const fs::path& path, std::shared_ptr<const Splice> splice,
                                      const std::atomic<bool>* cancel) {
  SpliceFile file(path, std::move(splice), cancel);
  if (const Result<void> begun = file.begin(); !begun) return fail(begun.error());
  return file;
}

Result<void> SpliceFile::begin() {
  Result<InputPtr> input = open_input(splice_->input, cancel_);
  if (!input) return fail(input.error());
  input_ = std::move(*input);
  video_ = video_stream_of(*input_);
  output_.reset(new_output(splice_->muxer));
  if (output_ == nullptr)
    return fail("", fmt::format("this FFmpeg cannot write {}", splice_->muxer), ErrorKind::unavailable);
  av_dict_copy(&output_->metadata, input_->metadata, 0);
  outputs_.assign(input_->nb_streams, -1);
  for (const int stream : splice_->streams) {
    outputs_[static_cast<std::size_t>(stream)] = static_cast<int>(output_->nb_streams);
    AVStream& added = add_stream(*output_, *input_->streams[stream]);
    if (stream == video_) set_header(*added.codecpar, splice_->header);
  }
  for (unsigned i = 0; i < input_->nb_streams; ++i)
    if (outputs_[i] < 0) input_->streams[i]->discard = AVDISCARD_ALL;
  format_ = splice_->format;
  format_.stream = input_->streams[video_]->codecpar;
  const int opened = avio_open(&output_->pb, url_of(path_).c_str(), AVIO_FLAG_WRITE);
  check_memory(opened);
  if (opened < 0) return fail(path_.string(), "cannot be created: " + text_of(opened), ErrorKind::cannot_create);
  AVDictionary* options = nullptr;
  if (splice_->writes_time_code) av_dict_set(&options, "write_tmcd", "1", 0);
  const int begun = avformat_write_header(output_.get(), &options);
  av_dict_free(&options);
  return check(begun);
}

// Reads on to the video packet of this ordinal, or to the end, and writes what is copied.
Result<void> SpliceFile::copy_up_to(std::optional<int> ordinal) {
  while (!ordinal || next_ordinal_ < *ordinal) {
    av_packet_unref(packet_.get());
    const int read = av_read_frame(input_.get(), packet_.get());
    check_memory(read);
    if (cancel_ != nullptr && cancel_->load()) return interrupted();
    if (read < 0 && next_ordinal_ >= static_cast<int>(splice_->layout.bytes.size()) && !ordinal) return {};
    if (read < 0)
      return fail(splice_->input.string(), "changed while it was being read; start again when nothing writes to it",
                  ErrorKind::cannot_read);
    const Result<void> copied = packet_->stream_index == video_ ? copy_video() : copy_other();
    if (!copied) return copied;
  }
  return {};
}

Result<void> SpliceFile::copy_video() {
  const auto ordinal = static_cast<std::size_t>(next_ordinal_++);
  const SpliceLayout& layout = splice_->layout;
  if (ordinal >= layout.bytes.size() || packet_->size != layout.bytes[ordinal])
    return fail(splice_->input.string(), "changed while it was being read; start again when nothing writes to it",
                ErrorKind::cannot_read);
  if (!layout.is_copied[ordinal]) return {};
  if (layout.broken_links.contains(static_cast<int>(ordinal))) {
    if (av_packet_make_writable(packet_.get()) < 0) throw std::bad_alloc();
    break_links({packet_->data, static_cast<std::size_t>(packet_->size)}, nal_length_bytes(*format_.stream));
  }
  if (packet_->pts == AV_NOPTS_VALUE) packet_->pts = packet_->dts;
  packet_->dts = layout.dts[ordinal] - layout.shift;
  packet_->pts -= layout.shift;
  return put(*packet_, outputs_[static_cast<std::size_t>(video_)], format_.tick);
}

// Of a part of the clip, what is heard and told during that.
Result<void> SpliceFile::copy_other() {
  const auto stream = static_cast<std::size_t>(packet_->stream_index);
  if (outputs_[stream] < 0) return {};
  const SpliceLayout& layout = splice_->layout;
  const AVRational tick = input_->streams[stream]->time_base;
  const bool is_part = layout.first_frame > 0 || layout.last_frame + 1 < static_cast<int>(layout.pts.size());
  const std::int64_t stamp = packet_->pts != AV_NOPTS_VALUE ? packet_->pts : packet_->dts;
  if (is_part && stamp != AV_NOPTS_VALUE) {
    const auto last = static_cast<std::size_t>(layout.last_frame);
    const bool ends = last + 1 < layout.pts.size();
    const bool is_before = av_compare_ts(stamp, tick, layout.shift, format_.tick) < 0;
    if (is_before || (ends && av_compare_ts(stamp, tick, layout.pts[last + 1], format_.tick) >= 0)) return {};
  }
  const std::int64_t shift = av_rescale_q(layout.shift, format_.tick, tick);
  if (packet_->pts != AV_NOPTS_VALUE) packet_->pts -= shift;
  if (packet_->dts != AV_NOPTS_VALUE) packet_->dts -= shift;
  return put(*packet_, outputs_[stream], tick);
}

Result<void> SpliceFile::put(AVPacket& packet, int output, AVRational tick) {
  av_packet_rescale_ts(&packet, tick, output_->streams[output]->time_base);
  packet.stream_index = output;
  packet.pos = -1;
  return check(av_interleaved_write_frame(output_.get(), &packet));
}

Result<void> SpliceFile::write(const Frame& frame, int number) {
  if (part_ >= splice_->layout.parts.size() || number < part().groups[group_].first) return {};
  const bool begins_part = group_ == 0 && number == part().groups[0].first;
  if (begins_part)
    if (const Result<void> copied = copy_up_to(std::min(part().replaced.front(), part().next)); !copied) return copied;
  const EncodedGroup group = part().groups[group_];
  ENSURE(number <= group.last);
  if (encoder_) {
    std::vector<EncodedPacket> packets;
    const std::int64_t pts = splice_->layout.pts[static_cast<std::size_t>(number)];
    if (const Result<void> added = encoder_->add(frame, pts, packets); !added) return added;
    if (const Result<void> written = put_encoded(packets); !written) return written;
  } else {
    waiting_.push_back(frame);
    if (waiting_.size() >= kMostWaiting || number == group.last)
      if (const Result<void> begun = encode_waiting(); !begun) return begun;
  }
  return number == group.last ? end_group() : Result<void>();
}

Result<void> SpliceFile::encode_waiting() {
  const Result<GroupQuality> quality = quality_of_waiting();
  if (!quality) return fail(quality.error());
  Result<GroupEncoder> encoder = GroupEncoder::open(format_, *quality);
  if (!encoder) return fail(encoder.error());
  if (encoder->parameter_sets() != splice_->parameter_sets)
    return fail(path_.string(), "could not be encoded: the encoder's parameter sets change from group to group",
                ErrorKind::write_failed);
  encoder_.emplace(std::move(*encoder));
  std::vector<EncodedPacket> packets;
  int number = part().groups[group_].first;
  for (const Frame& frame : std::exchange(waiting_, {})) {
    const std::int64_t pts = splice_->layout.pts[static_cast<std::size_t>(number++)];
    if (const Result<void> added = encoder_->add(frame, pts, packets); !added) return added;
  }
  return put_encoded(packets);
}

// Where the stream does not tell, by the bytes of the first packets of the part.
Result<GroupQuality> SpliceFile::quality_of_waiting() {
  if (std::optional<GroupQuality> stated = stated_quality(waiting_, format_)) return *std::move(stated);
  if (quality_) return *quality_;
  double bytes = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const auto number = static_cast<std::size_t>(part().groups[group_].first) + i;
    bytes += splice_->layout.bytes[static_cast<std::size_t>(splice_->layout.ordinals[number])];
  }
  Result<GroupQuality> found = quality_by_size(waiting_, bytes, format_);
  if (found) quality_ = *found;
  return found;
}

Result<void> SpliceFile::put_encoded(const std::vector<EncodedPacket>& packets) {
  for (const EncodedPacket& packet : packets)
    if (const Result<void> written = put_encoded(packet); !written) return written;
  return {};
}

Result<void> SpliceFile::put_encoded(const EncodedPacket& encoded) {
  const std::size_t i = encoded_++;
  const SpliceLayout& layout = splice_->layout;
  if (i >= part().dts.size() || encoded.pts < part().dts[i])
    return fail(path_.string(), "could not be encoded: the encoder reorders pictures more than the footage",
                ErrorKind::write_failed);
  if (const Result<void> copied = copy_up_to(std::min(part().replaced[i] + 1, part().next)); !copied) return copied;
  const PacketPtr packet = new_packet({reinterpret_cast<const char*>(encoded.bytes.data()), encoded.bytes.size()});
  packet->pts = encoded.pts - layout.shift;
  packet->dts = part().dts[i] - layout.shift;
  packet->duration = av_rescale_q(1, av_inv_q(format_.frame_rate), format_.tick);
  packet->flags = encoded.key ? AV_PKT_FLAG_KEY : 0;
  return put(*packet, outputs_[static_cast<std::size_t>(video_)], format_.tick);
}

Result<void> SpliceFile::end_group() {
  std::vector<EncodedPacket> packets;
  if (const Result<void> ended = encoder_->finish(packets); !ended) return ended;
  encoder_.reset();
  if (const Result<void> written = put_encoded(packets); !written) return written;
  if (++group_ < part().groups.size()) return {};
  if (encoded_ != part().replaced.size())
    return fail(path_.string(),
                fmt::format("could not be encoded: {} packets for {}", encoded_,
                            count_text(static_cast<int>(part().replaced.size()), "frame")),
                ErrorKind::write_failed);
  ++part_;
  group_ = 0;
  encoded_ = 0;
  quality_.reset();
  return {};
}

Result<void> SpliceFile::finish() {
  ENSURE(part_ == splice_->layout.parts.size() && !encoder_ && waiting_.empty());
  if (const Result<void> copied = copy_up_to(std::nullopt); !copied) return copied;
  if (const Result<void> written = check(av_write_trailer(output_.get())); !written) return written;
  avio_flush(output_->pb);
  if (const Result<void> flushed = check(0); !flushed) return flushed;
  if (const Result<void> closed = check(avio_closep(&output_->pb)); !closed) return closed;
  return verify();
}

// Frame n of the result is frame n of the footage, at its time.
Result<void> SpliceFile::verify() const {
  Result<Demuxer> demuxer = Demuxer::open(path_, cancel_);
  if (!demuxer) return fail(demuxer.error());
  const PacketTable table = PacketTable::read(*demuxer);
  if (const Result<void> on = demuxer->check_interrupt(); !on) return on;
  const SpliceLayout& layout = splice_->layout;
  const auto count = static_cast<std::size_t>(layout.last_frame - layout.first_frame + 1);
  const std::optional<FrameOrder> order = order_from_packets(table, demuxer->format(), demuxer->stream());
  const std::size_t found = order ? order->ordinals.size() : static_cast<std::size_t>(table.size());
  const auto failed = [this](const std::string& what) {
    return fail(path_.string(), "is not what it should be: " + what + "; use the codec h264", ErrorKind::write_failed);
  };
  if (found != count) return failed(fmt::format("{} frames instead of {}", found, count));
  if (!order) return {};
  const double tick_s = av_q2d(format_.tick);
  const double tolerance_s = 1.01 * std::max(tick_s, av_q2d(demuxer->stream().time_base));
  const auto first = static_cast<std::size_t>(layout.first_frame);
  for (std::size_t n = 0; n < count; ++n) {
    const double time_s = static_cast<double>(layout.pts[first + n] - layout.pts[first]) * tick_s;
    if (std::abs(order->times_s[n] - time_s) > tolerance_s)
      return failed(fmt::format("frame {} comes at {:.6f} s instead of {:.6f}", first + n, order->times_s[n], time_s));
  }
  return {};
}

Result<void> SpliceFile::check(int result) const {
  if (result >= 0 && output_->pb != nullptr) result = output_->pb->error;
  if (result >= 0) return {};
  check_memory(result);
  return fail(path_.string(), "could not be written: " + text_of(result), ErrorKind::write_failed);
}

}  // namespace sigs::libav
