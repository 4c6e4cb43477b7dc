// SPDX-License-Identifier: MIT
#include "ego_motion/horizon.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/pose.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr int kColumnStep_px = 4;
constexpr std::size_t kPerColumn = 3;  // candidates
constexpr float kLeastEdge = 12;       // of Sobel's sums on an image of 8 bits: a step of 3 codes
constexpr double kNear_rad = 0.003;    // a candidate on the plane
constexpr double kLeastShare = 0.5;    // of the columns
constexpr int kTrials = 300;
constexpr double kAgree_rad = 0.0087;  // half a degree
constexpr double kDip_rad = 0.0068;    // sqrt(2 h / R): the horizon's dip seen from 150 m
constexpr int kLeastLines = 5;

struct Candidate {
  int column = 0;
  bool falls = false;  // darker below
  Eigen::Vector3d ray;
};

bool is_own_body(const cv::Mat& own_body, double x, double y) {
  if (own_body.empty()) return false;
  const int column = std::clamp(static_cast<int>(std::lround(x)), 0, own_body.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(y)), 0, own_body.rows - 1);
  return own_body.at<uchar>(row, column) > 127;
}

// Rows of the strongest edges of a column, to parts of a row.
std::vector<std::pair<float, float>> edges_in(const cv::Mat& gradient, int x) {
  std::vector<std::pair<float, float>> edges;  // strength with sign, row
  for (int y = 2; y + 2 < gradient.rows; ++y) {
    const float before = std::abs(gradient.at<float>(y - 1, x));
    const float here = std::abs(gradient.at<float>(y, x));
    const float after = std::abs(gradient.at<float>(y + 1, x));
    if (here < kLeastEdge || here < before || here <= after) continue;
    const float bend = before - 2 * here + after;
    const float part = bend < 0 ? 0.5F * (before - after) / bend : 0;
    edges.emplace_back(gradient.at<float>(y, x), static_cast<float>(y) + std::clamp(part, -0.5F, 0.5F));
  }
  const std::size_t kept = std::min(edges.size(), kPerColumn);
  std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(kept), edges.end(),
                    [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  edges.resize(kept);
  return edges;
}

std::vector<Candidate> candidates_in(const cv::Mat& reduced, double scale, const Camera& camera,
                                     const cv::Mat& own_body) {
  cv::Mat smooth;
  cv::Mat gradient;
  cv::GaussianBlur(reduced, smooth, {9, 3}, 2.5, 0.8);
  cv::Sobel(smooth, gradient, CV_32F, 0, 1);
  std::vector<Candidate> candidates;
  for (int x = kColumnStep_px; x < reduced.cols - kColumnStep_px; x += kColumnStep_px)
    for (const auto& [strength, y] : edges_in(gradient, x)) {
      const glm::dvec2 pixel((x + 0.5) * scale - 0.5, (static_cast<double>(y) + 0.5) * scale - 0.5);
      if (is_own_body(own_body, pixel.x, pixel.y)) continue;
      if (const auto ray = camera.lens.ray(pixel))
        candidates.push_back({x / kColumnStep_px, strength < 0, eigen_of(*ray)});
    }
  return candidates;
}

// Number of columns with a candidate on the plane, of edges that all fall or all rise.
int support(const std::vector<Candidate>& candidates, const Eigen::Vector3d& normal, bool falls) {
  int columns = 0;
  int last = -1;
  for (const Candidate& c : candidates) {
    if (c.column == last || c.falls != falls || std::abs(normal.dot(c.ray)) > kNear_rad) continue;
    ++columns;
    last = c.column;
  }
  return columns;
}

}  // namespace

std::optional<HorizonLine> horizon_in(const cv::Mat& reduced, double scale, const Camera& camera,
                                      const cv::Mat& own_body, int frame) {
  const std::vector<Candidate> candidates = candidates_in(reduced, scale, camera, own_body);
  const int columns = reduced.cols / kColumnStep_px;
  if (candidates.size() < static_cast<std::size_t>(columns) / 2) return std::nullopt;
  cv::RNG chance(1);
  int best = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  bool falls = false;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Candidate& a = candidates[static_cast<std::size_t>(chance.uniform(0, static_cast<int>(candidates.size())))];
    const Candidate& b = candidates[static_cast<std::size_t>(chance.uniform(0, static_cast<int>(candidates.size())))];
    if (a.falls != b.falls || std::abs(a.column - b.column) < columns / 5) continue;
    const Eigen::Vector3d tried = a.ray.cross(b.ray).normalized();
    if (const int count = support(candidates, tried, a.falls); count > best) {
      best = count;
      normal = tried;
      falls = a.falls;
    }
  }
  if (best < kLeastShare * columns) return std::nullopt;
  int used = 0;
  double sum = 0;
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    used = 0;
    sum = 0;
    for (const Candidate& c : candidates) {
      const double miss = normal.dot(c.ray);
      if (c.falls != falls || std::abs(miss) > kNear_rad) continue;
      m += c.ray * c.ray.transpose();
      sum += miss * miss;
      ++used;
    }
    normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(0);
  }
  if (normal.z() > 0) normal = -normal;  // Z is down
  return HorizonLine{frame, normal, std::sqrt(sum / used / std::max(1, used / 10))};
}

std::optional<Level> level_of(std::span<const HorizonLine> lines,
                              std::span<const Eigen::Quaterniond> start_from_camera) {
  std::vector<Eigen::Vector3d> ups;
  for (const HorizonLine& line : lines)
    ups.push_back(start_from_camera[static_cast<std::size_t>(line.frame)] * line.up);
  Level level;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& middle : ups) {
    int count = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& up : ups) {
      if ((up - middle).norm() > kAgree_rad) continue;
      sum += up;
      ++count;
    }
    if (count > level.lines) {
      level.lines = count;
      best = sum;
    }
  }
  if (level.lines < kLeastLines || 2 * level.lines < static_cast<int>(ups.size())) return std::nullopt;
  level.up_in_start = best.normalized();
  double squares = 0;
  for (const Eigen::Vector3d& up : ups)
    if ((up - level.up_in_start).norm() <= kAgree_rad) squares += (up - level.up_in_start).squaredNorm() / 2;
  // Hills bias all lines alike, so that the scatter does not shrink with their number.
  level.sd_rad = std::sqrt(squares / level.lines + kDip_rad * kDip_rad);
  return level;
}

Eigen::Quaterniond world_from_start(const Eigen::Vector3d& up_in_start) {
  const Eigen::Vector3d down = -up_in_start;
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX().dot(down) * down;
  if (forward.norm() < 1e-6) forward = Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ().dot(down) * down;
  forward.normalize();
  Eigen::Matrix3d world;  // rows: the world's axes in the camera's
  world.row(0) = forward;
  world.row(1) = down.cross(forward);
  world.row(2) = down;
  return Eigen::Quaterniond(world).normalized();
}

}  // namespace sigs
