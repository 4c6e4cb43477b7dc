// SPDX-License-Identifier: MIT
#include "calibration/rough_stated.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>

#include "base/input_file.h"
#include "base/pose.h"
#include "telemetry/gpmf.h"
#include "video/data_streams.h"

namespace sigs {

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
