// SPDX-License-Identifier: MIT
#include "appearance/target_silhouette.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sigs {

namespace {

constexpr int kMargin_px = 14;  // within which background is compared and the target's traces are measured
constexpr int kBesideBox_px = 8;
constexpr int kPlaceStep_px = 6;  // no multiple of a codec's blocks: their grid must not always lie alike
constexpr std::size_t kChoices = 3;
constexpr double kSameMean = 6;  // code values that weigh as much as a standard deviation larger by a factor of e

struct Shade {
  double mean = 0, sd = 0;
};

// Mean and standard deviation of luma over rectangles, from sums.
class Shades {
 public:
  explicit Shades(const cv::Mat& luma) { cv::integral(luma, sum_, squares_, CV_64F, CV_64F); }

  // Over `outer` without `inner`, which may be empty.
  [[nodiscard]] Shade over(const cv::Rect& outer, const cv::Rect& inner = {}) const {
    const cv::Rect hole = inner & outer;
    const double count = std::max(1, outer.area() - hole.area());
    const double mean = (in(sum_, outer) - in(sum_, hole)) / count;
    const double square = (in(squares_, outer) - in(squares_, hole)) / count;
    return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
  }

 private:
  static double in(const cv::Mat& sums, const cv::Rect& part) {
    const cv::Point low = part.tl(), high = part.br();
    return sums.at<double>(high.y, high.x) - sums.at<double>(low.y, high.x) - sums.at<double>(high.y, low.x) +
           sums.at<double>(low.y, low.x);
  }

  cv::Mat sum_, squares_;
};

struct Place {
  cv::Point2d middle;
  double unlike = 0;
};

}  // namespace

std::optional<cv::Point2d> similar_place(const Frame& frame, const Box& box, cv::Size size_px, std::uint32_t seed) {
  const cv::Rect image({0, 0}, frame.size_px());
  const cv::Rect taken = pixels_touched(box, 2, image);
  const Shades shades(frame.planes[0]);
  const Shade wanted = shades.over(grown(taken, kMargin_px) & image, taken);
  std::vector<Place> places;
  const cv::Size outer = size_px + cv::Size(2 * kMargin_px, 2 * kMargin_px);
  for (int y = 0; y + outer.height <= image.height; y += kPlaceStep_px)
    for (int x = 0; x + outer.width <= image.width; x += kPlaceStep_px) {
      const cv::Rect part({x, y}, outer);
      if (!(grown(part, kBesideBox_px - kMargin_px) & grown(taken, kMargin_px)).empty()) continue;
      const Shade here = shades.over(part);
      places.push_back({.middle = {x + 0.5 * (outer.width - 1), y + 0.5 * (outer.height - 1)},
                        .unlike = std::abs(here.mean - wanted.mean) / kSameMean +
                                  std::abs(std::log((here.sd + 1) / (wanted.sd + 1)))});
    }
  if (places.empty()) return std::nullopt;
  const std::size_t count = std::min(kChoices, places.size());
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count), places.end(),
                    [](const Place& a, const Place& b) { return a.unlike < b.unlike; });
  return places[seed % count].middle;
}

}  // namespace sigs
