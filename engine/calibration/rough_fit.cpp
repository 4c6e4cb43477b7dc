// SPDX-License-Identifier: MIT
#include "calibration/rough_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace sigs {

double RoughFit::relative_uncertainty() const {
  return (std::tan(field_high_rad / 4) / std::tan(field_low_rad / 4) - 1) / 2;
}

Eigen::MatrixXd clustered_covariance(const std::vector<PartSums>& parts, const Eigen::MatrixXd& known) {
  Eigen::MatrixXd normal = known;
  Eigen::MatrixXd scatter = known;  // a prior is as uncertain as it says
  for (const PartSums& part : parts) {
    normal += part.normal;
    scatter += part.right * part.right.transpose();
  }
  const auto count = static_cast<double>(parts.size());
  const Eigen::MatrixXd inverse = normal.inverse();
  return inverse * scatter * inverse * (count > 1 ? count / (count - 1) : 1);
}

double student_95(int degrees) {
  constexpr std::array<double, 12> kTable{12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23, 2.20, 2.18};
  if (degrees < 1) return kTable[0];
  if (degrees <= static_cast<int>(kTable.size())) return kTable[static_cast<std::size_t>(degrees) - 1];
  return 1.96 + 2.5 / degrees;
}

RoughFit fit_of(const LensOf& lens_of, const Eigen::VectorXd& found, const Eigen::MatrixXd& covariance, int parts,
                double least_relative) {
  RoughFit fit{.lens = lens_of(found), .distortion_sd = std::sqrt(covariance(1, 1)), .parts = parts};
  const double t = student_95(parts - 1);
  const double middle = fit.lens.horizontal_field_rad();
  const Eigen::Matrix2d two = covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix2d axes = two.llt().matrixL();
  const double floor = t / student_95(1000) * 1.96 * least_relative * std::sin(middle / 2) * 2;
  double up2 = floor * floor;
  double down2 = floor * floor;
  for (int axis = 0; axis < 2; ++axis) {
    double high = 0;
    double low = 0;
    for (const double sign : {-1.0, 1.0}) {
      Eigen::VectorXd moved = found;
      moved.head<2>() += sign * t * axes.col(axis);
      const double change = lens_of(moved).horizontal_field_rad() - middle;
      high = std::max(high, change);
      low = std::min(low, change);
    }
    up2 += high * high;
    down2 += low * low;
  }
  fit.field_low_rad = std::max(0.0, middle - std::sqrt(down2));
  fit.field_high_rad = middle + std::sqrt(up2);
  return fit;
}

double scale_of(std::vector<double> lengths, double least_px) {
  if (lengths.empty()) return least_px;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max(least_px, *middle);
}

}  // namespace sigs
