// SPDX-License-Identifier: MIT
#include "video/libav/decoder.h"

#include <algorithm>
#include <new>
#include <string>

namespace sigs::libav {

Result<CodecPtr> open_decoder(const AVCodecParameters& parameters, const DecoderSettings& settings) {
  const AVCodec* codec = avcodec_find_decoder(parameters.codec_id);
  if (codec == nullptr)
    return fail("", std::string("no decoder for the codec ") + avcodec_get_name(parameters.codec_id),
                ErrorKind::cannot_read);
  CodecPtr context(avcodec_alloc_context3(codec));
  if (context == nullptr) throw std::bad_alloc();
  int error = avcodec_parameters_to_context(context.get(), &parameters);
  // Which macroblocks of a damaged MPEG-4 image FFmpeg misses depends on which of its threads is ahead.
  context->thread_count = parameters.codec_id == AV_CODEC_ID_MPEG4 ? 1 : settings.threads;
  context->has_b_frames = std::max(context->has_b_frames, settings.reorder_depth);
  if (error >= 0) error = avcodec_open2(context.get(), codec, nullptr);
  if (error < 0 && settings.threads > 1)  // there may be no more threads to be had; one gives the same images
    return open_decoder(parameters, {.threads = 1, .reorder_depth = settings.reorder_depth});
  check_memory(error);
  if (error < 0)
    return fail("", std::string("the ") + codec->name + " decoder cannot be opened: " + text_of(error),
                ErrorKind::cannot_read);
  return context;
}

bool is_damaged(const AVFrame& frame) {
  return frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
}

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

}  // namespace sigs::libav
