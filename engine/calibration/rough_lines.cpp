// SPDX-License-Identifier: MIT
#include "calibration/rough_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "ego_motion/sequence.h"

namespace sigs {

namespace {

constexpr double kLeastLength = 0.15;  // of the image's width
constexpr int kTries = 73;
constexpr double kFirst = -0.6;
constexpr double kStep = 0.0125;
constexpr double kAgree_px = 0.35;      // a line that misses by so much has half of the weight
constexpr double kAngleStep_rad = 0.2;  // edges closer than this in direction ...
constexpr double kOffsetStep = 0.06;    // ... and in place, of the radius, are one
constexpr int kLeastLines = 8;
constexpr double kLeastShare = 0.6;  // of the lines that have to agree
constexpr double kLargestSd = 0.04;
constexpr double kLeastSd = 0.01;
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
  seen_.push_back({frame, long_edges(luma, kLeastLength)});
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
  if (found.lines < kLeastLines) {
    found.reason = fmt::format("{} long, smooth edges were found, {} are needed", found.lines, kLeastLines);
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
  found.sd = std::hypot(std::sqrt(sum2 / kDraws), kLeastSd);
  if (found.agree < kLeastShare * found.lines)
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
