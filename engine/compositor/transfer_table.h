// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/transfer.h"

namespace sigs {

// A curve over [low, high), both powers of two, as parabolas on 32 equal parts of each octave. The parts of a float are
// its leading bits, so finding one takes no search.
template <int low_exponent, int high_exponent>
class PiecewiseParabola {
 public:
  template <class Curve>
  explicit PiecewiseParabola(const Curve& curve) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const double left = start(i);
      pieces_[i] = through(curve, left, start(i + 1) - left);
    }
  }

  static constexpr float low() { return kLow; }
  static constexpr float high() { return kHigh; }

  // low() <= x < high()
  [[nodiscard]] float at(float x) const {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const Piece& piece = pieces_[(bits >> kBitsWithin) - kFirst];
    const float along = x - std::bit_cast<float>((bits >> kBitsWithin) << kBitsWithin);
    return piece.value + along * (piece.slope + along * piece.bend);
  }

 private:
  struct Piece {
    float value = 0;
    float slope = 0;
    float bend = 0;
  };

  static constexpr float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
  }

  static double start(std::size_t piece) {
    return std::bit_cast<float>((kFirst + static_cast<std::uint32_t>(piece)) << kBitsWithin);
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
    const double bend = (after - 2 * middle + before) / (2 * step * step);
    const double back = 0.5 * width;  // coefficients are about the left end
    return {static_cast<float>(middle - back * (slope - back * bend)), static_cast<float>(slope - 2 * back * bend),
            static_cast<float>(bend)};
  }

  static constexpr std::uint32_t kBitsWithin = 23 - 5;
  static constexpr float kLow = power_of_two(low_exponent);
  static constexpr float kHigh = power_of_two(high_exponent);
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kLow) >> kBitsWithin;
  std::array<Piece, static_cast<std::size_t>(high_exponent - low_exponent) * 32> pieces_;
};

// The curve of base/transfer.h, both ways, within 1e-4 of an 8-bit code value and many times as fast: blending asks for
// it six times a pixel. Beyond +-4 it is that curve itself.
class TransferTable {
 public:
  TransferTable();

  [[nodiscard]] float linear_of_display(float display) const {
    const float size = std::fabs(display);
    if (size <= 0.04045F) return display / 12.92F;
    return size < decode_.high() ? std::copysign(decode_.at(size), display) : sigs::linear_of_display(display);
  }

  [[nodiscard]] float display_of_linear(float linear) const {
    const float size = std::fabs(linear);
    if (size <= 0.0031308F) return linear * 12.92F;
    return size < encode_.high() ? std::copysign(encode_.at(size), linear) : sigs::display_of_linear(linear);
  }

 private:
  PiecewiseParabola<-5, 2> decode_;
  PiecewiseParabola<-9, 2> encode_;
};

// A constant, computed at its first use.
[[nodiscard]] const TransferTable& transfer_table();

}  // namespace sigs
