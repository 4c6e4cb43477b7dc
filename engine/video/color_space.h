// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "base/transfer.h"
#include "video/frame.h"

namespace sigs {

// What the code points of ISO/IEC 23091-2 (Rec. ITU-T H.273) for colour mean: the relation of display values to linear
// light (transfer characteristics), and which red, green and blue they are values of (colour primaries).

// The relation of the footage's R'G'B' to linear light. 1 is diffuse white: the light of a white surface in the sun.
enum class TransferFunction {
  srgb,     // IEC 61966-2-1, and all of standard dynamic range: see transfer_function_of
  gamma22,  // a power of 2.2 (BT.470 System M)
  gamma28,  // a power of 2.8 (BT.470 System B, G)
  linear,
  pq,   // SMPTE ST 2084, Rec. ITU-R BT.2100: light on the display; 1 is 203 cd/m2, HDR reference white (BT.2408)
  hlg,  // ARIB STD-B67, BT.2100: light in the scene; 1 is the light of 75 % signal, HDR reference white (BT.2408)
};

// The function of a code point of TransferCharacteristics (H.273, table 3). Nothing for those that are not supported
// (logarithmic, BT.1361, ST 428-1, unknown numbers); sRGB's is then the one to assume.
//
// sRGB's is also used for unspecified, BT.709, BT.601, BT.2020, SMPTE 240M and xvYCC. The curves in those standards are
// of reference cameras that real cameras do not follow, meant for displays with a gamma of 2.4 (BT.1886). sRGB's lies
// between their inverse (a gamma of about 1.9) and the display, and textures keep their code values under it. Half way
// through an edge it differs by at most 4 code values of 255 from the display's curve, 8 from the cameras'.
[[nodiscard]] std::optional<TransferFunction> transfer_function_of(int code_point);

// Name of a code point of TransferCharacteristics: "PQ" for 16; "number 19" where the standard has none.
[[nodiscard]] std::string transfer_name(int code_point);

// Converts a display value (0..1, as code_to_rgb gives it) to light and back. Negative values are mirrored: f(-x) =
// -f(x). Above 1 (10,000 cd/m2) PQ continues along its tangent; the other functions continue by their own formula.
[[nodiscard]] double linear_of_display(TransferFunction function, double display);
[[nodiscard]] double display_of_linear(TransferFunction function, double linear);

// The light of half a step of this depth where the curve is steepest, around black. Less light than this, added to any
// sample, changes no code value.
[[nodiscard]] double min_light(TransferFunction function, int bit_depth = 8);

// The matrix that converts linear light from BT.709's (sRGB's) red, green and blue to those of the footage. White stays
// white, by Bradford's chromatic adaptation (Lam 1985) where the white points differ.
//   primaries  a code point of ColourPrimaries (H.273, table 2); unspecified is taken as BT.709
// Nothing for numbers that the standard does not define.
[[nodiscard]] std::optional<cv::Matx33d> from_bt709(int primaries);

// Name of a code point of ColourPrimaries: "BT.2020" for 9; "number 3" where the standard has none.
[[nodiscard]] std::string primaries_name(int primaries);

// Between a layer's light (linear, BT.709's primaries, 1 for diffuse white) and the light that a footage's code values
// stand for. What the footage states and SIGS does not follow is taken for sRGB's curve and BT.709's primaries; opening
// it warns of that.

// A footage's transfer function, both ways; display values are 0 to 1.
class TransferCurve {
 public:
  explicit TransferCurve(TransferFunction function) : function_(function) {}

  [[nodiscard]] float linear_of_display(float display) const {
    if (function_ == TransferFunction::srgb) return sigs::linear_of_display(display);
    return static_cast<float>(sigs::linear_of_display(function_, display));
  }

  [[nodiscard]] float display_of_linear(float linear) const {
    if (function_ == TransferFunction::srgb) return sigs::display_of_linear(linear);
    return static_cast<float>(sigs::display_of_linear(function_, linear));
  }

 private:
  TransferFunction function_;
};

[[nodiscard]] TransferCurve transfer_curve_of(const ColorInfo& color);

// A layer's colour (CV_32FC4, premultiplied) in the footage's primaries. Shares its samples where they are BT.709's.
[[nodiscard]] cv::Mat in_footage_primaries(const cv::Mat& layer_color, const ColorInfo& color);

}  // namespace sigs
