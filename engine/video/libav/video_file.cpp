// SPDX-License-Identifier: MIT
#include "video/libav/video_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "base/ensure.h"
#include "video/libav/planes.h"

namespace sigs::libav {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kFinestTicksPerSecond = 60000;

constexpr int kStreamBuffer_bytes = 1 << 16;

// Called by FFmpeg with bytes of the container.
int write_to_stream(void* below, uint8_t* bytes, int count) {
  auto& stream = *static_cast<StreamBelow*>(below);
  if (stream.error) return AVERROR(EIO);
  const Result<void> written = stream.out.write({reinterpret_cast<const char*>(bytes), static_cast<size_t>(count)});
  if (written) return count;
  stream.error = written.error();
  return AVERROR(EIO);
}

AVIOContext* buffer_above(StreamBelow& stream) {
  auto* const buffer = static_cast<unsigned char*>(av_malloc(kStreamBuffer_bytes));
  if (buffer == nullptr) throw std::bad_alloc();
  AVIOContext* const above =
      avio_alloc_context(buffer, kStreamBuffer_bytes, 1, &stream, nullptr, write_to_stream, nullptr);
  if (above != nullptr) return above;
  av_free(buffer);
  throw std::bad_alloc();
}

// Matroska has milliseconds, AVI frames. In MP4 a whole number of ticks is one nominal frame, and a tick is 1/60000 s
// or finer, so that constant rates are exact and varying ones nearly so.
AVRational tick_of(const VideoFormat& format) {
  if (format.container == Container::mkv) return {1, 1000};
  if (format.container == Container::avi) return {format.frame_rate_den, format.frame_rate_num};
  const int64_t num = format.frame_rate_num;
  return {1, static_cast<int>(num * std::max<int64_t>(1, (kFinestTicksPerSecond + num - 1) / num))};
}

// Whether the encoder has finished with an image's samples when it returns. Others may refer to them later.
bool is_done_at_once(VideoCodec codec) {
  return codec == VideoCodec::ffv1 || codec == VideoCodec::h264;
}

}  // namespace

const char* muxer_of(Container container) {
  if (container == Container::y4m) return "";  // VideoWriter writes it
  return container == Container::mkv ? "matroska" : extension_of(container);
}

void OutputCloser::operator()(AVFormatContext* context) const {
  if ((context->flags & AVFMT_FLAG_CUSTOM_IO) != 0 && context->pb != nullptr) {
    av_freep(&context->pb->buffer);
    avio_context_free(&context->pb);
  } else {
    avio_closep(&context->pb);
  }
  avformat_free_context(context);
}

VideoFile::VideoFile(fs::path path, VideoFormat format, Encoding encoding)
    : path_(std::move(path)), format_(format), encoding_(encoding), tick_(tick_of(format)) {}

Result<VideoFile> VideoFile::create(const fs::path& path, const VideoFormat& format) {
  silence();
  ENSURE(format.frame_rate_num > 0 && format.frame_rate_den > 0);
  const Result<Encoding> encoding = encoding_for(format);
  if (!encoding) return fail(named(encoding.error(), path));
  return begun(VideoFile(path, format, *encoding));
}

Result<VideoFile> VideoFile::create(OutputStream out, const VideoFormat& format) {
  silence();
  ENSURE(format.frame_rate_num > 0 && format.frame_rate_den > 0);
  const Result<Encoding> encoding = encoding_for(format);
  if (!encoding) return fail(named(encoding.error(), out.name()));
  VideoFile file(out.name(), format, *encoding);
  file.stream_ = std::make_unique<StreamBelow>(StreamBelow{std::move(out), {}});
  return begun(std::move(file));
}

Result<VideoFile> VideoFile::begun(VideoFile file) {
  if (const Result<void> done = file.begin(); !done) return fail(named(done.error(), file.path_));
  return file;
}

Result<void> VideoFile::open_output() {
  if (stream_ != nullptr) {
    output_->pb = buffer_above(*stream_);
    output_->pb->seekable = 0;
    output_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_FLUSH_PACKETS;
    return {};
  }
  const int opened = avio_open(&output_->pb, url_of(path_).c_str(), AVIO_FLAG_WRITE);
  check_memory(opened);
  return opened < 0 ? fail("", "cannot be created: " + text_of(opened), ErrorKind::cannot_create) : Result<void>();
}

Result<void> VideoFile::begin() {
  AVFormatContext* context = nullptr;
  if (avformat_alloc_output_context2(&context, nullptr, muxer_of(format_.container), nullptr) < 0)
    return fail("", fmt::format("this FFmpeg cannot write {}", muxer_of(format_.container)), ErrorKind::unavailable);
  output_.reset(context);
  context->flags |= AVFMT_FLAG_BITEXACT;  // no dates, no versions, no random identifiers
  Result<CodecPtr> encoder =
      open_encoder(format_, encoding_, tick_, (context->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  if (!encoder) return fail(encoder.error());
  encoder_ = std::move(*encoder);
  AVStream* stream = avformat_new_stream(context, nullptr);
  if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, encoder_.get()) < 0)
    throw std::bad_alloc();
  // Apple's players need the tag hvc1, which says that the codec's parameters are in the header alone.
  if (format_.codec == VideoCodec::hevc && format_.container == Container::mp4)
    stream->codecpar->codec_tag = MKTAG('h', 'v', 'c', '1');
  stream->time_base = tick_;
  stream->avg_frame_rate = encoder_->framerate;
  stream->sample_aspect_ratio = encoder_->sample_aspect_ratio;
  if (const Result<void> opened = open_output(); !opened) return opened;
  return check(avformat_write_header(context, nullptr));
}

Result<int64_t> VideoFile::next_stamp(double time_s) {
  if (format_.container == Container::avi) return ++last_stamp_;
  if (!std::isfinite(time_s) || (first_time_s_ && !(time_s > last_time_s_)))
    return fail(path_.string(), "a frame's time does not lie after the one before: " + std::to_string(time_s));
  if (!first_time_s_) first_time_s_ = time_s;
  last_time_s_ = time_s;
  const int64_t stamp = std::llround((time_s - *first_time_s_) / av_q2d(tick_));
  return last_stamp_ = std::max(stamp, last_stamp_ + 1);
}

FramePtr VideoFile::av_frame_of(const Frame& frame) const {
  FramePtr image = new_image(*encoder_);
  const Frame as_stored = stored(frame, encoding_);
  if (is_done_at_once(format_.codec) && can_wrap_planes(encoder_->pix_fmt)) {
    wrap_planes(*image, as_stored);
  } else {
    if (av_frame_get_buffer(image.get(), 0) < 0) throw std::bad_alloc();
    fill(*image, as_stored);
  }
  return image;
}

Result<void> VideoFile::write(const Frame& frame) {
  ENSURE(frame.layout == format_.layout && frame.bit_depth == format_.bit_depth && frame.size_px() == format_.size_px);
  warm_up();
  if (ffv1_) return put_known(ffv1_->packet_of(stored(frame, encoding_), format_.threads), frame.time_s);
  const Result<int64_t> stamp = next_stamp(frame.time_s);
  if (!stamp) return fail(stamp.error());
  const FramePtr image = av_frame_of(frame);
  image->pts = *stamp;
  return encode(image.get());
}

Result<void> VideoFile::write_blank(double time_s) {
  warm_up();
  if (!blank_.empty()) return put_known(blank_, time_s);
  Frame frame = blank_frame(format_.layout, format_.size_px, format_.color, format_.bit_depth);
  frame.time_s = time_s;
  return write(frame);
}

// All images are keyframes in FFV1 as it is set up here, so that the same image always gives the same packet.
void VideoFile::warm_up() {
  if (std::exchange(is_warm_, true) || format_.codec != VideoCodec::ffv1) return;
  ffv1_ = Ffv1Packets::like(*encoder_, format_, encoding_);
  const Frame frame = blank_frame(format_.layout, format_.size_px, format_.color, format_.bit_depth);
  if (ffv1_) {
    blank_ = ffv1_->packet_of(stored(frame, encoding_), format_.threads);
    return;
  }
  const FramePtr image = av_frame_of(frame);
  image->pts = std::max<int64_t>(last_stamp_, 0);
  blank_ = packet_at_once(*encoder_, *image);
}

tl::unexpected<Error> VideoFile::encoding_failed(int error) const {
  check_memory(error);
  return fail(path_.string(), "could not be encoded: " + text_of(error), ErrorKind::write_failed);
}

Result<void> VideoFile::encode(const AVFrame* image) {
  if (const int sent = avcodec_send_frame(encoder_.get(), image); sent < 0) return encoding_failed(sent);
  if (image != nullptr) ++images_;
  while (true) {
    const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return {};
    if (received < 0) return encoding_failed(received);
    // x265 leaves the decoding times of streams of one and two images undefined: it sets them by the third.
    if (format_.codec == VideoCodec::hevc && images_ < 3) packet_->dts = packet_->pts;
    if (const Result<void> written = put(*packet_); !written) return written;
  }
}

Result<void> VideoFile::put_known(const std::vector<uint8_t>& packet, double time_s) {
  const Result<int64_t> stamp = next_stamp(time_s);
  if (!stamp) return fail(stamp.error());
  const PacketPtr known = new_packet({reinterpret_cast<const char*>(packet.data()), packet.size()});
  known->pts = known->dts = *stamp;
  known->flags |= AV_PKT_FLAG_KEY;
  return put(*known);
}

// Writes a packet and leaves it empty.
Result<void> VideoFile::put(AVPacket& packet) {
  const AVRational period{format_.frame_rate_den, format_.frame_rate_num};
  if (packet.duration == 0) packet.duration = av_rescale_q(1, period, tick_);
  av_packet_rescale_ts(&packet, tick_, output_->streams[0]->time_base);
  packet.stream_index = 0;
  return check(av_interleaved_write_frame(output_.get(), &packet));
}

Result<void> VideoFile::finish() {
  if (const Result<void> flushed = encode(nullptr); !flushed) return flushed;
  if (const Result<void> written = check(av_write_trailer(output_.get())); !written) return written;
  avio_flush(output_->pb);
  if (const Result<void> flushed = check(0); !flushed) return flushed;
  return close_output();
}

Result<void> VideoFile::close_output() {
  return stream_ == nullptr ? check(avio_closep(&output_->pb)) : stream_->out.close();
}

// The result of a call of the muxer. A full disk may be reported only by the buffer below it.
Result<void> VideoFile::check(int result) const {
  if (stream_ != nullptr && stream_->error) return fail(*stream_->error);
  if (result >= 0 && output_->pb != nullptr) result = output_->pb->error;
  if (result >= 0) return {};
  check_memory(result);
  return fail(path_.string(), "could not be written: " + text_of(result), ErrorKind::write_failed);
}

}  // namespace sigs::libav
