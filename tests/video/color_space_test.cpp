// SPDX-License-Identifier: MIT
#include "video/color_space.h"

#include <doctest/doctest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "base/transfer.h"
#include "support/test_data.h"
#include "video/clips.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

constexpr TransferFunction kAll[] = {TransferFunction::srgb,   TransferFunction::gamma22, TransferFunction::gamma28,
                                     TransferFunction::linear, TransferFunction::pq,      TransferFunction::hlg};

}  // namespace

TEST_CASE("PQ has the published signals of light") {
  // Rec. ITU-R BT.2408-4, table 1 and annex: signal by cd/m2, rounded there to a thousandth.
  for (const auto& [luminance_nits, signal] :
       {std::pair{0.0, 0.0}, {100.0, 0.508}, {203.0, 0.581}, {1000.0, 0.752}, {4000.0, 0.903}, {10000.0, 1.0}}) {
    const double nits = luminance_nits;
    CAPTURE(nits);
    CHECK(std::abs(display_of_linear(TransferFunction::pq, nits / 203) - signal) < 0.0006);
  }
  CHECK(linear_of_display(TransferFunction::pq, 1) == doctest::Approx(10000.0 / 203).epsilon(1e-12));
}

TEST_CASE("HLG has the published signals of light and shows white at 203 cd per square metre") {
  // BT.2100: 1/12 of the scene's light is half the signal, all of it the whole. BT.2408: reference white is 75 %.
  const double white = linear_of_display(TransferFunction::hlg, 0.75);
  const double whole = linear_of_display(TransferFunction::hlg, 1);
  CHECK(white == doctest::Approx(1).epsilon(1e-12));
  CHECK(linear_of_display(TransferFunction::hlg, 0.5) / whole == doctest::Approx(1.0 / 12).epsilon(1e-6));
  // The reference display of 1000 cd/m2 has a system gamma of 1.2; the standards round to whole cd/m2.
  CHECK(std::abs(1000 * std::pow(white / whole, 1.2) - 203) < 0.5);
}

TEST_CASE("sRGB's function is that of textures") {
  for (float x = -0.5F; x < 2; x += 0.01F) {
    CHECK(linear_of_display(TransferFunction::srgb, x) == doctest::Approx(linear_of_display(x)).epsilon(1e-5));
    CHECK(display_of_linear(TransferFunction::srgb, x) == doctest::Approx(display_of_linear(x)).epsilon(1e-5));
  }
}

TEST_CASE("conversion to light and back is the identity, also beyond black and white, and every function increases") {
  for (const TransferFunction function : kAll) {
    CAPTURE(static_cast<int>(function));
    double before = linear_of_display(function, -1.91);
    for (double display = -1.9; display < 2; display += 0.01) {
      const double linear = linear_of_display(function, display);
      CHECK(linear > before);
      before = linear;
      if (std::abs(display) < 1e-3) continue;  // PQ is 0 below 1e-6
      CHECK(display_of_linear(function, linear) == doctest::Approx(display).epsilon(1e-6));
    }
  }
}

TEST_CASE("the minimum light is half an 8-bit step at black") {
  CHECK(min_light(TransferFunction::srgb) == doctest::Approx(0.5 / 255 / 12.92).epsilon(1e-12));
  for (const TransferFunction function : kAll)
    for (const double below : {-0.002, -0.001, 0.0, 0.01, 0.1, 0.5, 1.0}) {
      CAPTURE(static_cast<int>(function));
      const double light = linear_of_display(function, below);
      CHECK(display_of_linear(function, light + min_light(function)) - below < 0.5001 / 255);
    }
}

TEST_CASE("light of BT709 has the published shares in BT2020 and white stays white") {
  // Rec. ITU-R BT.2087-0, equation for non-constant luminance, to four digits.
  const cv::Matx33d published(0.6274, 0.3293, 0.0433, 0.0691, 0.9195, 0.0114, 0.0164, 0.0880, 0.8956);
  const cv::Matx33d matrix = *from_bt709(9);
  for (int i = 0; i < 9; ++i) CHECK(std::abs(matrix.val[i] - published.val[i]) < 1e-4);
  for (const int primaries : {1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 22}) {
    CAPTURE(primaries);
    const cv::Vec3d white = *from_bt709(primaries) * cv::Vec3d(1, 1, 1);
    for (int c = 0; c < 3; ++c) CHECK(white[c] == doctest::Approx(1).epsilon(1e-9));
  }
  CHECK(*from_bt709(1) == cv::Matx33d::eye());
  CHECK(!from_bt709(3));
  CHECK(!from_bt709(99));
}

TEST_CASE("footage with an unsupported transfer function gives a warning in one line that names what is assumed") {
  for (const auto& [curve, primaries, words] :
       {std::tuple{9, 1, "logarithmic"}, {17, 1, "ST 428-1"}, {1, 1, ""}, {16, 9, ""}, {18, 9, ""}, {2, 2, ""}}) {
    const int transfer = curve;
    CAPTURE(transfer);
    const TemporaryFolder folder;
    VideoFormat format;
    format.container = Container::mkv;
    format.size_px = {64, 48};
    format.color.transfer = transfer;
    format.color.primaries = primaries;
    write_clip(folder / "a.mkv", format, 2);
    const FrameSource source = opened(folder / "a.mkv");
    CHECK(source.info().color.transfer == transfer);
    const std::vector<Warning>& warnings = source.info().warnings;
    REQUIRE(warnings.size() == (*words == '\0' ? 0 : 1));
    if (warnings.empty()) continue;
    CHECK(warnings[0].text().find(words) != std::string::npos);
    CHECK(warnings[0].text().find("sRGB") != std::string::npos);
  }
}

}  // namespace sigs::test
