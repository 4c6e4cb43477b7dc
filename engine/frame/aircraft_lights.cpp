// SPDX-License-Identifier: MIT
#include "frame/aircraft_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/pose.h"
#include "frame/look.h"
#include "frame/render_plan.h"
#include "render/renderer.h"

namespace sigs {

namespace {

constexpr double kBlondelRey_s = 0.2;
constexpr double kSunlitWhite_cdpm2 = 1e5 / std::numbers::pi;  // white matt paint that faces a high sun of 100,000 lx
constexpr double kFaintest = 7e-5;                             // a quarter of the step from code 0 to 1 of 8 bits
constexpr double kOpacity = 1e-6;                              // so that a pixel counts as changed
constexpr double kReachInSigmas = 4;                           // sigmas

// BT.709's primaries at luminance 1, of chromaticities within 14 CFR 25.1397: red (0.69, 0.31), green (0.17, 0.55),
// white that of daylight; what the primaries cannot show is cut off.
constexpr glm::dvec3 kRed{4.7037, 0, 0}, kGreen{0, 1.3683, 0.2967}, kWhite{1, 1, 1};
constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722};

struct AngleFactor {
  double deg = 0;
  double factor = 0;
};

// Linear between the angles; the last one's factor holds up to its angle, 0 beyond.
double factor_at(std::span<const AngleFactor> table, double deg) {
  if (deg > table.back().deg) return 0;
  for (std::size_t i = 1; i < table.size(); ++i)
    if (deg <= table[i].deg)
      return std::lerp(table[i - 1].factor, table[i].factor,
                       (deg - table[i - 1].deg) / (table[i].deg - table[i - 1].deg));
  return table.front().factor;
}

constexpr std::array<AngleFactor, 8> kPositionUpDown{
    {{0, 1}, {5, 0.9}, {10, 0.8}, {15, 0.7}, {20, 0.5}, {30, 0.3}, {40, 0.1}, {90, 0.05}}};
constexpr std::array<AngleFactor, 5> kPositionAhead{{{0, 1}, {10, 1}, {20, 0.75}, {30, 0.125}, {110, 0.125}}};
constexpr std::array<AngleFactor, 6> kFlashUpDown{{{0, 1}, {5, 1}, {10, 0.6}, {20, 0.2}, {30, 0.1}, {75, 0.05}}};
constexpr double kTailOfAhead = 0.5;
constexpr double kSector_deg = 110;  // from ahead to where the tail light takes over
// Lights of one side fade over so much of the other one: else nobody straight ahead, between them, would see either,
// nor a beacon who is level with the aircraft; and at the end of the sectors neither a side's light nor that of the
// tail, which are apart. 25.1395 leaves the first 10 degrees free.
constexpr double kOverlap_deg = 3;

const char* name_of(Lamp::Kind kind) {
  constexpr std::array<const char*, 9> kNames{
      "left", "right", "tail", "strobe left", "strobe right", "strobe tail", "beacon top", "beacon bottom", "landing"};
  return kNames[static_cast<std::size_t>(kind)];
}

// Intensity during a flash of which eyes see the effective one (Blondel and Rey).
double during_flash_cd(double effective_cd, double flash_s) {
  return effective_cd * (kBlondelRey_s + flash_s) / flash_s;
}

// Solid angle of the pixel that looks along a direction, sr. None: it has no image.
std::optional<double> pixel_sr(const Lens& lens, const glm::dvec3& direction) {
  constexpr double kStep_rad = 1e-5;
  const glm::dvec3 along = glm::normalize(direction);
  const glm::dvec3 helper = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(helper, along)), down = glm::cross(along, right);
  std::array<glm::dvec2, 4> at{};
  std::size_t i = 0;
  for (const glm::dvec3& off : {right, -right, down, -down}) {
    const std::optional<glm::dvec2> pixel = lens.pixel(along + kStep_rad * off);
    if (!pixel) return std::nullopt;
    at[i++] = *pixel;
  }
  const glm::dvec2 a = (at[0] - at[1]) / (2 * kStep_rad), b = (at[2] - at[3]) / (2 * kStep_rad);
  const double pixels_per_sr = std::abs(a.x * b.y - a.y * b.x);
  return pixels_per_sr > 0 ? std::optional(1 / pixels_per_sr) : std::nullopt;
}

// Luminance of what the footage shows as white, cd/m2: as stated, else white paint in a high sun has as much light as
// the scene's own light gives it.
double white_cdpm2(const SceneLight& light) {
  if (light.white_cdpm2) return *light.white_cdpm2;
  const double shown = glm::dot(kLuminance, light.color) * (light.kind == LightKind::sun ? light.exposure : 1);
  return kSunlitWhite_cdpm2 / std::max(shown, 1e-9);
}

// A point of the aircraft in the camera frame, as it is when the row opens in which it appears; and since when.
struct SeenPoint {
  glm::dvec3 p_in_camera{0, 0, 0};
  glm::dvec3 to_camera_in_body{1, 0, 0};  // unit vector
  glm::dvec2 pixel{0, 0};
  double since_s = 0;
};

std::optional<SeenPoint> seen(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                              const Lens& lens, const glm::dvec3& place_m) {
  SeenPoint point;
  const std::optional<SeenInRow> in_row = seen_in_row(scene, [&](double row_s) -> std::optional<glm::dvec2> {
    const Pose<frame::Camera, frame::Body> pose =
        row_s == 0 ? placed.camera_from_body
                   : camera_from_body_at(scene, static_cast<std::size_t>(placed.id), moment.time_s + row_s);
    point.p_in_camera = pose * place_m;
    const double distance_m = glm::length(point.p_in_camera);
    if (!(distance_m > 0)) return std::nullopt;
    point.to_camera_in_body = glm::conjugate(pose.rotation) * (-point.p_in_camera / distance_m);
    return lens.pixel(point.p_in_camera);
  });
  if (!in_row) return std::nullopt;
  point.pixel = in_row->pixel;
  point.since_s = in_row->row_s;
  return point;
}

// Share of a Gaussian that falls on the pixel n.
double share_on(double center, double sigma, int n) {
  if (sigma <= 0) return std::lround(center) == n ? 1 : 0;
  const auto below = [&](double edge) { return 0.5 * std::erfc((center - edge) / (sigma * std::numbers::sqrt2)); };
  return below(n + 0.5) - below(n - 0.5);
}

// How far from its middle a part of the light adds anything, px.
double reach_px(double light, double sigma_px) {
  if (sigma_px <= 0) return 0.5;
  const double peak = light / (2 * std::numbers::pi * sigma_px * sigma_px);
  const double in_sigmas = peak > kFaintest ? std::sqrt(2 * std::log(peak / kFaintest)) : 0;
  return std::max(kReachInSigmas, in_sigmas) * sigma_px + 0.5;
}

}  // namespace

std::vector<Lamp> lamps_of(const LampSettings& settings, const LampPlaces& places) {
  using Kind = Lamp::Kind;
  std::vector<Lamp> lamps;
  if (settings.position_cd > 0) {
    lamps.push_back({Kind::left, places.left, kRed});
    lamps.push_back({Kind::right, places.right, kGreen});
    lamps.push_back({Kind::tail, places.tail, kWhite});
  }
  if (settings.strobe_cd > 0)
    for (const auto& [kind, place] : {std::pair(Kind::strobe_left, places.left),
                                      {Kind::strobe_right, places.right},
                                      {Kind::strobe_tail, places.tail}})
      lamps.push_back({kind, place, kWhite, true});
  if (settings.beacon_cd > 0) {
    lamps.push_back({Kind::beacon_top, places.top, kRed, true, 0.5});
    lamps.push_back({Kind::beacon_bottom, places.bottom, kRed, true, 0.5});
  }
  if (settings.landing_cd > 0) lamps.push_back({Kind::landing, places.nose, kWhite});
  return lamps;
}

double intensity_cd(const Lamp& lamp, const LampSettings& settings, const glm::dvec3& direction) {
  using Kind = Lamp::Kind;
  const double up_deg = deg_of_rad(std::asin(std::clamp(-direction.z, -1.0, 1.0)));
  const double right_deg = deg_of_rad(std::atan2(direction.y, direction.x));
  const double off_deg = std::abs(right_deg);
  const double left = std::clamp(1 - right_deg / kOverlap_deg, 0.0, 1.0);
  const double right = std::clamp(1 + right_deg / kOverlap_deg, 0.0, 1.0);
  const double beside = std::clamp(1 - (off_deg - kSector_deg) / kOverlap_deg, 0.0, 1.0);
  const double behind = std::clamp(1 + (off_deg - kSector_deg) / kOverlap_deg, 0.0, 1.0);
  const double ahead = beside * factor_at(kPositionAhead, std::min(off_deg, kSector_deg));
  const double flash_cd = during_flash_cd(1, settings.flash_s) * factor_at(kFlashUpDown, std::abs(up_deg));
  const double position_cd = settings.position_cd * factor_at(kPositionUpDown, std::abs(up_deg));
  switch (lamp.kind) {
    case Kind::left:
      return left * ahead * position_cd;
    case Kind::right:
      return right * ahead * position_cd;
    case Kind::tail:
      return behind * kTailOfAhead * position_cd;
    case Kind::strobe_left:
      return left * beside * settings.strobe_cd * flash_cd;
    case Kind::strobe_right:
      return right * beside * settings.strobe_cd * flash_cd;
    case Kind::strobe_tail:
      return behind * settings.strobe_cd * flash_cd;
    case Kind::beacon_top:
      return std::clamp(1 + up_deg / kOverlap_deg, 0.0, 1.0) * settings.beacon_cd * flash_cd;
    case Kind::beacon_bottom:
      return std::clamp(1 - up_deg / kOverlap_deg, 0.0, 1.0) * settings.beacon_cd * flash_cd;
    case Kind::landing:
      break;
  }
  const double halves = deg_of_rad(std::acos(std::clamp(direction.x, -1.0, 1.0))) / (settings.landing_beam_deg / 2);
  return settings.landing_cd * std::exp2(-halves * halves);
}

double share_of_exposure(const Lamp& lamp, const LampSettings& settings, double middle_s, double exposure_s) {
  if (!lamp.flashes) return 1;
  const double period_s = 60 / settings.flashes_per_minute;
  if (settings.flash_s >= period_s) return 1;
  // Time on before an instant, from the beginning of a flash on.
  const auto on_s = [&](double time_s) {
    const double flashes = time_s / period_s - settings.phase - lamp.lag;
    const double whole = std::floor(flashes);
    return whole * settings.flash_s + std::min((flashes - whole) * period_s, settings.flash_s);
  };
  return std::clamp((on_s(middle_s + exposure_s / 2) - on_s(middle_s - exposure_s / 2)) / exposure_s, 0.0, 1.0);
}

std::vector<LampImage> lamp_images(const Scene& scene, const SceneMoment& moment, const PlacedIntruder& placed,
                                   const Lens& lens) {
  const SceneIntruder& intruder = scene.intruders[static_cast<std::size_t>(placed.id)];
  const double exposure_s = moment.exposure_s > 0 ? moment.exposure_s : Shutter::kAssumedExposure_s;
  const double white = white_cdpm2(scene.light);
  std::vector<LampImage> images;
  for (const Lamp& lamp : lamps_of(intruder.lights, intruder.model->lamps)) {
    const std::optional<SeenPoint> point = seen(scene, moment, placed, lens, lamp.place_m);
    if (!point) continue;
    const double share = share_of_exposure(lamp, intruder.lights, moment.time_s + point->since_s, exposure_s);
    const double candela = intensity_cd(lamp, intruder.lights, point->to_camera_in_body);
    const std::optional<double> solid_angle_sr = pixel_sr(lens, point->p_in_camera);
    if (share <= 0 || candela <= 0 || !solid_angle_sr) continue;
    const double distance_m = glm::length(point->p_in_camera);
    const double illuminance_lx = share * candela * light_through_haze(scene, distance_m) / (distance_m * distance_m);
    const glm::dvec3 light = illuminance_lx / (white * *solid_angle_sr) * lamp.color;
    images.push_back({name_of(lamp.kind), point->pixel, {light.x, light.y, light.z}, share});
  }
  return images;
}

LampLayer with_layer(Layer layer) {
  LampLayer lamp;
  bool is_seen = false;
  for (int y = 0; y < layer.color.rows; ++y)
    for (int x = 0; x < layer.color.cols; ++x) {
      const auto& pixel = layer.color.at<cv::Vec4f>(y, x);
      const glm::dvec3 light(pixel[0], pixel[1], pixel[2]);
      is_seen = is_seen || std::max({light.x, light.y, light.z}) >= kFaintest;
      lamp.brightest = std::max(lamp.brightest, glm::dot(light, kLuminance));
    }
  if (!is_seen) return {};
  lamp.layer = std::move(layer);
  return lamp;
}

LampLayer lamp_layer(const LampImage& lamp, const LampSpread& spread, const cv::Rect& bounds) {
  const double light = std::max({lamp.light[0], lamp.light[1], lamp.light[2]});
  const double sharp = 1 - spread.glare;
  const double reach = std::max(reach_px(sharp * light, spread.sigma_px),
                                spread.glare > 0 ? reach_px(spread.glare * light, spread.glare_px) : 0);
  const double across_px = reach * spread.widening;
  const cv::Rect rect =
      pixels_touched({lamp.pixel.x - across_px, lamp.pixel.y - reach, 2 * across_px, 2 * reach}, 0, bounds);
  if (rect.empty()) return {};
  Layer layer{.rect = rect,
              .color = cv::Mat(rect.size(), CV_32FC4, cv::Scalar::all(0)),
              .coverage = cv::Mat::zeros(rect.size(), CV_32FC1)};
  std::vector<glm::dvec2> across;  // shares of the two Gaussians in each column
  for (int x = rect.x; x < rect.x + rect.width; ++x)
    across.emplace_back(share_on(lamp.pixel.x, spread.sigma_px * spread.widening, x),
                        share_on(lamp.pixel.x, spread.glare_px * spread.widening, x));
  for (int y = 0; y < rect.height; ++y) {
    const double down = share_on(lamp.pixel.y, spread.sigma_px, rect.y + y);
    const double down_wide = share_on(lamp.pixel.y, spread.glare_px, rect.y + y);
    for (int x = 0; x < rect.width; ++x) {
      const glm::dvec2& there = across[static_cast<std::size_t>(x)];
      const double share = sharp * down * there.x + spread.glare * down_wide * there.y;
      if (share * light < kFaintest) continue;
      auto& pixel = layer.color.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(share * lamp.light[c]);
      pixel[3] = static_cast<float>(kOpacity);
    }
  }
  return with_layer(std::move(layer));
}

}  // namespace sigs
