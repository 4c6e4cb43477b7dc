// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <variant>

#include "appearance/appearance.h"
#include "project/fields.h"

namespace sigs {

namespace {

// To three digits; more would not be honest, and settings are read by people.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double scale = std::pow(10, 2 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

// Of a codec whose quantiser can be matched.
bool is_matched(const std::string& codec) {
  return codec == "h264" || codec == "mjpeg";
}

}  // namespace

std::vector<AppearanceQuantity> quantities_of(const Appearance& appearance) {
  const PointSpreadFound& sharp = appearance.point_spread;
  const NoiseFound& noise = appearance.noise;
  return {{"point spread", "px", sharp.sigma_px, "appearance.point_spread_px"},
          {"sharpening", "", sharp.sharpening, "appearance.sharpening"},
          {"sharpening's width", "px", sharp.sharpening_px, "appearance.sharpening_px"},
          {"chroma spread", "px of chroma", sharp.chroma_spread_px, "appearance.chroma_spread_px"},
          {"noise at black", "codes", noise.sd_dark, "appearance.grain.sd_dark"},
          {"noise at white", "codes", noise.sd_bright, "appearance.grain.sd_bright"},
          {"noise of chroma", "codes", noise.sd_chroma, "appearance.grain.sd_chroma"},
          {"noise's spread", "px", noise.spread_px, "appearance.grain.spread_px"},
          {"noise's persistence", "", noise.persistence, "appearance.grain.persistence"}};
}

std::vector<Panel> panels_of(const Appearance& appearance) {
  std::vector<Panel> panels = appearance.point_spread.panels;
  panels.insert(panels.end(), appearance.noise.panels.begin(), appearance.noise.panels.end());
  return panels;
}

std::vector<std::string> applied_settings(const Appearance& appearance) {
  std::vector<std::string> keys{"compositing.blur_px_per_m"};
  for (const AppearanceQuantity& quantity : quantities_of(appearance))
    if (!quantity.setting.empty()) keys.push_back(quantity.setting);
  keys.emplace_back("appearance.codec.match");
  return keys;
}

void apply(const Appearance& appearance, Project& project) {
  project.compositing.blur_px_per_m = 0;
  for (const Field& field : fields_of(project)) {
    for (const AppearanceQuantity& quantity : quantities_of(appearance)) {
      if (quantity.setting != field.key) continue;
      const double value = std::clamp(rounded(quantity.estimate.value), field.minimum, field.maximum);
      if (double* const* const number = std::get_if<double*>(&field.value)) **number = value;
    }
  }
  project.appearance.codec.match =
      is_matched(appearance.footage.codec) ? CodecMatchChoice::footage : CodecMatchChoice::none;
}

}  // namespace sigs
