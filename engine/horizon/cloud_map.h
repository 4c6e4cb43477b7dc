// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "horizon/sky_map.h"
#include "video/frame.h"

namespace sigs {

// Polynomials of the place in an image that clear sky follows: of the second degree across (u) and of the fourth down
// (v), both from -1 to 1.
inline constexpr int kSkyTerms = 8;
using SkyTerms = std::array<double, kSkyTerms>;

[[nodiscard]] SkyTerms sky_terms(double u, double v);
[[nodiscard]] double value_of(const SkyTerms& fit, const SkyTerms& terms);

// A place of the sky.
struct SkyPlace {
  SkyTerms terms{};
  cv::Vec3f light;        // linear red, green, blue
  double saturation = 0;  // blue less red, of the luminance
};

// Weighted least squares, held a little towards 0 where the sky does not determine a term, and more so across the
// image: clear sky differs from row to row, and clouds on one side are not to pass for it.
[[nodiscard]] SkyTerms fitted(const std::vector<SkyPlace>& samples, const std::function<double(const SkyPlace&)>& value,
                              const std::function<double(const SkyPlace&)>& weight);

// The bluest sky: the 0.97 expectile of saturation, in which residuals above count 0.97 and those below 0.03.
[[nodiscard]] SkyTerms bluest(const std::vector<SkyPlace>& samples);

// What the clouds of a frame do to whatever is behind them, over a part of the image.
struct CloudPart {
  cv::Mat_<float> opacity;         // 0 clear sky or none at all, 1 nothing shows through
  cv::Mat_<cv::Vec3f> brightness;  // that they have beyond the clear sky: linear light, BT.709's primaries
};

// The clouds of one frame, by that frame alone.
//
// A cloud mixes its own light c with the clear sky's light s: what is seen is p = (1 - a) s + a c, with the opacity a.
// The clear sky is smooth: polynomials of the place in the image (second degree across, fourth down) are fitted to the
// bluest of the sky, as 0.97-expectiles, and then to what agrees with them. Two roads bound the opacity from below, and
// the higher one counts:
//   brightness  no cloud is brighter than b: a >= (p - s) / (b - s) of luminance. b is the 0.99 quantile of the sky,
//               and at least 0.8 of white
//   colour      clouds are neutral: a >= 1 - (blue - red of p) / (blue - red of s). Gray footage does not have it
// A sky of which nothing is blue is overcast: opaque everywhere.
//
// Limits: haze above the horizon and a bank of far clouds look alike, and what is the same all along the horizon counts
// as haze. Clouds as blue as the sky and no brighter, such as shadowed ones in gray footage, are not seen. Things in
// front of the sky that are not blue look like clouds. What lies below the sky's lower end (sky_map.h) is cloud or sky
// only where it joins the sky, and is brighter and less blue than clear sky, or as blue as sky.
class CloudMap {
 public:
  //   own_body  CV_8UC1 of any size, above 127 where the own body is; may be empty
  explicit CloudMap(const Frame& frame, const cv::Mat& own_body = {});

  //   rect  of the frame's pixels; beyond the frame the nearest pixels count
  [[nodiscard]] CloudPart part(const cv::Rect& rect) const;

  // Whether there is enough sky to say anything; without it no cloud is seen.
  [[nodiscard]] bool has_sky() const { return has_sky_; }
  // The share of the sky where clouds take at least this much, 0..1; 0 without a sky.
  [[nodiscard]] double cover(double least_opacity) const;

 private:
  struct ClearSky {
    SkyTerms saturation{};            // blue less red, over luminance
    std::array<SkyTerms, 3> light{};  // linear red, green, blue
  };
  struct Cells;

  [[nodiscard]] SkyTerms terms_at(double x_px, double y_px) const;  // of the reduced image
  [[nodiscard]] int first_clear_row(const Cells& cells) const;
  void find_clear_sky(const Cells& cells);
  void measure_noise(const std::vector<SkyPlace>& clear_samples);
  void add_bright_clouds(const Cells& cells);
  void fill_holes(const Cells& cells);
  [[nodiscard]] cv::Vec3f clear_light(const SkyTerms& terms) const;
  [[nodiscard]] cv::Vec3f linear(const cv::Vec3f& codes) const;
  [[nodiscard]] cv::Point2d in_reduced(double x_px, double y_px) const;
  [[nodiscard]] cv::Point cell_of(const cv::Point& pixel) const;  // pixel of the reduced image
  // Of the reduced image; around may extend beyond it.
  [[nodiscard]] CloudPart window_of(const cv::Rect& around) const;
  [[nodiscard]] double opacity_of(const cv::Vec3f& light, const cv::Vec3f& clear) const;

  cv::Mat_<cv::Vec3f> codes_;  // of the frame, reduced
  CodeToRgb map_;
  ColorInfo color_;
  cv::Matx33f to_bt709_;
  cv::Size2d reduction_;   // pixels of the frame in one of the reduced image
  cv::Mat_<uchar> sky_;    // of cells: 255 sky with its clouds, 128 something in it, 0 anything else
  cv::Mat_<uchar> inner_;  // likewise: 255 where it is sky all around
  ClearSky clear_;
  std::array<double, 2> rows_px_{};           // of the reduced image, between which clear sky was seen
  double brightest_ = 0;                      // luminance of an opaque cloud
  double bright_noise_ = 0, blue_noise_ = 0;  // by which clear sky may be off
  double overcast_ = 0;                       // how far the sky is taken for overcast, 0..1
  bool has_colour_ = false;
  bool has_sky_ = false;
};

}  // namespace sigs
