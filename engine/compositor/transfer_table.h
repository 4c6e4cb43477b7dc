// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "video/transfer_function.h"

namespace sigs {

// A curve between two powers of two as parabolas on 32 equal parts of each octave. The parts of a float are
// its leading bits, so finding one takes no search.
class PiecewiseParabola {
 public:
  // Over [2^low_exponent, 2^high_exponent).
  template <class Curve>
  PiecewiseParabola(int low_exponent, int high_exponent, const Curve& curve)
      : low_(power_of_two(low_exponent)),
        high_(power_of_two(high_exponent)),
        first_(std::bit_cast<std::uint32_t>(low_) >> kBitsWithin),
        pieces_(static_cast<std::size_t>(high_exponent - low_exponent) * 32) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double left = start(i);
      pieces_[i] = through(curve, left, start(i + 1) - left);
    }
  }

  [[nodiscard]] bool holds(float x) const { return x >= low_ && x < high_; }

  // holds(x)
  [[nodiscard]] float at(float x) const {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const Piece& piece = pieces_[(bits >> kBitsWithin) - first_];
    const float along = x - std::bit_cast<float>((bits >> kBitsWithin) << kBitsWithin);
    return piece.value + along * (piece.slope + along * piece.quadratic);
  }

 private:
  struct Piece {
    float value = 0;
    float slope = 0;
    float quadratic = 0;
  };

  [[nodiscard]] static float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
  }

  [[nodiscard]] double start(std::size_t piece) const {
    return std::bit_cast<float>((first_ + static_cast<std::uint32_t>(piece)) << kBitsWithin);
  }

  // The parabola through three Chebyshev nodes: off by at most the third derivative times (width / 2)^3 / 24.
  template <class Curve>
  static Piece through(const Curve& curve, double left, double width) {
    constexpr double kNode = 0.8660254037844386 / 2;  // cos(pi / 6), of half a width
    const double middle = curve(left + 0.5 * width);
    const double before = curve(left + (0.5 - kNode) * width);
    const double after = curve(left + (0.5 + kNode) * width);
    const double step = kNode * width;
    const double slope = (after - before) / (2 * step);
    const double quadratic = (after - 2 * middle + before) / (2 * step * step);
    const double back = 0.5 * width;  // coefficients are about the left end
    return {static_cast<float>(middle - back * (slope - back * quadratic)),
            static_cast<float>(slope - 2 * back * quadratic), static_cast<float>(quadratic)};
  }

  static constexpr std::uint32_t kBitsWithin = 23 - 5;
  float low_;
  float high_;
  std::uint32_t first_;
  std::vector<Piece> pieces_;
};

// A footage's transfer function, both ways, within 1e-2 of an 8-bit code value (sRGB's: 1e-4) and many times as fast:
// blending asks for it six times a pixel. Where no piece is it is the function itself.
class TransferTable {
 public:
  explicit TransferTable(TransferFunction function);

  [[nodiscard]] float linear_of_display(float display) const {
    const float size = std::fabs(display);
    if (size <= toe_display_) return display / toe_slope_;
    return decode_.holds(size) ? std::copysign(decode_.at(size), display) : exact_linear(display);
  }

  [[nodiscard]] float display_of_linear(float linear) const {
    const float size = std::fabs(linear);
    if (size <= toe_linear_) return linear * toe_slope_;
    return encode_.holds(size) ? std::copysign(encode_.at(size), linear) : exact_display(linear);
  }

  // The function without the table.
  [[nodiscard]] float exact_linear(float display) const;
  [[nodiscard]] float exact_display(float linear) const;

 private:
  TransferFunction function_;
  float toe_display_;  // up to here the function is a straight line; below 0: nowhere
  float toe_linear_;
  float toe_slope_;
  PiecewiseParabola decode_;
  PiecewiseParabola encode_;
};

// Constants, computed at their first use.
[[nodiscard]] const TransferTable& transfer_table(TransferFunction function);

}  // namespace sigs
