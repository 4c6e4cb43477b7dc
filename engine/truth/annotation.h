// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "geo/geodetic.h"

namespace sigs {

// Where a body lies against the horizon: the plane through the camera, level in the world (flat ground without end).
// unknown: the camera's attitude is not given, so the position of the footage's horizon is not known.
enum class HorizonSide { below, on, above, unknown };

[[nodiscard]] constexpr std::string_view name_of(HorizonSide side) {
  switch (side) {
    case HorizonSide::below:
      return "below";
    case HorizonSide::on:
      return "on";
    case HorizonSide::above:
      return "above";
    case HorizonSide::unknown:
      break;
  }
  return "unknown";
}

// The side of that name; none: there is none.
[[nodiscard]] constexpr std::optional<HorizonSide> horizon_side_named(std::string_view name) {
  for (const HorizonSide side : {HorizonSide::below, HorizonSide::on, HorizonSide::above, HorizonSide::unknown})
    if (name == name_of(side)) return side;
  return std::nullopt;
}

// How well an intruder stands out in one frame (truth/measure.h).
struct Detectability {
  double weber_contrast = 0;   // (L - B) / B: mean luminance of its visible pixels and of the footage there and around
  double rms_contrast = 0;     // root of the mean of (l - B)^2 over its visible pixels, by B
  double signal_to_noise = 0;  // difference of the means of luma, by the standard deviation of luma in the footage
};

// What was done to an intruder's image in one frame.
struct ImageFormation {
  double blur_px = 0;                       // sigma of its Gaussian blur
  double motion_blur_px = 0;                // length of its way in the image while the shutter is open
  std::optional<double> visibility_m = {};  // at which haze leaves 5 % of the contrast; none: clear air
};

// One of an intruder's lights that adds to the image (docs/aircraft-lights.md).
struct LampTruth {
  std::string name;        // "left", "right", "tail", "strobe left", ..., "beacon top", "beacon bottom", "landing"
  glm::dvec2 pixel{0, 0};  // where it is seen
  double share = 1;        // of the exposure during which it is on
  double brightest = 0;    // linear light that it adds to the pixel it adds most to; 1: white
};

// What the footage's clouds do to an intruder.
struct CloudTruth {
  double hidden = 0;              // of its coverage that own body and occluder leave, 0..1
  double assumed_distance_m = 0;  // of the clouds: no camera tells it
};

// Well clear of an intruder at one time, for one volume.
struct WellClearTruth {
  std::string volume;  // its name, "dwc-en-route"
  bool is_lost = false;
  double tau_mod_s = 0;  // for the volume's DMOD; infinite: the horizontal distance does not fall
  double severity = 0;   // of the loss, 0..100
};

// How an intruder moves against the camera's platform at one time. docs/encounters.md has the formula of each.
struct EncounterTruth {
  double range_rate_mps = 0;                    // negative while the distance falls
  double closing_speed_mps = 0;                 // the same with the other sign
  double bearing_rad = 0;                       // to the right of the ownship's course over ground
  double elevation_rad = 0;                     // above the horizontal plane through the camera
  double hmd_m = 0;                             // horizontal distance at closest approach, on straight flight
  double vmd_m = 0;                             // likewise how much higher the intruder is
  double time_to_closest_approach_s = 0;        // on straight flight
  double time_to_coaltitude_s = 0;              // infinite: it does not come
  std::vector<WellClearTruth> of_volumes = {};  // in the order of LabelSequence::volumes
};

// The truth of one intruder in one frame. docs/annotation-format.md has the formula of each.
struct IntruderTruth {
  int id = 0;
  std::string name;
  glm::dvec3 position_m{0, 0, 0};          // of the reference point, in the camera frame
  glm::dquat world_from_body{1, 0, 0, 0};  // its attitude
  bool in_image = false;                   // some of it lies within the image and in front of the lens, hidden or not
  double visible_fraction = 0;             // of the whole silhouette's area: what lies in the image and is not hidden
  std::optional<cv::Rect> visible_box;     // visible pixels; none where nothing is visible
  cv::Mat visible;         // CV_8UC1 over visible_box: 255 where a pixel shows it, else 0; empty: not measured
  int visible_pixels = 0;  // how many of them there are
  std::optional<cv::Rect> other_box = {};  // visible pixels of its smaller part across the sides of a 360 degree image
  int other_pixels = 0;                    // how many of them there are
  std::optional<Box> amodal_box;           // the whole of it through the lens; none where no part of it has an image
  HorizonSide horizon = HorizonSide::unknown;  // above or below: all of it is
  double inside_fraction = 0;                  // of the whole silhouette's area: what lies in the image, hidden or not
  std::optional<GeodeticPosition> place = {};  // of the reference point; none where the world has no place on the Earth
  std::optional<Detectability> detectability = {};  // none where no pixel shows it
  ImageFormation image_formation = {};
  std::optional<EncounterTruth> encounter = {};  // none where it was not asked for
  bool has_contrail = false;                     // some of its contrail is in the image; no box or mask has it
  bool has_shadow = false;                       // likewise of its shadow on the ground
  std::vector<LampTruth> lights = {};            // those that are on and bright enough to change the image
  bool lights_alone = false;              // its body changes nothing: what is visible, box included, is its lights
  std::optional<CloudTruth> clouds = {};  // none where the project's clouds hide nothing
  bool is_distractor = false;             // what detectors should not report, such as a bird
};

// What the frames are counted in, and which of them a set of labels holds.
struct FootageTruth {
  std::string video;  // file name without folder
  cv::Size size_px;
  int first_frame = 0;
  int last_frame = 0;  // included
  int frame_rate_num = 25;
  int frame_rate_den = 1;
};

// What is known of the camera's pose beyond the pose itself.
struct CameraTruth {
  std::string
      position_source;  // where it comes from, "PX4 ULog: vehicle_local_position"; empty: the project's settings
  std::string attitude_source;
  std::optional<glm::dvec3> attitude_sd_rad =
      {};                                      // of small turns about the camera's X, Y, Z; infinite: not known here
  std::optional<GeodeticPosition> place = {};  // none where the world has no place on the Earth
};

struct FrameTruth {
  int index = 0;  // counts the footage's frames from 0
  double time_s = 0;
  bool substituted = false;                  // the footage's own frame is damaged and substituted by another one
  glm::dvec3 camera_position_m{0, 0, 0};     // in the world
  glm::dquat world_from_camera{1, 0, 0, 0};  // its attitude
  CameraTruth camera = {};
  std::vector<IntruderTruth> intruders;      // by id
  std::vector<cv::Rect> real_aircraft = {};  // boxes, within the image, of aircraft that the footage itself shows
};

}  // namespace sigs
