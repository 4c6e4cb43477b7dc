// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/result.h"
#include "video/frame.h"
#include "video/frame_quantisers.h"
#include "video/frame_source.h"
#include "video/libav/demuxer.h"
#include "video/libav/frame_decoder.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// Sets the encoder's colour tags to what the footage states. What is unstated stays unstated, so that a player assumes
// the same for both.
void tag(AVCodecContext& encoder, const ColorInfo& color, PixelLayout layout);

// What a container and its first image state about a video: its orientation, and everything of VideoInfo.

// How a stored image becomes upright: rows and columns are exchanged, then columns and rows are reversed. All eight
// combinations of rotations by right angles and mirrors can be written so; each sample keeps its value.
struct Orientation {
  bool transpose = false;
  bool flip_columns = false;
  bool flip_rows = false;

  [[nodiscard]] bool operator==(const Orientation&) const = default;
};

// The orientation that the container's display matrix asks for (ISO/IEC 14496-12, 8.3.2.3; Matroska's projection pose).
// Error bad_data where it is a rotation by other than right angles.
[[nodiscard]] Result<Orientation> orientation_of(const AVStream& stream);

// The same of a display matrix itself, nine numbers; null: there is none.
[[nodiscard]] Result<Orientation> orientation_of(const int32_t* matrix);

// Error bad_data where the layout does not allow the orientation: a transposed 4:2:2 would be 4:4:0.
[[nodiscard]] Result<void> check_orientation(const Orientation& orientation, PixelLayout layout);

// The size and the samples of the upright image.
[[nodiscard]] cv::Size oriented(cv::Size size, const Orientation& orientation);
[[nodiscard]] Frame oriented(const Frame& frame, const Orientation& orientation);

// Sets what a decoded image as it is stored states of its footage: size, layout, depth, colours, codec. Size and chroma
// site are those of the upright image. Where it states no colours: limited range (full for RGB, JPEG and gray outside
// the video standards), matrix BT.601 below 720 lines and BT.709 from there on, chroma at the left (midway for JPEG).
// Warnings tell of an orientation, and of colours that are stated and SIGS does not support.
void add_image(VideoInfo& info, const AVFrame& image, AVCodecID codec, const Orientation& orientation);

// Nominal frame rate; 25/1 where the file states none.
[[nodiscard]] AVRational frame_rate_of(const Demuxer& demuxer);

// The properties of a video, from its container and its first decoded image, with warnings about what is damaged,
// missing or assumed.
[[nodiscard]] VideoInfo video_info_of(const std::filesystem::path& path, const Demuxer& demuxer,
                                      const PacketTable& table, const FrameOrder& order, const AVFrame& first,
                                      const Orientation& orientation);

// The quantisers of a decoded image, in the image as it is stored; null where neither the decoder nor the packet has
// told any.
//   image   its decoder had AV_CODEC_EXPORT_DATA_VIDEO_ENC_PARAMS set; 8-bit QPs are made of deeper ones
//   tables  of the image's packet, for JPEG; all 0: none
[[nodiscard]] std::shared_ptr<const FrameQuantisers> quantisers_of(const AVFrame& image, AVCodecID codec,
                                                                   const JpegTables& tables);

// The same for the upright image: the map of macroblocks is turned with it, and JPEG's tables where rows and columns
// are exchanged.
//   stored_px  size of the stored image
[[nodiscard]] std::shared_ptr<const FrameQuantisers> oriented(const std::shared_ptr<const FrameQuantisers>& quantisers,
                                                              cv::Size stored_px, const Orientation& orientation);

}  // namespace sigs::libav
