// SPDX-License-Identifier: MIT
#include "base/ensure.h"
#include "video/frame.h"

namespace sigs {
namespace {

// Share of red, green and blue in luma: Rec. ITU-T H.273, table 4 (MatrixCoefficients 6, 1 and 9).
struct LumaShares {
  double red = 0;
  double green = 0;
  double blue = 0;
};

LumaShares luma_shares(double red, double blue) {
  return {red, 1 - red - blue, blue};
}

LumaShares luma_shares(ColorMatrix matrix) {
  switch (matrix) {
    case ColorMatrix::bt601:
      return luma_shares(0.299, 0.114);
    case ColorMatrix::bt709:
      return luma_shares(0.2126, 0.0722);
    case ColorMatrix::bt2020:
      return luma_shares(0.2627, 0.0593);
  }
  ENSURE(false);
}

// How many code values luma 0..1 and a colour difference of -0.5..0.5 span in 8 bits: H.273, equations 20 to 31.
struct Quantiser {
  double luma_scale = 0;
  double luma_offset = 0;
  double chroma_scale = 0;
};

Quantiser quantiser(ColorRange range) {
  if (range == ColorRange::full) return {.luma_scale = 255, .luma_offset = 0, .chroma_scale = 255};
  return {.luma_scale = 219, .luma_offset = 16, .chroma_scale = 224};
}

CodeToRgb rgb_map() {
  return {cv::Matx33f::eye() * (1.0F / 255.0F), cv::Matx33f::eye() * 255.0F, cv::Vec3f(0, 0, 0)};
}

CodeToRgb gray_map(const LumaShares& k, const Quantiser& q) {
  const double s = 1 / q.luma_scale;
  const cv::Matx33d to_rgb(s, 0, 0, s, 0, 0, s, 0, 0);
  const cv::Matx33d from_rgb(k.red * q.luma_scale, k.green * q.luma_scale, k.blue * q.luma_scale, 0, 0, 0, 0, 0, 0);
  return {to_rgb, from_rgb, cv::Vec3f(static_cast<float>(q.luma_offset), 0, 0)};
}

// H.273, equations 38 to 40 and their inverse: E'Cb = (E'B - E'Y) / (2 (1 - KB)), E'Cr = (E'R - E'Y) / (2 (1 - KR)).
CodeToRgb ycbcr_map(const LumaShares& k, const Quantiser& q) {
  const double blue_span = 2 * (1 - k.blue);
  const double red_span = 2 * (1 - k.red);
  const cv::Matx33d rgb_of_ycc(1, 0, red_span,                                                 //
                               1, -k.blue * blue_span / k.green, -k.red * red_span / k.green,  //
                               1, blue_span, 0);
  const cv::Matx33d ycc_of_rgb(k.red, k.green, k.blue,                                              //
                               -k.red / blue_span, -k.green / blue_span, (1 - k.blue) / blue_span,  //
                               (1 - k.red) / red_span, -k.green / red_span, -k.blue / red_span);
  const cv::Matx33d scale(q.luma_scale, 0, 0, 0, q.chroma_scale, 0, 0, 0, q.chroma_scale);
  const cv::Matx33d unscale(1 / q.luma_scale, 0, 0, 0, 1 / q.chroma_scale, 0, 0, 0, 1 / q.chroma_scale);
  return {rgb_of_ycc * unscale, scale * ycc_of_rgb, cv::Vec3f(static_cast<float>(q.luma_offset), 128, 128)};
}

}  // namespace

CodeToRgb code_to_rgb(PixelLayout layout, const ColorInfo& color) {
  if (layout == PixelLayout::rgb) return rgb_map();
  const LumaShares shares = luma_shares(color.matrix);
  if (layout == PixelLayout::gray) return gray_map(shares, quantiser(color.range));
  return ycbcr_map(shares, quantiser(color.range));
}

}  // namespace sigs
