// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "camera/lens.h"
#include "scene/scene.h"
#include "scene/scene_at.h"
#include "truth/annotation.h"

namespace sigs {

// The lights that an aircraft shows, as points in the image (docs/aircraft-lights.md).

// One kind of light at one place of an aircraft.
struct Lamp {
  enum class Kind { left, right, tail, strobe_left, strobe_right, strobe_tail, beacon_top, beacon_bottom, landing };
  Kind kind = Kind::left;
  glm::dvec3 place_m{0, 0, 0};  // body axes
  glm::dvec3 color{1, 1, 1};    // linear light of luminance 1
  bool flashes = false;
  double lag = 0;  // of its flashes behind those of the strobes, in flashes
};

// Those that the settings switch on.
[[nodiscard]] std::vector<Lamp> lamps_of(const LampSettings& settings, const LampPlaces& places);

// Luminous intensity of a lamp in a direction away from the aircraft, cd; of one that flashes during its flash. Sectors
// and angles are those of 14 CFR 25.1385 to 25.1401, from the least intensities of one angle to those of the next
// linearly.
//   direction  unit vector, body axes
[[nodiscard]] double intensity_cd(const Lamp& lamp, const LampSettings& settings, const glm::dvec3& direction);

// Share of an exposure during which a flashing lamp is on, 0..1.
//   middle_s, exposure_s  the exposure's middle and length, > 0
[[nodiscard]] double share_of_exposure(const Lamp& lamp, const LampSettings& settings, double middle_s,
                                       double exposure_s);

// A lamp as the camera sees it in one frame.
struct LampImage {
  const char* name = "";
  glm::dvec2 pixel{0, 0};
  cv::Vec3d light{0, 0, 0};  // linear light, the sum over all pixels; 1: one pixel is white
  double share = 1;
};

// Those of an intruder that shine towards the camera while the shutter is open. A shutter of which no time is known is
// open for 1/500 s.
[[nodiscard]] std::vector<LampImage> lamp_images(const Scene& scene, const SceneMoment& moment,
                                                 const PlacedIntruder& placed, const Lens& lens);

// How a lamp's light is spread: a Gaussian for most of it and a wide one for a share.
struct LampSpread {
  double sigma_px = 0;
  double glare = 0;  // share, 0..1
  double glare_px = 0;
  double widening = 1;  // how much wider both are across (widening_at in compositor/blur.h)
};

// A point's light over the pixels within bounds where it adds at least a quarter of the darkest 8-bit code. It adds to
// what lies behind and hides nothing: its opacity is next to 0. Empty: it is too faint.
struct LampLayer {
  Layer layer;
  double brightest = 0;  // linear light (luminance) of its brightest pixel
};
// What is left of a lamp's light once something hides a part of it. Empty: less than that in each pixel.
[[nodiscard]] LampLayer with_layer(Layer layer);
[[nodiscard]] LampLayer lamp_layer(const LampImage& lamp, const LampSpread& spread, const cv::Rect& bounds);

}  // namespace sigs
