// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"

namespace sigs {

namespace frame {
struct FirstCamera;  // of a rig; axes as those of Camera
}  // namespace frame

// A camera of a rig as its calibration file has it.
struct CalibratedCamera {
  std::string name;  // as the file names it: "cam0"; of a stereo pair "left", "right"
  Camera camera;
  Pose<frame::FirstCamera, frame::Camera> first_from_camera;
  // Time of the first camera's clock less that of this one's at the same instant, by Kalibr's timeshift_cam_imu. The
  // clocks are those that stamped the images of the calibration; the footage's times are of them only where they count
  // from the same stamp.
  std::optional<double> clock_offset_s = {};
};

struct RigCalibration {
  std::string format;  // "Kalibr chain", "OpenCV stereo pair"
  std::vector<CalibratedCamera> cameras;
  std::vector<Warning> warnings = {};  // of the rig; those of a lens are in its Camera
};

struct RigReading {
  // Size of the images where the file states none, as OpenCV's stereo files.
  std::optional<cv::Size> size_px = {};
  // What one unit of T is in OpenCV's stereo files, in metres: that in which the board's squares were given.
  double opencv_unit_m = 1;
};

// Reads where the cameras of a rig are, and their lenses. The format is recognised by the content:
//   Kalibr chain        YAML or JSON (camchain.yaml, camchain-imucam.yaml): maps with camera_model, intrinsics,
//                       distortion_model, distortion_coeffs, resolution, at any depth. T_cn_cnm1 takes points of the
//                       camera before to this one; cameras without it are tied by T_cam_imu (IMU to camera), T_imu_cam
//                       (OpenVINS) or T_BS (EuRoC), both camera to IMU.
//                       https://github.com/ethz-asl/kalibr/wiki/yaml-formats
//   OpenCV stereo pair  any FileStorage, YAML or JSON with M1 D1 M2 D2 R T: p_second = R p_first + T
//                       (cv::stereoCalibrate). R and T may stand in the file beside it whose name has `extrinsics` in
//                       place of `intrinsics`, as OpenCV's sample stereo_calib writes them; either is then given
// Poses of files are in OpenCV's optical axes (x right, y down, z forward); here X is along the optical axis.
// Warnings: T of more than 5 m; links of the chain that contradict those over the IMU.
// Errors name file and field: one camera alone, a link of the chain that is missing, a rotation that is none, numbers
// that are not finite. Its kind is cannot_read where a file cannot be opened, else bad_data.
[[nodiscard]] Result<RigCalibration> read_rig_calibration(const std::filesystem::path& path,
                                                          const RigReading& reading = {});

}  // namespace sigs
