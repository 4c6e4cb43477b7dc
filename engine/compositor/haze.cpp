// SPDX-License-Identifier: MIT
#include "compositor/haze.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "video/color_space.h"

namespace sigs {
namespace {

// BT.709's luminance of linear red, green and blue.
float luminance(const cv::Vec4f& color) {
  return 0.2126F * color[0] + 0.7152F * color[1] + 0.0722F * color[2];
}

constexpr int kMinRing_px = 8;
constexpr int kMaxRing_px = 64;
constexpr double kMaxSamples = 1000;

cv::Rect surroundings(const cv::Rect& box, const cv::Rect& image) {
  const int across = std::clamp(box.width / 2, kMinRing_px, kMaxRing_px);
  const int down = std::clamp(box.height / 2, kMinRing_px, kMaxRing_px);
  return cv::Rect(box.x - across, box.y - down, box.width + 2 * across, box.height + 2 * down) & image;
}

// Code values at a pixel; chroma from the sample that lies nearest.
cv::Vec3f codes_at(const Frame& footage, int x, int y, const cv::Size& step, const cv::Vec3f& offset) {
  cv::Vec3f codes(static_cast<float>(sample_at(footage.planes[0], y, x)), offset[1], offset[2]);
  for (int plane = 1; plane < footage.plane_count(); ++plane)
    codes[plane] =
        static_cast<float>(sample_at(footage.planes[static_cast<std::size_t>(plane)], y / step.height, x / step.width));
  return codes;
}

// Of codes, by the first plane (luma, or red): the half around the median.
void keep_middle_half(std::vector<cv::Vec3f>& codes) {
  const auto by_first = [](const cv::Vec3f& a, const cv::Vec3f& b) { return a[0] < b[0]; };
  const auto quarter = static_cast<std::ptrdiff_t>(codes.size() / 4);
  std::nth_element(codes.begin(), codes.begin() + quarter, codes.end(), by_first);
  codes.erase(codes.begin(), codes.begin() + quarter);
  std::nth_element(codes.begin(), codes.end() - 1 - quarter, codes.end(), by_first);
  codes.erase(codes.end() - quarter, codes.end());
}

cv::Vec3d mean_light(const std::vector<cv::Vec3f>& codes, const Frame& footage) {
  const CodeToRgb map = code_to_rgb(footage.layout, footage.color, footage.bit_depth);
  const TransferCurve curve = transfer_curve_of(footage.color);
  cv::Vec3d sum(0, 0, 0);
  for (const cv::Vec3f& code : codes) {
    const cv::Vec3f rgb = map.to_rgb * (code - map.offset);
    for (int c = 0; c < 3; ++c) sum[c] += curve.linear_of_display(rgb[c]);
  }
  const cv::Matx33d to_footage = from_bt709(footage.color.primaries).value_or(cv::Matx33d::eye());
  const cv::Vec3d light = to_footage.inv() * (sum * (1.0 / static_cast<double>(codes.size())));
  return {std::max(light[0], 0.0), std::max(light[1], 0.0), std::max(light[2], 0.0)};
}

}  // namespace

Layer toned(const Layer& layer, double saturation, double black) {
  if ((saturation == 1 && black == 0) || layer.empty()) return layer;
  const auto share = static_cast<float>(saturation);
  const auto flare = static_cast<float>(black);
  Layer out{layer.rect, layer.color.clone(), layer.coverage};
  for (int y = 0; y < out.color.rows; ++y) {
    cv::Vec4f* const colors = out.color.ptr<cv::Vec4f>(y);
    for (int x = 0; x < out.color.cols; ++x) {
      cv::Vec4f& color = colors[x];
      if (!(color[3] > 0)) continue;
      const float gray = luminance(color);
      for (int c = 0; c < 3; ++c)
        color[c] = std::max(share == 1 ? color[c] : gray + share * (color[c] - gray), 0.0F) + flare * color[3];
    }
  }
  return out;
}

double haze_transmission(double distance_m, double visibility_m) {
  return std::exp(-3 * distance_m / visibility_m);
}

Layer hazed(const Layer& layer, double transmission, const cv::Vec3d& airlight) {
  if (transmission == 1 || layer.empty()) return layer;
  const auto share = static_cast<float>(transmission);
  const cv::Vec3f veil(airlight * (1 - transmission));
  Layer out{layer.rect, layer.color.clone(), layer.coverage};
  for (int y = 0; y < out.color.rows; ++y) {
    cv::Vec4f* const colors = out.color.ptr<cv::Vec4f>(y);
    for (int x = 0; x < out.color.cols; ++x)
      for (int c = 0; c < 3; ++c) colors[x][c] = share * colors[x][c] + veil[c] * colors[x][3];
  }
  return out;
}

Layer hazed(const Layer& layer, const cv::Mat& distance_m, double visibility_m, const cv::Vec3d& airlight) {
  if (layer.empty()) return layer;
  Layer out{layer.rect, layer.color.clone(), layer.coverage};
  for (int y = 0; y < out.color.rows; ++y) {
    cv::Vec4f* const colors = out.color.ptr<cv::Vec4f>(y);
    const float* const distances = distance_m.ptr<float>(y);
    for (int x = 0; x < out.color.cols; ++x) {
      if (!(colors[x][3] > 0)) continue;
      const auto share = static_cast<float>(haze_transmission(distances[x], visibility_m));
      for (int c = 0; c < 3; ++c)
        colors[x][c] = std::lerp(static_cast<float>(airlight[c]) * colors[x][3], colors[x][c], share);
    }
  }
  return out;
}

std::optional<cv::Vec3d> airlight_around(const Frame& footage, const cv::Rect& box, const cv::Mat& own_body) {
  const cv::Rect around = surroundings(box, {{0, 0}, footage.size_px()});
  if (around.empty()) return std::nullopt;
  const int every = std::max(1, static_cast<int>(std::ceil(std::sqrt(around.area() / kMaxSamples))));
  const cv::Size step = chroma_step(footage.layout);
  const cv::Vec3f offset = code_to_rgb(footage.layout, footage.color, footage.bit_depth).offset;
  std::vector<cv::Vec3f> codes;
  for (int y = around.y + every / 2; y < around.br().y; y += every)
    for (int x = around.x + every / 2; x < around.br().x; x += every)
      if (own_body.empty() || !(own_body.at<float>(y, x) > 0)) codes.push_back(codes_at(footage, x, y, step, offset));
  if (codes.empty()) return std::nullopt;
  keep_middle_half(codes);
  return mean_light(codes, footage);
}

}  // namespace sigs
