// SPDX-License-Identifier: MIT
#include "video/color_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sigs {
namespace {

// A row of one of H.273's tables.
template <class Meaning>
struct CodePoint {
  int number = 0;
  const char* name = "";
  Meaning meaning{};
};

// Null where the table has no such number.
template <class Meaning, std::size_t kCount>
const CodePoint<Meaning>* find(const CodePoint<Meaning> (&table)[kCount], int number) {
  const auto* const found =
      std::find_if(table, table + kCount, [number](const auto& row) { return row.number == number; });
  return found == table + kCount ? nullptr : found;
}

template <class Meaning, std::size_t kCount>
std::string name_in(const CodePoint<Meaning> (&table)[kCount], int number) {
  const CodePoint<Meaning>* const known = find(table, number);
  return known == nullptr ? fmt::format("number {}", number) : known->name;
}

// Rec. ITU-R BT.2100-2, table 4: the reference PQ EOTF and its inverse.
constexpr double kM1 = 2610.0 / 16384;
constexpr double kM2 = 2523.0 / 4096 * 128;
constexpr double kC1 = 3424.0 / 4096;
constexpr double kC2 = 2413.0 / 4096 * 32;
constexpr double kC3 = 2392.0 / 4096 * 32;
constexpr double kPqWhite = 203.0 / 10000;                             // of the greatest light, 10,000 cd/m2
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

// Of values that are not negative.
struct Curve {
  double (*linear)(double display);
  double (*display)(double linear);
};

const Curve& curve_of(TransferFunction function) {
  constexpr auto kSame = [](double value) { return value; };
  static constexpr std::array<Curve, 6> kCurves{{
      {srgb_linear, srgb_display},
      {[](double display) { return std::pow(display, 2.2); }, [](double linear) { return std::pow(linear, 1 / 2.2); }},
      {[](double display) { return std::pow(display, 2.8); }, [](double linear) { return std::pow(linear, 1 / 2.8); }},
      {kSame, kSame},
      {pq_linear, pq_display},
      {hlg_linear, hlg_display},
  }};
  return kCurves.at(static_cast<std::size_t>(function));
}

// H.273 (07/2021), table 3.
constexpr CodePoint<std::optional<TransferFunction>> kTransfers[] = {{1, "BT.709", TransferFunction::srgb},
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

// Colour primaries. Chromaticity in CIE 1931 x, y.
struct Chromaticity {
  double x = 0;
  double y = 0;
};

struct Primaries {
  Chromaticity red;
  Chromaticity green;
  Chromaticity blue;
  Chromaticity white;
};

constexpr Chromaticity kD65{0.3127, 0.3290};
constexpr Chromaticity kWhiteC{0.310, 0.316};

constexpr Primaries kBt709{{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, kD65};
constexpr Primaries k525Lines{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, kD65};

// H.273 (07/2021), table 2.
constexpr CodePoint<Primaries> kPrimaries[] = {
    {1, "BT.709", kBt709},
    {2, "unspecified", kBt709},
    {4, "BT.470 M", {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, kWhiteC}},
    {5, "BT.601, 625 lines", {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, kD65}},
    {6, "BT.601, 525 lines", k525Lines},
    {7, "SMPTE 240M", k525Lines},
    {8, "film", {{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, kWhiteC}},
    {9, "BT.2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65}},
    {10, "CIE XYZ", {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}},
    {11, "DCI-P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
    {12, "Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65}},
    {22, "EBU 3213", {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, kD65}}};

cv::Vec3d xyz_of(const Chromaticity& c) {
  return {c.x / c.y, 1, (1 - c.x - c.y) / c.y};
}

// The matrix whose columns are the primaries' XYZ, scaled so that their sum is the white's (SMPTE RP 177).
cv::Matx33d xyz_of_rgb(const Primaries& p) {
  const auto column = [](const Chromaticity& c) { return cv::Vec3d(c.x, c.y, 1 - c.x - c.y); };
  const cv::Vec3d red = column(p.red);
  const cv::Vec3d green = column(p.green);
  const cv::Vec3d blue = column(p.blue);
  const cv::Matx33d directions(red[0], green[0], blue[0], red[1], green[1], blue[1], red[2], green[2], blue[2]);
  return directions * cv::Matx33d::diag(directions.inv() * xyz_of(p.white));
}

// Bradford's adaptation of XYZ from one white to another (Lam 1985, as in ICC.1, annex E).
cv::Matx33d adapted(const Chromaticity& from, const Chromaticity& to) {
  const cv::Matx33d cones(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296);
  const cv::Vec3d before = cones * xyz_of(from);
  const cv::Vec3d after = cones * xyz_of(to);
  const cv::Vec3d scale(after[0] / before[0], after[1] / before[1], after[2] / before[2]);
  return cones.inv() * cv::Matx33d::diag(scale) * cones;
}

}  // namespace

std::optional<TransferFunction> transfer_function_of(int code_point) {
  const auto* const known = find(kTransfers, code_point);
  return known == nullptr ? std::nullopt : known->meaning;
}

std::string transfer_name(int code_point) {
  return name_in(kTransfers, code_point);
}

double linear_of_display(TransferFunction function, double display) {
  return std::copysign(curve_of(function).linear(std::fabs(display)), display);
}

double display_of_linear(TransferFunction function, double linear) {
  return std::copysign(curve_of(function).display(std::fabs(linear)), linear);
}

double min_light(TransferFunction function, int bit_depth) {
  // Every curve of display over light is steepest at black and mirrored there, so a step of half a code value, placed
  // evenly about black, takes the minimum light.
  return 2 * linear_of_display(function, 0.25 / max_code(bit_depth));
}

std::optional<cv::Matx33d> from_bt709(int primaries) {
  const auto* const footage = find(kPrimaries, primaries);
  if (footage == nullptr) return std::nullopt;
  if (primaries == 1 || primaries == 2) return cv::Matx33d::eye();
  return xyz_of_rgb(footage->meaning).inv() * adapted(kBt709.white, footage->meaning.white) * xyz_of_rgb(kBt709);
}

std::string primaries_name(int primaries) {
  return name_in(kPrimaries, primaries);
}

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
