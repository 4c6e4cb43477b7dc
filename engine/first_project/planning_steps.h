// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "appearance/surroundings.h"
#include "base/result.h"
#include "ego_motion/project_motion.h"
#include "first_project/first_project.h"
#include "scene/scene.h"
#include "telemetry/track.h"
#include "video/frame_source.h"

namespace sigs {

// The steps of planned_first_project(), in their order, each in a source of its own: first_look.cpp,
// first_match.cpp, first_flight.cpp.

// What tells the level in the footage.
enum class LevelBy {
  nothing,
  horizon,    // a straight one, which tells roll and pitch
  skyline,    // sky above woods, hills, houses: tells the pitch to some degrees
  sky,        // nothing but sky: the camera looks up, by an unknown angle
  ground,     // nothing but ground: the camera looks down, by an unknown angle
  all_round,  // 360 degree footage, which its camera has mostly levelled
};

// What a few frames of the footage show.
struct FirstLook {
  SurroundingsEstimate surroundings;  // light and sun
  LevelBy level_by = LevelBy::nothing;
  double roll_rad = 0, pitch_rad = 0;  // of the camera; guessed for `sky` and `ground`, 0 for `nothing` and `all_round`
  double cloud_cover = 0;              // share of the sky, 0..1
};

// Whether an image is as small as those of most thermal cameras: 640 by 512 px.
[[nodiscard]] inline bool is_as_small_as_thermal(const cv::Size& size_px) {
  return size_px.width <= 640 && size_px.height <= 512;
}

// Looks at up to 7 frames of the scene's range. Damaged ones are left out. The level is sought only where the scene
// does not know it. In gray footage with warm ground below a darker sky it is that of the skyline between them. A
// horizon (horizon/horizon.h) is taken where it lies within 4 degrees of the median in at least half of the frames;
// else a skyline in at least half of them; else sky, or ground, that fills at least half of them. Errors: those of
// FrameSource::read().
[[nodiscard]] Result<FirstLook> first_look(FrameSource& footage, const Scene& scene, const std::atomic<bool>* cancel);

// Sets the camera's attitude by what was seen; one note for camera.attitude_deg. A camera that looks up by more than 5
// degrees is taken to stand on the ground, where no log has its path.
[[nodiscard]] std::vector<FirstProjectNote> set_attitude(const FirstLook& look, bool has_path, Project& project);

// Sets the project's light by what was seen; one note for light.kind. Where no sky was seen the light stays.
[[nodiscard]] FirstProjectNote set_light(const FirstLook& look, Project& project);

// How a long step goes on: its share that is done, 0 to 1, and whether it is to end.
struct MatchControl {
  std::function<void(double share)> progress;  // called on the calling thread; may be empty
  const std::atomic<bool>* cancel = nullptr;   // set to true: ends soon with the error `interrupted`; may be null
};

// Makes the project's intruders look as if the footage's camera had filmed them: what `sigs appearance --into` writes,
// of the scene's range. What the footage does not tell gets the estimate's default. One note for each group of settings
// that belong together, with what was found, or why it is not known. Not known is here what needs the camera's height
// above the ground, which no footage states: the visibility.
//   footage  opened with Quantisers::read
// Errors: those of FrameSource::read(), interrupted.
[[nodiscard]] Result<std::vector<FirstProjectNote>> match_appearance(FrameSource& footage, const Scene& scene,
                                                                     Project& project, const MatchControl& control);

// Makes the project thermal where the footage has the colours of a thermal camera's palette (video/heat_palette.h).
// None: it has not.
// Errors: those of FrameSource::read(), interrupted.
[[nodiscard]] Result<std::optional<FirstProjectNote>> set_palette(FrameSource& footage, const Scene& scene,
                                                                  Project& project, const std::atomic<bool>* cancel);

// What footage looks like beside footage by day.
struct DarkOrThermal {
  std::optional<FirstProjectNote> note;
  bool is_lit = true;  // by day, so that what was found of its light counts
};

// Makes the project thermal or one of the night, where the footage looks so: a guess, which the note says. Thermal: it
// is gray, and its ground is brighter than its sky, as things that are warm are, or there is no ground and the image is
// as small as most thermal ones; or it has a palette. Then the sky's code value is by the footage, the halo's width by
// the image's, and the visible light's estimates are taken back; a palette whose ground has less heat than its sky runs
// the other way. Night: half of it is darker than code 25 of 8 bits. Then the intruder is lit as dark. Small gray
// footage by day may be thermal with what is warm dark, which the note says.
//   project  after match_appearance()
// Errors: those of FrameSource::read(), interrupted.
[[nodiscard]] Result<DarkOrThermal> set_dark_or_thermal(FrameSource& footage, const Scene& scene, Project& project,
                                                        const std::atomic<bool>* cancel);

// The camera's turns as the images show them (ego_motion).
struct FirstMotion {
  std::optional<FocalScale> focal;  // the lens is another one: of its focal length; the track is by that
  std::optional<Track> track;       // attitudes on the footage's time axis; none: the camera's attitude stays as it is
  FoundAttitudes attitudes;         // of the track, for follow_attitudes(), without the file's name
  FirstProjectNote note;            // what was found, or why there is none
};

struct FirstMotionOptions {
  bool horizon_is_seen = true;   // false: an edge that may look like one does not count
  bool lens_is_guessed = false;  // the focal length may be that which the turns show
  const Track* log = nullptr;    // of the flight, with angular rates or none; its positions become the track's
};

// Finds them where they help. None where the camera stands still (no more than half a pixel; three where there are cuts
// or jerks between), where more than a twentieth of the frames used are lost, where nothing tells the turn of a frame
// within a pixel, and for footage longer than 90 s. Error: interrupted.
[[nodiscard]] Result<FirstMotion> first_motion(FrameSource& footage, const Scene& scene,
                                               const FirstMotionOptions& options, const MatchControl& control);

// The flight of a first project's intruder.
struct FirstFlight {
  std::vector<WaypointSettings> waypoints;
  Visibility visibility;
  double raise_m = 0;  // how much higher the camera has to be for the intruder to stay above the ground
  FirstProjectNote note;
};

// A flight in front of the camera, in view in as many frames of the scene's range as can be, at a speed of aircraft of
// the model's size. Of these the first is taken that is in view in 95 % of the frames, else the best one:
//   crossing   straight across the image, nearest in the middle of the range
//   turn       in from one side, a turn away from the camera in the middle of the range, out on the other side
//   approach   towards the camera, passing it after the range's end
// At its nearest it is 20 to 60 px large: 3 % of the image's width within these. It crosses the middle column of the
// image just above the horizon where the scene knows that and it is in the image, else a little above the middle; where
// the camera looks up by more than 5 degrees, near the middle, so that the intruder is seen from below, and where it
// looks down, from above. Flight is level. Where the camera turns in one direction by more than 10 degrees, the flight
// follows. A range of one frame has a waypoint in that frame and one after it.
//   scene  with camera, motion, footage and range; without intruders
[[nodiscard]] FirstFlight first_flight(Scene scene, const std::shared_ptr<const Model>& model);

}  // namespace sigs
