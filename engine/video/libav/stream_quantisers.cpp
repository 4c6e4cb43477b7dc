// SPDX-License-Identifier: MIT
#include "video/libav/stream_info.h"

extern "C" {
#include <libavutil/pixdesc.h>
#include <libavutil/video_enc_params.h>
}

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

namespace sigs::libav {
namespace {

constexpr int kBlock_px = FrameQuantisers::kBlock_px;

PictureType type_of(const AVFrame& image) {
  switch (image.pict_type) {
    case AV_PICTURE_TYPE_I:
    case AV_PICTURE_TYPE_SI:
      return PictureType::intra;
    case AV_PICTURE_TYPE_P:
    case AV_PICTURE_TYPE_SP:
    case AV_PICTURE_TYPE_S:
      return PictureType::predicted;
    case AV_PICTURE_TYPE_B:
    case AV_PICTURE_TYPE_BI:
      return PictureType::bidirectional;
    default:
      return PictureType::unknown;
  }
}

int blocks_along(int size_px) {
  return (size_px + kBlock_px - 1) / kBlock_px;
}

// A QP of d bits counts from -6 (d - 8), and FFmpeg adds 6 (d - 8) to it; the step of the 8-bit samples that are made
// of the deeper ones is that of the QP itself.
int depth_offset(const AVFrame& image, QuantiserKind kind) {
  const AVPixFmtDescriptor* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(image.format));
  return kind == QuantiserKind::h264 && format != nullptr ? 6 * (format->comp[0].depth - 8) : 0;
}

// The blocks that the decoder has listed, macroblock by macroblock; a larger block fills all that it covers.
cv::Mat block_map(const AVVideoEncParams& params, cv::Size size_px, int offset) {
  cv::Mat blocks(blocks_along(size_px.height), blocks_along(size_px.width), CV_16SC1, cv::Scalar(params.qp - offset));
  const cv::Rect whole({0, 0}, blocks.size());
  for (unsigned int i = 0; i < params.nb_blocks; ++i) {
    const AVVideoBlockParams& block = *av_video_enc_params_block(const_cast<AVVideoEncParams*>(&params), i);
    const auto value = static_cast<short>(params.qp + block.delta_qp - offset);
    const cv::Point first(block.src_x / kBlock_px, block.src_y / kBlock_px);
    if (block.w == kBlock_px && block.h == kBlock_px && whole.contains(first)) {  // as nearly all are
      blocks.at<short>(first) = value;
      continue;
    }
    const cv::Rect covered(first, cv::Size(std::max(1, blocks_along(block.w)), std::max(1, blocks_along(block.h))));
    const cv::Rect inside = covered & whole;
    for (int y = inside.y; y < inside.br().y; ++y) std::fill_n(blocks.ptr<short>(y) + inside.x, inside.width, value);
  }
  return blocks;
}

std::shared_ptr<const FrameQuantisers> jpeg_quantisers(const AVFrame& image, const JpegTables& tables,
                                                       const std::string& codec) {
  if (tables.luma[0] == 0) return nullptr;
  return std::make_shared<const FrameQuantisers>(FrameQuantisers{.codec = codec,
                                                                 .kind = QuantiserKind::jpeg,
                                                                 .type = type_of(image),
                                                                 .mean = jpeg_quality_percent(tables.luma),
                                                                 .tables = tables});
}

JpegTable transposed(const JpegTable& table) {
  JpegTable turned{};
  for (std::size_t i = 0; i < table.size(); ++i) turned[8 * (i % 8) + i / 8] = table[i];
  return turned;
}

// Minus the number of samples by which the last macroblock exceeds the image.
int cut_px(int size_px) {
  return size_px - kBlock_px * blocks_along(size_px);
}

}  // namespace

std::shared_ptr<const FrameQuantisers> quantisers_of(const AVFrame& image, AVCodecID codec, const JpegTables& tables) {
  const std::string name = avcodec_get_name(codec);
  if (codec == AV_CODEC_ID_MJPEG) return jpeg_quantisers(image, tables, name);
  if (is_lossless_codec(name))
    return std::make_shared<const FrameQuantisers>(
        FrameQuantisers{.codec = name, .kind = QuantiserKind::none, .type = type_of(image)});
  const AVFrameSideData* data = av_frame_get_side_data(&image, AV_FRAME_DATA_VIDEO_ENC_PARAMS);
  if (data == nullptr || image.width <= 0 || image.height <= 0) return nullptr;
  const auto& params = *reinterpret_cast<const AVVideoEncParams*>(data->data);
  if (params.type != AV_VIDEO_ENC_PARAMS_H264 && params.type != AV_VIDEO_ENC_PARAMS_MPEG2) return nullptr;
  FrameQuantisers found{.codec = name,
                        .kind = params.type == AV_VIDEO_ENC_PARAMS_H264 ? QuantiserKind::h264 : QuantiserKind::mpeg,
                        .type = type_of(image)};
  found.blocks = block_map(params, cv::Size(image.width, image.height), depth_offset(image, found.kind));
  found.mean = cv::mean(found.blocks)[0];
  if (found.kind == QuantiserKind::h264) {
    found.cb_offset = params.delta_qp[1][0];
    found.cr_offset = params.delta_qp[2][0];
  }
  return std::make_shared<const FrameQuantisers>(std::move(found));
}

std::shared_ptr<const FrameQuantisers> oriented(const std::shared_ptr<const FrameQuantisers>& quantisers,
                                                cv::Size stored_px, const Orientation& orientation) {
  if (quantisers == nullptr || orientation == Orientation{}) return quantisers;
  FrameQuantisers turned = *quantisers;
  turned.blocks = oriented(Frame{.planes = {quantisers->blocks}}, orientation).planes[0];
  const cv::Size upright = oriented(stored_px, orientation);
  turned.origin_px = {orientation.flip_columns ? cut_px(upright.width) : 0,
                      orientation.flip_rows ? cut_px(upright.height) : 0};
  if (orientation.transpose) turned.tables = {transposed(turned.tables.luma), transposed(turned.tables.chroma)};
  return std::make_shared<const FrameQuantisers>(std::move(turned));
}

}  // namespace sigs::libav
