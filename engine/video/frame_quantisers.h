// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sigs {

// How coarsely the footage's codec has quantised one of its images, as the stream itself states it.

// How a picture of a stream refers to others.
enum class PictureType { unknown, intra, predicted, bidirectional };

// What the numbers of FrameQuantisers mean.
enum class QuantiserKind {
  h264,  // QP of luma of ITU-T H.264, 0..51; the step doubles every 6. Below 0 in footage of more than 8 bits
  mpeg,  // step of an 8x8 coefficient, in code values: quantiser_scale of MPEG-1 and -2, twice the one of MPEG-4 part 2
  none,  // the codec keeps every sample
  jpeg,  // quality of the tables in percent, as the IJG library scales those of ITU-T T.81, annex K
};

// What stands in where neither the footage nor a project states a quantiser: what x264 and most JPEG encoders use by
// themselves.
inline constexpr int kDefaultQp = 23;
inline constexpr double kDefaultJpegQuality_percent = 90;

// The steps of the 8x8 coefficients of a JPEG image, row by row from the lowest frequencies on; each 1..65535.
using JpegTable = std::array<int, 64>;

// The tables of an image: luma's and chroma's.
struct JpegTables {
  JpegTable luma{};
  JpegTable chroma{};

  [[nodiscard]] bool operator==(const JpegTables&) const = default;
};

// The quantisers of one image of the footage, in the image's own pixels (upright, as Frame has them).
struct FrameQuantisers {
  static constexpr int kBlock_px = 16;  // side of a macroblock, in luma samples

  std::string codec;  // FFmpeg's name: "h264", "mpeg4", "mjpeg"
  QuantiserKind kind = QuantiserKind::h264;
  PictureType type = PictureType::unknown;
  double mean = 0;  // of all macroblocks

  // The quantiser of each macroblock, CV_16SC1; empty for jpeg, whose tables hold for all.
  cv::Mat blocks;
  // Pixel of the first macroblock's upper left corner: 0, or down to -15 where turning the image upright has brought
  // the stored image's cut right or lower edge to the left or top.
  cv::Point origin_px{0, 0};

  int cb_offset = 0;  // h264: what is added to luma's QP before chroma's is looked up
  int cr_offset = 0;
  JpegTables tables;  // jpeg

  // Whether the image is coded as what it differs by from others.
  [[nodiscard]] bool is_predicted() const {
    return type == PictureType::predicted || type == PictureType::bidirectional;
  }

  // Of the macroblock at (column, row) counted from the one at origin_px; outside the image that of the nearest one.
  [[nodiscard]] int at(int column, int row) const;
};

// Those of a part of the image. Null of null.
[[nodiscard]] std::shared_ptr<const FrameQuantisers> part_of(const std::shared_ptr<const FrameQuantisers>& quantisers,
                                                             const cv::Rect& part);

// Whether FrameSource finds the quantisers of a codec's images in their stream: H.264, MPEG-1, -2, -4 part 2, MJPEG.
//   codec  VideoInfo::codec
[[nodiscard]] bool states_quantisers(std::string_view codec);

// Whether a codec keeps every sample as it is, so that its images show no trace of it (FFV1, PNG, raw video).
[[nodiscard]] bool is_lossless_codec(std::string_view codec);

// The tables of ITU-T T.81, annex K, scaled as the IJG library does by a quality of 1 to 100 percent (jpeg_set_quality,
// baseline). 50: the tables themselves.
[[nodiscard]] JpegTables jpeg_tables(double quality_percent);

// The quality in percent whose luma table is nearest to the given one, by the sum of steps.
[[nodiscard]] double jpeg_quality_percent(const JpegTable& luma);

// The tables of a JPEG image by its DQT segments (T.81, B.2.4.1); the first component's is luma's, the second one's
// chroma's. All 0 where the bytes are no JPEG image or hold no tables.
[[nodiscard]] JpegTables jpeg_tables_in(const unsigned char* bytes, std::size_t count);

}  // namespace sigs
