// SPDX-License-Identifier: MIT
#include "geo/waypoints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ensure.h"

namespace sigs {

namespace {

// The method takes time with the square of the number of points where each split takes off one point alone. Every point
// of this number stays, so that such a file takes as long as its length; in others it is one point of thousands.
constexpr std::size_t kMaxAtOnce = 4096;

double distance_to_segment_m(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double part = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::length(p - (a + part * along));
}

class Simplification {
 public:
  Simplification(const std::vector<WorldWaypoint>& all, bool in_time, double tolerance_m)
      : all_(all), in_time_(in_time), tolerance_m_(tolerance_m), kept_(all.size(), false) {}

  [[nodiscard]] std::vector<WorldWaypoint> waypoints() {
    for (std::size_t first = 0; first < all_.size(); first += kMaxAtOnce)
      keep_needed(first, std::min(first + kMaxAtOnce, all_.size() - 1));
    std::vector<WorldWaypoint> chosen;
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (kept_[i]) chosen.push_back(all_[i]);
    return chosen;
  }

 private:
  [[nodiscard]] double error_m(std::size_t i, std::size_t first, std::size_t last) const {
    const WorldWaypoint& a = all_[first];
    const WorldWaypoint& b = all_[last];
    if (!in_time_) return distance_to_segment_m(all_[i].position_m, a.position_m, b.position_m);
    const double part = (all_[i].time_s - a.time_s) / (b.time_s - a.time_s);
    return glm::length(all_[i].position_m - glm::mix(a.position_m, b.position_m, part));
  }

  // Splits at the point that is furthest off, until none is off by more than the tolerance.
  void keep_needed(std::size_t begin, std::size_t end) {
    kept_[begin] = kept_[end] = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{begin, end}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      std::size_t furthest = first;
      double largest_m = tolerance_m_;
      for (std::size_t i = first + 1; i < last; ++i)
        if (const double off_m = error_m(i, first, last); off_m > largest_m) {
          largest_m = off_m;
          furthest = i;
        }
      if (furthest == first) continue;
      kept_[furthest] = true;
      open.emplace_back(first, furthest);
      open.emplace_back(furthest, last);
    }
  }

  const std::vector<WorldWaypoint>& all_;
  bool in_time_;
  double tolerance_m_;
  std::vector<bool> kept_;
};

}  // namespace

std::vector<WorldWaypoint> waypoints_of(const RecordedPath& path, const LocalFrame& frame, double tolerance_m) {
  ENSURE(tolerance_m >= 0 && std::isfinite(tolerance_m));
  std::vector<WorldWaypoint> all;
  for (const TimedPlace& point : path.points) all.push_back({point.time_s, frame.world_of(point.place)});
  if (tolerance_m == 0) return all;
  return Simplification(all, path.has_times, tolerance_m).waypoints();
}

}  // namespace sigs
