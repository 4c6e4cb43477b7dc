// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "geo/geodetic.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"
#include "telemetry/track.h"

namespace sigs {

// What a flight log makes of the camera's motion and of the world's place on the Earth.
struct CameraFlight {
  CameraMotion motion;
  std::optional<LocalFrame> earth;
  std::optional<double> utc_at_frame_0_s;
  bool horizon_is_known = false;
  std::vector<Warning> warnings;
};

// The camera's flight without any file (steady_motion), with the world on the Earth where the project states it.
[[nodiscard]] CameraFlight steady_flight(const Project& project);

// Makes the flight that of the scene; its warnings join those of the scene.
void set_camera_motion(Scene& scene, CameraFlight flight);

// The camera's motion of a project: constant speed and attitude as it states them, and what its attitude file and its
// log (camera.track) know better.
//
// Position: the log's geodetic positions, else its local ones, joined by a C2 cubic spline. Where the project states
// latitude and longitude of the world's origin, geodetic positions are absolute; else the camera is at
// camera.position_m at the footage's frame 0 and the log adds the displacement since.
// Attitude: world_from_ned * (the log's attitude) * (camera.attitude_deg), the last one being the mount's angles. Where
// the log's attitude is the camera's own (camera.track.mount, Track::attitude_is_whole), camera.attitude_deg is that of
// the camera at the start, and only what the log does not know of it counts: (camera.attitude_deg) * (turn) for a log
// that knows turns since its first sample alone (Track::level_is_known), whatever the mount; (its yaw) * (the log's
// attitude) for one that knows the level but not north; else nothing of it.
// World X: geo.heading_deg; else the heading of what carries the camera at frame 0, if the log has it against north;
// else the course over ground there, if it moves by more than 1 m/s; else north, with a warning.
// Readout: camera.readout_s, else the log's, else 0. Exposure time: likewise, by camera.exposure_s.
//
// A problem at camera.track.file: it cannot be read, has nothing of what the settings ask for (no attitude, unless
// camera.track.attitude is none), is damaged or does not
// cover the project's frames, or knows the attitude in less than half of them by its own standard deviation (all
// allowed by camera.track.incomplete: use), or covers none of them.
//   range  the project's frames
[[nodiscard]] Result<CameraFlight, Problem> camera_flight(const Project& project, const FootageShape& footage,
                                                          const FrameRange& range, SceneFiles& files);

// The same by a log that has been read; camera.track.file and camera.attitude_file are not looked at.
[[nodiscard]] Result<CameraFlight, Problem> flight_by_log(const Project& project, const Track& track,
                                                          const FootageShape& footage, const FrameRange& range);

}  // namespace sigs
