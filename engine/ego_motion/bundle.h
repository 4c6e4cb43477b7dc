// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "ego_motion/rotation_fit.h"
#include "ego_motion/settings.h"

namespace sigs {

// Adjustment of key frames and landmarks together, so that near ground, which moves by parallax, and far points tell of
// the rotation what they know each: Triggs et al., Bundle Adjustment - A Modern Synthesis (1999). Landmarks have an
// inverse depth (Montiel, Civera, Davison 2006), which is 0 for points too far for any parallax.
//
// The unit of length is what the camera flies in one second on average: nothing in the images tells the true scale.

struct BundleFrame {
  glm::dquat world_from_camera = glm::dquat(1, 0, 0, 0);
  glm::dvec3 position = glm::dvec3(0);
  double time_s = 0;
};

// The point reference + direction / inverse_depth.
struct Landmark {
  glm::dvec3 reference = glm::dvec3(0);        // fixed
  glm::dvec3 direction = glm::dvec3(1, 0, 0);  // unit
  double inverse_depth = 0;
  double weight = 1;  // 0..1: how far its observations agree with each other; set by adjust()
  double trust = 1;   // 0..1: how far it is known beforehand to stand still
};

struct BundleObservation {
  int frame = 0;
  int landmark = 0;
  glm::dvec3 ray;  // unit, camera axes
};

struct Bundle {
  std::vector<BundleFrame> frames;  // the first is held
  std::vector<Landmark> landmarks;
  std::vector<BundleObservation> observations;  // by rising landmark, of each by rising frame
};

struct BundleSettings {
  double min_sigma_rad = 1e-5;    // of an observation
  double min_scale_rad = 1e-4;    // of weights: what agrees as well as this is not distinguished, see adjust()
  double start_sigma_rad = 2e-3;  // the first round takes no observation for wrong that misses by less
  double inverse_depth_sd = 0.3;  // what is expected of landmarks beforehand, per unit of length
  double acceleration_sd = 0.3;   // change of velocity in a second, units per second
  int rounds = 12;
};

struct BundleFit {
  std::vector<glm::dmat3> covariances;  // of each frame's rotation against the first: small turns about the
                                        // camera's axes, rad^2
  double sigma_rad = 0;                 // of an observation in one direction
};

// Least squares with weights of Geman and McClure, of single observations and of whole landmarks, whose scale shrinks
// from round to round (graduated non-convexity): what moves on its own loses its weight. Changes frames and landmarks.
// The scale does not fall below min_scale_rad, lest the few that agree best by chance, among many that are as good,
// take all the weight. Landmarks that are not trusted count for as much less, and nothing for the scale.
[[nodiscard]] BundleFit adjust(Bundle& bundle, const BundleSettings& settings, CancelFlag cancel = nullptr);

// How far a camera's small turn and small motion, and a landmark's, move a point's image on the unit sphere.
struct Projection {
  glm::dvec2 residual;  // seen less predicted, in the tangent plane of the ray
  // In each direction, of the prediction: by the landmark (two tangents of its direction, inverse depth), then by the
  // frame (turn about the camera's axes, position).
  std::array<std::array<double, 9>, 2> slopes{};
};
[[nodiscard]] Projection projection(const BundleFrame& frame, const Landmark& landmark, const glm::dvec3& ray);

// Ground stands still and clouds do not; the parallax of landmarks shows which is which. Over even ground the inverse
// depth of a landmark rises in proportion to the sine of its angle below the horizon: inverse_depth = g . direction,
// where g points down and has the length 1 / height. No attitude has to be known for it.

// g by least squares over landmarks that agree with the camera's motion and are near enough for parallax, with weights
// of Geman and McClure against hills and houses. None where fewer than 15 are so, or they do not lie below a horizon.
[[nodiscard]] std::optional<glm::dvec3> ground_of(std::span<const Landmark> landmarks);

// 1 below the horizon of `ground` and up to 3 degrees above it (hills), falling to kSkyTrust at 6 degrees. 1 where the
// ground is not known.
[[nodiscard]] double trust_of(const std::optional<glm::dvec3>& ground, const glm::dvec3& direction);

// Key frames with the landmarks that they see, adjusted together.
struct KeyFrames {
  std::vector<BundleFrame> frames;              // the first has no rotation
  std::vector<glm::dmat3> covariances;          // of their rotations against the first
  std::unordered_map<int, Landmark> landmarks;  // by the feature's id
  double sigma_rad = 0;                         // of one feature in one frame, in one direction
  std::optional<glm::dvec3> ground;             // as ground_of() has it; none: nothing near shows parallax
};

// Adjusts key frames: first each few with those shortly before them, so that the first values need not be good over the
// whole time, then all.
//   first_values  rotations of all frames, from frame to frame
//   keys          numbers of the key frames, two or more, rising
[[nodiscard]] KeyFrames adjusted_keys(std::span<const FrameRays> frames, std::span<const double> times_s,
                                      std::span<const glm::dquat> first_values, std::span<const int> keys,
                                      double pixel_rad, CancelFlag cancel = nullptr);

// A frame's rotation from the landmarks that it sees.
struct LocatedFrame {
  glm::dquat world_from_camera;
  glm::dmat3 covariance;  // of this frame alone, landmarks taken as known, rad^2
  int features_used = 0;
  ReadoutTurn readout_turn;  // to be added to the one with which rays were unrolled; see located_frame
};

//   readout_s  0: rays are those of one instant. Else they were unrolled with a turn that may be wrong, and what has to
//              be added to it is found too; that it is not known beforehand counts in the covariance
//   guess      near enough that half of the features miss by some pixels at most; its position is held within narrow
//              limits, since an aircraft's motion is smooth
[[nodiscard]] LocatedFrame located_frame(const KeyFrames& keys, const FrameRays& rays, const BundleFrame& guess,
                                         double readout_s);

}  // namespace sigs
