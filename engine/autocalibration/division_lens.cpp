// SPDX-License-Identifier: MIT
#include "autocalibration/division_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "base/input_file.h"
#include "base/pose.h"
#include "base/statistics.h"
#include "base/text.h"
#include "telemetry/gpmf.h"
#include "video/data_streams.h"

namespace sigs {

namespace {

constexpr int kRadii = 60;  // at which models are compared
constexpr double kBrownFits_px = 0.2;
constexpr double kKannalaFits_px = 2;  // a rough lens is not known better

glm::dvec2 centre_of(cv::Size size_px) {
  return {(size_px.width - 1) / 2.0, (size_px.height - 1) / 2.0};
}

// Coefficients c of r = f a (1 + c1 a^2 + c2 a^4 ...), where a is what the model takes of the angle from the axis.
std::vector<double> polynomial(const DivisionLens& lens, int terms, double (*argument)(double angle_rad)) {
  cv::Mat_<double> powers(kRadii, terms), wanted(kRadii, 1), found;
  for (int i = 0; i < kRadii; ++i) {
    const double r = lens.radius_px() * (i + 1) / kRadii;
    const glm::dvec3 ray = lens.ray(centre_of(lens.size_px) + glm::dvec2(r, 0));
    const double a = argument(std::atan2(ray.y, ray.x));
    wanted(i) = r - lens.focal_px * a;
    for (int t = 0; t < terms; ++t) powers(i, t) = lens.focal_px * std::pow(a, 2 * t + 3);
  }
  cv::solve(powers, wanted, found, cv::DECOMP_SVD);
  return {found.begin(), found.end()};
}

// How far the model misses the lens, px; infinity where it has no image of what the lens sees.
double miss_px(const Lens& model, const DivisionLens& lens) {
  double largest = 0;
  for (int i = 1; i <= kRadii; ++i) {
    const glm::dvec2 at =
        centre_of(lens.size_px) + (centre_of(lens.size_px) + glm::dvec2(0.5, 0.5)) * (i / double(kRadii));
    const auto pixel = model.pixel(lens.ray(at));
    if (!pixel) return INFINITY;
    largest = std::max(largest, std::hypot(pixel->x - at.x, pixel->y - at.y));
  }
  return largest;
}

}  // namespace

double DivisionLens::radius_px() const {
  return std::hypot(size_px.width, size_px.height) / 2;
}

glm::dvec3 DivisionLens::ray(const glm::dvec2& pixel) const {
  const glm::dvec2 off = pixel - centre_of(size_px);
  const double share = squared_length(off) / (radius_px() * radius_px());
  return {focal_px * (1 + distortion * share), off.x, off.y};
}

std::optional<glm::dvec2> DivisionLens::pixel(const glm::dvec3& direction) const {
  const double side = std::hypot(direction.y, direction.z);
  const double x = direction.x;
  const double bend = 4 * distortion * focal_px * focal_px * side * side / (radius_px() * radius_px());
  // side * focal * (1 + distortion r^2 / radius^2) = x r, solved for r.
  const double root = x * x - bend;
  if (!(root >= 0)) return std::nullopt;
  const double below = x + std::sqrt(root);
  if (!(below > 0)) return std::nullopt;
  return centre_of(size_px) + glm::dvec2(direction.y, direction.z) * (2 * focal_px / below);
}

double DivisionLens::horizontal_field_rad() const {
  const double half_px = size_px.width / 2.0;
  const double share = half_px * half_px / (radius_px() * radius_px());
  return 2 * std::atan2(half_px, focal_px * (1 + distortion * share));
}

std::optional<DivisionLens> division_lens_of_field(cv::Size size_px, double field_rad, double distortion) {
  DivisionLens lens{.size_px = size_px, .focal_px = 1, .distortion = distortion};
  if (!(field_rad > 0) || !(field_rad < 2 * std::numbers::pi) || size_px.empty()) return std::nullopt;
  const double half_px = size_px.width / 2.0;
  const double share = half_px * half_px / (lens.radius_px() * lens.radius_px());
  lens.focal_px = half_px / std::tan(field_rad / 2) / (1 + distortion * share);
  if (!(lens.focal_px > 0) || !std::isfinite(lens.focal_px)) return std::nullopt;
  return lens;
}

Result<LensParameters> parameters_of(const DivisionLens& lens) {
  const glm::dvec2 centre = centre_of(lens.size_px);
  LensParameters found{.fx = lens.focal_px, .fy = lens.focal_px, .cx = centre.x, .cy = centre.y};
  if (std::abs(lens.distortion) < 1e-9) return found;
  const double corner_rad = [&] {
    const glm::dvec3 ray = lens.ray(centre + centre);
    return std::atan2(std::hypot(ray.y, ray.z), ray.x);
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

double LensEstimate::relative_uncertainty() const {
  return (std::tan(field_high_rad / 4) / std::tan(field_low_rad / 4) - 1) / 2;
}

cv::Mat_<double> clustered_covariance(const std::vector<NormalEquations>& parts, const NormalEquations& known) {
  NormalEquations all = known;
  cv::Mat_<double> scatter = known.matrix();  // a prior is as uncertain as it says
  for (const NormalEquations& part : parts) {
    all.add(part);
    scatter += part.right() * part.right().t();
  }
  const auto count = static_cast<double>(parts.size());
  const cv::Mat_<double> inverse = all.inverse();
  return cv::Mat(inverse * scatter * inverse * (count > 1 ? count / (count - 1) : 1));
}

double student_95(int degrees) {
  constexpr std::array<double, 12> kTable{12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23, 2.20, 2.18};
  if (degrees < 1) return kTable[0];
  if (degrees <= static_cast<int>(kTable.size())) return kTable[static_cast<std::size_t>(degrees) - 1];
  return 1.96 + 2.5 / degrees;
}

LensEstimate fit_of(const LensOf& lens_of, const std::vector<double>& found, const cv::Mat_<double>& covariance,
                    int parts, double min_relative) {
  LensEstimate fit{.lens = lens_of(found), .distortion_sd = std::sqrt(covariance(1, 1)), .parts = parts};
  const double t = student_95(parts - 1);
  const double middle = fit.lens.horizontal_field_rad();
  // Cholesky's factor of the covariance of both, by columns.
  const double first = std::sqrt(covariance(0, 0));
  const double mixed = covariance(1, 0) / first;
  const std::array<glm::dvec2, 2> axes{glm::dvec2(first, mixed),
                                       glm::dvec2(0, std::sqrt(std::max(0.0, covariance(1, 1) - mixed * mixed)))};
  const double floor = t / student_95(1000) * 1.96 * min_relative * std::sin(middle / 2) * 2;
  double up2 = floor * floor;
  double down2 = floor * floor;
  for (const glm::dvec2& axis : axes) {
    double high = 0;
    double low = 0;
    for (const double sign : {-1.0, 1.0}) {
      std::vector<double> moved = found;
      moved[0] += sign * t * axis.x;
      moved[1] += sign * t * axis.y;
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
  return lengths.empty() ? min_px : std::max(min_px, median(std::move(lengths)));
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

LensEstimate fit_with(DivisionLens lens, const DistortionPrior& prior, double relative) {
  LensEstimate fit{.lens = lens, .distortion_sd = prior.sd};
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
  const std::optional<double> stated = finite_number(text);
  if (!stated) return std::nullopt;
  const bool is_in_tenths = text.find('.') == std::string_view::npos && *stated >= 100;
  const double focal_mm = is_in_tenths ? *stated / 10 : *stated;
  if (!(focal_mm >= 10 && focal_mm <= 300)) return std::nullopt;
  return focal_mm;
}

LensAnswer stated_lens(const std::filesystem::path& file, cv::Size size_px, const DistortionPrior& prior) {
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
  DivisionLens lens{.size_px = size_px, .distortion = prior.mean};
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
