// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/ensure.h"
#include "scene/flight.h"
#include "scene/scene_at.h"

namespace sigs {

namespace {

constexpr int kSamplesAFrame = 4;
constexpr int kMaxSamples = 20'000;
constexpr std::size_t kMaxValleys = 16;  // of the sampled distance that are looked at closely, the deepest ones
constexpr int kNarrowings = 60;          // by the golden section: from two samples to 1e-12 of it
constexpr double kEqual_m = 1e-6;

struct Moment {
  double frame = 0;
  double distance_m = 0;
};

class Distance {
 public:
  Distance(const Scene& scene, const SceneIntruder& intruder) : scene_(scene), intruder_(intruder) {}

  [[nodiscard]] Moment at(double frame) const {
    const double time_s = time_of_frame_s(scene_.footage, frame);
    const glm::dvec3 camera_m = camera_at(scene_.motion, time_s).translation_m;
    return {frame, glm::distance(intruder_.trajectory.position_m(time_s), camera_m)};
  }

 private:
  const Scene& scene_;
  const SceneIntruder& intruder_;
};

std::vector<Moment> sampled(const Distance& distance, int first_frame, int last_frame) {
  const int frames = std::max(0, last_frame - first_frame);
  const int steps = frames <= kMaxSamples / kSamplesAFrame ? frames * kSamplesAFrame : kMaxSamples;
  std::vector<Moment> samples;
  for (int i = 0; i <= steps; ++i)
    samples.push_back(distance.at(first_frame + (steps > 0 ? double(frames) * i / steps : 0)));
  return samples;
}

// Numbers of the samples that none of their neighbours is below; the deepest ones, in the order of time.
std::vector<std::size_t> valleys_of(const std::vector<Moment>& samples) {
  std::vector<std::size_t> valleys;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool falls = i == 0 || samples[i].distance_m < samples[i - 1].distance_m;
    const bool rises = i + 1 == samples.size() || samples[i].distance_m <= samples[i + 1].distance_m;
    if (falls && rises) valleys.push_back(i);
  }
  if (valleys.size() > kMaxValleys) {
    std::stable_sort(valleys.begin(), valleys.end(),
                     [&](std::size_t a, std::size_t b) { return samples[a].distance_m < samples[b].distance_m; });
    valleys.resize(kMaxValleys);
    std::sort(valleys.begin(), valleys.end());
  }
  return valleys;
}

// Golden section search (Kiefer 1953).
Moment lowest_between(const Distance& distance, double low_frame, double high_frame) {
  constexpr double kShare = 1 / std::numbers::phi;
  Moment a = distance.at(high_frame - kShare * (high_frame - low_frame));
  Moment b = distance.at(low_frame + kShare * (high_frame - low_frame));
  for (int i = 0; i < kNarrowings; ++i) {
    if (a.distance_m <= b.distance_m) {
      high_frame = b.frame;
      b = a;
      a = distance.at(high_frame - kShare * (high_frame - low_frame));
    } else {
      low_frame = a.frame;
      a = b;
      b = distance.at(low_frame + kShare * (high_frame - low_frame));
    }
  }
  return a.distance_m <= b.distance_m ? a : b;
}

}  // namespace

ClosestApproach closest_approach(const Scene& scene, int intruder) {
  ENSURE(intruder >= 0 && static_cast<std::size_t>(intruder) < scene.intruders.size());
  const Distance distance(scene, scene.intruders[static_cast<std::size_t>(intruder)]);
  const std::vector<Moment> samples = sampled(distance, scene.first_frame, scene.last_frame);
  Moment best = samples.front();
  for (const std::size_t i : valleys_of(samples)) {
    const Moment found =
        lowest_between(distance, samples[i > 0 ? i - 1 : i].frame, samples[std::min(i + 1, samples.size() - 1)].frame);
    const Moment& lowest = found.distance_m < samples[i].distance_m ? found : samples[i];
    if (lowest.distance_m < best.distance_m - kEqual_m || i == 0) best = lowest;
  }
  return {best.frame, time_of_frame_s(scene.footage, best.frame), best.distance_m};
}

}  // namespace sigs
