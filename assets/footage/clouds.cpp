// SPDX-License-Identifier: MIT
#include "clouds.h"

#include <algorithm>
#include <cmath>

#include "light.h"
#include "noise.h"
#include "parallel.h"

namespace sigs::footage {

namespace {

constexpr int kCube = 96;              // cells along one side of the noise cube
constexpr float kExtinction = 0.026F;  // 1/m in the thick of a cloud
constexpr double kExtent_m = 42000;
constexpr float kMaxNoise = 1.5F;  // beyond the range of the noise that clouds follow

// Distance to the nearest of one jittered point in each of count^3 boxes of a cube of side 1 that repeats.
float nearest_point(const glm::vec3& p, int count, std::uint32_t seed) {
  const glm::vec3 scaled = p * static_cast<float>(count);
  const glm::ivec3 box(glm::floor(scaled));
  float best = 9;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const glm::ivec3 there = box + glm::ivec3(i, j, k);
        const glm::ivec3 w = ((there % count) + count) % count;
        const std::uint32_t bits = hash(w.x + 64 * w.z, w.y, seed);
        const glm::vec3 jitter{chance(bits), chance(hash(bits)), chance(hash(bits + 77))};
        const glm::vec3 apart = glm::vec3(there) + jitter - scaled;
        best = std::min(best, glm::dot(apart, apart));
      }
  return std::sqrt(best);
}

// Cellular noise in octaves: cumulus consists of round lumps of many sizes.
float cumulus_density(const glm::vec3& p) {
  float sum = 0, strength = 0.58F;
  int count = 4;
  for (std::uint32_t octave = 0; octave < 4; ++octave) {
    sum += strength * (1 - std::min(nearest_point(p, count, 101 + octave), 1.0F));
    strength *= 0.46F;
    count *= 2;
  }
  return sum;
}

// Light that a thickness of cloud transmits: the direct part, and the part scattered many times.
float transmittance(float thickness) {
  return 0.62F * std::exp(-thickness) + 0.38F * std::exp(-0.16F * thickness);
}

}  // namespace

Clouds::Clouds(const CloudCover& cover) : cover_(cover), billows_(static_cast<std::size_t>(kCube) * kCube * kCube) {
  parallel_rows(kCube, [&](int z) {
    for (int y = 0; y < kCube; ++y)
      for (int x = 0; x < kCube; ++x)
        billows_[(static_cast<std::size_t>(z) * kCube + y) * kCube + x] =
            cumulus_density(glm::vec3(x, y, z) / static_cast<float>(kCube));
  });
}

float Clouds::billows(const glm::dvec3& p) const {
  const auto split = [](double x, int& i, int& next) {
    const double scaled = (x - std::floor(x)) * kCube;
    i = std::min(static_cast<int>(scaled), kCube - 1);
    next = i + 1 == kCube ? 0 : i + 1;
    return static_cast<float>(scaled - i);
  };
  int x0, x1, y0, y1, z0, z1;
  const float u = split(p.x, x0, x1), v = split(p.y, y0, y1), w = split(p.z, z0, z1);
  const auto row = [&](int y, int z) {
    const float* line = &billows_[(static_cast<std::size_t>(z) * kCube + y) * kCube];
    return line[x0] + u * (line[x1] - line[x0]);
  };
  const float near = row(y0, z0) + v * (row(y1, z0) - row(y0, z0)), far = row(y0, z1) + v * (row(y1, z1) - row(y0, z1));
  return near + w * (far - near);
}

float Clouds::cover(const glm::dvec2& p_m) const {
  const float shape = fractal_noise(p_m / cover_.size_m, 3, 111) + 0.35F * fractal_noise(p_m / 9000.0, 2, 115);
  return smooth(cover_.clear_below, cover_.full_above, shape);
}

float Clouds::density(const glm::dvec3& p_m, float cover_here, float detail) const {
  const float h = static_cast<float>((p_m.z - kBase_m) / (kTop_m - kBase_m));
  if (h <= 0 || h >= 1 || cover_here <= 0) return 0;
  const float top = 0.12F + 0.88F * cover_here;
  const float profile = smooth(0.0F, 0.07F, h) * (1 - smooth(0.35F * top, top, h));
  const float body = cover_here * profile;
  if (body <= 0.01F) return 0;
  const float coarse = billows(p_m / 1500.0);
  float dense = body * 1.5F + coarse - 0.94F;
  if (dense <= 0) return 0;
  constexpr float kMeanBillow = 0.52F;
  const float fine =
      detail <= 0 ? kMeanBillow : glm::mix(kMeanBillow, billows(glm::dvec3(p_m.y, p_m.z, p_m.x) / 360.0), detail);
  dense -= 0.46F * (0.80F - fine) * (1 - std::min(dense * 1.5F, 0.8F));
  return std::clamp(dense * 2.8F, 0.0F, 1.0F);
}

float Clouds::depth_to_sun(const glm::dvec3& p_m) const {
  const glm::dvec3 up{kToSun.x, kToSun.y, -kToSun.z};
  float depth = 0;
  double behind = 0;
  for (const double step : {35.0, 60.0, 110.0, 190.0, 320.0}) {
    const glm::dvec3 there = p_m + up * (behind + 0.5 * step);
    depth += density(there, cover(glm::dvec2(there)), 0) * static_cast<float>(step);
    behind += step;
  }
  return depth * kExtinction;
}

float Clouds::sun_share(const glm::dvec2& p_m) const {
  const double lift = kBase_m + 0.25 * (kTop_m - kBase_m);
  const glm::dvec2 above = p_m + glm::dvec2(kToSun) * (lift / -kToSun.z);
  const float thick = smooth(0.22F, 0.62F, cover(above) + 0.25F * (billows(glm::dvec3(above, lift) / 1500.0) - 0.5F));
  return 1 - 0.74F * thick;
}

glm::vec4 Clouds::along(const glm::dvec2& eye_m, double height_m, const glm::dvec3& ray, double dither) const {
  const double climb = -ray.z;
  if (climb < 0.02 || cover_.clear_below > kMaxNoise) return glm::vec4(0);
  const double enter_m = (kBase_m - height_m) / climb, leave_m = std::min((kTop_m - height_m) / climb, kExtent_m);
  if (enter_m >= kExtent_m) return glm::vec4(0);
  const double step_m = std::max((leave_m - enter_m) / 90, 20.0);
  const float detail =
      std::min(1.0F, 60.0F / static_cast<float>(step_m));  // finer detail than the steps would be aliased
  glm::vec3 light{0};
  float clear = 1;
  float depth_weight = 0, depth_sum = 0;
  for (double t = enter_m + dither * step_m; t < leave_m && clear > 0.015F; t += step_m) {
    const glm::dvec3 p{eye_m.x + t * ray.x, eye_m.y + t * ray.y, height_m + t * climb};
    const float here = density(p, cover(glm::dvec2(p)), detail);
    if (here <= 0) continue;
    const float h = static_cast<float>((p.z - kBase_m) / (kTop_m - kBase_m));
    const glm::vec3 sun = kSunlight * (1.12F * transmittance(depth_to_sun(p)));
    const glm::vec3 sky =
        glm::mix(glm::vec3(0.20F, 0.235F, 0.28F), glm::vec3(0.36F, 0.42F, 0.52F), smooth(0.0F, 0.7F, h));
    const float kept = std::exp(-here * kExtinction * static_cast<float>(step_m));
    const float share = clear * (1 - kept);
    light += share * (sun + sky);
    depth_sum += share * static_cast<float>(t);
    depth_weight += share;
    clear *= kept;
  }
  if (depth_weight <= 0) return glm::vec4(0);
  const double distance_m = depth_sum / depth_weight;
  const float opacity =
      (1 - clear) * (1 - smooth(0.55F * float(kExtent_m), float(kExtent_m), static_cast<float>(distance_m)));
  const glm::vec3 through = clear_share(0.55 * distance_m);  // the air up there is thinner than at the ground
  const glm::vec3 behind = clear_sky(static_cast<float>(climb));
  return {(light / (1 - clear) * through + behind * (1.0F - through)) * opacity, opacity};
}

}  // namespace sigs::footage
