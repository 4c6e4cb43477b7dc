// SPDX-License-Identifier: MIT
#include "calibration/rough_lines.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "ego_motion/sequence.h"

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

  std::vector<EdgeChain> all(double min_px) {
    std::vector<EdgeChain> chains;
    for (int y = 0; y < open_.rows; ++y)
      for (int x = 0; x < open_.cols; ++x) {
        if (open_(y, x) == 0) continue;
        EdgeChain chain = followed({x, y}, 1);
        std::reverse(chain.begin(), chain.end());
        open_(y, x) = 255;
        const EdgeChain other = followed({x, y}, -1);
        if (!other.empty()) chain.insert(chain.end(), other.begin() + 1, other.end());
        if (cv::norm(chain.back() - chain.front()) >= min_px) chains.push_back(std::move(chain));
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

std::vector<EdgeChain> long_edges(const cv::Mat& luma, double min_length) {
  if (luma.empty() || luma.type() != CV_8UC1) return {};
  cv::Mat reduced = luma;
  int scale = 1;
  while (luma.cols / scale > kMaxWidth_px) scale *= 2;
  if (scale > 1) cv::resize(luma, reduced, luma.size() / scale, 0, 0, cv::INTER_AREA);
  if (reduced.cols < 16 || reduced.rows < 16) return {};
  std::vector<EdgeChain> chains;
  const cv::Rect2d inner(kBorder_px, kBorder_px, reduced.cols - 2 * kBorder_px, reduced.rows - 2 * kBorder_px);
  for (EdgeChain& chain : ChainFinder(reduced).all(min_length * reduced.cols)) {
    std::erase_if(chain, [&](const cv::Point2d& p) { return !inner.contains(p); });
    if (chain.size() < 12 || cv::norm(chain.back() - chain.front()) < min_length * reduced.cols) continue;
    if (!is_smooth(chain)) continue;
    EdgeChain kept = thinned(chain);
    for (cv::Point2d& p : kept) p = (p + cv::Point2d(0.5, 0.5)) * scale - cv::Point2d(0.5, 0.5);
    chains.push_back(std::move(kept));
  }
  return chains;
}

namespace {

constexpr double kMinLength = 0.15;  // of the image's width
constexpr int kTries = 73;
constexpr double kFirst = -0.6;
constexpr double kStep = 0.0125;
constexpr double kAgree_px = 0.35;      // a line that misses by so much has half of the weight
constexpr double kAngleStep_rad = 0.2;  // edges closer than this in direction ...
constexpr double kOffsetStep = 0.06;    // ... and in place, of the radius, are one
constexpr int kMinLines = 8;
constexpr double kMinShare = 0.6;  // of the lines that have to agree
constexpr double kLargestSd = 0.04;
constexpr double kMinSd = 0.01;
constexpr int kDraws = 200;

using Costs = std::array<double, kTries>;

double distortion_at(double index) {
  return kFirst + kStep * index;
}

// How far the edge deviates from a straight line once a lens of this distortion is taken out; rms, px.
double bend_px(const EdgeChain& edge, cv::Size size_px, double distortion) {
  const cv::Point2d centre((size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0);
  const double radius2 = (std::pow(size_px.width, 2) + std::pow(size_px.height, 2)) / 4;
  std::vector<cv::Point2d> straight;
  cv::Point2d mean(0, 0);
  double stretch = 0;
  for (const cv::Point2d& p : edge) {
    const cv::Point2d off = p - centre;
    const double factor = 1 / (1 + distortion * off.dot(off) / radius2);
    straight.push_back(off * factor);
    mean += straight.back();
    stretch += factor;
  }
  const auto count = static_cast<double>(edge.size());
  mean /= count;
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const cv::Point2d& p : straight) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
    yy += (p.y - mean.y) * (p.y - mean.y);
  }
  const double smallest = (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
  return std::sqrt(std::max(0.0, smallest) / count) / (stretch / count);
}

// Direction and place of an edge in steps; edges of both ways of running are the same.
std::tuple<int, int> place_of(const EdgeChain& edge, cv::Size size_px) {
  const cv::Point2d chord = edge.back() - edge.front();
  double angle = std::atan2(chord.y, chord.x);
  if (angle < 0) angle += std::numbers::pi;
  const cv::Point2d centre((size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0);
  const cv::Point2d to = (edge.front() + edge.back()) / 2 - centre;
  const double offset = to.y * std::cos(angle) - to.x * std::sin(angle);
  const double radius = std::hypot(size_px.width, size_px.height) / 2;
  return {static_cast<int>(angle / kAngleStep_rad), static_cast<int>(std::floor(offset / (kOffsetStep * radius)))};
}

double least_at(const Costs& costs) {
  const auto i = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  if (i == 0 || i + 1 == costs.size()) return static_cast<double>(i);
  const double bend = costs[i - 1] - 2 * costs[i] + costs[i + 1];
  const double shift = bend > 0 ? 0.5 * (costs[i - 1] - costs[i + 1]) / bend : 0;
  return static_cast<double>(i) + std::clamp(shift, -0.5, 0.5);
}

// All edges of one place.
struct Line {
  Costs cost{};      // mean over its edges, 0 to 1
  double count = 0;  // of edges
};

}  // namespace

void LinesRoad::add(int frame, const cv::Mat& luma) {
  size_px_ = luma.size();
  seen_.push_back({frame, long_edges(luma, kMinLength)});
}

LinesAnswer LinesRoad::answer() const {
  LinesAnswer found;
  std::map<std::tuple<int, int>, Line> places;
  for (const Seen& seen : seen_) {
    if (seen.edges.size() > found.edges.size()) {
      found.edges = seen.edges;
      found.frame = seen.frame;
    }
    for (const EdgeChain& edge : seen.edges) {
      Line& line = places[place_of(edge, size_px_)];
      for (int i = 0; i < kTries; ++i) {
        const double miss = bend_px(edge, size_px_, distortion_at(i)) / kAgree_px;
        line.cost[static_cast<std::size_t>(i)] += miss * miss / (1 + miss * miss);
      }
      ++line.count;
    }
  }
  std::vector<Costs> lines;
  for (auto& [place, line] : places) {
    for (double& cost : line.cost) cost /= line.count;
    lines.push_back(line.cost);
  }
  found.lines = static_cast<int>(lines.size());
  if (found.lines < kMinLines) {
    found.reason = fmt::format("{} long, smooth edges were found, {} are needed", found.lines, kMinLines);
    return found;
  }
  const auto sum_of = [&](auto&& pick) {
    Costs sum{};
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += lines[pick(i)][k];
    return sum;
  };
  const double at = least_at(sum_of([](std::size_t i) { return i; }));
  found.distortion = distortion_at(at);
  for (const Costs& line : lines) found.agree += line[static_cast<std::size_t>(std::lround(at))] < 0.5 ? 1 : 0;
  Sequence chance;
  double sum2 = 0;
  for (int draw = 0; draw < kDraws; ++draw)
    sum2 += std::pow(
        distortion_at(least_at(sum_of([&](std::size_t) { return chance.below(lines.size()); }))) - found.distortion, 2);
  found.sd = std::hypot(std::sqrt(sum2 / kDraws), kMinSd);
  if (found.agree < kMinShare * found.lines)
    found.reason =
        fmt::format("{} of {} long edges stay curved whatever the distortion", found.lines - found.agree, found.lines);
  else if (found.sd > kLargestSd)
    found.reason = fmt::format("{} long edges leave the distortion open: {:.2f} +- {:.2f}", found.lines,
                               found.distortion, found.sd);
  else
    found.is_certain = true;
  return found;
}

}  // namespace sigs
