// SPDX-License-Identifier: MIT
#include "ego_motion/ground_plane.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace sigs {

namespace {

constexpr double kSkyTrust = 0.02;
constexpr double kHills_rad = 0.052;
constexpr double kSky_rad = 0.105;
constexpr double kNear = 0.015;  // inverse depth, per unit of length; some 70 seconds of flight away
constexpr std::size_t kLeastNear = 15;
constexpr double kRough = 0.3;  // of the median inverse depth: what hills make it differ by

}  // namespace

std::optional<Eigen::Vector3d> ground_of(std::span<const Landmark> landmarks) {
  std::vector<const Landmark*> near;
  std::vector<double> depths;
  for (const Landmark& landmark : landmarks)
    if (landmark.weight > 0.2 && landmark.trust > 0.5 && landmark.inverse_depth > kNear) {
      near.push_back(&landmark);
      depths.push_back(landmark.inverse_depth);
    }
  if (near.size() < kLeastNear) return std::nullopt;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const double scale = kRough * *middle;
  Eigen::Vector3d ground = Eigen::Vector3d::Zero();
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-6;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Landmark* landmark : near) {
      const double miss = round == 0 ? 0 : (landmark->inverse_depth - ground.dot(landmark->direction)) / scale;
      const double root = 1 / (1 + miss * miss);
      normal += root * root * landmark->direction * landmark->direction.transpose();
      right += root * root * landmark->inverse_depth * landmark->direction;
    }
    ground = normal.ldlt().solve(right);
  }
  if (!ground.allFinite() || !(ground.norm() > kNear)) return std::nullopt;
  return ground;
}

double trust_of(const std::optional<Eigen::Vector3d>& ground, const Eigen::Vector3d& direction) {
  if (!ground) return 1;
  const double above_rad = std::asin(std::clamp(-ground->normalized().dot(direction), -1.0, 1.0));
  const double share = std::clamp((above_rad - kHills_rad) / (kSky_rad - kHills_rad), 0.0, 1.0);
  return 1 - share * (1 - kSkyTrust);
}

}  // namespace sigs
