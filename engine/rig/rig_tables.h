// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "base/result.h"
#include "rig/rig_truth.h"

namespace sigs {

// The truth of a rig as tables that others read. Keys are paths within a folder, values the files' texts.
using TextFiles = std::map<std::string, std::string>;

// The tables of nuScenes (https://www.nuscenes.org/nuscenes#data-format, schema v1.0): sensors and their calibration,
// poses of the aircraft, images and annotations in three dimensions, in v1.0-sigs/. A sample is a frame of the first
// camera; of the other cameras the frame nearest to it is the sample's key frame. Axes are nuScenes': the aircraft's
// and the world's X forward, Y left, Z up; a camera's z along its axis. Times are the rig's, in microseconds.
//   name             of the scene
//   image_extension  images are NAME.CAMERA/frame_000123.png
[[nodiscard]] TextFiles nuscenes_tables(const RigTruth& rig, const std::string& name,
                                        const std::string& image_extension);

// KITTI's calib_cam_to_cam.txt (raw data development kit), and poses.txt and times.txt of its odometry benchmark: the
// first camera's pose at each of its frames against that at its first. Error bad_project: a lens that KITTI's five
// coefficients cannot describe; camera and lens are named.
[[nodiscard]] Result<TextFiles> kitti_tables(const RigTruth& rig);

}  // namespace sigs
