// SPDX-License-Identifier: MIT
#include "video/libav/image_file.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "base/image.h"
#include "base/image_codecs.h"
#include "base/input_file.h"
#include "video/libav/demuxer.h"
#include "video/libav/planes.h"

namespace sigs::libav {

namespace fs = std::filesystem;

namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t kImageLimit_bytes = 1024 * kMebibyte;
constexpr std::size_t kMaxKept = 8;  // steps back in the editor are short
constexpr std::size_t kMaxKept_bytes = 64 << 20;

AVCodecID codec_of_bytes(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return AV_CODEC_ID_PNG;
  if (bytes.starts_with("\xff\xd8\xff"sv)) return AV_CODEC_ID_MJPEG;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return AV_CODEC_ID_TIFF;
  return AV_CODEC_ID_NONE;
}

// The first image that a fresh decoder makes of the bytes; nothing where it reports damage.
FramePtr decoded(AVCodecID id, const std::string& bytes) {
  const AVCodec* codec = avcodec_find_decoder(id);
  if (codec == nullptr) return nullptr;
  const CodecPtr context = new_context(codec);
  context->thread_count = 1;
  context->max_pixels = kMaxImagePixels;
  DecoderErrors errors;
  errors.restart(0);
  context->opaque = errors.tag_of(0);
  const int opened = avcodec_open2(context.get(), codec, nullptr);
  check_memory(opened);
  if (opened < 0) return nullptr;
  const PacketPtr packet = new_packet(bytes);
  FramePtr frame = new_frame();
  int result = avcodec_send_packet(context.get(), packet.get());
  if (result >= 0) result = avcodec_send_packet(context.get(), nullptr);
  if (result >= 0) result = avcodec_receive_frame(context.get(), frame.get());
  check_memory(result);
  const bool is_intact = result >= 0 && errors.taken().empty() && frame->decode_error_flags == 0 &&
                         (frame->flags & AV_FRAME_FLAG_CORRUPT) == 0;
  return is_intact ? std::move(frame) : nullptr;
}

const int32_t* matrix_of(const AVFrame& frame) {
  const AVFrameSideData* data = av_frame_get_side_data(&frame, AV_FRAME_DATA_DISPLAYMATRIX);
  return data != nullptr && data->size >= 9 * sizeof(int32_t) ? reinterpret_cast<const int32_t*>(data->data) : nullptr;
}

}  // namespace

Result<StillImage> decoded_still(const fs::path& path, bool quantisers) {
  silence();
  const Result<std::string> bytes = read_text(path, kImageLimit_bytes);
  if (!bytes) return fail(bytes.error());
  StillImage still{.codec = codec_of_bytes(*bytes)};
  if (still.codec == AV_CODEC_ID_NONE) return fail(path.string(), "is neither a PNG nor a TIFF nor a JPEG image");
  if (const Result<void> size = check_image_size(image_size_px(path).value_or(cv::Size())); !size)
    return fail(path.string(), size.error().what);
  still.frame = decoded(still.codec, *bytes);
  if (still.frame == nullptr) return fail(path.string(), "is damaged: it cannot be decoded as a whole");
  const Result<Orientation> orientation = orientation_of(matrix_of(*still.frame));
  if (!orientation) return fail(named(orientation.error(), path));
  still.orientation = *orientation;
  if (quantisers && still.codec == AV_CODEC_ID_MJPEG)
    still.quantisers =
        quantisers_of(*still.frame, still.codec,
                      jpeg_tables_in(reinterpret_cast<const unsigned char*>(bytes->data()), bytes->size()));
  return still;
}

const StillImage* StillFrames::kept(int n) const {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [n](const Kept& one) { return one.n == n; });
  return found == kept_.end() ? nullptr : &found->image;
}

// Decodes the n-th image, which is then kept. False: it is damaged.
Result<bool> StillFrames::show(int n) {
  if (cancel_ != nullptr && cancel_->load()) return interrupted();
  if (damaged_.contains(n)) return false;
  if (kept(n) != nullptr) return true;
  Result<StillImage> image = decoded_still(file(n), quantisers_);
  if (!image && image.error().kind == ErrorKind::cannot_read) return fail(image.error());
  if (!image) {
    damaged_.insert(n);
    return false;
  }
  kept_.push_back({n, std::move(*image)});
  const std::size_t most = std::clamp<std::size_t>(kMaxKept_bytes / bytes_of(*kept_.back().image.frame), 1, kMaxKept);
  while (kept_.size() > most) kept_.pop_front();
  return true;
}

Result<StillFrames::Found> StillFrames::find(int n) {
  const int count = static_cast<int>(files_.size());
  for (int step = 0; step < count; ++step) {
    const int m = step <= n ? n - step : step;  // n, then back to the first, then on after n
    const Result<bool> intact = show(m);
    if (!intact) return fail(intact.error());
    if (*intact) return Found{kept(m), m};
  }
  return Found{};
}

VideoInfo sequence_info_of(const fs::path& path, const ImageSequence& sequence, const StillImage& first) {
  VideoInfo info;
  info.path = path;
  info.times_s = sequence.times_s;
  info.frame_rate_num = sequence.frame_rate_num;
  info.frame_rate_den = sequence.frame_rate_den;
  info.variable_frame_rate = sequence.variable_frame_rate;
  info.container = "images";
  info.warnings = sequence.warnings;
  add_image(info, *first.frame, first.codec, first.orientation);
  return info;
}

}  // namespace sigs::libav
