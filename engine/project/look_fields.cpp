// SPDX-License-Identifier: MIT
// The fields of light, compositing and appearance.
#include "project/field_list.h"

namespace sigs {

void add_light(FieldList list, LightSettings& light) {
  list.add("kind", choice_of(light.kind, {"point", "sun"}), "",
           "point: the paper's lamp and ambient light; sun: parallel light, sky and ground");
  list.number("position_m", &light.position_m, "m", -1e12, 1e12,
              "where the light is, in the world; it shines every way");
  list.number("color", &light.color, "", 0, 100, "red, green, blue in linear light; 1: white faces become white");
  list.number("ambient", &light.ambient, "", 0, 1, "share of the light that comes from everywhere");
  list.number("sun.azimuth_deg", &light.sun.azimuth_deg, "deg", -360, 360,
              "sun: from world X to the right; null: by time and place of the camera's log");
  list.number("sun.elevation_deg", &light.sun.elevation_deg, "deg", -90, 90,
              "sun: above the horizon; null: by time and place of the camera's log");
  list.number("sky_color", &light.sky_color, "", 0, 100, "sun: light of the whole sky on a face that looks up");
  list.number("ground_color", &light.ground_color, "", 0, 100, "sun: light of the ground on a face that looks down");
  list.number("exposure", &light.exposure, "", 0, 1000, "sun: factor of all light");
  list.number("ground_shadow", &light.ground_shadow, "", 0, 1,
              "sun: share of the light of level ground, z = 0, that an intruder's shadow takes; 0: none is drawn");
  list.number("white_cdpm2", &light.white_cdpm2, "cd/m2", 1e-6, 1e9,
              "luminance that the footage shows as white, for aircraft's lights; null: that of white paint in the sun");
}

void add_compositing(FieldList list, CompositingSettings& compositing) {
  list.add("method", choice_of(compositing.method, {"direct", "classic", "plain"}), "",
           "direct: layer through the lens; classic: the paper's section 3.2; plain: keyed paste");
  list.add("blend", choice_of(compositing.blend, {"linear", "display"}), "",
           "mix light, or mix code values as the paper does (direct only)");
  list.number("blur_px_per_m", &compositing.blur_px_per_m, "px/m", 0, 10,
              "Gaussian blur: sigma a metre of distance; null: 0.002 with classic, else 0");
  list.number("supersampling", &compositing.supersampling, "", 1, 8, "drawn pixels an image pixel, each way");
  list.add(
      "quality", choice_of(compositing.quality, {"exact", "auto", "draft"}), "",
      "exact: all is drawn alike; auto: smooth parts of near intruders with fewer pixels; draft: one pixel each way");
}

void add_appearance(FieldList list, AppearanceSettings& appearance) {
  list.number("psf_sigma_px", &appearance.psf_sigma_px, "px", 0, 20, "sigma of the lens' and the sensor's blur");
  list.number("sharpening", &appearance.sharpening, "", -0.9, 5,
              "the camera's own: how much of the detail is added; below 0 taken away, as a lens that glows does");
  list.number("sharpening_px", &appearance.sharpening_px, "px", 0.2, 20, "sigma of the blur that detail is told by");
  list.number("chroma_blur_px", &appearance.chroma_blur_px, "px", 0, 20,
              "blur of the colours alone, in samples of the chroma planes");
  list.number("black", &appearance.black, "", 0, 1, "linear light that is added to all of the intruder: flare");
  list.number("saturation", &appearance.saturation, "", 0, 4, "of the intruder's colours; 1: as painted");
  list.number("glare", &appearance.glare, "", 0, 1,
              "share of the light of aircraft's lights that the lens spreads wide");
  list.number("glare_px", &appearance.glare_px, "px", 0.2, 100, "sigma of that spread");
  GrainSettings& grain = appearance.grain;
  list.add("grain.source", choice_of(grain.source, {"made", "footage"}), "",
           "made: by the numbers below; footage: the noise that the intruder hides, made where that is texture");
  list.number("grain.sd_dark", &grain.sd_dark, "code", 0, 64, "noise of luma where the image is black");
  list.number("grain.sd_bright", &grain.sd_bright, "code", 0, 64, "noise of luma where the image is white");
  list.number("grain.sd_chroma", &grain.sd_chroma, "code", 0, 64, "noise of chroma");
  list.number("grain.correlation_length_px", &grain.correlation_length_px, "px", 0, 10,
              "sigma over which neighbours share noise; 0: none");
  list.number("grain.temporal_correlation", &grain.temporal_correlation, "", 0, 0.99,
              "correlation of the noise from frame to frame");
  list.number("grain.seed", &grain.seed, "", 0, 2e9, "another number gives other noise of the same kind");
  HazeSettings& haze = appearance.haze;
  list.number("haze.visibility_m", &haze.visibility_m, "m", 0.1, 1e7,
              "distance at which 5 % of the contrast is left; null: clear air");
  list.add("haze.airlight", choice_of(haze.airlight, {"behind", "color"}), "",
           "colour of the haze: as the footage is around the intruder, or airlight_color");
  list.number("haze.airlight_color", &haze.airlight_color, "", 0, 100, "red, green, blue in linear light");
  ThermalSettings& thermal = appearance.thermal;
  list.number("thermal.sky", &thermal.sky, "code", 0, 255, "thermal: code value of the clear sky");
  list.add("thermal.hot", choice_of(thermal.hot, {"white", "black"}), "", "thermal: how what is warm is shown");
  list.number("thermal.halo", &thermal.halo, "", 0, 5,
              "thermal: how much the camera takes away of the mean around each place; 0: no halo");
  list.number("thermal.halo_px", &thermal.halo_px, "px", 0.2, 1000, "thermal: sigma of the blur that this mean is of");
  list.add("codec.match", choice_of(appearance.codec.match, {"none", "footage", "h264", "mjpeg"}), "",
           "codec that the image around the intruder goes through once; footage: its own");
  list.number("codec.quantiser", &appearance.codec.quantiser, "", 0, 100,
              "QP of H.264, 0 to 51, or quality of MJPEG in percent; null: as the footage's stream says");
  list.number("codec.predicted_frames", &appearance.codec.predicted_frames, "", 0, 16,
              "frames before this one from which H.264 and MPEG carry what they left");
}

}  // namespace sigs
