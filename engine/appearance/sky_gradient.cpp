// SPDX-License-Identifier: MIT
#include "appearance/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/pose.h"

namespace sigs {

namespace {

constexpr std::size_t kMinSamples = 12;
constexpr double kMinExplained = 0.8;
constexpr double kMinSpread = 0.22;  // natural logarithm of the luminance, largest less least within a band
constexpr double kMinAzimuthSd_rad = 0.14, kMinElevationSd_rad = 0.2;
constexpr int kCoarse_deg = 4;

double angle_from_sun(const SkySample& s, double azimuth_rad, double elevation_rad) {
  const double cosine = std::sin(s.elevation_rad) * std::sin(elevation_rad) +
                        std::cos(s.elevation_rad) * std::cos(elevation_rad) * std::cos(s.azimuth_rad - azimuth_rad);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// Of values for the samples: the sum of squares of what the bands' means and the lens' fall leave.
template <class Value>
double left_over(const std::vector<SkySample>& samples, const Value& value) {
  struct Band {
    double sum = 0, lens = 0, count = 0;
  };
  std::vector<Band> bands;
  const auto lens = [](const SkySample& s) { return s.from_axis_rad * s.from_axis_rad; };
  for (const SkySample& s : samples) {
    bands.resize(std::max(bands.size(), static_cast<std::size_t>(s.band) + 1));
    Band& band = bands[static_cast<std::size_t>(s.band)];
    band.sum += value(s), band.lens += lens(s), ++band.count;
  }
  double vv = 0, vl = 0, ll = 1e-12;
  for (const SkySample& s : samples) {
    const Band& band = bands[static_cast<std::size_t>(s.band)];
    const double v = value(s) - band.sum / band.count, l = lens(s) - band.lens / band.count;
    vv += v * v, vl += v * l, ll += l * l;
  }
  return std::max(0.0, vv - vl * vl / ll);
}

double misfit(const std::vector<SkySample>& samples, double azimuth_rad, double elevation_rad) {
  return left_over(samples, [&](const SkySample& s) {
    return std::log(s.luminance) - std::log(clear_sky_indicatrix(angle_from_sun(s, azimuth_rad, elevation_rad)));
  });
}

struct Best {
  double azimuth_rad = 0, elevation_rad = 0, cost = 0;
};

Best best_sun(const std::vector<SkySample>& samples) {
  Best best{0, 0, misfit(samples, 0, 0.1)};
  const auto look = [&](double azimuth_rad, double elevation_rad) {
    const double cost = misfit(samples, azimuth_rad, elevation_rad);
    if (cost < best.cost) best = {azimuth_rad, elevation_rad, cost};
  };
  for (int az = 0; az < 360; az += kCoarse_deg)
    for (int el = 2; el < 88; el += kCoarse_deg) look(rad_of_deg(az), rad_of_deg(el));
  for (double step = 0.5 * rad_of_deg(kCoarse_deg); step > 0.002; step /= 2) {
    const Best middle = best;
    for (const double da : {-step, 0.0, step})
      for (const double de : {-step, 0.0, step})
        look(middle.azimuth_rad + da, std::clamp(middle.elevation_rad + de, 0.0, 1.55));
  }
  return best;
}

// How far one may go along one angle until the misfit grows by the share that a deviation of 1 means, with the other
// angle free.
template <class Cost>
double reach(const Cost& cost, double limit, double least) {
  double off = least;
  while (off < std::numbers::pi / 2 && (cost(off) < limit || cost(-off) < limit)) off *= 1.2;
  return off;
}

}  // namespace

double clear_sky_indicatrix(double angle_rad) {
  const double cosine = std::cos(angle_rad);
  return 1 + 10 * (std::exp(-3 * angle_rad) - std::exp(-1.5 * std::numbers::pi)) + 0.45 * cosine * cosine;
}

std::optional<SkySun> sun_of_sky(const std::vector<SkySample>& samples) {
  if (samples.size() < kMinSamples) return std::nullopt;
  if (std::all_of(samples.begin(), samples.end(), [&](const SkySample& s) { return s.band == samples[0].band; }))
    return std::nullopt;
  const double total = left_over(samples, [](const SkySample& s) { return std::log(s.luminance); });
  // A slope of this spread across a band has a twelfth of its square as variance.
  const double least = static_cast<double>(samples.size()) * kMinSpread * kMinSpread / 12;
  if (!(total > least)) return std::nullopt;
  const Best best = best_sun(samples);
  if (best.cost > (1 - kMinExplained) * total) return std::nullopt;
  // Neighbouring samples are alike: about four count as one.
  const double limit = best.cost * (1 + 4.0 / std::max(1.0, static_cast<double>(samples.size()) - 4)) + 1e-9;
  SkySun sun{.azimuth_rad = best.azimuth_rad, .elevation_rad = best.elevation_rad};
  sun.azimuth_sd_rad = reach([&](double d) { return misfit(samples, best.azimuth_rad + d, best.elevation_rad); }, limit,
                             kMinAzimuthSd_rad);
  sun.elevation_sd_rad =
      reach([&](double d) { return misfit(samples, best.azimuth_rad, std::clamp(best.elevation_rad + d, 0.0, 1.55)); },
            limit, kMinElevationSd_rad);
  return sun;
}

}  // namespace sigs
