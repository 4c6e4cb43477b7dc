// SPDX-License-Identifier: MIT
#include "calibration/rough_chains.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace sigs {

namespace {

constexpr int kMaxWidth_px = 1400;  // larger images are halved
constexpr double kBlur_px = 1.0;
constexpr double kLow = 60;  // of Canny, of Sobel's sums
constexpr double kHigh = 160;
constexpr double kSameSide = 0.88;  // cosine between the slopes of neighbours
constexpr double kBend = 1.0 / 15;  // of the length
constexpr double kSmooth_px = 0.5;
constexpr std::size_t kPoints = 60;  // that are kept of a chain
constexpr double kBorder_px = 3;

class ChainFinder {
 public:
  explicit ChainFinder(const cv::Mat& luma) {
    cv::Mat smooth;
    cv::GaussianBlur(luma, smooth, {}, kBlur_px);
    cv::Sobel(smooth, dx_, CV_16S, 1, 0);
    cv::Sobel(smooth, dy_, CV_16S, 0, 1);
    cv::Canny(dx_, dy_, open_, kLow, kHigh, true);
  }

  std::vector<EdgeChain> all(double least_px) {
    std::vector<EdgeChain> chains;
    for (int y = 0; y < open_.rows; ++y)
      for (int x = 0; x < open_.cols; ++x) {
        if (open_(y, x) == 0) continue;
        EdgeChain chain = followed({x, y}, 1);
        std::reverse(chain.begin(), chain.end());
        open_(y, x) = 255;
        const EdgeChain other = followed({x, y}, -1);
        if (!other.empty()) chain.insert(chain.end(), other.begin() + 1, other.end());
        if (cv::norm(chain.back() - chain.front()) >= least_px) chains.push_back(std::move(chain));
      }
    return chains;
  }

 private:
  [[nodiscard]] cv::Point2d slope(cv::Point at) const {
    return {static_cast<double>(dx_(at)), static_cast<double>(dy_(at))};
  }

  // Along the edge from a pixel: bright side to the right (way 1) or to the left (-1).
  EdgeChain followed(cv::Point at, int way) {
    EdgeChain chain;
    for (;;) {
      open_(at) = 0;
      chain.push_back(refined(at));
      const cv::Point2d here = slope(at);
      const double size = cv::norm(here);
      const cv::Point2d along(way * here.y / size, -way * here.x / size);
      double best = 0.3;
      cv::Point next(-1, -1);
      for (int v = -1; v <= 1; ++v)
        for (int u = -1; u <= 1; ++u) {
          const cv::Point there = at + cv::Point(u, v);
          if ((u == 0 && v == 0) || !cv::Rect({}, open_.size()).contains(there) || open_(there) == 0) continue;
          const cv::Point2d other = slope(there);
          if (here.dot(other) < kSameSide * size * cv::norm(other)) continue;
          const double ahead = (u * along.x + v * along.y) / std::hypot(u, v);
          if (ahead > best) {
            best = ahead;
            next = there;
          }
        }
      if (next.x < 0) return chain;
      at = next;
    }
  }

  [[nodiscard]] double steepness(cv::Point2d at) const {
    const int x = static_cast<int>(std::floor(at.x));
    const int y = static_cast<int>(std::floor(at.y));
    if (x < 0 || y < 0 || x + 1 >= dx_.cols || y + 1 >= dx_.rows) return 0;
    const double u = at.x - x;
    const double v = at.y - y;
    const auto size = [this](int px, int py) { return cv::norm(slope({px, py})); };
    return (1 - v) * ((1 - u) * size(x, y) + u * size(x + 1, y)) +
           v * ((1 - u) * size(x, y + 1) + u * size(x + 1, y + 1));
  }

  [[nodiscard]] cv::Point2d refined(cv::Point at) const {
    const cv::Point2d across = slope(at) / cv::norm(slope(at));
    const cv::Point2d middle(at);
    const double before = steepness(middle - across);
    const double there = steepness(middle);
    const double after = steepness(middle + across);
    const double bend = before - 2 * there + after;
    const double shift = bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.7, 0.7) : 0;
    return middle + shift * across;
  }

  cv::Mat_<short> dx_, dy_;
  cv::Mat_<unsigned char> open_;
};

// Whether it bends little and smoothly: a cubic over its chord.
bool is_smooth(const EdgeChain& chain) {
  const cv::Point2d chord = chain.back() - chain.front();
  const double length = cv::norm(chord);
  const cv::Point2d along = chord / length;
  const auto count = static_cast<Eigen::Index>(chain.size());
  Eigen::MatrixXd powers(count, 4);
  Eigen::VectorXd off(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const cv::Point2d to = chain[static_cast<std::size_t>(i)] - chain.front();
    const double t = to.dot(along) / length;
    powers.row(i) << 1, t, t * t, t * t * t;
    off(i) = along.x * to.y - along.y * to.x;
  }
  if (off.cwiseAbs().maxCoeff() > kBend * length) return false;
  const Eigen::VectorXd left = off - powers * powers.colPivHouseholderQr().solve(off);
  return std::sqrt(left.squaredNorm() / static_cast<double>(count)) < kSmooth_px;
}

EdgeChain thinned(const EdgeChain& chain) {
  EdgeChain some;
  const std::size_t every = std::max<std::size_t>(1, chain.size() / kPoints);
  for (std::size_t i = 0; i < chain.size(); i += every) some.push_back(chain[i]);
  return some;
}

}  // namespace

std::vector<EdgeChain> long_edges(const cv::Mat& luma, double least_length) {
  if (luma.empty() || luma.type() != CV_8UC1) return {};
  cv::Mat reduced = luma;
  int scale = 1;
  while (luma.cols / scale > kMaxWidth_px) scale *= 2;
  if (scale > 1) cv::resize(luma, reduced, luma.size() / scale, 0, 0, cv::INTER_AREA);
  if (reduced.cols < 16 || reduced.rows < 16) return {};
  std::vector<EdgeChain> chains;
  const cv::Rect2d inner(kBorder_px, kBorder_px, reduced.cols - 2 * kBorder_px, reduced.rows - 2 * kBorder_px);
  for (EdgeChain& chain : ChainFinder(reduced).all(least_length * reduced.cols)) {
    std::erase_if(chain, [&](const cv::Point2d& p) { return !inner.contains(p); });
    if (chain.size() < 12 || cv::norm(chain.back() - chain.front()) < least_length * reduced.cols) continue;
    if (!is_smooth(chain)) continue;
    EdgeChain kept = thinned(chain);
    for (cv::Point2d& p : kept) p = (p + cv::Point2d(0.5, 0.5)) * scale - cv::Point2d(0.5, 0.5);
    chains.push_back(std::move(kept));
  }
  return chains;
}

}  // namespace sigs
