// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace sigs {

// Part of a project (project.h): how intruders become part of the image, and how the footage looks.

// How the intruder gets into the image: directly through the lens, by section 3.2 of the paper, or by a keyed paste;
// and whether light is mixed, which adds as in the lens, or code values, as the paper does. No project states `heat`:
// code values as sRGB has them whatever the footage's curve, since they stand for heat, and none clips before the
// stages that follow.
enum class MethodChoice { direct, classic, plain };
enum class BlendChoice { linear, display, heat };

// How much of the drawing is saved: nothing; what changes the image by less than a stated error (docs/accuracy.md); or
// whatever a look does not need.
enum class QualityChoice { exact, automatic, draft };

// The blur by distance with which SIGS follows the paper, which gives no number: sigma 2 px at 1 km.
inline constexpr double kPaperBlur_px_per_m = 0.002;

// How layers become part of the image. blur_px_per_m: standard deviation of the Gaussian blur for each metre of
// distance, none: blur_by_distance_px_per_m(); supersampling: rendered pixels for each image pixel, along each axis.
struct CompositingSettings {
  MethodChoice method = MethodChoice::direct;
  BlendChoice blend = BlendChoice::linear;
  std::optional<double> blur_px_per_m;
  int supersampling = 3;
  QualityChoice quality = QualityChoice::exact;

  [[nodiscard]] bool operator==(const CompositingSettings&) const = default;
};

// As the settings state it, else by the method: the paper's for `classic`; 0 for `direct`, since lenses blur what is
// far no more than what is near (AppearanceSettings::psf_sigma_px).
[[nodiscard]] inline double blur_by_distance_px_per_m(const CompositingSettings& compositing) {
  return compositing.blur_px_per_m.value_or(compositing.method == MethodChoice::classic ? kPaperBlur_px_per_m : 0.0);
}

// Rendered pixels for each image pixel, along each axis, where all is drawn alike.
[[nodiscard]] inline int drawn_px_per_px(const CompositingSettings& compositing) {
  return compositing.quality == QualityChoice::draft ? 1 : compositing.supersampling;
}

// Where an intruder's noise comes from: it is made by the numbers, or it is that of the footage which the intruder
// hides, and made where that is textured or clipped.
enum class GrainSource { made, footage };

// Random noise of the footage, in 8-bit code values, as the codec left it. Its variance is linear in brightness.
struct GrainSettings {
  GrainSource source = GrainSource::made;
  double sd_dark = 0;    // standard deviation of luma where the image is black
  double sd_bright = 0;  // where it is white
  double sd_chroma = 0;  // of both chroma planes
  double correlation_length_px =
      0;  // sigma of the Gaussian that neighbouring pixels share noise by; 0: each has its own
  double temporal_correlation = 0;  // correlation from one frame to the next, 0..1
  int seed = 1;

  [[nodiscard]] bool is_none() const { return sd_dark == 0 && sd_bright == 0 && sd_chroma == 0; }
  [[nodiscard]] bool operator==(const GrainSettings&) const = default;
};

// Where the haze's colour comes from: the footage around the intruder, or a colour that is given.
enum class AirlightChoice { behind, color };

// Haze in front of the intruder (Koschmieder): contrast falls by exp(-3 r / visibility_m).
struct HazeSettings {
  std::optional<double> visibility_m;  // at which 5 % of the contrast is left; none: clear
  AirlightChoice airlight = AirlightChoice::behind;
  glm::dvec3 airlight_color{0.6, 0.65, 0.7};  // linear light

  [[nodiscard]] bool operator==(const HazeSettings&) const = default;
};

// One generation of compression that the image around the intruder goes through: none, the footage's own codec, or one
// that is named.
enum class CodecMatchChoice { none, footage, h264, mjpeg };

struct CodecMatchSettings {
  CodecMatchChoice match = CodecMatchChoice::none;
  int predicted_frames = 0;         // images before this one that H.264 or MPEG has predicted from one another, 0..16
  std::optional<double> quantiser;  // QP of H.264 (0..51) or percent of JPEG's table; none: as the stream says

  [[nodiscard]] bool operator==(const CodecMatchSettings&) const = default;
};

// Which end of the scale things that are warm have.
enum class HotChoice { white, black };

// Of thermal footage: its scale, and the camera's enhancement of local contrast, by which a warm thing darkens what is
// around it.
struct ThermalSettings {
  double sky = 96;  // 8-bit code value of the clear sky
  HotChoice hot = HotChoice::white;
  double halo = 0.9;    // how much of the surroundings' mean is taken away, 0..5
  double halo_px = 32;  // sigma of the Gaussian that this mean is taken by

  [[nodiscard]] bool operator==(const ThermalSettings&) const = default;
};

// How the footage looks, and so how an intruder in it has to look (method direct). Each part but the point
// spread is left out at its default.
struct AppearanceSettings {
  double psf_sigma_px = 0.45;  // sigma of the lens' and the sensor's Gaussian
  double sharpening = 0;       // of the camera: how much of the detail is added, 0..5
  double sharpening_px = 1;    // sigma of the Gaussian that detail is told by
  double chroma_blur_px = 0;   // sigma of the Gaussian over the samples of the chroma planes
  double black = 0;            // linear light that the footage's black stands for: flare of the lens
  double saturation = 1;       // of the intruder's colours
  double glare = 0.05;         // share of the light of aircraft's lamps that the lens spreads wide
  double glare_px = 6;         // sigma of that
  GrainSettings grain;
  HazeSettings haze;
  ThermalSettings thermal;  // used with Spectrum::thermal
  CodecMatchSettings codec;

  [[nodiscard]] bool operator==(const AppearanceSettings&) const = default;
};

}  // namespace sigs
