// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "ego_motion/bundle.h"
#include "ego_motion/tracks.h"

namespace sigs {

// Key frames with the landmarks that they see, adjusted together.
struct KeyFrames {
  std::vector<BundleFrame> frames;              // the first has no rotation
  std::vector<Eigen::Matrix3d> covariances;     // of their rotations against the first
  std::unordered_map<int, Landmark> landmarks;  // by the feature's id
  double sigma_rad = 0;                         // of one feature in one frame, in one direction
  std::optional<Eigen::Vector3d> ground;        // as ground_of() has it; none: nothing near shows parallax
};

// Adjusts key frames: first each few with those shortly before them, so that the first values need not be good over the
// whole time, then all.
//   first_values  rotations of all frames, from frame to frame
//   keys          numbers of the key frames, two or more, rising
[[nodiscard]] KeyFrames adjusted_keys(std::span<const FrameRays> frames, std::span<const double> times_s,
                                      std::span<const Eigen::Quaterniond> first_values, std::span<const int> keys,
                                      double pixel_rad, CancelFlag cancel = nullptr);

// A frame's rotation from the landmarks that it sees.
struct LocatedFrame {
  Eigen::Quaterniond world_from_camera;
  Eigen::Matrix3d covariance;  // of this frame alone, landmarks taken as known, rad^2
  int features_used = 0;
  ReadoutTurn readout_turn;  // to be added to the one with which rays were unrolled; see located_frame
};

//   readout_s  0: rays are those of one instant. Else they were unrolled with a turn that may be wrong, and what has to
//              be added to it is found too; that it is not known beforehand counts in the covariance
//   guess      near enough that half of the features miss by some pixels at most; its position is held within narrow
//              limits, since an aircraft's motion is smooth
[[nodiscard]] LocatedFrame located_frame(const KeyFrames& keys, const FrameRays& rays, const BundleFrame& guess,
                                         double readout_s);

// The direction in which the camera moves between two frames, unit, in the axes of the first: the one to which the
// paths of all features on the sphere lead (the focus of expansion). Forward where nothing moves by parallax.
[[nodiscard]] Eigen::Vector3d direction_of_motion(std::span<const RayPair> pairs_without_rotation, double pixel_rad);

}  // namespace sigs
