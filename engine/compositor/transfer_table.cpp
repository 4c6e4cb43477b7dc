// SPDX-License-Identifier: MIT
#include "compositor/transfer_table.h"

#include <limits>

#include "base/transfer.h"

namespace sigs {

namespace {

// Powers of two between which a function is tabulated: from well below an 8-bit step to well beyond what codes hold.
struct Octaves {
  int decode_low = 0;
  int decode_high = 0;
  int encode_low = 0;
  int encode_high = 0;
};

Octaves octaves_of(TransferFunction function) {
  switch (function) {
    case TransferFunction::srgb:
    case TransferFunction::linear:
      return {-5, 2, -9, 2};
    case TransferFunction::gamma22:
      return {-9, 2, -20, 2};
    case TransferFunction::gamma28:
      return {-9, 2, -26, 2};
    case TransferFunction::pq:
      return {-9, 1, -22, 6};
    case TransferFunction::hlg:
      return {-9, 1, -19, 6};
  }
  return {};
}

struct Toe {
  float display = -1;
  float linear = -1;
  float slope = 1;
};

Toe toe_of(TransferFunction function) {
  constexpr float kEverywhere = std::numeric_limits<float>::infinity();
  if (function == TransferFunction::srgb) return {0.04045F, 0.0031308F, 12.92F};
  if (function == TransferFunction::linear) return {kEverywhere, kEverywhere, 1};
  return {};
}

// sRGB's curve above its toe, whose straight line begins within the first piece.
double decoded(TransferFunction function, double display) {
  if (function == TransferFunction::srgb) return std::pow((display + 0.055) / 1.055, 2.4);
  return linear_of_display(function, display);
}

double encoded(TransferFunction function, double linear) {
  if (function == TransferFunction::srgb) return 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return display_of_linear(function, linear);
}

}  // namespace

TransferTable::TransferTable(TransferFunction function)
    : function_(function),
      toe_display_(toe_of(function).display),
      toe_linear_(toe_of(function).linear),
      toe_slope_(toe_of(function).slope),
      decode_(octaves_of(function).decode_low, octaves_of(function).decode_high,
              [function](double display) { return decoded(function, display); }),
      encode_(octaves_of(function).encode_low, octaves_of(function).encode_high,
              [function](double linear) { return encoded(function, linear); }) {}

float TransferTable::exact_linear(float display) const {
  if (function_ == TransferFunction::srgb) return sigs::linear_of_display(display);
  return static_cast<float>(sigs::linear_of_display(function_, display));
}

float TransferTable::exact_display(float linear) const {
  if (function_ == TransferFunction::srgb) return sigs::display_of_linear(linear);
  return static_cast<float>(sigs::display_of_linear(function_, linear));
}

const TransferTable& transfer_table(TransferFunction function) {
  static const TransferTable kTables[] = {
      TransferTable(TransferFunction::srgb),    TransferTable(TransferFunction::gamma22),
      TransferTable(TransferFunction::gamma28), TransferTable(TransferFunction::linear),
      TransferTable(TransferFunction::pq),      TransferTable(TransferFunction::hlg)};
  return kTables[static_cast<std::size_t>(function)];
}

}  // namespace sigs
