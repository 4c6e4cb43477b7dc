// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sigs {

// An edge of the image followed from pixel to pixel, to parts of a pixel: a straight line of the world, perhaps.
using EdgeChain = std::vector<cv::Point2d>;

// Long edges of an image that bend little: edges by Canny (1986), places across them by a parabola through the steepest
// slopes. Each is at least `min_length` of the image's width long from end to end, deviates from its chord by less
// than a fifteenth of that, and follows a smooth curve to 0.5 px. In pixels of `luma`, CV_8UC1.
[[nodiscard]] std::vector<EdgeChain> long_edges(const cv::Mat& luma, double min_length);

// The distortion that straight lines of the world show, by which their images bend (Brown 1971, "Close-range camera
// calibration": the plumb-line method). It tells nothing of the focal length.
struct LinesAnswer {
  bool is_certain = false;
  std::string reason;     // why not
  double distortion = 0;  // RoughLens::distortion
  double sd = 0;
  int lines = 0;                 // lines at different places of the image that were used
  int agree = 0;                 // of them, those that this distortion straightens
  int frame = -1;                // the frame with the most edges, for a plot
  std::vector<EdgeChain> edges;  // of that frame, px
};

// Collects long edges of some frames.
class LinesRoad {
 public:
  // luma: CV_8UC1, all of the same size.
  void add(int frame, const cv::Mat& luma);

  // The distortion that straightens most edges best. Edges of one place and direction in the image, in whatever frame,
  // count as one; the standard deviation is by drawing places anew (bootstrap, Efron 1979). Not certain where there are
  // few, most stay curved, or what is drawn spreads: roads, hills and clouds have edges that bend themselves.
  [[nodiscard]] LinesAnswer answer() const;

 private:
  struct Seen {
    int frame = 0;
    std::vector<EdgeChain> edges;
  };
  cv::Size size_px_;
  std::vector<Seen> seen_;
};

}  // namespace sigs
