// SPDX-License-Identifier: MIT
#include "sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/transfer.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

constexpr float kExposure = 0.98F;
constexpr float kVeil = 0.010F;  // stray light in a cheap lens

// Display value of a linear one: a shoulder for the highlights, a toe for the shadows.
float toned(float linear) {
  const float exposed = std::max(linear, 0.0F) * kExposure + kVeil;
  const float shouldered = exposed < 0.55F ? exposed : 0.55F + 0.45F * (1 - std::exp(-(exposed - 0.55F) / 0.45F));
  const float display = display_of_linear(std::min(shouldered, 1.0F));
  return display + 0.07F * (display - 0.5F) * 4 * display * (1 - display);
}

// The curve by table: 4096 steps in the square root of the light up to 4 are finer than an 8-bit code.
class ToneTable {
 public:
  ToneTable() : values_(kSteps + 2) {
    for (int i = 0; i < kSteps + 2; ++i)
      values_[i] = toned(4.0F * static_cast<float>(i) * static_cast<float>(i) / (kSteps * kSteps));
  }
  [[nodiscard]] float operator()(float linear) const {
    const float at = std::sqrt(std::clamp(linear * 0.25F, 0.0F, 1.0F)) * kSteps;
    const int i = static_cast<int>(at);
    return values_[i] + (at - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 4096;
  std::vector<float> values_;
};

// About normal, mean 0, deviation 1: the sum of the four bytes of a hash.
float grain(int x, int y, std::uint32_t seed) {
  const std::uint32_t bits = hash(x, y, seed);
  const int sum = int(bits & 255) + int(bits >> 8 & 255) + int(bits >> 16 & 255) + int(bits >> 24);
  return (static_cast<float>(sum) - 510.0F) / 147.8F;
}

float vignette(int x, int y, cv::Size size) {
  const float half_width = 0.5F * static_cast<float>(size.width);
  const float u = static_cast<float>(x) / half_width - 1;
  const float v = (static_cast<float>(y) - 0.5F * static_cast<float>(size.height)) / half_width;
  const float r2 = u * u + v * v;
  return 1 - 0.10F * r2 - 0.085F * r2 * r2;
}

// Planes of Y', Cb, Cr at full size; Y' 0..1, chroma -0.5..0.5.
struct Planes {
  cv::Mat_<float> luma, blue, red;
};

Planes ycbcr(const cv::Mat_<cv::Vec3f>& light, float exposure) {
  static const ToneTable tone;
  Planes planes{cv::Mat_<float>(light.size()), cv::Mat_<float>(light.size()), cv::Mat_<float>(light.size())};
  parallel_rows(light.rows, [&](int y) {
    for (int x = 0; x < light.cols; ++x) {
      const float dim = exposure * vignette(x, y, light.size());
      const cv::Vec3f& c = light(y, x);
      const float r = tone(c[0] * dim), g = tone(c[1] * dim), b = tone(c[2] * dim);
      const float luma = 0.2126F * r + 0.7152F * g + 0.0722F * b;
      constexpr float kVivid = 0.90F;
      planes.luma(y, x) = luma;
      planes.blue(y, x) = kVivid * (b - luma) / 1.8556F;
      planes.red(y, x) = kVivid * (r - luma) / 1.5748F;
    }
  });
  return planes;
}

cv::Mat_<float> sharpened(const cv::Mat_<float>& luma) {
  cv::Mat_<float> soft;
  cv::GaussianBlur(luma, soft, {}, 1.2);
  cv::Mat_<float> sharp;
  cv::addWeighted(luma, 1.3, soft, -0.3, 0, sharp);
  return sharp;
}

// Half size in both ways: 1 2 1 across on the even columns, the mean of two rows.
void write_chroma(const cv::Mat_<float>& plane, std::uint32_t seed, std::uint8_t* out) {
  parallel_rows(plane.rows / 2, [&](int row) {
    for (int i = 0; i < plane.cols / 2; ++i) {
      const int left = std::max(2 * i - 1, 0), middle = 2 * i, right = 2 * i + 1;
      float sum = 0;
      for (const int y : {2 * row, 2 * row + 1}) sum += plane(y, left) + 2 * plane(y, middle) + plane(y, right);
      const float code = 128 + 224 * sum / 8 + 0.45F * grain(i, row, seed);
      out[row * (plane.cols / 2) + i] = cv::saturate_cast<std::uint8_t>(std::clamp(code, 16.0F, 240.0F));
    }
  });
}

}  // namespace

std::vector<std::uint8_t> developed(const cv::Mat_<cv::Vec3f>& light, float exposure, int frame) {
  const Planes planes = ycbcr(light, exposure);
  const cv::Mat_<float> luma = sharpened(planes.luma);
  const std::size_t pixels = light.total();
  std::vector<std::uint8_t> bytes(pixels * 3 / 2);
  const std::uint32_t seed = 1000U + 3U * static_cast<std::uint32_t>(frame);
  parallel_rows(light.rows, [&](int y) {
    for (int x = 0; x < light.cols; ++x) {
      const float value = std::clamp(luma(y, x), 0.0F, 1.0F);
      const float deviation = 1.7F - 1.0F * value;  // the curve brightens the shadows, and their noise with them
      const float code = 16 + 219 * value + deviation * grain(x, y, seed);
      bytes[static_cast<std::size_t>(y) * light.cols + x] =
          cv::saturate_cast<std::uint8_t>(std::clamp(code, 16.0F, 235.0F));
    }
  });
  write_chroma(planes.blue, seed + 1, bytes.data() + pixels);
  write_chroma(planes.red, seed + 2, bytes.data() + pixels + pixels / 4);
  return bytes;
}

}  // namespace sigs::footage
