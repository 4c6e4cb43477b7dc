// SPDX-License-Identifier: MIT
#include "ego_motion/rotation_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "ego_motion/sequence.h"
#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr int kTrials = 60;                // with half of the pairs astray a pair of good ones is missed once in 3e7
constexpr double kTukey = 4.685;           // 95 % efficient on normal errors
constexpr double kMadToSigma = 0.8493218;  // of the length of an error in two directions: 1 / sqrt(2 ln 2)
constexpr double kMinSigma_rad = 1e-7;

double miss(const Eigen::Matrix3d& turn, const RayPair& pair) {
  return (turn * pair.before - pair.after).norm();
}

std::optional<Eigen::Matrix3d> tried(std::span<const RayPair> pairs, const RotationFitSettings& settings) {
  Sequence chance;
  std::size_t best_count = 0;
  std::optional<Eigen::Matrix3d> best;
  constexpr std::array<double, 2> kEqual{1, 1};
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::array<RayPair, 2> two{pairs[chance.below(pairs.size())], pairs[chance.below(pairs.size())]};
    constexpr double kApart = 0.02;  // rad; nearer directions leave the turn about them open
    if (two[0].before.cross(two[1].before).norm() < kApart) continue;
    const Eigen::Matrix3d turn = best_rotation(two, kEqual).toRotationMatrix();
    std::size_t count = 0;
    for (const RayPair& pair : pairs) count += miss(turn, pair) < settings.inlier_rad ? 1U : 0U;
    if (count > best_count) {
      best_count = count;
      best = turn;
    }
  }
  return best;
}

// Sigma in one direction from the median length of the misses within the limit.
double sigma_of(std::vector<double> misses, double limit) {
  std::erase_if(misses, [limit](double m) { return m > limit; });
  if (misses.empty()) return limit;
  const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
  std::nth_element(misses.begin(), middle, misses.end());
  return std::max(kMinSigma_rad, *middle * kMadToSigma);
}

}  // namespace

Eigen::Quaterniond best_rotation(std::span<const RayPair> pairs, std::span<const double> weights) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) m += weights[i] * pairs[i].before * pairs[i].after.transpose();
  Eigen::Matrix4d n;                                                                          // Horn 1987, section 4.A
  n << m(0, 0) + m(1, 1) + m(2, 2), m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0),  //
      m(1, 2) - m(2, 1), m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(2, 0) + m(0, 2),   //
      m(2, 0) - m(0, 2), m(0, 1) + m(1, 0), -m(0, 0) + m(1, 1) - m(2, 2), m(1, 2) + m(2, 1),  //
      m(0, 1) - m(1, 0), m(2, 0) + m(0, 2), m(1, 2) + m(2, 1), -m(0, 0) - m(1, 1) + m(2, 2);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(n);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized();
}

std::optional<RotationFit> fitted_rotation(std::span<const RayPair> all, const RotationFitSettings& settings) {
  std::vector<RayPair> pairs;
  for (const RayPair& pair : all)
    if (pair.before.allFinite() && pair.after.allFinite()) pairs.push_back(pair);
  if (pairs.size() < static_cast<std::size_t>(std::max(2, settings.min_inliers))) return std::nullopt;
  const std::optional<Eigen::Matrix3d> start = tried(pairs, settings);
  if (!start) return std::nullopt;

  Eigen::Quaterniond turn(*start);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  std::vector<double> misses(pairs.size());
  double limit = settings.inlier_rad;
  double sigma = limit;
  int inliers = 0;
  for (int round = 0; round < 5; ++round) {
    const Eigen::Matrix3d matrix = turn.toRotationMatrix();
    for (std::size_t i = 0; i < pairs.size(); ++i) misses[i] = miss(matrix, pairs[i]);
    sigma = sigma_of(misses, settings.inlier_rad);
    limit = std::min(settings.inlier_rad, kTukey * sigma);
    normal.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    inliers = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (misses[i] >= limit) continue;
      const double share = misses[i] / limit;
      const double weight = (1 - share * share) * (1 - share * share);
      // A small turn d of the second frame's rays moves R x by d x (R x).
      const Eigen::Vector3d there = matrix * pairs[i].before;
      normal += weight * (Eigen::Matrix3d::Identity() - there * there.transpose());
      right += weight * there.cross(pairs[i].after);
      ++inliers;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
    if (solver.eigenvalues()(0) < 1e-4 * solver.eigenvalues()(2) || inliers < settings.min_inliers) return std::nullopt;
    turn = (turn_of(normal.ldlt().solve(right)) * turn).normalized();
  }
  if (inliers < settings.min_share * static_cast<double>(pairs.size())) return std::nullopt;
  return RotationFit{turn, sigma * sigma * normal.inverse(), sigma, inliers};
}

}  // namespace sigs
