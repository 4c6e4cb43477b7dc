// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "project/project.h"
#include "truth/annotation.h"

namespace sigs {

// What the cameras of one aircraft see together: where each intruder is in the aircraft's axes (X out of the nose, Y
// right, Z down), which cameras show it, and how one takes it over from another.

// A camera as the rig's truth needs it.
struct RigCameraGeometry {
  std::string name;
  Camera camera;
  MountSettings mount;
  ClockSettings clock;
  std::string video;  // file that shows it
  FrameRange frames;  // of its footage
};

// An intruder of the rig.
struct RigIntruder {
  std::string name;
  std::string category;
  glm::dvec3 low_m{0, 0, 0};  // bounds of the model in body axes, relative to the reference point
  glm::dvec3 high_m{0, 0, 0};
};

// An intruder in a frame of one camera.
struct RigSighting {
  bool is_visible = false;
  bool in_image = false;  // some of it is, hidden or not
  double visible_fraction = 0;
  glm::dvec3 position_m{0, 0, 0};              // of the reference point, in the aircraft's axes
  glm::dquat world_from_intruder{1, 0, 0, 0};  // its attitude
};

// A frame of one camera.
struct RigFrame {
  int frame = 0;
  double time_s = 0;  // of the rig's clock
  Pose<frame::World, frame::Body> world_from_aircraft;
  std::vector<RigSighting> intruders;  // in the rig's order
};

// An unbroken time during which a camera shows an intruder, from the first frame with a visible pixel to the last.
struct CameraView {
  std::size_t camera = 0;
  double first_s = 0;  // of the rig's clock
  double last_s = 0;
};

// From the camera that shows an intruder to the next one, when it leaves the image of the first or is hidden there
// until it leaves it. None where it is hidden for a while, nor where the first one's footage ends.
struct Handover {
  std::size_t from = 0;
  std::size_t to = 0;
  double time_s = 0;  // of the last frame in which `from` shows it
  double gap_s = 0;   // from there to the first frame in which `to` shows it; negative: both did for as long
};

// What two cameras make of an intruder's distance by triangulation.
struct StereoRange {
  std::size_t first = 0;
  std::size_t second = 0;
  double error_m_per_px = 0;  // of the distance, for an error of one pixel in one of the two images, the coarser
};

// An intruder at the time of a frame of the first camera.
struct RigRow {
  int frame = 0;
  double time_s = 0;
  int intruder = 0;
  double range_m = 0;                                   // from the aircraft's origin
  double bearing_rad = 0;                               // to the right of the nose
  double elevation_rad = 0;                             // above the plane of nose and wings
  std::vector<std::optional<double>> visible_fraction;  // by camera, in the frame nearest in time; none: no frame then
  std::vector<bool> is_visible;                         // by camera: some pixel shows it in that frame
  std::optional<StereoRange> stereo;  // of the pair with the least error; none: no two cameras show it
};

class RigTruth {
 public:
  RigTruth(std::vector<RigCameraGeometry> cameras, std::vector<RigIntruder> intruders);

  // The truth of a camera's next frame. May be called from any thread, for one camera in order of the frames.
  void add(std::size_t camera, const FrameTruth& truth);

  [[nodiscard]] const std::vector<RigCameraGeometry>& cameras() const { return cameras_; }
  [[nodiscard]] const std::vector<RigIntruder>& intruders() const { return intruders_; }
  [[nodiscard]] const std::vector<RigFrame>& frames(std::size_t camera) const { return frames_.at(camera); }

  // The frame of a camera that is nearest to a time; null: none is nearer than three quarters of its interval.
  [[nodiscard]] const RigFrame* frame_at(std::size_t camera, double time_s) const;

  // By time, then by intruder.
  [[nodiscard]] std::vector<RigRow> rows() const;
  // By first_s.
  [[nodiscard]] std::vector<CameraView> views(int intruder) const;
  [[nodiscard]] std::vector<Handover> handovers(int intruder) const;

  // Cameras, and the views and handovers of each intruder: docs/rigs.md.
  [[nodiscard]] std::string json(const std::string& name) const;
  // The rows, with a header.
  [[nodiscard]] std::string csv() const;

 private:
  std::vector<RigCameraGeometry> cameras_;
  std::vector<RigIntruder> intruders_;
  std::vector<std::vector<RigFrame>> frames_;  // by camera
  std::mutex mutex_;
};

// By how much the distance to a point is wrong if the second camera's image is wrong by one pixel and the first
// camera's is right: 1 / |d pixel / d distance| along the ray of the first. None where the second has no image of the
// point, or where no distance moves it there: it lies on the line through both.
[[nodiscard]] std::optional<double> range_error_m_per_px(const RigCameraGeometry& first,
                                                         const RigCameraGeometry& second, const glm::dvec3& p_in_body);

// The truth of a rig as tables that others read. Keys are paths within a folder, values the files' texts.
using TextFiles = std::map<std::string, std::string>;

// The tables of nuScenes (https://www.nuscenes.org/nuscenes#data-format, schema v1.0): sensors and their calibration,
// poses of the aircraft, images and annotations in three dimensions, in v1.0-sigs/. A sample is a frame of the first
// camera; of the other cameras the frame nearest to it is the sample's key frame. Axes are nuScenes': the aircraft's
// and the world's X forward, Y left, Z up; a camera's z along its axis. Times are the rig's, in microseconds.
//   name             of the scene
//   image_extension  images are ../NAME.CAMERA/frame_000123.png, beside the tables' folder
[[nodiscard]] TextFiles nuscenes_tables(const RigTruth& rig, const std::string& name,
                                        const std::string& image_extension);

// KITTI's calib_cam_to_cam.txt (raw data development kit), and poses.txt and times.txt of its odometry benchmark: the
// first camera's pose at each of its frames against that at its first. Error bad_project: a lens that KITTI's five
// coefficients cannot describe; camera and lens are named.
[[nodiscard]] Result<TextFiles> kitti_tables(const RigTruth& rig);

}  // namespace sigs
