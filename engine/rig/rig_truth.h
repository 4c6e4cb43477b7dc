// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
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

// An unbroken time during which a camera shows an intruder, from the first frame with a visible pixel to the last.
struct CameraView {
  std::size_t camera = 0;
  double first_s = 0;  // of the rig's clock
  double last_s = 0;
};

// From the camera that shows an intruder to the next one, when it leaves the image of the first.
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
  RigTruth(std::vector<RigCameraGeometry> cameras, std::vector<std::string> intruders);

  // The truth of a camera's next frame. May be called from any thread, for one camera in order of the frames.
  void add(std::size_t camera, const FrameTruth& truth);

  [[nodiscard]] const std::vector<RigCameraGeometry>& cameras() const { return cameras_; }
  [[nodiscard]] const std::vector<std::string>& intruders() const { return intruders_; }

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
  struct Seen {
    int frame = 0;
    double time_s = 0;
    bool is_visible = false;
    double visible_fraction = 0;
    glm::dvec3 position_m{0, 0, 0};  // in the aircraft's axes
  };
  [[nodiscard]] const Seen* nearest(std::size_t camera, std::size_t intruder, double time_s) const;

  std::vector<RigCameraGeometry> cameras_;
  std::vector<std::string> intruders_;
  std::vector<std::vector<std::vector<Seen>>> seen_;  // by camera, intruder and frame
  std::mutex mutex_;
};

// By how much the distance to a point is wrong if the second camera's image is wrong by one pixel and the first
// camera's is right: 1 / |d pixel / d distance| along the ray of the first. None where the second has no image of the
// point, or where no distance moves it there: it lies on the line through both.
[[nodiscard]] std::optional<double> range_error_m_per_px(const RigCameraGeometry& first,
                                                         const RigCameraGeometry& second, const glm::dvec3& p_in_body);

}  // namespace sigs
