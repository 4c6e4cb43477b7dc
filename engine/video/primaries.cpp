// SPDX-License-Identifier: MIT
#include "video/primaries.h"

#include <algorithm>
#include <iterator>

namespace sigs {
namespace {

// CIE 1931 x, y.
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

struct CodePoint {
  int number = 0;
  const char* name = "";
  Primaries primaries;
};

constexpr Primaries kBt709{{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, kD65};
constexpr Primaries k525Lines{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, kD65};

// H.273 (07/2021), table 2.
constexpr CodePoint kCodePoints[] = {{1, "BT.709", kBt709},
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

const CodePoint* find(int number) {
  const auto* const found = std::ranges::find(kCodePoints, number, &CodePoint::number);
  return found == std::end(kCodePoints) ? nullptr : found;
}

cv::Vec3d xyz_of(const Chromaticity& c) {
  return {c.x / c.y, 1, (1 - c.x - c.y) / c.y};
}

// Columns: the primaries' XYZ, scaled so that their sum is the white's. SMPTE RP 177.
cv::Matx33d xyz_of_rgb(const Primaries& p) {
  const auto column = [](const Chromaticity& c) { return cv::Vec3d(c.x, c.y, 1 - c.x - c.y); };
  const cv::Vec3d red = column(p.red);
  const cv::Vec3d green = column(p.green);
  const cv::Vec3d blue = column(p.blue);
  const cv::Matx33d directions(red[0], green[0], blue[0], red[1], green[1], blue[1], red[2], green[2], blue[2]);
  return directions * cv::Matx33d::diag(directions.inv() * xyz_of(p.white));
}

// Lam 1985, as in ICC.1, annex E.
cv::Matx33d adapted(const Chromaticity& from, const Chromaticity& to) {
  const cv::Matx33d cones(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296);
  const cv::Vec3d before = cones * xyz_of(from);
  const cv::Vec3d after = cones * xyz_of(to);
  const cv::Vec3d scale(after[0] / before[0], after[1] / before[1], after[2] / before[2]);
  return cones.inv() * cv::Matx33d::diag(scale) * cones;
}

}  // namespace

std::optional<cv::Matx33d> from_bt709(int primaries) {
  const CodePoint* const footage = find(primaries);
  if (footage == nullptr) return std::nullopt;
  if (primaries == 1 || primaries == 2) return cv::Matx33d::eye();
  return xyz_of_rgb(footage->primaries).inv() * adapted(kBt709.white, footage->primaries.white) * xyz_of_rgb(kBt709);
}

std::string primaries_name(int primaries) {
  const CodePoint* const known = find(primaries);
  return known == nullptr ? "number " + std::to_string(primaries) : known->name;
}

}  // namespace sigs
