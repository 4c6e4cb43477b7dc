// SPDX-License-Identifier: MIT
#include "calibration/rough_lens.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "base/input_file.h"
#include "base/pose.h"
#include "ego_motion/turns.h"
#include "telemetry/gpmf.h"
#include "video/data_streams.h"

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
                double min_relative) {
  RoughFit fit{.lens = lens_of(found), .distortion_sd = std::sqrt(covariance(1, 1)), .parts = parts};
  const double t = student_95(parts - 1);
  const double middle = fit.lens.horizontal_field_rad();
  const Eigen::Matrix2d two = covariance.topLeftCorner<2, 2>();
  const Eigen::Matrix2d axes = two.llt().matrixL();
  const double floor = t / student_95(1000) * 1.96 * min_relative * std::sin(middle / 2) * 2;
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

double scale_of(std::vector<double> lengths, double min_px) {
  if (lengths.empty()) return min_px;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::max(min_px, *middle);
}

namespace {

constexpr double kGoProRelative = 0.05;  // 95 %, of the focal length
constexpr double kDjiRelative = 0.15;    // which crop of the sensor the video uses is not stated
constexpr double kWidth_mm = 36;
constexpr int kMaxDepth = 8;

std::optional<double> diagonal_in(std::string_view value, int depth) {
  for (const GpmfElement& element : gpmf_level(value).elements) {
    if (element.type == 0 && depth < kMaxDepth) {
      if (const auto found = diagonal_in(element.value, depth + 1)) return found;
    }
    if (element.key != "ZFOV") continue;
    const auto numbers = gpmf_numbers(element);
    if (!numbers || numbers->values.empty()) continue;
    const double field_deg = numbers->values.front();
    if (field_deg >= 5 && field_deg < 180) return rad_of_deg(field_deg);
  }
  return std::nullopt;
}

RoughFit fit_with(RoughLens lens, const DistortionPrior& prior, double relative) {
  RoughFit fit{.lens = lens, .distortion_sd = prior.sd};
  const double half_rad = lens.horizontal_field_rad() / 2;
  fit.field_low_rad = 2 * std::atan(std::tan(half_rad) / (1 + relative));
  fit.field_high_rad = 2 * std::atan(std::tan(half_rad) * (1 + relative));
  return fit;
}

}  // namespace

std::optional<double> gopro_diagonal_field_rad(std::string_view payload) {
  return diagonal_in(payload, 0);
}

std::optional<double> dji_focal_mm(std::string_view subtitles) {
  constexpr std::string_view kKey = "focal_len";
  const auto key = subtitles.find(kKey);
  if (key == std::string_view::npos) return std::nullopt;
  const auto from = subtitles.find_first_not_of(" :\t", key + kKey.size());
  if (from == std::string_view::npos) return std::nullopt;
  const auto to = std::min(subtitles.size(), subtitles.find_first_not_of("0123456789.", from));
  const std::string_view text = subtitles.substr(from, to - from);
  double stated = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), stated).ec != std::errc()) return std::nullopt;
  const bool is_in_tenths = text.find('.') == std::string_view::npos && stated >= 100;
  const double focal_mm = is_in_tenths ? stated / 10 : stated;
  if (!(focal_mm >= 10 && focal_mm <= 300)) return std::nullopt;
  return focal_mm;
}

RoughAnswer stated_lens(const std::filesystem::path& file, cv::Size size_px, const DistortionPrior& prior) {
  std::optional<double> diagonal_rad;
  std::optional<double> focal_mm;
  if (const auto streams = data_streams_of(file)) {
    for (const DataStream& stream : *streams) {
      if (stream.kind != DataKind::gpmf && stream.kind != DataKind::subtitles) continue;
      const auto packets = read_data_stream(file, stream.index);
      if (!packets || packets->packets.empty()) continue;
      const std::string& first = packets->packets.front().bytes;
      if (stream.kind == DataKind::gpmf && !diagonal_rad) diagonal_rad = gopro_diagonal_field_rad(first);
      if (stream.kind == DataKind::subtitles && !focal_mm) focal_mm = dji_focal_mm(first);
    }
  } else if (const auto text = read_text(file)) {
    focal_mm = dji_focal_mm(*text);
  }
  RoughLens lens{.size_px = size_px, .distortion = prior.mean};
  if (diagonal_rad) {
    lens.focal_px = lens.radius_px() / std::tan(*diagonal_rad / 2) / (1 + lens.distortion);
    return {.fit = fit_with(lens, prior, kGoProRelative),
            .reason = fmt::format("a diagonal field of view of {:.1f} degrees", deg_of_rad(*diagonal_rad))};
  }
  if (focal_mm) {
    const double share = std::pow(size_px.width / 2.0 / lens.radius_px(), 2);
    lens.focal_px = *focal_mm / kWidth_mm * size_px.width / (1 + lens.distortion * share);
    return {.fit = fit_with(lens, prior, kDjiRelative),
            .reason = fmt::format("a focal length of {:.0f} mm for an image 36 mm wide", *focal_mm)};
  }
  return {.fit = std::nullopt, .reason = "the file states none"};
}

}  // namespace sigs
