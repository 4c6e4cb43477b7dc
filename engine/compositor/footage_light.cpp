// SPDX-License-Identifier: MIT
#include "compositor/footage_light.h"

#include "video/color_space.h"

namespace sigs {

TransferCurve transfer_curve_of(const ColorInfo& color) {
  return TransferCurve(transfer_function_of(color.transfer).value_or(TransferFunction::srgb));
}

cv::Mat in_footage_primaries(const cv::Mat& layer_color, const ColorInfo& color) {
  const cv::Matx33f matrix = from_bt709(color.primaries).value_or(cv::Matx33d::eye());
  if (layer_color.empty() || matrix == cv::Matx33f::eye()) return layer_color;
  cv::Mat converted(layer_color.size(), CV_32FC4);
  for (int y = 0; y < layer_color.rows; ++y) {
    const cv::Vec4f* const in = layer_color.ptr<cv::Vec4f>(y);
    cv::Vec4f* const out = converted.ptr<cv::Vec4f>(y);
    for (int x = 0; x < layer_color.cols; ++x) {
      const cv::Vec3f light = matrix * cv::Vec3f(in[x][0], in[x][1], in[x][2]);
      out[x] = {light[0], light[1], light[2], in[x][3]};
    }
  }
  return converted;
}

}  // namespace sigs
