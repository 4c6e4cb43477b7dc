// SPDX-License-Identifier: MIT
#include "video/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/ensure.h"

namespace sigs {
namespace {

// Rec. ITU-R BT.2100-2, table 4: the reference PQ EOTF and its inverse.
constexpr double kM1 = 2610.0 / 16384;
constexpr double kM2 = 2523.0 / 4096 * 128;
constexpr double kC1 = 3424.0 / 4096;
constexpr double kC2 = 2413.0 / 4096 * 32;
constexpr double kC3 = 2392.0 / 4096 * 32;
constexpr double kPqWhite = 203.0 / 10000;                             // of the scale's end
constexpr double kPqSlopeAtEnd = (1 + kC3) / (1 - kC1) / (kM1 * kM2);  // since c1 = c3 - c2 + 1

double pq_linear(double display) {
  if (display > 1) return (1 + kPqSlopeAtEnd * (display - 1)) / kPqWhite;
  const double n = std::pow(display, 1 / kM2);
  return std::pow(std::fmax(n - kC1, 0) / (kC2 - kC3 * n), 1 / kM1) / kPqWhite;
}

double pq_display(double linear) {
  const double share = linear * kPqWhite;
  if (share > 1) return 1 + (share - 1) / kPqSlopeAtEnd;
  const double y = std::pow(share, kM1);
  return std::pow((kC1 + kC2 * y) / (1 + kC3 * y), kM2);
}

// BT.2100-2, table 5: the reference HLG OETF and its inverse.
constexpr double kA = 0.17883277;
constexpr double kB = 1 - 4 * kA;
const double kC = 0.5 - kA * std::log(4 * kA);
constexpr double kHlgWhite = 0.75;  // signal

double hlg_scene(double display) {
  return display <= 0.5 ? display * display / 3 : (std::exp((display - kC) / kA) + kB) / 12;
}

double hlg_linear(double display) {
  return hlg_scene(display) / hlg_scene(kHlgWhite);
}

double hlg_display(double linear) {
  const double scene = linear * hlg_scene(kHlgWhite);
  return scene <= 1.0 / 12 ? std::sqrt(3 * scene) : kA * std::log(12 * scene - kB) + kC;
}

double srgb_linear(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

double srgb_display(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_of_size(TransferFunction function, double display) {
  switch (function) {
    case TransferFunction::srgb:
      return srgb_linear(display);
    case TransferFunction::gamma22:
      return std::pow(display, 2.2);
    case TransferFunction::gamma28:
      return std::pow(display, 2.8);
    case TransferFunction::linear:
      return display;
    case TransferFunction::pq:
      return pq_linear(display);
    case TransferFunction::hlg:
      return hlg_linear(display);
  }
  ENSURE(false);
}

double display_of_size(TransferFunction function, double linear) {
  switch (function) {
    case TransferFunction::srgb:
      return srgb_display(linear);
    case TransferFunction::gamma22:
      return std::pow(linear, 1 / 2.2);
    case TransferFunction::gamma28:
      return std::pow(linear, 1 / 2.8);
    case TransferFunction::linear:
      return linear;
    case TransferFunction::pq:
      return pq_display(linear);
    case TransferFunction::hlg:
      return hlg_display(linear);
  }
  ENSURE(false);
}

struct CodePoint {
  int number = 0;
  const char* name = "";
  std::optional<TransferFunction> function;
};

// H.273 (07/2021), table 3.
constexpr CodePoint kCodePoints[] = {{1, "BT.709", TransferFunction::srgb},
                                     {2, "unspecified", TransferFunction::srgb},
                                     {4, "gamma 2.2", TransferFunction::gamma22},
                                     {5, "gamma 2.8", TransferFunction::gamma28},
                                     {6, "BT.601", TransferFunction::srgb},
                                     {7, "SMPTE 240M", TransferFunction::srgb},
                                     {8, "linear", TransferFunction::linear},
                                     {9, "logarithmic 100:1", std::nullopt},
                                     {10, "logarithmic 316:1", std::nullopt},
                                     {11, "xvYCC", TransferFunction::srgb},
                                     {12, "BT.1361", std::nullopt},
                                     {13, "sRGB", TransferFunction::srgb},
                                     {14, "BT.2020", TransferFunction::srgb},
                                     {15, "BT.2020", TransferFunction::srgb},
                                     {16, "PQ", TransferFunction::pq},
                                     {17, "ST 428-1", std::nullopt},
                                     {18, "HLG", TransferFunction::hlg}};

const CodePoint* find(int number) {
  const auto* const found = std::ranges::find(kCodePoints, number, &CodePoint::number);
  return found == std::end(kCodePoints) ? nullptr : found;
}

}  // namespace

std::optional<TransferFunction> transfer_function_of(int code_point) {
  const CodePoint* const known = find(code_point);
  return known == nullptr ? std::nullopt : known->function;
}

std::string transfer_name(int code_point) {
  const CodePoint* const known = find(code_point);
  return known == nullptr ? "number " + std::to_string(code_point) : known->name;
}

double linear_of_display(TransferFunction function, double display) {
  return std::copysign(linear_of_size(function, std::fabs(display)), display);
}

double display_of_linear(TransferFunction function, double linear) {
  return std::copysign(display_of_size(function, std::fabs(linear)), linear);
}

double min_light(TransferFunction function) {
  // Every curve is steepest at black and mirrored there, so nothing rises faster than across it.
  return 2 * linear_of_display(function, 0.25 / 255);
}

}  // namespace sigs
