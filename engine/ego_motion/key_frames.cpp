// SPDX-License-Identifier: MIT
#include "ego_motion/bundle.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/least_squares.h"
#include "base/pose.h"

namespace sigs {

namespace {

constexpr double kFloor_px = 0.02;           // no feature is known better
constexpr double kScale_px = 0.12;           // features in coded footage are off by about half of it
constexpr std::size_t kLocalKeys = 10;       // adjusted together while key frames are added
constexpr std::size_t kAddedKeys = 3;        // between two such adjustments
constexpr double kRateSd_radps = 2;          // of a rate that is not known from frame to frame
constexpr double kRateChangeSd_radps2 = 50;  // of its change within a frame: some pixels of shake at 12 Hz
constexpr double kDoubtful_px = 0.18;        // an adjustment whose features are off by more may have gone astray
constexpr double kPositionSd = 0.01;         // of a frame between its key frames, in the unit of length

// The direction in which the camera moves between two frames, unit, in the axes of the first: the one to which the
// paths of all features on the sphere lead (the focus of expansion). Forward where nothing moves by parallax.
//   pairs  without the rotation
glm::dvec3 direction_of_motion(std::span<const RayPair> pairs, double pixel_rad) {
  const glm::dvec3 forward(1, 0, 0);
  std::vector<glm::dvec3> normals;
  for (const RayPair& pair : pairs) normals.push_back(glm::cross(pair.before, pair.after));
  std::vector<double> weights(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) weights[i] = 1 / (glm::length(normals[i]) + pixel_rad);
  glm::dvec3 direction = forward;
  for (int round = 0; round < 6; ++round) {
    glm::dmat3 sum(0);
    for (std::size_t i = 0; i < normals.size(); ++i) sum += weights[i] * glm::outerProduct(normals[i], normals[i]);
    const PrincipalAxes found = principal_axes(sum);
    if (!(found.values[1] > 0)) return forward;
    direction = found.axes[0];
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const double miss = glm::dot(direction, normals[i]);
      weights[i] = 1 / (1 + miss * miss / (0.25 * pixel_rad * pixel_rad));
    }
  }
  double away = 0;  // features move away from the direction of motion
  for (std::size_t i = 0; i < pairs.size(); ++i)
    away += weights[i] * glm::dot(pairs[i].after - pairs[i].before,
                                  direction - glm::dot(direction, pairs[i].before) * pairs[i].before);
  return away > 0 ? -direction : direction;
}

class KeyAdjuster {
 public:
  KeyAdjuster(std::span<const FrameRays> frames, std::span<const double> times_s,
              std::span<const glm::dquat> first_values, std::span<const int> keys, double pixel_rad, CancelFlag cancel)
      : frames_(frames),
        times_s_(times_s),
        first_values_(first_values),
        keys_(keys),
        pixel_rad_(pixel_rad),
        cancel_(cancel) {
    bundle_settings_.min_sigma_rad = kFloor_px * pixel_rad;
    bundle_settings_.min_scale_rad = kScale_px * pixel_rad;
  }

  KeyFrames solved() {
    result_.frames.push_back({.time_s = times_s_[at(0)]});
    for (std::size_t k = 1; k < keys_.size() && !is_cancelled(cancel_); ++k) {
      append(k);
      if (k % kAddedKeys == 0 || k + 1 == keys_.size()) adjust_range(k < kLocalKeys ? 0 : k + 1 - kLocalKeys, k + 1, 8);
    }
    if (is_cancelled(cancel_)) return {};
    const BundleFit fit = adjust_range(0, keys_.size(), 14);
    if (fit.sigma_rad > kDoubtful_px * pixel_rad_) {
      KeyAdjuster turning(frames_, times_s_, first_values_, keys_, pixel_rad_, cancel_);
      const BundleFit turns = turning.adjust_turns();
      if (turns.sigma_rad <= fit.sigma_rad) return turning.result(turns);
    }
    return result(fit);
  }

 private:
  // Rotations alone, all landmarks at infinity. Where a lens's field of view is narrow or its calibration wrong, travel
  // and turn look nearly alike, and the adjustment of both can end far from the truth, where it explains the image
  // worse than turns do.
  BundleFit adjust_turns() {
    bundle_settings_.inverse_depth_sd = 1e-7;
    const glm::dquat start_from_world = glm::conjugate(first_values_[at(0)]);
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const double time_s = times_s_[at(k)];
      result_.frames.push_back({.world_from_camera = glm::normalize(start_from_world * first_values_[at(k)]),
                                .position = glm::dvec3(1, 0, 0) * (time_s - times_s_[at(0)]),
                                .time_s = time_s});
    }
    return adjust_range(0, keys_.size(), 10);
  }

  KeyFrames result(const BundleFit& fit) {
    result_.ground = ground_;
    result_.covariances = fit.covariances;
    result_.sigma_rad = fit.sigma_rad;
    return std::move(result_);
  }

  [[nodiscard]] std::size_t at(std::size_t k) const { return static_cast<std::size_t>(keys_[k]); }

  // The next key frame goes on from the one before as the chain turns and in the direction in which the features flow.
  void append(std::size_t k) {
    const BundleFrame& before = result_.frames.back();
    const glm::dquat turn = glm::conjugate(first_values_[at(k - 1)]) * first_values_[at(k)];
    std::vector<RayPair> pairs = common_rays(frames_[at(k - 1)], frames_[at(k)]);
    for (RayPair& pair : pairs) pair.after = turn * pair.after;
    const double step_s = times_s_[at(k)] - times_s_[at(k - 1)];
    const glm::dvec3 direction = before.world_from_camera * direction_of_motion(pairs, pixel_rad_);
    glm::dvec3 velocity = direction;
    if (k >= 2) {
      const BundleFrame& older = result_.frames[k - 2];
      const glm::dvec3 last = (before.position - older.position) / (before.time_s - older.time_s);
      // Once landmarks have a scale, the speed has to go on with it.
      velocity = k < kAddedKeys + 1 ? direction * glm::length(last) : last;
    }
    result_.frames.push_back({.world_from_camera = glm::normalize(before.world_from_camera * turn),
                              .position = before.position + velocity * step_s,
                              .time_s = times_s_[at(k)]});
  }

  // Adjusts key frames [begin, end) and the landmarks that two or more of them see.
  BundleFit adjust_range(std::size_t begin, std::size_t end, int rounds) {
    std::map<int, std::vector<BundleObservation>> seen;
    for (std::size_t k = begin; k < end; ++k)
      for (const RayObservation& o : frames_[at(k)])
        seen[o.id].push_back({.frame = static_cast<int>(k - begin), .landmark = 0, .ray = o.ray});
    Bundle bundle{.frames = {result_.frames.begin() + static_cast<std::ptrdiff_t>(begin),
                             result_.frames.begin() + static_cast<std::ptrdiff_t>(end)}};
    std::vector<int> ids;
    for (auto& [id, observations] : seen) {
      if (observations.size() < 2) continue;
      for (BundleObservation& o : observations) o.landmark = static_cast<int>(ids.size());
      bundle.landmarks.push_back(landmark_of(id, observations, bundle));
      bundle.observations.insert(bundle.observations.end(), observations.begin(), observations.end());
      ids.push_back(id);
    }
    BundleSettings settings = bundle_settings_;
    settings.rounds = rounds;
    settings.start_sigma_rad = 4 * pixel_rad_;
    for (Landmark& landmark : bundle.landmarks) landmark.trust = trust_of(ground_, landmark.direction);
    BundleFit fit = adjust(bundle, settings, cancel_);
    std::copy(bundle.frames.begin(), bundle.frames.end(), result_.frames.begin() + static_cast<std::ptrdiff_t>(begin));
    for (std::size_t i = 0; i < ids.size(); ++i) result_.landmarks[ids[i]] = bundle.landmarks[i];
    ground_ = ground_of(bundle.landmarks);
    return fit;
  }

  // As known already, else from the observations: direction of the first, inverse depth by least squares over all.
  [[nodiscard]] Landmark landmark_of(int id, const std::vector<BundleObservation>& observations,
                                     const Bundle& bundle) const {
    if (const auto known = result_.landmarks.find(id); known != result_.landmarks.end()) return known->second;
    const BundleFrame& first = bundle.frames[static_cast<std::size_t>(observations.front().frame)];
    Landmark landmark{.reference = first.position,
                      .direction = glm::normalize(first.world_from_camera * observations.front().ray)};
    double top = 0;
    double bottom = 1e-4;
    for (const BundleObservation& o : observations) {
      const BundleFrame& frame = bundle.frames[static_cast<std::size_t>(o.frame)];
      const glm::dvec3 ray = frame.world_from_camera * o.ray;
      const glm::dvec3 by_depth = glm::cross(frame.position - landmark.reference, ray);
      top += glm::dot(glm::cross(landmark.direction, ray), by_depth);
      bottom += squared_length(by_depth);
    }
    landmark.inverse_depth = std::clamp(top / bottom, 0.0, 2.0);
    return landmark;
  }

  std::span<const FrameRays> frames_;
  std::span<const double> times_s_;
  std::span<const glm::dquat> first_values_;
  std::span<const int> keys_;
  double pixel_rad_;
  CancelFlag cancel_;
  BundleSettings bundle_settings_;
  std::optional<glm::dvec3> ground_;  // of the last adjustment
  KeyFrames result_;
};

}  // namespace

KeyFrames adjusted_keys(std::span<const FrameRays> frames, std::span<const double> times_s,
                        std::span<const glm::dquat> first_values, std::span<const int> keys, double pixel_rad,
                        CancelFlag cancel) {
  return KeyAdjuster(frames, times_s, first_values, keys, pixel_rad, cancel).solved();
}

LocatedFrame located_frame(const KeyFrames& keys, const FrameRays& rays, const BundleFrame& guess, double readout_s) {
  constexpr int kUnknowns = 12;  // turn, position, rate, its change
  struct Seen {
    const Landmark* landmark;
    const glm::dvec3* ray;
    double delay_s;
  };
  std::vector<Seen> seen;
  for (const RayObservation& o : rays)
    if (const auto found = keys.landmarks.find(o.id); found != keys.landmarks.end() && found->second.weight > 0.2)
      seen.push_back({&found->second, &o.ray, readout_s * o.row});
  const double variance = keys.sigma_rad * keys.sigma_rad;
  const double of_position = variance / (kPositionSd * kPositionSd);
  const double of_rate = variance / (kRateSd_radps * kRateSd_radps);
  const double of_change = variance / (kRateChangeSd_radps2 * kRateChangeSd_radps2);
  BundleFrame frame = guess;
  ReadoutTurn turn;
  NormalEquations equations(kUnknowns);
  int used = 0;
  for (int round = 0; round < 4; ++round) {
    const double scale = keys.sigma_rad * std::max(3.0, 24.0 / (1 << (2 * round)));
    equations = NormalEquations(kUnknowns);
    for (int i = 0; i < 3; ++i) {
      equations.add_known(i, 1e-9);
      equations.add_known(3 + i, of_position, guess.position[i] - frame.position[i]);
      equations.add_known(6 + i, of_rate, -turn.rate_radps[i]);
      equations.add_known(9 + i, of_change, -turn.rate_change_radps2[i]);
    }
    used = 0;
    for (const Seen& s : seen) {
      const Projection p = projection(frame, *s.landmark, turn_of(turn.after(s.delay_s)) * *s.ray);
      const double root = 1 / (1 + squared_length(p.residual) / (2 * scale * scale));
      const double w = s.landmark->weight * s.landmark->trust * root * root;
      if (root > 0.3) ++used;
      for (int axis = 0; axis < 2; ++axis) {
        const std::span<const double> of_frame = std::span(p.slopes[static_cast<std::size_t>(axis)]).last<6>();
        std::array<double, kUnknowns> slopes{};
        std::copy(of_frame.begin(), of_frame.end(), slopes.begin());
        // A ray that is unrolled by a larger rate moves as if the camera turned back by as much.
        for (std::size_t i = 0; i < 3; ++i) {
          slopes[6 + i] = s.delay_s * slopes[i];
          slopes[9 + i] = s.delay_s * s.delay_s / 2 * slopes[i];
        }
        equations.add(slopes, p.residual[axis], w);
      }
    }
    const std::vector<double> change = equations.solved();
    const auto three = [&](std::size_t i) { return glm::dvec3(change[i], change[i + 1], change[i + 2]); };
    if (!std::all_of(change.begin(), change.end(), [](double c) { return std::isfinite(c); })) break;
    frame.world_from_camera = glm::normalize(frame.world_from_camera * turn_of(three(0)));
    frame.position += three(3);
    if (readout_s > 0) turn += {three(6), three(9)};
  }
  return {frame.world_from_camera, variance * block_of(equations.inverse(), 0), used, turn};
}

}  // namespace sigs
