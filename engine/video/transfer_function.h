// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace sigs {

// How R'G'B' of footage stand for linear light, in which 1 is diffuse white: what a white face in the sun becomes.
enum class TransferFunction {
  srgb,     // IEC 61966-2-1, and all of standard dynamic range: see below
  gamma22,  // a power of 2.2 (BT.470 System M)
  gamma28,  // a power of 2.8 (BT.470 System B, G)
  linear,
  pq,   // SMPTE ST 2084, Rec. ITU-R BT.2100: light on the display; 1 is 203 cd/m2, HDR reference white (BT.2408)
  hlg,  // ARIB STD-B67, BT.2100: light in the scene; 1 is the light of 75 % signal, HDR reference white (BT.2408)
};

// The function for an ISO/IEC 23091-2 (H.273) code point of TransferCharacteristics. Nothing for those that are not
// followed (logarithmic, ST 428-1, unknown numbers); sRGB's is the one to assume then.
//
// sRGB's also stands for unspecified, BT.709, BT.601, BT.2020, SMPTE 240M and xvYCC. Those standards' own curves are
// of cameras that no camera in the field has, made for displays with a gamma of 2.4 (BT.1886). sRGB's lies between that
// inverse (about 1.9) and the display, and textures keep their code values under it. Half way through an edge it
// differs by at most 4 code values of 255 from the display's, 8 from the cameras'.
[[nodiscard]] std::optional<TransferFunction> transfer_function_of(int code_point);

// "PQ" for 16; "number 19" where the standard has none.
[[nodiscard]] std::string transfer_name(int code_point);

// Display value (0..1, as code_to_rgb gives it) to light and back. Negative values go through the mirror image. PQ ends
// at 1 (10,000 cd/m2) and goes on along its tangent there; the others go on by their own formula.
[[nodiscard]] double linear_of_display(TransferFunction function, double display);
[[nodiscard]] double display_of_linear(TransferFunction function, double linear);

// The light above black that is half an 8-bit step: what adds less to whatever is there changes no sample.
[[nodiscard]] double min_light(TransferFunction function);

}  // namespace sigs
