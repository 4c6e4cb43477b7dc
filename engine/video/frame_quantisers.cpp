// SPDX-License-Identifier: MIT
#include "video/frame_quantisers.h"

extern "C" {
#include <libavutil/pixdesc.h>
#include <libavutil/video_enc_params.h>
}

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "video/libav/stream_info.h"

namespace sigs {
namespace {

// T.81, tables K.1 and K.2.
constexpr JpegTable kLuma50{16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,  //
                            14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,  //
                            18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,  //
                            49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};
constexpr JpegTable kChroma50{17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99,  //
                              24, 26, 56, 99, 99, 99, 99, 99, 47, 66, 99, 99, 99, 99, 99, 99,  //
                              99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,  //
                              99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99};

JpegTable scaled(const JpegTable& table, int percent) {
  JpegTable steps{};
  for (std::size_t i = 0; i < table.size(); ++i) steps[i] = std::clamp((table[i] * percent + 50) / 100, 1, 255);
  return steps;
}

const AVCodecDescriptor* descriptor_of(std::string_view codec) {
  return avcodec_descriptor_get_by_name(std::string(codec).c_str());
}

// The place, row by row, of the coefficient that comes i-th in zigzag order (T.81, figure A.6).
int natural_place(int i) {
  int row = 0;
  int column = 0;
  for (int step = 0; step < i; ++step) {
    const bool rising = (row + column) % 2 == 0;
    int& ahead = rising ? column : row;
    int& back = rising ? row : column;
    if (ahead == 7) {
      ++back;
    } else {
      ++ahead;
      back -= back > 0 ? 1 : 0;
    }
  }
  return 8 * row + column;
}

// Reads the marker segments of a JPEG image up to its first scan.
class JpegSegments {
 public:
  JpegSegments(const unsigned char* bytes, std::size_t count) : bytes_(bytes), count_(count) {}

  [[nodiscard]] JpegTables tables() {
    if (count_ < 2 || bytes_[0] != 0xFF || bytes_[1] != 0xD8) return {};
    std::size_t at = 2;
    while (at + 4 <= count_ && bytes_[at] == 0xFF) {
      const int marker = bytes_[at + 1];
      if (marker == 0xFF) {  // a fill byte
        ++at;
        continue;
      }
      const std::size_t length = word(at + 2);
      if (marker == 0xDA || length < 2 || at + 2 + length > count_) break;
      if (marker == 0xDB) read_tables(at + 4, at + 2 + length);
      if (marker >= 0xC0 && marker <= 0xC2) read_components(at + 4, at + 2 + length);
      at += 2 + length;
    }
    const JpegTable luma = read_[luma_].value_or(JpegTable{});
    return {luma, read_[chroma_].value_or(luma)};
  }

 private:
  [[nodiscard]] std::size_t word(std::size_t at) const {
    return static_cast<std::size_t>(bytes_[at]) << 8 | bytes_[at + 1];
  }

  void read_tables(std::size_t at, std::size_t end) {
    while (at < end) {
      const bool words = bytes_[at] >> 4 != 0;
      const std::size_t number = bytes_[at] & 15;
      ++at;
      if (number >= read_.size() || end - at < (words ? 128U : 64U)) return;
      JpegTable table{};
      for (int i = 0; i < 64; ++i, at += words ? 2 : 1)
        table[static_cast<std::size_t>(natural_place(i))] =
            std::max(1, words ? static_cast<int>(word(at)) : static_cast<int>(bytes_[at]));
      read_[number] = table;
    }
  }

  // The frame header (T.81, B.2.2): precision, height, width, number of components, then three bytes for each.
  void read_components(std::size_t at, std::size_t end) {
    if (end - at < 9) return;
    const std::size_t components = bytes_[at + 5];
    luma_ = bytes_[at + 8] & 3;
    chroma_ = components > 1 && end - at >= 12 ? bytes_[at + 11] & 3 : luma_;
  }

  const unsigned char* bytes_;
  std::size_t count_;
  std::array<std::optional<JpegTable>, 4> read_;
  std::size_t luma_ = 0;
  std::size_t chroma_ = 0;
};

}  // namespace

int FrameQuantisers::at(int column, int row) const {
  if (blocks.empty()) return static_cast<int>(std::lround(mean));
  return blocks.at<short>(std::clamp(row, 0, blocks.rows - 1), std::clamp(column, 0, blocks.cols - 1));
}

std::shared_ptr<const FrameQuantisers> part_of(const std::shared_ptr<const FrameQuantisers>& quantisers,
                                               const cv::Rect& part) {
  if (!quantisers || quantisers->blocks.empty()) return quantisers;
  constexpr int kBlock_px = FrameQuantisers::kBlock_px;
  const auto whole = [&](int first, int length, int origin, int count) {
    const int from = std::clamp((first - origin) / kBlock_px, 0, count - 1);
    const int to = std::clamp((first + length - 1 - origin) / kBlock_px + 1, from + 1, count);
    return cv::Range(from, to);
  };
  const cv::Point origin = quantisers->origin_px;
  const cv::Range columns = whole(part.x, part.width, origin.x, quantisers->blocks.cols);
  const cv::Range rows = whole(part.y, part.height, origin.y, quantisers->blocks.rows);
  auto here = std::make_shared<FrameQuantisers>(*quantisers);
  here->blocks = quantisers->blocks(rows, columns).clone();
  here->origin_px = {origin.x + columns.start * kBlock_px - part.x, origin.y + rows.start * kBlock_px - part.y};
  here->mean = cv::mean(here->blocks)[0];
  return here;
}

bool states_quantisers(std::string_view codec) {
  return codec == "h264" || codec == "mpeg4" || codec == "mpeg2video" || codec == "mpeg1video" || codec == "mjpeg";
}

bool is_lossless_codec(std::string_view codec) {
  const AVCodecDescriptor* descriptor = descriptor_of(codec);
  return descriptor != nullptr && (descriptor->props & AV_CODEC_PROP_LOSSLESS) != 0 &&
         (descriptor->props & AV_CODEC_PROP_LOSSY) == 0;
}

JpegTables jpeg_tables(double quality_percent) {
  const int quality = static_cast<int>(std::lround(std::clamp(quality_percent, 1.0, 100.0)));
  const int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  return {scaled(kLuma50, percent), scaled(kChroma50, percent)};
}

double jpeg_quality_percent(const JpegTable& luma) {
  const auto sum_of = [](const JpegTable& table) { return std::accumulate(table.begin(), table.end(), 0); };
  const int sum = sum_of(luma);
  int best = 1;
  int least = std::numeric_limits<int>::max();
  for (int quality = 1; quality <= 100; ++quality) {
    const int off = std::abs(sum_of(jpeg_tables(quality).luma) - sum);
    if (off <= least) best = quality;
    least = std::min(least, off);
  }
  return best;
}

JpegTables jpeg_tables_in(const unsigned char* bytes, std::size_t count) {
  return JpegSegments(bytes, count).tables();
}

}  // namespace sigs

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
