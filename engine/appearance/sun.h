// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "appearance/estimate.h"
#include "appearance/light_image.h"
#include "camera/camera.h"
#include "project/project.h"

namespace sigs {

enum class SunEvidence { none, given, shadows, sky };

// Where the sun is, rad. Azimuth from world X to the right, elevation above the horizon (SunSettings, in rad).
struct SunEstimate {
  Estimate azimuth_rad;                      // not known: behind the camera: what people point a camera at is lit
  Estimate elevation_rad;                    // not known: 25 degrees
  SunEvidence evidence = SunEvidence::none;  // of the azimuth
};

// Where the sun is by time and place. While the footage is taken it moves by the two ranges.
struct GivenSun {
  glm::dvec3 to_sun_in_world{0};  // in the middle of the footage, of any length but 0
  double azimuth_range_rad = 0;
  double elevation_range_rad = 0;
};

// By what an azimuth of this witness was found, for people: "by time and place". Empty for none.
[[nodiscard]] std::string how_found(SunEvidence evidence);

// The unit vector towards the sun, world axes (Z down).
[[nodiscard]] glm::dvec3 to_sun_of(double azimuth_rad, double elevation_rad);

// Finds the sun's direction. It needs the camera's calibration and the level (an attitude, or a skyline: world X is
// then the camera's heading). Two witnesses:
//
// shadows  The ground ahead, at depressions of 24 to 60 degrees, is laid flat. Dark long patches on it that lie by
//          themselves are shadows; their common direction is the sun's azimuth, but for its sense, which the ends
//          tell: at one stands what casts the shadow, the other one is bare ground. Known where 10 patches or more are
//          there and three quarters of them agree.
// sky      A clear sky is brighter around the sun: CIE's standard clear sky (ISO 15469, type 12) is fitted to the
//          luminance of the sky by azimuth, with a free factor for each elevation. Known where it explains 0.8 of the
//          differences and these are more than lenses give. It alone tells the elevation.
//
// Both are unsure: their deviations are tens of degrees unless the patches are many. A direction that is given (by time
// and place) stands before both.
class Sun {
 public:
  // image: of this frame.
  void add(const Frame& frame, const LightImage& image);
  [[nodiscard]] SunEstimate finish(const std::optional<GivenSun>& given = std::nullopt) const;

  // A dark patch on the ground.
  struct Patch {
    double direction_rad = 0;  // of its axis, from world X to the right, modulo a half turn
    double weight = 0;
    double sense = 0;  // above 0: what casts it stands at its beginning, so that it points away from the sun
  };
  static constexpr int kAzimuths = 72, kElevations = 14;  // of 5 degrees each

 private:
  struct SkyBin {
    double sum = 0, count = 0;
    double from_axis = 0;  // sum of angles
  };

  void add_sky(const LightImage& image, const glm::dquat& world_from_camera);
  void add_ground(const Frame& frame, const LightImage& image, const glm::dquat& world_from_camera);
  void set_by_shadows(SunEstimate& sun) const;
  void set_by_sky(SunEstimate& sun) const;

  std::array<std::array<SkyBin, kAzimuths>, kElevations> sky_{};
  std::vector<Patch> patches_;
  double blue_cells_ = 0, sky_cells_ = 0;
  int frames_ = 0, with_level_ = 0;
};

// The sun's direction in the settings. One that was given stays as it is there: time and place tell it at each frame.
void apply(const SunEstimate& sun, LightSettings& settings);

// The long dark patches on the ground ahead of the camera, laid flat; see Sun.
//   luma               CV_8UC1, of the camera's size
//   world_from_camera  attitude against the level
//   own_body           CV_8UC1 of the same size, above 127 where hidden; may be empty
[[nodiscard]] std::vector<Sun::Patch> shadow_patches(const cv::Mat& luma, const Camera& camera,
                                                     const glm::dquat& world_from_camera, const cv::Mat& own_body);

// Mean luminance of a part of the sky.
struct SkySample {
  double azimuth_rad = 0, elevation_rad = 0;
  double luminance = 0;      // above 0
  double from_axis_rad = 0;  // from the camera's axis
  int band = 0;              // those of equal elevation have the same; from 0
};

// The direction of the sun that a clear sky's brightness around it tells.
struct SkySun {
  double azimuth_rad = 0, elevation_rad = 0;
  double azimuth_sd_rad = 0, elevation_sd_rad = 0;
};

// Scattering indicatrix of CIE's standard clear sky (ISO 15469:2004, type 12: c = 10, d = -3, e = 0.45): brightness at
// an angle from the sun, in parts of that at 90 degrees.
[[nodiscard]] double clear_sky_indicatrix(double angle_rad);

// The sun whose indicatrix explains the samples best, each band with a factor of its own, since haze makes elevations
// differ, and with a fall of brightness by the square of the angle from the camera's axis, as lenses have. Nothing
// where it explains less than 0.8 of the variance that these leave, where that is small (a quarter of the luminance
// from end to end), or where there are fewer than 12 samples in 2 bands.
[[nodiscard]] std::optional<SkySun> sun_of_sky(const std::vector<SkySample>& samples);

}  // namespace sigs
