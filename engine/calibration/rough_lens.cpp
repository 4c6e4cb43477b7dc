// SPDX-License-Identifier: MIT
#include "calibration/rough_lens.h"

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <vector>

#include "ego_motion/turns.h"

namespace sigs {

namespace {

constexpr int kRadii = 60;  // at which models are compared
constexpr double kBrownFits_px = 0.2;
constexpr double kKannalaFits_px = 2;  // a rough lens is not known better

Eigen::Vector2d centre_of(cv::Size size_px) {
  return {(size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0};
}

// Coefficients c of r = f a (1 + c1 a^2 + c2 a^4 ...), where a is what the model takes of the angle from the axis.
std::vector<double> polynomial(const RoughLens& lens, int terms, double (*argument)(double angle_rad)) {
  Eigen::MatrixXd powers(kRadii, terms);
  Eigen::VectorXd wanted(kRadii);
  for (int i = 0; i < kRadii; ++i) {
    const double r = lens.radius_px() * (i + 1) / kRadii;
    const Eigen::Vector3d ray = lens.ray(centre_of(lens.size_px) + Eigen::Vector2d(r, 0));
    const double a = argument(std::atan2(ray.y(), ray.x()));
    wanted(i) = r - lens.focal_px * a;
    for (int t = 0; t < terms; ++t) powers(i, t) = lens.focal_px * std::pow(a, 2 * t + 3);
  }
  const Eigen::VectorXd found = powers.colPivHouseholderQr().solve(wanted);
  return {found.data(), found.data() + found.size()};
}

// How far the model misses the lens, px; infinity where it has no image of what the lens sees.
double miss_px(const Lens& model, const RoughLens& lens) {
  double largest = 0;
  for (int i = 1; i <= kRadii; ++i) {
    const Eigen::Vector2d at =
        centre_of(lens.size_px) + (centre_of(lens.size_px) + Eigen::Vector2d(0.5, 0.5)) * i / kRadii;
    const auto pixel = model.pixel(glm_of(lens.ray(at)));
    if (!pixel) return INFINITY;
    largest = std::max(largest, std::hypot(pixel->x - at.x(), pixel->y - at.y()));
  }
  return largest;
}

}  // namespace

double RoughLens::radius_px() const {
  return std::hypot(size_px.width, size_px.height) / 2;
}

Eigen::Vector3d RoughLens::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d off = pixel - centre_of(size_px);
  const double share = off.squaredNorm() / (radius_px() * radius_px());
  return {focal_px * (1 + distortion * share), off.x(), off.y()};
}

std::optional<Eigen::Vector2d> RoughLens::pixel(const Eigen::Vector3d& direction) const {
  const double side = std::hypot(direction.y(), direction.z());
  const double x = direction.x();
  const double bend = 4 * distortion * focal_px * focal_px * side * side / (radius_px() * radius_px());
  // side * focal * (1 + distortion r^2 / radius^2) = x r, solved for r.
  const double root = x * x - bend;
  if (!(root >= 0)) return std::nullopt;
  const double below = x + std::sqrt(root);
  if (!(below > 0)) return std::nullopt;
  return centre_of(size_px) + Eigen::Vector2d(direction.y(), direction.z()) * (2 * focal_px / below);
}

double RoughLens::horizontal_field_rad() const {
  const double half_px = size_px.width / 2.0;
  const double share = half_px * half_px / (radius_px() * radius_px());
  return 2 * std::atan2(half_px, focal_px * (1 + distortion * share));
}

std::optional<RoughLens> rough_lens_of_field(cv::Size size_px, double field_rad, double distortion) {
  RoughLens lens{.size_px = size_px, .focal_px = 1, .distortion = distortion};
  if (!(field_rad > 0) || !(field_rad < 2 * std::numbers::pi) || size_px.empty()) return std::nullopt;
  const double half_px = size_px.width / 2.0;
  const double share = half_px * half_px / (lens.radius_px() * lens.radius_px());
  lens.focal_px = half_px / std::tan(field_rad / 2) / (1 + distortion * share);
  if (!(lens.focal_px > 0) || !std::isfinite(lens.focal_px)) return std::nullopt;
  return lens;
}

Result<LensParameters> parameters_of(const RoughLens& lens) {
  const Eigen::Vector2d centre = centre_of(lens.size_px);
  LensParameters found{.fx = lens.focal_px, .fy = lens.focal_px, .cx = centre.x(), .cy = centre.y()};
  if (std::abs(lens.distortion) < 1e-9) return found;
  const double corner_rad = [&] {
    const Eigen::Vector3d ray = lens.ray(centre + centre);
    return std::atan2(std::hypot(ray.y(), ray.z()), ray.x());
  }();
  if (corner_rad < 1.4) {
    const std::vector<double> k = polynomial(lens, 3, [](double angle_rad) { return std::tan(angle_rad); });
    found.coefficients = {k[0], k[1], 0, 0, k[2]};
    const Result<Lens> made = Lens::make(found);
    if (made && miss_px(*made, lens) < kBrownFits_px) return found;
  }
  found.model = LensModel::kannala_brandt;
  found.coefficients = polynomial(lens, 4, [](double angle_rad) { return angle_rad; });
  const Result<Lens> made = Lens::make(found);
  if (made && miss_px(*made, lens) < kKannalaFits_px) return found;
  return fail("the lens found", "is none that OpenCV's models can express");
}

}  // namespace sigs
