// SPDX-License-Identifier: MIT
#include "reference/sample_accumulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include "reference/gaussian_weights.h"

namespace sigs::truth {
namespace {

constexpr int kRowsPerSlab = 32;
constexpr int kSlabsAtOnce = 8;
constexpr unsigned kMaxThreads = 2;

// How the grid's columns or rows go to targets: pixels, or the nodes between two Gaussians.
struct Axis {
  std::vector<GaussianWeights> spreads;
  int first = 0;  // target
  int past = 0;
};

struct Plan {
  bool is_direct = true;
  double sigma_px = 0;  // of each of the Gaussians
  double step_px = 1;   // between nodes
  Axis x;
  Axis y;
  cv::Rect rect;
  cv::Rect covered;  // pixels of the image under the grid
};

// The contribution of some rows of the grid.
struct Slab {
  int first_row = 0;  // target
  cv::Mat color;      // CV_64FC4, the plan's columns
  cv::Mat coverage;   // CV_64FC1 over plan.covered
  double hits = 0;    // in the image
  glm::dvec2 sum_px{0, 0};
  glm::dvec2 low_px{std::numeric_limits<double>::infinity()};
  glm::dvec2 high_px{-std::numeric_limits<double>::infinity()};
};

Axis axis_of(const FineGrid& grid, std::int64_t first, int count, const Plan& plan) {
  Axis axis{.first = std::numeric_limits<int>::max(), .past = std::numeric_limits<int>::min()};
  for (int i = 0; i < count; ++i) {
    const double x_px = grid.middle_px(first + i);
    GaussianWeights spread =
        plan.is_direct ? to_pixels(x_px, plan.sigma_px) : to_nodes(x_px, plan.sigma_px, plan.step_px);
    for (double& weight : spread.weights) weight /= grid.per_px;
    axis.first = std::min(axis.first, spread.first_target);
    axis.past = std::max(axis.past, spread.first_target + static_cast<int>(spread.weights.size()));
    axis.spreads.push_back(std::move(spread));
  }
  return axis;
}

Plan plan_of(const FineGrid& grid, double sigma_px, const cv::Rect& image) {
  Plan plan{.is_direct = sigma_px <= kDirect_px};
  plan.sigma_px = plan.is_direct ? sigma_px : sigma_px / std::numbers::sqrt2;
  plan.step_px = plan.is_direct ? 1 : kStepsOfNodes * plan.sigma_px;
  plan.x = axis_of(grid, grid.first_x, grid.count_x, plan);
  plan.y = axis_of(grid, grid.first_y, grid.count_y, plan);
  const cv::Point first(grid.pixel_of(grid.first_x), grid.pixel_of(grid.first_y));
  const cv::Point last(grid.pixel_of(grid.first_x + grid.count_x - 1), grid.pixel_of(grid.first_y + grid.count_y - 1));
  const int reach = static_cast<int>(std::ceil(kReachOfBlur * sigma_px));
  const cv::Rect under(first, last + cv::Point(1, 1));
  plan.covered = under & image;
  plan.rect = cv::Rect(under.x - reach, under.y - reach, under.width + 2 * reach, under.height + 2 * reach) & image;
  return plan;
}

void add_silhouette(Slab& slab, const FineGrid& grid, int i, int j, const cv::Rect& covered) {
  const cv::Point pixel(grid.pixel_of(grid.first_x + i), grid.pixel_of(grid.first_y + j));
  if (!covered.contains(pixel)) return;
  const glm::dvec2 middle_px(grid.middle_px(grid.first_x + i), grid.middle_px(grid.first_y + j));
  slab.coverage.at<double>(pixel - covered.tl()) += 1.0 / grid.per_px / grid.per_px;
  slab.hits += 1;
  slab.sum_px += grid.ray_px(i, j);
  slab.low_px = glm::min(slab.low_px, middle_px - 0.5 / grid.per_px);
  slab.high_px = glm::max(slab.high_px, middle_px + 0.5 / grid.per_px);
}

Slab slab_of(const RayTracer& tracer, const FineGrid& grid, const Plan& plan, int first_row) {
  const int past_row = std::min(first_row + kRowsPerSlab, grid.count_y);
  const GaussianWeights& last = plan.y.spreads[static_cast<std::size_t>(past_row - 1)];
  Slab slab{.first_row = plan.y.spreads[static_cast<std::size_t>(first_row)].first_target};
  const int rows = last.first_target + static_cast<int>(last.weights.size()) - slab.first_row;
  slab.color = cv::Mat::zeros(rows, plan.x.past - plan.x.first, CV_64FC4);
  slab.coverage = cv::Mat::zeros(plan.covered.size(), CV_64FC1);
  for (int j = first_row; j < past_row; ++j) {
    const std::vector<RayHit> ray_hits = tracer.row(grid, j);
    cv::Mat across = cv::Mat::zeros(1, slab.color.cols, CV_64FC4);
    for (int i = 0; i < grid.count_x; ++i) {
      const RayHit& ray = ray_hits[static_cast<std::size_t>(i)];
      if (!ray.hits) continue;
      const GaussianWeights& spread = plan.x.spreads[static_cast<std::size_t>(i)];
      cv::Vec4d* target = across.ptr<cv::Vec4d>() + (spread.first_target - plan.x.first);
      for (const double weight : spread.weights)
        *target++ += weight * cv::Vec4d(ray.color.r, ray.color.g, ray.color.b, ray.color.a);
      add_silhouette(slab, grid, i, j, plan.covered);
    }
    const GaussianWeights& down = plan.y.spreads[static_cast<std::size_t>(j)];
    for (std::size_t k = 0; k < down.weights.size(); ++k) {
      cv::Mat row = slab.color.row(down.first_target + static_cast<int>(k) - slab.first_row);
      row += down.weights[k] * across;
    }
  }
  return slab;
}

// Several slabs in parallel; their assignment to threads does not affect them.
std::vector<Slab> slabs_from(const RayTracer& tracer, const FineGrid& grid, const Plan& plan, int first_row) {
  const int left = (grid.count_y - first_row + kRowsPerSlab - 1) / kRowsPerSlab;
  std::vector<Slab> slabs(static_cast<std::size_t>(std::min(left, kSlabsAtOnce)));
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads);
  const auto work = [&](std::size_t from) {
    for (std::size_t i = from; i < slabs.size(); i += threads)
      slabs[i] = slab_of(tracer, grid, plan, first_row + static_cast<int>(i) * kRowsPerSlab);
  };
  std::vector<std::jthread> others;
  for (unsigned t = 1; t < threads; ++t) others.emplace_back(work, t);
  work(0);
  return slabs;
}

// Weights of the second Gaussian: one row a pixel of [first, first + count), one column a node.
cv::Mat node_weights(const Axis& nodes, const Plan& plan, int first, int count) {
  cv::Mat weights = cv::Mat::zeros(count, nodes.past - nodes.first, CV_64FC1);
  for (int k = nodes.first; k < nodes.past; ++k) {
    const GaussianWeights spread = to_pixels(k * plan.step_px, plan.sigma_px);
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
      const int row = spread.first_target + static_cast<int>(i) - first;
      if (row >= 0 && row < count) weights.at<double>(row, k - nodes.first) = spread.weights[i] * plan.step_px;
    }
  }
  return weights;
}

cv::Mat pixels_of(const cv::Mat& targets, const Plan& plan) {
  if (plan.is_direct) {
    const cv::Rect all(plan.x.first, plan.y.first, targets.cols, targets.rows);
    return targets((plan.rect & all) - all.tl()).clone();
  }
  const cv::Mat across = node_weights(plan.x, plan, plan.rect.x, plan.rect.width);
  const cv::Mat down = node_weights(plan.y, plan, plan.rect.y, plan.rect.height);
  std::vector<cv::Mat> channels;
  cv::split(targets, channels);
  for (cv::Mat& channel : channels) channel = cv::Mat(down * channel * across.t());
  cv::Mat pixels;
  cv::merge(channels, pixels);
  return pixels;
}

}  // namespace

ReferenceImage accumulated(const RayTracer& tracer, const FineGrid& grid, double sigma_px, const cv::Rect& image) {
  const Plan plan = plan_of(grid, sigma_px, image);
  if (plan.rect.empty()) return {};
  cv::Mat targets = cv::Mat::zeros(plan.y.past - plan.y.first, plan.x.past - plan.x.first, CV_64FC4);
  Slab sum;
  sum.coverage = cv::Mat::zeros(plan.covered.size(), CV_64FC1);
  for (int row = 0; row < grid.count_y; row += kRowsPerSlab * kSlabsAtOnce)
    for (const Slab& slab : slabs_from(tracer, grid, plan, row)) {
      cv::Mat rows = targets.rowRange(slab.first_row - plan.y.first, slab.first_row - plan.y.first + slab.color.rows);
      rows += slab.color;
      if (!plan.covered.empty()) sum.coverage += slab.coverage;
      sum.hits += slab.hits;
      sum.sum_px += slab.sum_px;
      sum.low_px = glm::min(sum.low_px, slab.low_px);
      sum.high_px = glm::max(sum.high_px, slab.high_px);
    }
  ReferenceImage truth{.rect = plan.rect, .color = pixels_of(targets, plan)};
  truth.coverage = cv::Mat::zeros(plan.rect.size(), CV_64FC1);
  if (sum.hits == 0) return truth;
  sum.coverage.copyTo(truth.coverage(plan.covered - plan.rect.tl()));
  truth.area_px = sum.hits / grid.per_px / grid.per_px;
  truth.centroid_px = sum.sum_px / sum.hits;
  truth.silhouette = {sum.low_px.x, sum.low_px.y, sum.high_px.x - sum.low_px.x, sum.high_px.y - sum.low_px.y};
  return truth;
}

}  // namespace sigs::truth
