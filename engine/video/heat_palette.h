// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "video/frame.h"

namespace sigs {

// How a thermal camera shows heat. Each but gray is a row of 256 colours from cold to warm: iron and rainbow are those
// of FLIR's cameras, the others the colour maps of these names in OpenCV.
enum class HeatPalette { gray, iron, rainbow, hot, jet, turbo, inferno, magma, plasma };
inline constexpr std::array<std::string_view, 9> kHeatPaletteNames = {"gray",  "iron",    "rainbow", "hot",   "jet",
                                                                      "turbo", "inferno", "magma",   "plasma"};

// From here on, in 8-bit codes of red, green and blue in the mean, colours are not those of a palette.
inline constexpr double kMaxOffPalette_codes = 20;

// Footage in a palette as the heat that it shows, and heat as the colours that the camera would have given it. Not for
// several threads at a time.
class HeatColors {
 public:
  // palette: not gray
  explicit HeatColors(HeatPalette palette);

  [[nodiscard]] HeatPalette palette() const { return palette_; }

  // A frame's heat: gray of 8 bits in full range, the number of the nearest colour, 0 coldest. Time, damage and
  // quantisers are the frame's.
  struct Heat {
    Frame frame;
    double off_codes = 0;  // distance of the frame's colours from those of the palette, mean over the pixels
  };
  [[nodiscard]] Heat heat_of(const Frame& frame) const;

  // Gives the image the colours of `after` where it has those of `before` (both CV_8UC1 of the image's size): each
  // sample changes as its colour does, so what compression has made of it stays. Where both are the same, samples keep
  // their bits.
  void show(const cv::Mat& before, const cv::Mat& after, Frame& image) const;

 private:
  [[nodiscard]] int nearest(const cv::Vec3b& bgr) const;

  HeatPalette palette_;
  cv::Mat colors_;                            // CV_8UC3, 256 x 1, BGR
  mutable std::vector<std::int16_t> coarse_;  // nearest colour of each cell of 4 codes; below 0: not yet asked for
};

// None of gray: there is nothing to undo.
[[nodiscard]] std::optional<HeatColors> heat_colors(HeatPalette palette);

// Which palette footage has, by a few of its frames.
class PaletteSearch {
 public:
  void add(const Frame& frame);

  // The palette from which their colours are off least; none where they are gray, show nearly a single tone, or have
  // colours of another kind.
  struct Found {
    HeatPalette palette = HeatPalette::gray;
    double off_codes = 0;  // as Heat::off_codes
  };
  [[nodiscard]] std::optional<Found> found() const;

 private:
  std::vector<Frame> small_;
  double color_codes_ = 0;  // sum over the frames of how far they are from gray in the mean
};

}  // namespace sigs
