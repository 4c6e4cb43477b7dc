// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.h"
#include "video/libav/handles.h"
#include "video/video_writer.h"

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sigs::libav {

// How the footage's planes are stored in a codec.
struct Encoding {
  const char* encoder = "";  // FFmpeg's name
  AVPixelFormat pixel_format = AV_PIX_FMT_NONE;
  PixelLayout layout = PixelLayout::yuv420;  // of the stored image
  int bit_depth = 8;                         // of the stored image
  ColorInfo color;                           // of the stored image
};

// FFV1 stores every layout as it is. H.264, HEVC and AV1 store gray as 4:2:0 with neutral chroma, since few players
// support their gray profiles, and RGB as 4:4:4 BT.709. MJPEG is what every reader of JPEG expects: full range, BT.601,
// chroma midway. The depth is the frames' one (at most format.max_bit_depth), else the next higher that the encoder has
// for the layout, else its highest.
// Error usage: the codec cannot be put into the container, or cannot store the size.
// Error unavailable: FFmpeg was built without the encoder, or it has no format of this layout.
[[nodiscard]] Result<Encoding> encoding_for(const VideoFormat& format);

// The frame as the encoding stores it. It shares the samples where nothing changes.
[[nodiscard]] Frame stored(const Frame& frame, const Encoding& encoding);

// Opens an encoder whose bytes do not depend on the machine or the number of threads.
//   tick     unit of the time stamps that it will be given
//   headers  the container stores the codec's parameters once, not in the stream
// Error unavailable: FFmpeg was built without the encoder, or the encoder refuses the format.
[[nodiscard]] Result<CodecPtr> open_encoder(const VideoFormat& format, const Encoding& encoding, AVRational tick,
                                            bool headers);

// Numbers of threads are the same for all machines: the results of x264's motion search and lookahead, and of x265,
// depend on them, and x264's hand-written routines differ in the last bit between processors unless cpu-independent is
// set. x265 does not state its version and options, and has no messages.
inline constexpr int kH264Threads = 4;
inline constexpr const char* kH264Parameters = "threads=4:lookahead-threads=1:sliced-threads=0:cpu-independent=1";
inline constexpr const char* kHevcParameters = "pools=4:frame-threads=2:info=0:log-level=none";

// Error unavailable: FFmpeg was built without the encoder.
[[nodiscard]] Result<const AVCodec*> found_encoder(const char* name);

// The encoder's context, opened with options, which are freed. Error unavailable: the encoder refuses them.
[[nodiscard]] Result<CodecPtr> opened(const AVCodec& encoder, CodecPtr context, AVDictionary* options);

// An image for the encoder, without samples.
[[nodiscard]] FramePtr new_image(const AVCodecContext& encoder);

// The packet that the encoder gives at once for an image; empty where it gives none.
[[nodiscard]] std::vector<std::uint8_t> packet_at_once(AVCodecContext& encoder, const AVFrame& image);

// Whether an encoder takes images of a format.
[[nodiscard]] bool supports(const AVCodec& encoder, AVPixelFormat format);

// Appends the coded samples of one slice of an FFV1 image (RFC 9043): what follows the slice's header, up to the next
// whole byte. Samples of 8 bits, Golomb-Rice codes with run mode (3.8.2), three neighbours as context (3.5), and the
// quantisation table of FFmpeg's encoder for them, so that the bytes are the same as that encoder's. It takes half of
// that encoder's time, and next to none for rows of zeros, of which a mask consists.
//   planes  CV_8UC1, not empty: luma, or luma and two planes of chroma of one size; parts of larger ones are fine
void append_ffv1_samples(std::vector<std::uint8_t>& bytes, std::span<const cv::Mat> planes);

// Makes FFV1's packets in place of FFmpeg's encoder, with the same bytes, in half of its time and without the
// buffer of 148 bytes for each pixel that FFmpeg fills with zeros before the first packet. FFmpeg's encoder still gives
// the stream's header.
class Ffv1Packets {
 public:
  // Tries both encoders on a small image. None where their bytes differ, or where the stream's header is not that of
  // the small image: more than 8 bits, RGB, sizes that are not cut into 2 x 2 slices, another version of FFmpeg.
  //   encoder  opened for the images that are to be written
  [[nodiscard]] static std::optional<Ffv1Packets> like(const AVCodecContext& encoder, const VideoFormat& format,
                                                       const Encoding& encoding);

  // The packet of an image, which is a keyframe as all of them are.
  //   frame    as stored in the encoding
  //   threads  that code slices; the bytes do not depend on them
  [[nodiscard]] std::vector<std::uint8_t> packet_of(const Frame& frame, int threads);

 private:
  struct Slice {
    std::vector<std::uint8_t> header;  // the same in every image
    std::vector<std::uint8_t> bytes;   // of the last image; kept for its memory
  };
  [[nodiscard]] bool learn_headers(const std::vector<std::uint8_t>& packet, const Frame& frame);
  void code(std::size_t slice, const Frame& frame);

  std::array<Slice, 4> slices_;  // row by row
};

}  // namespace sigs::libav
