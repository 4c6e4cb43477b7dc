// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "base/pose.h"
#include "camera/lens_model.h"
#include "project/look_settings.h"
#include "video/heat_palette.h"

namespace sigs {

// Part of a project (project.h): the footage, the camera that took it or several of them, and where the world lies on
// the Earth.

// What the camera's sensor responds to: light, or the heat that things send out (long-wave infrared).
enum class Spectrum { visible, thermal };

// The part of the footage's image that is the camera's: one eye of a stereo camera that stores both side by side, one
// circle of two fisheye lenses, an image between black bars. The upper left pixel is (left_px, top_px).
struct CropSettings {
  int left_px = 0;
  int top_px = 0;
  int width_px = 0;   // 0: to the right edge
  int height_px = 0;  // 0: to the lower edge

  [[nodiscard]] bool operator==(const CropSettings&) const = default;
};

// The background: which video, which of its frames, and the camera that took it.
struct FootageSettings {
  std::string video;                    // a file, a folder of images, or a pattern such as images/%06d.png
  std::optional<double> frame_rate_hz;  // of images; none: not known
  std::string timestamps;               // file with the time of each image; empty: evenly spaced
  int first_frame = 0;
  std::optional<int> last_frame;  // the last one used; none: the footage's last
  CropSettings crop;              // pixels, calibration and masks are those of what is left
  std::string calibration;
  std::string own_body_mask;  // empty: none
  // What stands in the world nearer than the intruders, such as trees: a mask of one frame. Empty: nothing.
  std::string occluder_mask;
  int occluder_frame = 0;          // the frame that the mask was made of, counted from 0
  double occluder_distance_m = 0;  // intruders nearer than this are before it; 0: none is
  // From which distance on the footage's clouds hide intruders; none: they hide none. It is assumed: no camera tells
  // it.
  std::optional<double> cloud_distance_m;
  double cloud_depth_m = 200;  // from there, over which they become as thick as they look
  std::string real_aircraft;   // file with the boxes of aircraft that the footage itself shows; empty: none
  Spectrum spectrum = Spectrum::visible;
  HeatPalette palette = HeatPalette::gray;  // of thermal footage
  // Of the calibration's numbers; none: as the file states or, where it does not, judged by its numbers
  // (docs/calibration-files.md).
  std::optional<LensModel> lens_model;
  double max_substituted_percent = 1;  // of the exported frames; more damaged ones are an error

  [[nodiscard]] bool operator==(const FootageSettings&) const = default;
};

// The method that finds the UAV's own body: the project's own one, or that of section 4 of the paper.
enum class OwnBodyMethod { stable, paper };

// Section 4 of the paper. Where the paper gives no number, 0 means: chosen for the clip (occlusion/README.md).
struct PaperOwnBodySettings {
  double canny_low = 0;
  double canny_high = 0;
  int dilation_px = 0;
  int closing_px = 0;
  double min_area_percent = 0.5;  // of the image; paper section 4.2

  [[nodiscard]] bool operator==(const PaperOwnBodySettings&) const = default;
};

// Parameters of the method `stable` (occlusion/README.md).
struct StableOwnBodySettings {
  double vibration_px = 2;
  double min_area_percent = 0.1;
  double min_moving_percent = 5;

  [[nodiscard]] bool operator==(const StableOwnBodySettings&) const = default;
};

// How the UAV's own body is found in the footage (occlusion/detect.h).
struct OwnBodySettings {
  OwnBodyMethod method = OwnBodyMethod::stable;
  int frames = 1500;
  int every = 1;
  double settled_percent = 0;
  double soft_edge_px = 1;
  PaperOwnBodySettings paper;
  StableOwnBodySettings stable;

  [[nodiscard]] bool operator==(const OwnBodySettings&) const = default;
};

// Which attitude of a flight log is used: the camera's or gimbal's where it has one, else the airframe's; one of the
// two; or none.
enum class TrackAttitudeChoice { automatic, camera, airframe, none };

// Whether the log's positions are used: where it has some; always (it is an error if it has none); never.
enum class TrackPositionChoice { automatic, log, none };

// How the camera sits on what the log's attitude describes: at camera.attitude_deg, the mount's angles; not at all, as
// that attitude is the camera's own; or as the log itself says (Track::attitude_is_whole), else at camera.attitude_deg.
enum class TrackMountChoice { automatic, attitude_deg, none };

// What happens with a log that is damaged or does not cover all frames: it is an error, or its sound part is used.
enum class IncompleteTrackChoice { refuse, use };

// The flight log by which the camera moves (telemetry/track.h).
struct TrackSettings {
  std::string file;     // empty: none
  double offset_s = 0;  // time in the log at the footage's frame 0
  TrackPositionChoice position = TrackPositionChoice::automatic;
  TrackAttitudeChoice attitude = TrackAttitudeChoice::automatic;
  TrackMountChoice mount = TrackMountChoice::automatic;
  IncompleteTrackChoice incomplete = IncompleteTrackChoice::refuse;

  [[nodiscard]] bool operator==(const TrackSettings&) const = default;
};

// Where a camera of a rig sits on the aircraft: in the axes of that (X out of the nose, Y right, Z down).
struct MountSettings {
  glm::dvec3 position_m{0, 0, 0};
  double roll_deg = 0;
  double pitch_deg = 0;
  double yaw_deg = 0;

  [[nodiscard]] bool operator==(const MountSettings&) const = default;
};

// Position, mounting and speed of the camera or, in a project with several of them, of the aircraft that carries them.
// The world's X axis is its heading at frame 0.
struct CameraSettings {
  glm::dvec3 position_m{0, 0, -150};  // world, at frame 0 (paper section 3.1.3)
  std::optional<double> roll_deg;     // none: not known; mount_attitude() takes it as 0
  std::optional<double> pitch_deg;    // likewise
  double yaw_deg = 0;
  std::string attitude_file;  // attitude, at each frame, of what carries the camera; empty: level
  double speed_mps = 0;       // along world X
  TrackSettings track;
  std::optional<double> readout_s;   // of the rolling shutter, first to last row; none: as the log says, else 0
  std::optional<double> exposure_s;  // how long the shutter is open; none: as the log says, else 0

  [[nodiscard]] bool operator==(const CameraSettings&) const = default;
};

// Where the world lies on the Earth (geo/geodetic.h): the place of its origin and the heading of X. Without place or
// heading they come from the camera's log, where it has them.
struct GeoSettings {
  std::optional<double> latitude_deg;
  std::optional<double> longitude_deg;
  std::optional<double> height_m;     // of the world's plane z = 0 above the WGS-84 ellipsoid
  std::optional<double> heading_deg;  // of world X, from true north to the right

  [[nodiscard]] bool operator==(const GeoSettings&) const = default;
};

// The clock of a camera of a rig. The rig's time is that of its first camera.
struct ClockSettings {
  double offset_s = 0;   // the rig's time at the camera's frame 0
  double drift_ppm = 0;  // by which the camera's seconds are longer than the rig's

  [[nodiscard]] double rig_time_s(double camera_time_s) const {
    return offset_s + camera_time_s * (1 + drift_ppm * 1e-6);
  }
  [[nodiscard]] bool operator==(const ClockSettings&) const = default;
};

// One of several cameras of an aircraft.
struct RigCamera {
  std::string name;
  FootageSettings footage;
  MountSettings mount;
  ClockSettings clock;
  std::optional<double> readout_s;               // as in CameraSettings
  std::optional<double> exposure_s;              // likewise
  std::optional<AppearanceSettings> appearance;  // none: the project's
  std::string unknown_json;

  [[nodiscard]] bool operator==(const RigCamera&) const = default;
};

// The camera of a rig through which a project is seen (project/project.h).
struct RigView {
  std::size_t camera = 0;
  std::string name;
  MountSettings mount;
  ClockSettings clock;
  FootageSettings reference;      // of the first camera: waypoints count its frames
  MountSettings reference_mount;  // of the first camera: a log of a camera's own attitude is that one's
  bool has_own_appearance = false;

  [[nodiscard]] bool operator==(const RigView&) const = default;
};

}  // namespace sigs
